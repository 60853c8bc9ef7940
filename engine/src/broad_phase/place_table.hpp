// SPDX-License-Identifier: Apache-2.0
#pragma once

// The places of those bodies that have boxes of their own: a disk in a cell has its cell's, and
// needs no line here.

#include "broad_phase/place.hpp"

#include <cstdint>
#include <vector>

namespace stoss::engine {

class PlaceTable {
 public:
  bool contains(std::int32_t item) const {
    return index(item) < line_of_.size() && line_of_[index(item)] != kNone;
  }
  /// REQUIRES: contained.
  Place& of(std::int32_t item) { return places_[index(line_of_[index(item)])]; }
  const Place& of(std::int32_t item) const { return places_[index(line_of_[index(item)])]; }

  /// Its place, an empty one if it had none.
  Place& make(std::int32_t item) {
    if (index(item) >= line_of_.size()) line_of_.resize(index(item) + 1, kNone);
    std::int32_t& line = line_of_[index(item)];
    if (line == kNone && free_.empty()) {
      line = static_cast<std::int32_t>(places_.size());
      places_.emplace_back();
    } else if (line == kNone) {
      line = free_.back();
      free_.pop_back();
      places_[index(line)] = Place{};
    }
    return places_[index(line)];
  }

  void drop(std::int32_t item) {
    if (!contains(item)) return;
    free_.push_back(line_of_[index(item)]);
    line_of_[index(item)] = kNone;
  }

 private:
  static constexpr std::int32_t kNone = -1;
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<Place> places_;
  std::vector<std::int32_t> line_of_;  // of each item, in places_
  std::vector<std::int32_t> free_;
};

}  // namespace stoss::engine

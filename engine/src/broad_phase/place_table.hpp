// SPDX-License-Identifier: Apache-2.0
#pragma once

// The places of those bodies that have boxes of their own, which are few: a disk in a cell has its
// cell's. Whose line is which is known to whoever has put it in.

#include "broad_phase/place.hpp"

#include <cstdint>
#include <vector>

namespace stoss::engine {

class PlaceTable {
 public:
  Place& of(std::int32_t line) { return places_[index(line)]; }
  const Place& of(std::int32_t line) const { return places_[index(line)]; }

  /// Of an empty place of a body.
  std::int32_t make(std::int32_t body) {
    std::int32_t line;
    if (free_.empty()) {
      line = static_cast<std::int32_t>(places_.size());
      places_.emplace_back();
    } else {
      line = free_.back();
      free_.pop_back();
      of(line) = Place{};
    }
    of(line).body = body;
    return line;
  }

  void drop(std::int32_t line) { free_.push_back(line); }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<Place> places_;
  std::vector<std::int32_t> free_;
};

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// From ids to slots. An entry is a slot alone: whose it is, its body tells. Open addressing with
// linear probing; entries behind a removed one move up, so that there are no tombstones and a world
// that spawns and removes for months stays as fast as it was.
//
// Source: Knuth, The Art of Computer Programming 3, section 6.4, algorithms L and R, with his
// multiplicative hash. Deviations: the hash, as a fraction of 2^64, times the number of places is
// an id's home (Lemire, ACM TOMACS 29 (2019) 3), so that there may be any number of them; ids that
// follow each other stand side by side, so that many are found in a line of memory.
//
// Invariants: 1. an id's slot stands at the id's home or in the run of entries from there;
// 2. at most 5/8 of the places are taken. Looked up, never iterated.

#include "body.hpp"
#include "prefetch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stoss::engine {

class SlotTable {
 public:
  static constexpr Slot kNone = -1;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// kNone if there is none. REQUIRES of IdOf: `Id operator()(slot) const`, of slots in the table.
  template <class IdOf>
  Slot find(Id id, const IdOf& id_of) const {
    if (places_.empty()) return kNone;
    for (std::size_t i = home(id);; i = next(i)) {
      const Slot slot = places_[i];
      if (slot == kNone || id_of(slot) == id) return slot;
    }
  }

  /// Asks for what insert() or find() will look at.
  void prefetch_place(Id id) const {
    if (!places_.empty()) prefetch(&places_[home(id)]);
  }

  /// REQUIRES: the id is not in the table.
  template <class IdOf>
  void insert(Id id, Slot slot, const IdOf& id_of) {
    if (8 * (size_ + 1) > 5 * places_.size()) reserve(size_ + 1, id_of);
    put(id, slot);
    ++size_;
  }

  /// REQUIRES: the id is in the table.
  template <class IdOf>
  void erase(Id id, const IdOf& id_of) {
    std::size_t hole = home(id);
    while (id_of(places_[hole]) != id) hole = next(hole);
    for (std::size_t i = next(hole); places_[i] != kNone; i = next(i)) {
      if (way(home(id_of(places_[i])), i) < way(hole, i)) continue;
      places_[hole] = places_[i];
      hole = i;
    }
    places_[hole] = kNone;
    --size_;
  }

  /// Makes room for so many: for no more at first, and at least doubles what there is after that.
  template <class IdOf>
  void reserve(std::size_t count, const IdOf& id_of) {
    if (8 * count <= 5 * places_.size()) return;
    const std::size_t wanted = std::max({kPlacesMin, 8 * count / 5 + 1, 2 * places_.size()});
    const std::vector<Slot> before = std::exchange(places_, std::vector<Slot>(wanted, kNone));
    for (const Slot slot : before) {
      if (slot != kNone) put(id_of(slot), slot);
    }
  }

 private:
  static constexpr int kRunShift = 4;  // a run of ids fills a cache line
  static constexpr std::size_t kPlacesMin = std::size_t{1} << kRunShift;

  std::size_t home(Id id) const {
    const Uint128 hash = (id >> kRunShift) * 0x9e3779b97f4a7c15U;
    const auto first = static_cast<std::size_t>(hash * places_.size() >> 64);
    const std::size_t i = first + (id & ((Id{1} << kRunShift) - 1));
    return i < places_.size() ? i : i - places_.size();
  }
  std::size_t next(std::size_t i) const { return i + 1 == places_.size() ? 0 : i + 1; }
  /// Steps by next() that lead there.
  std::size_t way(std::size_t from, std::size_t to) const {
    return to >= from ? to - from : to + places_.size() - from;
  }
  void put(Id id, Slot slot) {
    std::size_t i = home(id);
    while (places_[i] != kNone) i = next(i);
    places_[i] = slot;
  }

  std::vector<Slot> places_;
  std::size_t size_ = 0;
};

}  // namespace stoss::engine

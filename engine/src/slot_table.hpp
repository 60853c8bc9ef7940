// SPDX-License-Identifier: Apache-2.0
#pragma once

// From ids to slots. An entry is a slot alone: whose it is, its body tells. Open addressing with
// linear probing; entries behind a removed one move up, so that there are no tombstones and a world
// that spawns and removes for months stays as fast as it was.
//
// Source: Knuth, The Art of Computer Programming 3, section 6.4, algorithms L and R, with his
// multiplicative hash.
//
// Invariants: 1. an id's slot stands at the id's home or in the run of entries from there;
// 2. at most 5/8 of the places are taken. Looked up, never iterated.

#include "body.hpp"
#include "prefetch.hpp"

#include <bit>
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
      const std::size_t from_home = (i - home(id_of(places_[i]))) & (places_.size() - 1);
      const std::size_t from_hole = (i - hole) & (places_.size() - 1);
      if (from_home < from_hole) continue;
      places_[hole] = places_[i];
      hole = i;
    }
    places_[hole] = kNone;
    --size_;
  }

  /// Makes room for so many, and at least doubles what there is if that is not enough.
  template <class IdOf>
  void reserve(std::size_t count, const IdOf& id_of) {
    if (8 * count <= 5 * places_.size()) return;
    constexpr std::size_t kPlacesMin = 16;
    std::size_t wanted = kPlacesMin;
    while (8 * count > 5 * wanted) wanted *= 2;
    const std::vector<Slot> before = std::exchange(places_, std::vector<Slot>(wanted, kNone));
    shift_ = 64 - static_cast<int>(std::bit_width(wanted - 1));
    for (const Slot slot : before) {
      if (slot != kNone) put(id_of(slot), slot);
    }
  }

 private:
  std::size_t home(Id id) const {
    return static_cast<std::size_t>((id * 0x9e3779b97f4a7c15U) >> shift_);
  }
  std::size_t next(std::size_t i) const { return (i + 1) & (places_.size() - 1); }
  void put(Id id, Slot slot) {
    std::size_t i = home(id);
    while (places_[i] != kNone) i = next(i);
    places_[i] = slot;
  }

  std::vector<Slot> places_;  // a power of two of them, or none
  std::size_t size_ = 0;
  int shift_ = 0;
};

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Slots by the order of their events, the first on top: a heap of four below each, with the
// instants in its entries, so that comparing touches no other line of memory.
//
// Invariant: nobody stands above an earlier one.
//
// REQUIRES of Owner, which is copied: `bool is_before(slot, slot) const`, by the events themselves,
// and `void note_place(slot, place) const`, which is told where a slot stands whenever that
// changes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stoss::engine {

class EventHeap {
 public:
  struct Entry {
    /// Never less for a later event: only where two are equal the events need to be compared.
    std::uint64_t after;
    std::int32_t slot;
  };

  bool empty() const { return size_ == 0; }
  std::int32_t size() const { return size_; }
  /// REQUIRES: below size(). The first of all is at 0.
  std::int32_t slot_at(std::int32_t place) const { return entries_[index(place)].slot; }
  /// The place of the one after the first, as far as numbers tell. REQUIRES: there are two.
  std::int32_t second() const {
    std::int32_t best = 1;
    for (std::int32_t i = 2; i < std::min(size_, kArity + 1); ++i) {
      if (entries_[index(i)].after < entries_[index(best)].after) best = i;
    }
    return best;
  }
  /// For how many there is memory.
  std::size_t room() const { return entries_.size(); }

  void clear() { size_ = 0; }
  template <class Owner>
  [[gnu::noinline]] void push(Entry entry, Owner owner) {
    if (index(size_) == entries_.size()) grow();
    sift_up(size_++, entry, owner);
  }
  /// Fills the gap that an entry leaves.
  template <class Owner>
  [[gnu::noinline]] void close_gap(std::int32_t place, Owner owner) {
    const Entry last = entries_[index(--size_)];
    if (place != size_) find_place(place, last, owner);
  }

  /// Puts an entry where it belongs, with a gap at `place`.
  template <class Owner>
  [[gnu::noinline]] void find_place(std::int32_t place, Entry entry, Owner owner) {
    if (place > 0 && before(entry, entries_[index((place - 1) / kArity)], owner)) {
      sift_up(place, entry, owner);
    } else {
      sift_down(place, entry, owner);
    }
  }

 private:
  static constexpr std::int32_t kArity = 4;
  static constexpr std::size_t kRoomMin = 64;

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  [[gnu::noinline, gnu::cold]] void grow() { entries_.resize(2 * entries_.size() + kRoomMin); }

  template <class Owner>
  static bool before(const Entry& a, const Entry& b, Owner owner) {
    return a.after != b.after ? a.after < b.after : owner.is_before(a.slot, b.slot);
  }
  template <class Owner>
  void put(std::int32_t place, Entry entry, Owner owner) {
    entries_[index(place)] = entry;
    owner.note_place(entry.slot, place);
  }

  // By numbers alone; where two are equal, the rest of the way is gone with a closer look.
  template <class Owner>
  void sift_up(std::int32_t place, Entry entry, Owner owner) {
    Entry* const heap = entries_.data();
    while (place > 0) {
      const std::int32_t parent = (place - 1) / kArity;
      const Entry above = heap[index(parent)];
      if (above.after == entry.after) [[unlikely]]
        return sift_up_closely(place, entry, owner);
      if (above.after < entry.after) break;
      put(place, above, owner);
      place = parent;
    }
    put(place, entry, owner);
  }

  template <class Owner>
  [[gnu::noinline]] void sift_up_closely(std::int32_t place, Entry entry, Owner owner) {
    while (place > 0) {
      const std::int32_t parent = (place - 1) / kArity;
      if (!before(entry, entries_[index(parent)], owner)) break;
      put(place, entries_[index(parent)], owner);
      place = parent;
    }
    put(place, entry, owner);
  }

  template <class Owner>
  void sift_down(std::int32_t place, Entry entry, Owner owner) {
    Entry* const heap = entries_.data();
    const std::int32_t size = size_;
    for (;;) {
      const std::int32_t first = kArity * place + 1;
      if (first >= size) break;
      const std::int32_t last = std::min(first + kArity, size);
      Entry least = heap[index(first)];
      std::int32_t best = first;
      bool is_tie = false;
      for (std::int32_t i = first + 1; i < last; ++i) {
        const Entry other = heap[index(i)];
        is_tie |= other.after == least.after;
        best = other.after < least.after ? i : best;
        least = other.after < least.after ? other : least;
      }
      if (is_tie || least.after == entry.after) [[unlikely]]
        return sift_down_closely(place, entry, owner);
      if (entry.after < least.after) break;
      put(place, least, owner);
      place = best;
    }
    put(place, entry, owner);
  }

  template <class Owner>
  [[gnu::noinline]] void sift_down_closely(std::int32_t place, Entry entry, Owner owner) {
    for (;;) {
      const std::int32_t first = kArity * place + 1;
      if (first >= size_) break;
      const std::int32_t last = std::min(first + kArity, size_);
      std::int32_t best = first;
      for (std::int32_t i = first + 1; i < last; ++i) {
        if (before(entries_[index(i)], entries_[index(best)], owner)) best = i;
      }
      if (!before(entries_[index(best)], entry, owner)) break;
      put(place, entries_[index(best)], owner);
      place = best;
    }
    put(place, entry, owner);
  }

  std::vector<Entry> entries_;  // and room for more
  std::int32_t size_ = 0;
};

}  // namespace stoss::engine

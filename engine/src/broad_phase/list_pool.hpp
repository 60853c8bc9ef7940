// SPDX-License-Identifier: Apache-2.0
#pragma once

// Many short lists of slots in one piece of memory: room for 7, 15, 31, ... each, behind one word
// that tells how long the list is, given back when a list grows out of it or becomes empty and
// given out again. A warm event loop asks for no memory.
//
// Invariant: the word of the list that has no room stands first, and says so for ever.

#include "prefetch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace stoss::engine {

/// A list in a pool; empty and without room at first.
struct PooledList {
  std::uint32_t head = 0;  ///< where its word stands; 0: no room
};

class ListPool {
 public:
  [[gnu::always_inline]] std::span<const std::int32_t> items(PooledList list) const {
    const std::int32_t* const head = memory_.data() + list.head;
    return {head + 1, Word(*head).size()};
  }
  /// Asks for them.
  void prefetch_items(PooledList list) const { prefetch(memory_.data() + list.head); }
  std::uint32_t size(PooledList list) const { return Word(memory_[list.head]).size(); }

  void push(PooledList& list, std::int32_t item) {
    Word word(memory_[list.head]);
    if (word.size() == word.room()) word = grow(list, word.size() + 1);
    memory_[list.head + 1 + word.size()] = item;
    ++memory_[list.head];
  }

  /// Takes one item out, if it is there; the order changes.
  void erase(PooledList& list, std::int32_t item) {
    const std::uint32_t last = list.head + size(list);
    for (std::uint32_t i = list.head + 1; i <= last; ++i) {
      if (memory_[i] != item) continue;
      if (last == list.head + 1) return release(list);
      memory_[i] = memory_[last];
      --memory_[list.head];
      return;
    }
  }

  void assign(PooledList& list, std::span<const std::int32_t> items) {
    if (items.empty()) return release(list);
    Word word(memory_[list.head]);
    if (items.size() > word.room()) word = grow(list, items.size());
    memory_[list.head] = word.with_size(items.size());
    std::uint32_t to = list.head;
    for (const std::int32_t item : items) memory_[++to] = item;
  }

  void release(PooledList& list) {
    if (list.head == 0) return;
    std::uint32_t& first_free = free_[Word(memory_[list.head]).room_class()];
    memory_[list.head + 1] = static_cast<std::int32_t>(first_free);
    first_free = list.head;
    free_words_ += Word(memory_[list.head]).room() + 1;
    list = PooledList{};
  }

  /// Is most of the memory free, and more than so many words?
  bool is_mostly_free(std::size_t words) const {
    return free_words_ > words && 2 * free_words_ > memory_.size();
  }
  /// Gives it back. for_each_list(visit) calls visit(list) for all lists of the pool.
  template <class ForEachList>
  void pack(const ForEachList& for_each_list) {
    ListPool packed;
    packed.memory_.reserve(memory_.size() - free_words_);
    for_each_list([&](PooledList& list) { packed.move_in(list, *this); });
    *this = std::move(packed);
  }

 private:
  /// Its class of room and, below that, its size.
  class Word {
   public:
    explicit Word(std::int32_t word) : word_(static_cast<std::uint32_t>(word)) {}
    std::uint32_t size() const { return word_ & kSizeMax; }
    std::uint32_t room_class() const { return word_ >> kSizeBits; }
    /// The word and its items fill 4 << room_class words; class 0: no room.
    std::uint32_t room() const { return room_class() == 0 ? 0 : (4U << room_class()) - 1; }
    std::int32_t with_size(std::size_t size) const {
      return static_cast<std::int32_t>((word_ & ~kSizeMax) | static_cast<std::uint32_t>(size));
    }
    static Word of_class(std::uint32_t room_class) {
      return Word(static_cast<std::int32_t>(room_class << kSizeBits));
    }

   private:
    static constexpr int kSizeBits = 27;
    static constexpr std::uint32_t kSizeMax = (std::uint32_t{1} << kSizeBits) - 1;
    std::uint32_t word_;
  };

  Word grow(PooledList& list, std::size_t wanted);
  void move_in(PooledList& list, const ListPool& from);

  static constexpr std::size_t kLeastPiece = 8;
  std::vector<std::int32_t> memory_ = std::vector<std::int32_t>(kLeastPiece);
  std::size_t free_words_ = 0;
  std::array<std::uint32_t, 32> free_{};  // by class: a piece whose second word tells the next
};

}  // namespace stoss::engine

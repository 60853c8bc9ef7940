// SPDX-License-Identifier: Apache-2.0
#pragma once

// Many short lists of slots in one piece of memory: room for 8, 16, 32, ... each, given back when a
// list grows out of it and given out again. A warm event loop asks for no memory. Room that a list
// does not fill holds items that some list held once, or 0.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stoss::engine {

/// A list in a pool; empty and without room at first.
struct PooledList {
  std::uint32_t offset = 0;
  std::uint32_t size : 27 = 0;
  std::uint32_t room_class : 5 = 0;  ///< room for 4 << room_class; 0: none
};

class ListPool {
 public:
  std::span<const std::int32_t> items(const PooledList& list) const {
    return {memory_.data() + list.offset, list.size};
  }

  void push(PooledList& list, std::int32_t item) {
    if (list.size == room(list)) grow(list, list.size + std::size_t{1});
    memory_[list.offset + list.size] = item;
    list.size = (list.size + 1) & kSizeMax;
  }

  /// Takes one item out, if it is there; the order changes.
  void erase(PooledList& list, std::int32_t item) {
    const std::uint32_t last = list.offset + list.size - 1;
    for (std::uint32_t i = list.offset; i != last + 1; ++i) {
      if (memory_[i] != item) continue;
      memory_[i] = memory_[last];
      list.size = (list.size - 1) & kSizeMax;
      return;
    }
  }

  void assign(PooledList& list, std::span<const std::int32_t> items) {
    list.size = 0;
    if (items.size() > room(list)) grow(list, items.size());
    std::uint32_t to = list.offset;
    for (const std::int32_t item : items) memory_[to++] = item;
    list.size = static_cast<std::uint32_t>(items.size()) & kSizeMax;
  }

  void release(PooledList& list) {
    if (list.room_class > 0) free_[list.room_class].push_back(list.offset);
    list = PooledList{};
  }

 private:
  static constexpr std::size_t kLeastRoom = 8;
  static constexpr std::uint32_t kSizeMax = (std::uint32_t{1} << 27) - 1;

  static std::size_t room(const PooledList& list) {
    return list.room_class == 0 ? 0 : kLeastRoom / 2 << list.room_class;
  }
  void grow(PooledList& list, std::size_t wanted);

  std::vector<std::int32_t> memory_;
  std::array<std::vector<std::uint32_t>, 32> free_;  // by class
};

}  // namespace stoss::engine

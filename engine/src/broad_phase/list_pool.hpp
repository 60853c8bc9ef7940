// SPDX-License-Identifier: Apache-2.0
#pragma once

// Many short lists of slots in one piece of memory: room for 8, 16, 32, ... each, given back when a
// list grows out of it and given out again. A warm event loop asks for no memory.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stoss::engine {

/// A list in a pool; empty and without room at first.
struct PooledList {
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
  std::int32_t room_class = -1;  ///< room for kLeastRoom << room_class; -1: none
};

class ListPool {
 public:
  std::span<const std::int32_t> items(const PooledList& list) const {
    return {memory_.data() + list.offset, list.size};
  }

  void push(PooledList& list, std::int32_t item) {
    if (list.size == room(list)) grow(list, list.size + 1);
    memory_[list.offset + list.size++] = item;
  }

  /// Takes one item out, if it is there; the order changes.
  void erase(PooledList& list, std::int32_t item) {
    for (std::uint32_t i = list.offset; i < list.offset + list.size; ++i) {
      if (memory_[i] != item) continue;
      memory_[i] = memory_[list.offset + --list.size];
      return;
    }
  }

  void assign(PooledList& list, std::span<const std::int32_t> items) {
    list.size = 0;
    if (items.size() > room(list)) grow(list, items.size());
    for (const std::int32_t item : items) memory_[list.offset + list.size++] = item;
  }

  void release(PooledList& list) {
    if (list.room_class >= 0) free_[index(list.room_class)].push_back(list.offset);
    list = PooledList{};
  }

 private:
  static constexpr std::size_t kLeastRoom = 8;

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::size_t room(const PooledList& list) {
    return list.room_class < 0 ? 0 : kLeastRoom << list.room_class;
  }
  void grow(PooledList& list, std::size_t wanted);

  std::vector<std::int32_t> memory_;
  std::array<std::vector<std::uint32_t>, 29> free_;  // by class
};

}  // namespace stoss::engine

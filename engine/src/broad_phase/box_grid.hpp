// SPDX-License-Identifier: Apache-2.0
#pragma once

// Square boxes of disks, of any size, anywhere, found by place in constant time.
//
// A box of half side h stands on a level whose cells are larger, 2^level > h, and hardly more so,
// in the one cell that holds its middle. A search looks, on every level that has boxes, at the
// cells within one cell of the box searched. Cells are kept in blocks of four by four, a cache line
// each, behind a hash of the block's place: no world size, and empty space costs nothing.
//
// Source: hierarchical grids, Mirtich, "Efficient algorithms for two-phase collision detection"
// (1997); with one cell a box and searches of all levels as in Ogarko, Luding, Comput. Phys.
// Commun. 183 (2012) 931.
//
// Invariants: 1. an item's half side is below the cell of its level, and is padded by more than the
// rounding of its coordinates, so cell numbers fit into 54 bits; 2. a block in the table holds at
// least one item.

#include "broad_phase/place.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace stoss::engine {

class BoxGrid {
 public:
  void reserve(std::int32_t item) {
    if (index(item) >= places_.size()) places_.resize(index(item) + 1);
  }
  /// REQUIRES: reserved. What the grid does not know of it is the caller's to change.
  Place& place(std::int32_t item) { return places_[index(item)]; }
  const Place& place(std::int32_t item) const { return places_[index(item)]; }

  /// Puts `item` in with a box that holds `tight` grown by `margin` on every side. REQUIRES: not in
  /// the grid, reserved; `tight` a square.
  void insert(std::int32_t item, const Aabb& tight, double margin);
  /// REQUIRES: in the grid.
  void remove(std::int32_t item);
  bool contains(std::int32_t item) const {
    return index(item) < places_.size() && places_[index(item)].cell != kNull;
  }

  /// The items whose boxes overlap `box`, or all but do; valid until the next call.
  std::span<const std::int32_t> find(const Aabb& box) const;

 private:
  static constexpr std::int32_t kNull = Place::kNone;
  static constexpr int kBlockSide = 4;
  static constexpr std::size_t kBlockCells = kBlockSide * kBlockSide;

  /// Where a block is: its numbers along the axes, and the level whose cells it holds.
  struct BlockKey {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int32_t level = 0;
    std::int32_t items = 0;
    bool is_at(std::int64_t at_x, std::int64_t at_y, std::int32_t at_level) const {
      return x == at_x && y == at_y && level == at_level;
    }
  };
  struct alignas(64) Block {
    std::array<std::int32_t, kBlockCells> first;
  };

  struct Level {
    std::int32_t level = 0;
    std::int32_t items = 0;
    double cell = 1;     ///< m
    double inverse = 1;  ///< 1 / cell
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::int64_t floor_of(double x) {
    const auto whole = static_cast<std::int64_t>(x);
    return whole - (static_cast<double>(whole) > x ? 1 : 0);
  }
  static std::size_t place_in_block(std::int64_t x, std::int64_t y) {
    return static_cast<std::size_t>((y & (kBlockSide - 1)) * kBlockSide + (x & (kBlockSide - 1)));
  }
  static std::uint64_t hash_of(std::int64_t x, std::int64_t y, std::int32_t level) {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U;
    h ^= static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU;
    h ^= static_cast<std::uint64_t>(level) * 0x165667b19e3779f9U;
    return (h ^ (h >> 32)) * 0xd6e8feb86659fd93U;
  }

  Level& level_of(std::int32_t level);
  Level& level_for(double half);
  std::int32_t find_block(std::int64_t x, std::int64_t y, std::int32_t level) const {
    for (std::size_t i = hash_of(x, y, level) >> table_shift_;; i = (i + 1) & (table_.size() - 1)) {
      const std::int32_t block = table_[i];
      if (block == kNull || keys_[index(block)].is_at(x, y, level)) return block;
    }
  }
  std::int32_t make_block(std::int64_t x, std::int64_t y, std::int32_t level);
  void drop_block(std::int32_t block);
  void file_block(std::int32_t block);
  void grow_table();

  struct CellRange {
    std::int64_t x0, y0, x1, y1;
  };
  std::int32_t* find_on(const Level& level, const Extent& box, std::int32_t* to) const;
  std::int32_t* find_slowly(const Level& level, const Extent& box, std::int32_t* to) const;
  std::int32_t* first_items(const CellRange& cells, std::int32_t level, std::int32_t* to) const;

  std::vector<Place> places_;
  std::vector<Level> levels_;  // those that have items
  std::vector<BlockKey> keys_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> free_blocks_;
  std::vector<std::int32_t> table_ = std::vector<std::int32_t>(64, kNull);  // open addressing
  int table_shift_ = 58;  // of a hash, for a place in the table

  // Of a search: room for every item.
  mutable std::vector<std::int32_t> found_;
  mutable std::vector<std::int32_t> first_;
};

}  // namespace stoss::engine

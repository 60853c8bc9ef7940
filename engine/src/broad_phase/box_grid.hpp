// SPDX-License-Identifier: Apache-2.0
#pragma once

// Boxes of disks, of any size, anywhere, found by place in constant time.
//
// A box of extent e stands on the level whose cells are just as large, 2^level >= e, in the one
// cell that holds its centre. A search looks, on every level that has boxes, at the cells within
// half a cell of the box searched. Cells are kept in blocks of four by four, a cache line each,
// behind a hash of the block's place: no world size, and empty space costs nothing.
//
// Source: hierarchical grids, Mirtich, "Efficient algorithms for two-phase collision detection"
// (1997); with one cell a box and searches of all levels as in Ogarko, Luding, Comput. Phys.
// Commun. 183 (2012) 931.
//
// Invariants: 1. an item's box is at most as large as a cell of its level, and is padded by more
// than the rounding of its coordinates, so cell numbers fit into 53 bits; 2. a block in the table
// holds at least one item.

#include "broad_phase/aabb.hpp"
#include "prefetch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace stoss::engine {

class BoxGrid {
 public:
  /// Puts `item` in with `box`. REQUIRES: not in the grid; the box has been grown().
  void insert(std::int32_t item, const Aabb& box);
  /// REQUIRES: in the grid.
  void remove(std::int32_t item);
  bool contains(std::int32_t item) const {
    return index(item) < items_.size() && items_[index(item)].cell != kNull;
  }
  const Aabb& box_of(std::int32_t item) const { return items_[index(item)].box; }

  /// Calls visit(item) for every item whose box overlaps `box`.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    for (const Level& level : levels_) query_level(level, box, visit);
  }

 private:
  static constexpr std::int32_t kNull = -1;
  static constexpr int kBlockSide = 4;
  static constexpr std::size_t kBlockCells = kBlockSide * kBlockSide;

  struct Item {
    Aabb box;
    std::int32_t next = kNull;
    std::int32_t previous = kNull;  ///< kNull: the first of its cell
    std::int32_t cell = kNull;      ///< block * kBlockCells + place in it; kNull: not in the grid
    std::int32_t level = 0;
  };

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
  static std::int64_t floor_of(double x) { return static_cast<std::int64_t>(std::floor(x)); }
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

  template <class Visit>
  void visit_cell(std::int32_t first, const Aabb& box, Visit&& visit) const {
    for (std::int32_t item = first; item != kNull;) {
      const Item& here = items_[index(item)];
      const std::int32_t next = here.next;
      if (overlaps(here.box, box)) visit(item);
      item = next;
    }
  }

  template <class Visit>
  void query_level(const Level& level, const Aabb& box, Visit&& visit) const {
    // Half a cell more than the box, and a little for the rounding of these very numbers.
    const double half = 0.5000001 * level.cell;
    const auto low = [&](double x) { return (x - half - 1e-15 * std::abs(x)) * level.inverse; };
    const auto high = [&](double x) { return (x + half + 1e-15 * std::abs(x)) * level.inverse; };
    const double first_x = low(box.low_x), last_x = high(box.high_x);
    const double first_y = low(box.low_y), last_y = high(box.high_y);
    // Where it would look at more cells than there are items, it looks at the items.
    if (!((last_x - first_x) * (last_y - first_y) <= 16 + static_cast<double>(items_.size()))) {
      for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& here = items_[i];
        if (here.cell != kNull && here.level == level.level && overlaps(here.box, box)) {
          visit(static_cast<std::int32_t>(i));
        }
      }
      return;
    }
    // The first items of the cells are asked for all at once, before any is looked at.
    constexpr std::size_t kBatch = 32;
    std::array<std::int32_t, kBatch> first;
    std::size_t count = 0;
    const auto flush = [&] {
      for (std::size_t i = 0; i < count; ++i) visit_cell(first[i], box, visit);
      count = 0;
    };
    for_each_cell({floor_of(first_x), floor_of(first_y), floor_of(last_x), floor_of(last_y)},
                  level.level,
                  [&](std::int32_t item) {
                    if (item == kNull) return;
                    prefetch(&items_[index(item)]);
                    first[count++] = item;
                    if (count == kBatch) flush();
                  });
    flush();
  }

  struct CellRange {
    std::int64_t x0, y0, x1, y1;
  };

  /// Calls visit(first item or kNull) for the cells of a range in blocks that there are.
  template <class Visit>
  void for_each_cell(const CellRange& range, std::int32_t level, Visit&& visit) const {
    const auto [x0, y0, x1, y1] = range;
    for (std::int64_t by = y0 >> 2; by <= y1 >> 2; ++by) {
      const std::int64_t row0 = std::max(y0, by * kBlockSide);
      const std::int64_t row1 = std::min(y1, by * kBlockSide + kBlockSide - 1);
      for (std::int64_t bx = x0 >> 2; bx <= x1 >> 2; ++bx) {
        const std::int32_t block = find_block(bx, by, level);
        if (block == kNull) continue;
        const Block& cells = blocks_[index(block)];
        const std::int64_t column0 = std::max(x0, bx * kBlockSide);
        const std::int64_t column1 = std::min(x1, bx * kBlockSide + kBlockSide - 1);
        for (std::int64_t y = row0; y <= row1; ++y) {
          for (std::int64_t x = column0; x <= column1; ++x) {
            visit(cells.first[place_in_block(x, y)]);
          }
        }
      }
    }
  }

  std::vector<Item> items_;
  std::vector<Level> levels_;  // those that have items
  std::vector<BlockKey> keys_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> free_blocks_;
  std::vector<std::int32_t> table_ = std::vector<std::int32_t>(64, kNull);  // open addressing
  int table_shift_ = 58;  // of a hash, for a place in the table
};

}  // namespace stoss::engine

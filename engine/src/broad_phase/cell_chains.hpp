// SPDX-License-Identifier: Apache-2.0
#pragma once

// Items in square cells, any number in each, found by the cells' numbers. Cells are kept in blocks
// of eight by eight, with a bit for each that holds something, behind a hash of the block's place:
// no world size, and empty space costs nothing.
//
// Invariant: a block in the table holds at least one item.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace stoss::engine {

class CellChains {
 public:
  static constexpr std::int32_t kNone = -1;

  /// A cell, by its numbers along the axes, among those of its level, which may be of any size.
  struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int32_t level = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Range {
    std::int64_t x0 = 0;
    std::int64_t y0 = 0;
    std::int64_t x1 = 0;  ///< included
    std::int64_t y1 = 0;
  };

  /// REQUIRES: in no cell.
  void insert(std::int32_t item, const Cell& cell);
  /// REQUIRES: in a cell.
  void remove(std::int32_t item);
  bool contains(std::int32_t item) const {
    return index(item) < links_.size() && links_[index(item)].cell != kNone;
  }
  /// REQUIRES: in a cell.
  Cell cell_of(std::int32_t item) const {
    const std::size_t at = index(links_[index(item)].cell);
    const Cell& block = heads_[at / kBlockCells].key;
    const auto in_block = static_cast<std::int64_t>(at % kBlockCells);
    return {block.x * kBlockSide + in_block % kBlockSide,
            block.y * kBlockSide + in_block / kBlockSide,
            block.level};
  }

  /// Calls visit(item) for all in cells of the range. `visit` changes nothing here.
  template <class Visit>
  void for_each(const Range& cells, std::int32_t level, const Visit& visit) const {
    const std::int64_t by1 = cells.y1 >> kBlockShift, bx1 = cells.x1 >> kBlockShift;
    for (std::int64_t by = cells.y0 >> kBlockShift; by <= by1; ++by) {
      for (std::int64_t bx = cells.x0 >> kBlockShift; bx <= bx1; ++bx) {
        const std::int32_t block = table_[entry_of({bx, by, level})].block;
        if (block != kNone) for_each_in(block, bx, by, cells, visit);
      }
    }
  }

  /// The same for cells near an item, of its level: its block need not be looked up. REQUIRES: in a
  /// cell; the range lies within one cell of its own.
  template <class Visit>
  void for_each_near(std::int32_t item, const Range& cells, const Visit& visit) const {
    const std::int32_t own = links_[index(item)].cell / static_cast<std::int32_t>(kBlockCells);
    const Cell& key = heads_[index(own)].key;
    const std::int64_t by1 = cells.y1 >> kBlockShift, bx1 = cells.x1 >> kBlockShift;
    for (std::int64_t by = cells.y0 >> kBlockShift; by <= by1; ++by) {
      for (std::int64_t bx = cells.x0 >> kBlockShift; bx <= bx1; ++bx) {
        const bool is_own = bx == key.x && by == key.y;
        const std::int32_t block = is_own ? own : table_[entry_of({bx, by, key.level})].block;
        if (block != kNone) for_each_in(block, bx, by, cells, visit);
      }
    }
  }

  /// The same for all of a level.
  template <class Visit>
  void for_each(std::int32_t level, const Visit& visit) const {
    for (const Entry& entry : table_) {
      if (entry.block == kNone || entry.key.level != level) continue;
      const std::int64_t x = entry.key.x * kBlockSide, y = entry.key.y * kBlockSide;
      const Range all{x, y, x + kBlockSide - 1, y + kBlockSide - 1};
      for_each_in(entry.block, entry.key.x, entry.key.y, all, visit);
    }
  }

  /// How many blocks a level has.
  std::size_t block_count(std::int32_t level) const {
    return static_cast<std::size_t>(std::count_if(
        table_.begin(), table_.end(), [level](const Entry& entry) {
          return entry.block != kNone && entry.key.level == level;
        }));
  }
  /// An upper bound of what a search of all blocks looks at.
  std::size_t table_size() const { return table_.size(); }

  static constexpr int kBlockShift = 3;
  static constexpr std::int64_t kBlockSide = 1 << kBlockShift;  ///< in cells
  static constexpr std::size_t kBlockCells = kBlockSide * kBlockSide;

  static std::int64_t floor_of(double x) {
    const auto whole = static_cast<std::int64_t>(x);
    return whole - (static_cast<double>(whole) > x ? 1 : 0);
  }

 private:
  /// A place in the table; key and block in one, for a search reads both.
  struct Entry {
    Cell key;  ///< of a block
    std::int32_t block = kNone;
  };
  struct alignas(64) Block {
    std::array<std::int32_t, kBlockCells> first;
  };
  struct Head {
    Cell key;                    ///< the block's numbers along the axes, and its level
    std::uint64_t occupied = 0;  ///< a bit for each cell that holds an item
  };
  struct Link {
    std::int32_t next = kNone;      ///< in the same cell
    std::int32_t previous = kNone;  ///< kNone: the first of its cell
    std::int32_t cell = kNone;
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::uint64_t hash_of(const Cell& key) {
    std::uint64_t h = static_cast<std::uint64_t>(key.x) * 0x9e3779b97f4a7c15U;
    h ^= static_cast<std::uint64_t>(key.y) * 0xc2b2ae3d27d4eb4fU;
    h ^= static_cast<std::uint64_t>(key.level) * 0x165667b19e3779f9U;
    return (h ^ (h >> 32)) * 0xd6e8feb86659fd93U;
  }

  // In the part of a range that lies in a block.
  template <class Visit>
  void for_each_in(std::int32_t block,
                   std::int64_t block_x,
                   std::int64_t block_y,
                   const Range& cells,
                   const Visit& visit) const {
    const std::uint64_t columns = bits_between(cells.x0 - block_x * kBlockSide,
                                               cells.x1 - block_x * kBlockSide);
    const std::uint64_t rows = bits_between(8 * (cells.y0 - block_y * kBlockSide),
                                            8 * (cells.y1 - block_y * kBlockSide) + 7);
    std::uint64_t wanted =
        heads_[index(block)].occupied & rows & ((columns & 0xff) * 0x0101010101010101U);
    const std::int32_t* const first = blocks_[index(block)].first.data();
    for (; wanted != 0; wanted &= wanted - 1) {
      std::int32_t item = first[std::countr_zero(wanted)];
      do {
        const std::int32_t next = links_[index(item)].next;
        visit(item);
        item = next;
      } while (item != kNone);
    }
  }
  /// Bits low to high, those of them that there are.
  static std::uint64_t bits_between(std::int64_t low, std::int64_t high) {
    const std::int64_t from = std::max(low, std::int64_t{0});
    const std::int64_t to = std::min(high, std::int64_t{63});
    return (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (63 - to));
  }

  /// The place of the key in the table, or where it would be.
  std::size_t entry_of(const Cell& key) const {
    for (std::size_t i = hash_of(key) >> table_shift_;; i = (i + 1) & (table_.size() - 1)) {
      if (table_[i].block == kNone || table_[i].key == key) return i;
    }
  }
  std::int32_t make_block(const Cell& key);
  void drop_entry(std::size_t hole);
  void grow_table();

  std::vector<Link> links_;  // of the items
  std::vector<Block> blocks_;
  std::vector<Head> heads_;  // of the blocks
  std::vector<std::int32_t> free_blocks_;
  std::vector<Entry> table_ = std::vector<Entry>(64);  // open addressing
  std::size_t entries_ = 0;
  int table_shift_ = 58;  // of a hash, for a place in the table
};

}  // namespace stoss::engine

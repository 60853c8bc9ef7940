// SPDX-License-Identifier: Apache-2.0
#pragma once

// Items in square cells, found by the cells' numbers. A cell has places for two items, which are
// read without a branch; the few that find both taken hang behind the second. Cells are kept in
// blocks of eight by eight, behind a hash of the block's place: no world size, and empty space
// costs nothing.
//
// Invariants: 1. a block in the table holds at least one item; 2. where a cell's second place is
// empty nothing hangs behind it, and where the first is empty the second is.

#include "broad_phase/cell_side.hpp"
#include "broad_phase/list_pool.hpp"
#include "broad_phase/three_cells.hpp"
#include "prefetch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace stoss::engine {

class CellStore {
 public:
  static constexpr std::int32_t kNone = kNoItem;
  static constexpr int kBlockShift = 3;
  static constexpr std::int64_t kBlockSide = 1 << kBlockShift;  ///< in cells
  static constexpr std::size_t kBlockCells = kBlockSide * kBlockSide;
  static constexpr int kSide = kBlockSide;

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

  /// So many items are to come.
  void make_room(std::size_t items) {
    links_.reserve(items);
    items_to_be_ = items;
  }
  /// REQUIRES: in no cell.
  void insert(std::int32_t item, const Cell& cell);
  /// REQUIRES: in a cell.
  void remove(std::int32_t item);
  /// From its cell to one that is so many cells away. REQUIRES: in a cell.
  void move(std::int32_t item, std::int64_t dx, std::int64_t dy) {
    const auto cell = static_cast<std::uint32_t>(links_[index(item)].cell);
    const auto at = static_cast<std::int64_t>(cell % kBlockCells);
    const std::int64_t x = at % kBlockSide + dx;
    const std::int64_t y = at / kBlockSide + dy;
    if (((x | y) & ~(kBlockSide - 1)) != 0) return move_far(item, dx, dy);
    take_out(item);
    put_in(item,
           static_cast<std::int32_t>(cell / kBlockCells),
           static_cast<std::size_t>(y * kBlockSide + x));
  }
  bool contains(std::int32_t item) const {
    return index(item) < links_.size() && links_[index(item)].cell >= 0;
  }
  /// The same of an item that has been in one, or for which something has been kept.
  bool contains_known(std::int32_t item) const { return links_[index(item)].cell >= 0; }
  /// For an item in no cell its owner may keep a number, 0 or more, until it comes in; kNone: none.
  void keep_for(std::int32_t item, std::int32_t number);
  /// Is it in a cell, or is something kept for it?
  bool knows(std::int32_t item) const {
    return index(item) < links_.size() && links_[index(item)].cell != kNone;
  }
  /// REQUIRES: known, and in no cell.
  std::int32_t kept_for(std::int32_t item) const { return kBelowNone - links_[index(item)].cell; }
  /// REQUIRES: in a cell.
  Cell cell_of(std::int32_t item) const {
    const std::size_t at = index(links_[index(item)].cell);
    const Head& block = heads_[at / kBlockCells];
    const auto in_block = static_cast<std::int64_t>(at % kBlockCells);
    return {block.x * kBlockSide + in_block % kBlockSide,
            block.y * kBlockSide + in_block / kBlockSide,
            block.level};
  }

  /// Asks for what tells where an item is; once that has come, for what collect_around() will read
  /// of its block, and of the cells.
  void prefetch_link(std::int32_t item) const { prefetch(links_.data() + item); }
  void prefetch_block(std::int32_t item) const {
    prefetch_all(heads_[index(links_[index(item)].cell) / kBlockCells]);
  }
  void prefetch_around(std::int32_t item) const {
    const std::int32_t* const first = row_where(item);
    prefetch(first - 2 * kBlockSide);
    prefetch(first);
    prefetch(first + 2 * kBlockSide);
  }
  /// And for what collect_beside() will, when the item has moved one up or down.
  void prefetch_beyond(std::int32_t item) const {
    const std::int32_t* const first = row_where(item);
    prefetch(first - 4 * kBlockSide);
    prefetch(first + 4 * kBlockSide);
  }

  /// Writes all items but one that are in cells near it; returns where it has stopped. REQUIRES: in
  /// a cell; the range lies within two cells of its own, on its level; room at `to` for
  /// all items of the blocks that the range meets and kWrittenBeyond more.
  std::int32_t* collect_near(std::int32_t item, const Range& cells, std::int32_t* to) const {
    const std::int32_t own = links_[index(item)].cell / static_cast<std::int32_t>(kBlockCells);
    const Head& head = heads_[index(own)];
    const std::int64_t by1 = cells.y1 >> kBlockShift, bx1 = cells.x1 >> kBlockShift;
    for (std::int64_t by = cells.y0 >> kBlockShift; by <= by1; ++by) {
      for (std::int64_t bx = cells.x0 >> kBlockShift; bx <= bx1; ++bx) {
        const std::int32_t block = head.beside[beside(bx - head.x, by - head.y)];
        to = collect_in(index(block), part_of(cells, bx, by), item, to);
      }
    }
    return to;
  }

  /// The same for the nine cells around its own.
  std::int32_t* collect_around(std::int32_t item, std::int32_t* to) const {
    const auto cell = static_cast<std::uint32_t>(links_[index(item)].cell);
    const std::uint32_t at = cell % kBlockCells;
    const std::uint32_t x = at % kBlockSide, y = at / kBlockSide;
    if (x - 1 >= kBlockSide - 2 || y - 1 >= kBlockSide - 2) {
      return collect_across(
          item, heads_[cell / kBlockCells], static_cast<int>(x), static_cast<int>(y), to);
    }
    const std::uint32_t corner = at - kBlockSide - 1;
    const std::int32_t* row = &blocks_[cell / kBlockCells].items[2 * corner];
    const std::int32_t* const start = to;
    for (int i = 0; i < 3; ++i, row += 2 * kBlockSide) {
      to = take_three(row, row + 2, row + 4, item, to);
    }
    constexpr std::uint64_t kNineCells = 0x070707;
    const Head& head = heads_[cell / kBlockCells];
    head.looks += kOneSearch + static_cast<std::uint64_t>(to - start);
    const std::uint64_t crowded = head.crowded & (kNineCells << corner);
    return crowded == 0 ? to : collect_hanging(cell / kBlockCells, crowded, item, to);
  }

  /// For how many collect_around() needs room at most.
  std::size_t around_max() const {
    return 4 * static_cast<std::size_t>(items_max_) + kWrittenBeyond;
  }

  /// The same for the three cells on one side of its own: dx or dy is 1 or -1, the other 0.
  std::int32_t* collect_beside(std::int32_t item, int dx, int dy, std::int32_t* to) const {
    const auto cell = static_cast<std::uint32_t>(links_[index(item)].cell);
    const Head& head = heads_[cell / kBlockCells];
    const int x = static_cast<int>(cell % kBlockCells) % kSide + dx;
    const int y = static_cast<int>(cell % kBlockCells) / kSide + dy;
    const int along_x = dx == 0 ? 1 : 0, along_y = 1 - along_x;
    const std::array<Seen, 3> side{seen_from(head, x - along_x, y - along_y),
                                   seen_from(head, x, y),
                                   seen_from(head, x + along_x, y + along_y)};
    to = take_three(side[0].places, side[1].places, side[2].places, item, to);
    for (const Seen& some : side) {
      if (some.crowded != 0) to = collect_hanging(index(some.block), some.crowded, item, to);
    }
    return to;
  }

  /// Calls visit(item) for all in cells of the range. `visit` changes nothing here.
  template <class Visit>
  void for_each(const Range& cells, std::int32_t level, const Visit& visit) const {
    const std::int64_t by1 = cells.y1 >> kBlockShift, bx1 = cells.x1 >> kBlockShift;
    for (std::int64_t by = cells.y0 >> kBlockShift; by <= by1; ++by) {
      for (std::int64_t bx = cells.x0 >> kBlockShift; bx <= bx1; ++bx) {
        const std::int32_t block = table_[entry_of({bx, by, level})];
        if (block != kNone) for_each_in(block, part_of(cells, bx, by), visit);
      }
    }
  }

  /// The same for all of a level.
  template <class Visit>
  void for_each(std::int32_t level, const Visit& visit) const {
    for (const std::int32_t block : table_) {
      if (block == kNone || heads_[index(block)].level != level) continue;
      for_each_in(block, {0, 0, kBlockSide - 1, kBlockSide - 1}, visit);
    }
  }

  /// Is most of the memory for blocks free, and more than a little?
  bool is_mostly_free() const {
    constexpr std::size_t kFew = 64;
    return free_blocks_.size() > kFew && 2 * free_blocks_.size() > blocks_.size();
  }
  /// Gives it back. drop(list) is called for what would have been inherited.
  template <class Drop>
  void pack(const Drop& drop) {
    for (const std::int32_t block : free_blocks_) drop(heads_[index(block)].note.list);
    pack_blocks();
  }

  /// What the owner of the cells keeps for a block of them; made anew with the block.
  struct Note {
    std::uint64_t as_of = 0;  ///< 0: nothing
    PooledList list;          ///< of which a new block may inherit some
  };
  struct NotedBlock {
    Cell key;  ///< the block's numbers along the axes, and its level
    Note* note;
  };
  /// Of the block where the item is. REQUIRES: in a cell.
  NotedBlock noted_block_of(std::int32_t item) {
    Head& head = heads_[index(links_[index(item)].cell) / kBlockCells];
    return {head.key(), &head.note};
  }
  const Note& note_of_block_of(std::int32_t item) const {
    return heads_[index(links_[index(item)].cell) / kBlockCells].note;
  }
  /// Forgets what is kept for the blocks that a range meets. False, and nothing is done, where
  /// these are many.
  bool forget_notes(const Range& cells, std::int32_t level);

  /// Some item of a level, -1 where the next few blocks hold none; each call goes on where the last
  /// has stopped, so that one block after the other is emptied by who takes out what it is given.
  std::int32_t some_item_of(std::int32_t level);

  /// How often collect_around() was called for items of a level, and how many it has written, as
  /// far as is known, since the last call for it.
  CellWork take_work(std::int32_t level);
  /// More than the cells that a search of all blocks looks at.
  double cells_max() const { return static_cast<double>(kBlockCells * table_.size()); }

  /// A cell's bit among those of its block. REQUIRES: in a cell.
  std::uint64_t bit_of_cell_of(std::int32_t item) const {
    return std::uint64_t{1} << (index(links_[index(item)].cell) % kBlockCells);
  }
  /// The cell of a bit, by its number, in the block with these numbers along the axes.
  static Cell cell_of_bit(const Cell& block, int bit) {
    return {block.x * kBlockSide + bit % kSide, block.y * kBlockSide + bit / kSide, block.level};
  }
  /// The bits of those of a range that lie in a block, by its numbers along the axes.
  static std::uint64_t bits_within(const Range& cells, std::int64_t block_x, std::int64_t block_y) {
    const Range part = part_of(cells, block_x, block_y);
    return part.x0 > part.x1 || part.y0 > part.y1 ? 0 : bits_of(part);
  }

  /// The largest whole number below; of one beyond 2^62, which no item's cell has, some such.
  static std::int64_t floor_of(double x) { return floor_within(std::clamp(x, -0x1p62, 0x1p62)); }
  /// The same of one that is not beyond.
  static std::int64_t floor_within(double x) {
    const auto whole = static_cast<std::int64_t>(x);
    return whole - (static_cast<double>(whole) > x ? 1 : 0);
  }

 private:
  /// In two lines; what most searches read is in one.
  struct alignas(32) Head {
    std::int64_t x = 0;  ///< the block's numbers along the axes
    std::int64_t y = 0;
    std::int32_t level = 0;
    std::int32_t items = 0;
    /// At items, by collect_around(); and from kOneSearch on how often it was called.
    mutable std::uint64_t looks = 0;
    std::uint64_t crowded = 0;             ///< a bit for each cell with items behind its second
    std::array<std::int32_t, 9> beside{};  ///< the blocks around it, itself in the middle
    Note note;

    Cell key() const { return {x, y, level}; }
  };
  static_assert(sizeof(Head) == 96);
  static constexpr std::uint64_t kOneSearch = std::uint64_t{1} << 32;
  static std::size_t beside(std::int64_t dx, std::int64_t dy) {
    return static_cast<std::size_t>(3 * dy + dx + 4);
  }
  struct alignas(64) Block {
    std::array<std::int32_t, 2 * kBlockCells> items;
    Block() { items.fill(kNone); }
  };
  /// The block that stands for all that hold nothing, and is not in the table.
  static constexpr std::int32_t kNoBlock = 0;
  struct Link {
    std::int32_t cell = kNone;  ///< or kBelowNone less what is kept for the item
    std::int32_t next = kNone;  ///< of the second in a cell, and of those behind it
  };

  static constexpr std::int32_t kBelowNone = 2 * kNone;
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::uint64_t hash_of(const Cell& key) {
    std::uint64_t h = static_cast<std::uint64_t>(key.x) * 0x9e3779b97f4a7c15U;
    h ^= static_cast<std::uint64_t>(key.y) * 0xc2b2ae3d27d4eb4fU;
    h ^= static_cast<std::uint64_t>(key.level) * 0x165667b19e3779f9U;
    return (h ^ (h >> 32)) * 0xd6e8feb86659fd93U;
  }

  /// The part of a range that lies in a block, counted from its corner; it ends before it begins
  /// where there is none.
  static Range part_of(const Range& cells, std::int64_t block_x, std::int64_t block_y) {
    const std::int64_t x = block_x * kBlockSide, y = block_y * kBlockSide;
    return {std::max(cells.x0 - x, std::int64_t{0}),
            std::max(cells.y0 - y, std::int64_t{0}),
            std::min(cells.x1 - x, kBlockSide - 1),
            std::min(cells.y1 - y, kBlockSide - 1)};
  }
  /// The cells of such a part as bits. REQUIRES: there is one.
  static std::uint64_t bits_of(const Range& part) {
    const std::uint64_t row = (0xffU >> (7 - part.x1)) & (0xffU << part.x0);
    const std::uint64_t rows = (~std::uint64_t{0} >> (8 * (7 - part.y1)));
    return row * kEveryRow & rows & (~std::uint64_t{0} << (8 * part.y0));
  }

  std::int32_t* collect_in(std::size_t block,
                           const Range& part,
                           std::int32_t but_for,
                           std::int32_t* to) const {
    const std::int32_t* row =
        &blocks_[block].items[static_cast<std::size_t>(2 * (part.y0 * kBlockSide + part.x0))];
    const auto width = 2 * (part.x1 - part.x0 + 1);
    for (std::int64_t y = part.y0; y <= part.y1; ++y, row += 2 * kBlockSide) {
      for (std::int64_t i = 0; i < width; ++i) to = take_one(row[i], but_for, to);
    }
    const std::uint64_t crowded = heads_[block].crowded & bits_of(part);
    return crowded == 0 ? to : collect_hanging(block, crowded, but_for, to);
  }

  /// A cell as it is seen from a block beside its own.
  struct Seen {
    const std::int32_t* places;
    std::int32_t block;
    std::uint64_t crowded;  ///< its bit, if items hang behind its second
  };
  /// By its numbers, counted from the corner of the block. REQUIRES: within 8 cells of it.
  Seen seen_from(const Head& head, int x, int y) const {
    const std::int32_t block = head.beside[beside(x >> kBlockShift, y >> kBlockShift)];
    const std::size_t at = in_block(x, y);
    return {&blocks_[index(block)].items[2 * at],
            block,
            heads_[index(block)].crowded & std::uint64_t{1} << at};
  }

  /// Of cells as they are seen from a block beside it, or from their own: which block, counted from
  /// the middle of a row of three, and which place in a row of that.
  struct Column {
    int block;
    int place;
  };
  static Column column_of(int x) { return {x >> kBlockShift, 2 * (x & (kSide - 1))}; }

  /// Of a column and those beside it: which cells of its block stand in them, and which of the
  /// block beside, if one of them is there. The same of rows.
  struct Strip {
    std::uint64_t own = 0;
    std::uint64_t beyond = 0;
    int beside = 0;
  };
  static constexpr std::array<Strip, kSide> strips_of(std::uint64_t first, int shift) {
    std::array<Strip, kSide> strips{};
    for (int i = 0; i < kSide; ++i) {
      Strip& strip = strips[static_cast<std::size_t>(i)];
      for (int j = std::max(i - 1, 0); j <= std::min(i + 1, kSide - 1); ++j) {
        strip.own |= first << (j * shift);
      }
      strip.beside = i == 0 ? -1 : i == kSide - 1 ? 1 : 0;
      if (strip.beside != 0) strip.beyond = first << ((strip.beside < 0 ? kSide - 1 : 0) * shift);
    }
    return strips;
  }
  static constexpr std::uint64_t kEveryRow = 0x0101010101010101U;  // its first cell

  /// Calls visit(block, cells) for the blocks where the nine cells around one are, with the bits of
  /// those behind whose seconds items hang. They are in four blocks at most.
  template <class Visit>
  void for_each_crowded_around(const Head& head,
                               std::size_t x,
                               std::size_t y,
                               const Visit& visit) const {
    static constexpr auto kColumns = strips_of(kEveryRow, 1);
    static constexpr auto kRows = strips_of(0xff, kSide);
    const Strip& columns = kColumns[x];
    const Strip& rows = kRows[y];
    const auto visit_beside = [&](int dx, int dy, std::uint64_t cells) {
      const std::size_t block = index(head.beside[beside(dx, dy)]);
      visit(block, heads_[block].crowded & cells);
    };
    visit_beside(0, 0, columns.own & rows.own);
    visit_beside(columns.beside, 0, columns.beyond & rows.own);
    visit_beside(0, rows.beside, columns.own & rows.beyond);
    visit_beside(columns.beside, rows.beside, columns.beyond & rows.beyond);
  }
  // The nine cells around one at its block's edge, which almost half of all are.
  std::int32_t* collect_across(
      std::int32_t item, const Head& head, int x, int y, std::int32_t* to) const {
    const std::array<Column, 3> columns{column_of(x - 1), column_of(x), column_of(x + 1)};
    const std::int32_t* const start = to;
    for (int row = y - 1; row <= y + 1; ++row) {
      const std::int32_t* const blocks = &head.beside[beside(0, row >> kBlockShift)];
      const int first = 2 * kSide * (row & (kSide - 1));
      const auto places = [&](const Column& column) {
        return blocks_[index(blocks[column.block])].items.data() + first + column.place;
      };
      to = take_three(places(columns[0]), places(columns[1]), places(columns[2]), item, to);
    }
    head.looks += kOneSearch + static_cast<std::uint64_t>(to - start);
    const auto column = static_cast<std::size_t>(x), line = static_cast<std::size_t>(y);
    std::uint64_t crowded = 0;
    for_each_crowded_around(
        head, column, line, [&](std::size_t, std::uint64_t cells) { crowded |= cells; });
    return crowded == 0 ? to : collect_hanging_around(item, head, column, line, to);
  }
  std::int32_t* collect_hanging_around(
      std::int32_t item, const Head& head, std::size_t x, std::size_t y, std::int32_t* to) const;
  std::int32_t* collect_hanging(std::size_t block,
                                std::uint64_t cells,
                                std::int32_t but_for,
                                std::int32_t* to) const;

  template <class Visit>
  void for_each_in(std::int32_t block, const Range& part, const Visit& visit) const {
    for (std::int64_t y = part.y0; y <= part.y1; ++y) {
      for (std::int64_t i = 2 * part.x0; i <= 2 * part.x1 + 1; ++i) {
        const std::int32_t item =
            blocks_[index(block)].items[static_cast<std::size_t>(2 * y * kBlockSide + i)];
        if (item != kNone) visit(item);
      }
    }
    for_each_hanging(block, heads_[index(block)].crowded & bits_of(part), visit);
  }

  /// Calls visit(item) for those behind the seconds of some cells.
  template <class Visit>
  void for_each_hanging(std::int32_t block, std::uint64_t cells, const Visit& visit) const {
    for (; cells != 0; cells &= cells - 1) {
      const auto cell = static_cast<std::size_t>(std::countr_zero(cells));
      std::int32_t item = links_[index(blocks_[index(block)].items[2 * cell + 1])].next;
      for (; item != kNone; item = links_[index(item)].next) visit(item);
    }
  }

  /// The place of the key in the table, or where it would be.
  std::size_t entry_of(const Cell& key) const {
    for (std::size_t i = hash_of(key) >> table_shift_;; i = (i + 1) & (table_.size() - 1)) {
      if (table_[i] == kNone || heads_[index(table_[i])].key() == key) return i;
    }
  }
  /// The block of a key, made if need be.
  std::int32_t block_for(const Cell& key) {
    const std::int32_t block = table_[entry_of(key)];
    return block != kNone ? block : make_block(key);
  }
  /// Where in its block a cell with these numbers is.
  static std::size_t in_block(std::int64_t x, std::int64_t y) {
    return static_cast<std::size_t>((y & (kBlockSide - 1)) * kBlockSide + (x & (kBlockSide - 1)));
  }
  /// The first place of the row of its block where the item is.
  const std::int32_t* row_where(std::int32_t item) const {
    const std::size_t cell = index(links_[index(item)].cell);
    return &blocks_[cell / kBlockCells].items[2 * (cell % kBlockCells / kBlockSide * kBlockSide)];
  }
  void move_far(std::int32_t item, std::int64_t dx, std::int64_t dy);
  void put_in(std::int32_t item, std::int32_t block, std::size_t at);
  void take_out(std::int32_t item);
  std::int32_t make_block(const Cell& key);
  void drop_block(std::int32_t block);
  void link(std::int32_t block, std::int32_t as);
  void drop_entry(std::size_t hole);
  void resize_table(std::size_t size);
  void grow_blocks();
  void pack_blocks();
  void renumber(const std::vector<std::int32_t>& numbers);

  std::vector<Link> links_;  // of the items
  std::vector<Block> blocks_ = std::vector<Block>(1);
  std::vector<Head> heads_ = std::vector<Head>(1);  // of the blocks
  std::vector<std::int32_t> free_blocks_;
  /// Of blocks, by their keys; open addressing. A block beside another is known without it.
  static constexpr std::size_t kTableLeast = 64;
  std::vector<std::int32_t> table_ = std::vector<std::int32_t>(kTableLeast, kNone);
  std::size_t entries_ = 0;
  std::size_t items_ = 0;
  std::size_t items_to_be_ = 0;  // as many have been announced
  std::int32_t items_max_ = 0;   // that a block has ever held
  std::size_t looked_at_ = 0;    // the block, by some_item_of()
  int table_shift_ = 58;         // of a hash, for a place in the table
};

}  // namespace stoss::engine

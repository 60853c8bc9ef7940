// SPDX-License-Identifier: Apache-2.0
#pragma once

// Moving disks of about one size, which keep no lists of each other.
//
// A disk stands in the cell where it was when it came in, and may go a little beyond its sides
// before it must be brought to another (its cage). Cells are so large that two disks cannot touch
// unless their cells are neighbours: whom a disk may meet is read off nine cells, and when it has
// crossed to another, those that are new to it off three or five.
//
// Levels are made for the sizes that come. Where disks fly far, cells are larger than they must be:
// their sides follow the work, crossings against looks at neighbours (cell_side.hpp). When a
// level's are found too large or too small, a level with better ones takes its place, and each disk
// moves there when it next crosses a side.
//
// What else stands near, in no cell, is known block by block (bystanders), and asked for anew only
// where something has come or gone.
//
// Source: cells without lists, one crossing event a body, Smallenburg, Eur. Phys. J. E 45 (2022)
// 22; cages wider than their cells as in Bannerman, Sargant, Lue, J. Comput. Chem. 32 (2011) 3329.
// Deviation: only what is new to a disk is looked at when it crosses.

#include "broad_phase/aabb.hpp"
#include "broad_phase/cell_side.hpp"
#include "broad_phase/cell_store.hpp"
#include "broad_phase/list_pool.hpp"
#include "broad_phase/place.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace stoss::engine {

class DiskCells {
 public:
  using Cell = CellStore::Cell;
  /// A square that its disk's centre stays in.
  struct Cage {
    double x = 0;     ///< m, of its middle
    double y = 0;     ///< m
    double half = 0;  ///< m
  };
  /// From a cell to another of its level.
  struct Step {
    std::int64_t dx = 0;
    std::int64_t dy = 0;
    bool is_long() const { return dx < -1 || dx > 1 || dy < -1 || dy > 1; }
  };

  /// So many disks are to come.
  void make_room(std::size_t disks) { store_.make_room(disks); }
  bool contains(std::int32_t disk) const { return store_.contains(disk); }
  bool contains_known(std::int32_t disk) const { return store_.contains_known(disk); }
  /// As the store of cells does, keeps a number for a body that is not contained.
  void keep_for(std::int32_t body, std::int32_t number) { store_.keep_for(body, number); }
  bool knows(std::int32_t body) const { return store_.knows(body); }
  std::int32_t kept_for(std::int32_t body) const { return store_.kept_for(body); }
  /// REQUIRES: contained.
  Cell cell_of(std::int32_t disk) const { return store_.cell_of(disk); }

  /// REQUIRES: contained.
  Cage cage_of(std::int32_t disk) const {
    const Cell cell = store_.cell_of(disk);
    return cage_in(level_of(cell.level), cell);
  }
  /// The disk is in it, while it is in its cage. REQUIRES: contained.
  Aabb box_of(std::int32_t disk) const {
    const Cell cell = store_.cell_of(disk);
    return box_in(level_of(cell.level), cell);
  }
  /// Calls visit(body) for what may meet the disk without standing in a cell: of all that
  /// `others.find(box, found)` adds to `found` for a box around the disk's block of cells, those
  /// whose `others.box_of(body)` comes to the disk's cage, and for whom `others.may_come_to(body,
  /// box)` is true of a box around that. False, and nothing is done, where the block has many.
  /// REQUIRES: contained.
  template <class Others, class Visit>
  bool for_each_bystander(std::int32_t disk, const Others& others, const Visit& visit) {
    const auto [key, note] = store_.noted_block_of(disk);
    if (note->as_of != changes_) note_bystanders(key, *note, others);
    const auto noted = lists_.items(note->list);
    if (noted.size() == kManyBystanders * kWordsNoted) return false;
    const std::uint64_t here = store_.bit_of_cell_of(disk);
    for (std::size_t i = 0; i < noted.size(); i += kWordsNoted) {
      if ((cells_noted(&noted[i]) & here) != 0) visit(noted[i]);
    }
    return true;
  }
  /// Are `known` all that for_each_bystander() would find, and is nothing else to be found? No,
  /// where that is not told at once. REQUIRES: contained.
  bool has_bystanders(std::int32_t disk, std::span<const std::int32_t> known) const {
    const CellStore::Note& note = store_.note_of_block_of(disk);
    if (note.as_of != changes_ || has_other_levels()) return false;
    const std::uint64_t here = store_.bit_of_cell_of(disk);
    const auto noted = lists_.items(note.list);
    std::size_t found = 0;
    for (std::size_t i = 0; i < noted.size(); i += kWordsNoted) {
      if ((cells_noted(&noted[i]) & here) == 0) continue;
      if (std::find(known.begin(), known.end(), noted[i]) == known.end()) return false;
      ++found;
    }
    return found == known.size() && noted.size() != kManyBystanders * kWordsNoted;
  }
  bool has_other_levels() const { return levels_.size() > 1; }
  /// To be told of each box of a body in no cell, when it comes and when it goes.
  void note_bystander(const Aabb& box);

  void prefetch_link(std::int32_t disk) const { store_.prefetch_link(disk); }
  /// Asks for what collect_around() will read of this one, and of those around it. REQUIRES:
  /// contained.
  void prefetch_block(std::int32_t disk) const { store_.prefetch_block(disk); }
  void prefetch_around(std::int32_t disk) const { store_.prefetch_around(disk); }
  void prefetch_beyond(std::int32_t disk) const { store_.prefetch_beyond(disk); }

  /// Puts a disk in whose centre is at (x, y), off by less than 1e-10 of `radius`. False where
  /// cells do not suit it: too far out for their numbers, or much larger than most. `least`: m,
  /// that a cage should leave it to go. REQUIRES: not in.
  bool enter(std::int32_t disk, double x, double y, double radius, double least);
  /// Brings a disk to the cell where it is now, of its own level. None, and nothing is done, where
  /// it should enter() anew. REQUIRES: contained.
  std::optional<Step> move(std::int32_t disk, double x, double y);
  /// REQUIRES: contained.
  void leave(std::int32_t disk);
  /// A disk that should enter() anew though it may not move for long: its level has been given up,
  /// and costs every search as long as disks are left in it. -1: none, or none at hand.
  std::int32_t straggler() {
    return has_other_levels() ? straggler_of_some_level() : CellStore::kNone;
  }

  /// So much room collect_around() and collect_new_around() need, in disks.
  std::size_t around_max() const { return store_.around_max(); }
  /// Writes all disks of the level that this one may meet; returns where it has stopped. REQUIRES:
  /// contained; room at `to`.
  std::int32_t* collect_around(std::int32_t disk, std::int32_t* to) const {
    return store_.collect_around(disk, to);
  }

  /// The same for those alone that it could not meet before its last step.
  std::int32_t* collect_new_around(std::int32_t disk, const Step& step, std::int32_t* to) const {
    if (step.is_long()) return collect_around(disk, to);
    const auto dx = static_cast<int>(step.dx), dy = static_cast<int>(step.dy);
    if (dy == 0 && dx == 0) return to;
    if (dy == 0) return store_.collect_beside(disk, dx, 0, to);
    if (dx == 0) return store_.collect_beside(disk, 0, dy, to);
    const Cell own = store_.cell_of(disk);
    to = store_.collect_beside(disk, dx, 0, to);
    return store_.collect_near(
        disk,
        {std::min(own.x, own.x - dx), own.y + dy, std::max(own.x, own.x - dx), own.y + dy},
        to);
  }

  /// Calls visit(disk) for every disk whose cage, with its radius, overlaps the box, and some more;
  /// but for those of one level.
  template <class Visit>
  void find(const Aabb& box, std::int32_t but_for_level, const Visit& visit) const {
    for (const Level& level : levels_) {
      if (level.id != but_for_level) find_on(level, box, visit);
    }
  }
  static constexpr std::int32_t kNoLevel = -1;

 private:
  struct Level {
    std::int32_t id = 0;
    std::int32_t items = 0;
    double side = 1;        ///< m, of a cell
    double inverse = 1;     ///< 1 / side
    double radius_max = 0;  ///< m
    double cage_half = 1;   ///< m; of a cage, half its side
    double reach = 0;       ///< m; of a disk in its cage, beyond its cell's sides
    bool is_retired = false;
    std::uint64_t crossings = 0;  ///< from cell to cell, since they were last looked at
  };

  template <class Visit>
  void find_on(const Level& level, const Aabb& box, const Visit& visit) const {
    const Aabb near = box_beside(level, box, kCellRounding);
    const double cells = (near.high_x - near.low_x) * (near.high_y - near.low_y);
    if (!(cells <= 64 + store_.cells_max())) return store_.for_each(level.id, visit);
    store_.for_each(cells_in(near), level.id, visit);
  }

  // Notes who may come to which cells of a block.
  template <class Others>
  void note_bystanders(const Cell& key, CellStore::Note& note, const Others& others) {
    const Level& level = level_of(key.level);
    asked_.clear();
    others.find(box_of_block(level, key), asked_);
    noted_.clear();
    for (const std::int32_t body : asked_) {
      if (noted_.size() == kManyBystanders * kWordsNoted) break;
      const CellStore::Range range = cells_beside(level, others.box_of(body), kCellRounding);
      std::uint64_t cells = CellStore::bits_within(range, key.x, key.y);
      for (std::uint64_t left = cells; left != 0; left &= left - 1) {
        const Aabb box = box_in(level, CellStore::cell_of_bit(key, std::countr_zero(left)));
        if (!others.may_come_to(body, box)) cells &= ~(left & -left);
      }
      if (cells != 0) note_down(body, cells);
    }
    lists_.assign(note.list, noted_);
    note.as_of = changes_;
  }

  // Of a body beside a block it is noted to which of its cells it may come, one bit each.
  static constexpr std::size_t kManyBystanders = 32;
  static constexpr std::size_t kWordsNoted = 3;
  static_assert(CellStore::kBlockCells == 64);

  static std::uint64_t cells_noted(const std::int32_t* noted) {
    std::uint64_t cells = 0;
    std::memcpy(&cells, noted + 1, sizeof cells);
    return cells;
  }
  void note_down(std::int32_t body, std::uint64_t cells) {
    noted_.resize(noted_.size() + kWordsNoted);
    std::int32_t* const words = noted_.data() + noted_.size() - kWordsNoted;
    words[0] = body;
    std::memcpy(words + 1, &cells, sizeof cells);
  }
  /// A box and what disks in their cages reach beyond their cells, in sides of cells. `rounding`:
  /// as much more.
  static Aabb box_beside(const Level& level, const Aabb& box, double rounding) {
    const double beyond = level.reach + rounding * level.side;
    return {(box.low_x - beyond) * level.inverse,
            (box.low_y - beyond) * level.inverse,
            (box.high_x + beyond) * level.inverse,
            (box.high_y + beyond) * level.inverse};
  }
  static CellStore::Range cells_in(const Aabb& box) {
    return {CellStore::floor_of(box.low_x),
            CellStore::floor_of(box.low_y),
            CellStore::floor_of(box.high_x),
            CellStore::floor_of(box.high_y)};
  }
  /// The cells whose cages, with their disks, a box may overlap.
  static CellStore::Range cells_beside(const Level& level, const Aabb& box, double rounding) {
    return cells_in(box_beside(level, box, rounding));
  }

  static Aabb box_of_block(const Level& level, const Cell& key) {
    const double side = static_cast<double>(CellStore::kBlockSide) * level.side;
    const double reach = level.reach + kCellRounding * level.side;
    const double x = static_cast<double>(key.x) * side;
    const double y = static_cast<double>(key.y) * side;
    return {x - reach, y - reach, x + side + reach, y + side + reach};
  }
  /// Where a centre at (x, y) stands on a level; none beyond the range of its cells' numbers.
  static std::optional<Cell> cell_at(const Level& level, double x, double y) {
    const double number_x = x * level.inverse;
    const double number_y = y * level.inverse;
    if (!(std::abs(number_x) < kNumberMax && std::abs(number_y) < kNumberMax)) return std::nullopt;
    return Cell{CellStore::floor_within(number_x), CellStore::floor_within(number_y), level.id};
  }
  static Cage cage_in(const Level& level, const Cell& cell) {
    return {(static_cast<double>(cell.x) + 0.5) * level.side,
            (static_cast<double>(cell.y) + 0.5) * level.side,
            level.cage_half};
  }
  /// Around a cage with its disk.
  static Aabb box_in(const Level& level, const Cell& cell) {
    const Cage cage = cage_in(level, cell);
    const double half =
        Extent::padded(cage.half + level.radius_max, std::max(std::abs(cage.x), std::abs(cage.y)));
    return {cage.x - half, cage.y - half, cage.x + half, cage.y + half};
  }
  Level& level_of(std::int32_t id) {
    std::size_t i = 0;
    while (levels_[i].id != id) ++i;
    return levels_[i];
  }
  const Level& level_of(std::int32_t id) const {
    return const_cast<DiskCells&>(*this).level_of(id);
  }
  bool are_few_beside_smaller(double radius, std::int32_t items) const;
  Level* level_for(double radius);
  Level& make_level(double radius_max, double side);
  void look_after(Level& level);
  bool is_given_up(const Level& level) const {
    return level.is_retired || are_few_beside_smaller(level.radius_max, level.items);
  }
  std::int32_t straggler_of_some_level();

  static constexpr double kNumberMax = 0x1p40;

  CellStore store_;
  std::vector<Level> levels_;  // few
  std::int32_t next_id_ = 0;
  ListPool lists_;             // of bystanders
  std::uint64_t changes_ = 1;  // among them, that concern too many blocks to be told to each
  std::vector<std::int32_t> asked_;
  std::vector<std::int32_t> noted_;
};

}  // namespace stoss::engine

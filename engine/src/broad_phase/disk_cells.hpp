// SPDX-License-Identifier: Apache-2.0
#pragma once

// Moving disks of about one size, which keep no lists of each other.
//
// A disk stands in the cell where it was when it came in, and may go a little beyond its sides
// before it must be brought to another (its cage). Cells are so large that two disks cannot touch
// unless their cells are neighbours: whom a disk may meet is read off nine cells, and when it has
// crossed to another, those that are new to it off three or five.
//
//   W (1 - 2 s) >= 2 r      W: side of a cell [m]; s: the part of it that a cage is wider, on each
//                           side; r: the largest radius of the level [m]                      (1)
//
// Levels are made for the sizes that come. Where disks fly far, cells are larger than (1) asks:
// their sides follow the work, crossings against looks at neighbours. When a level's are found too
// large or too small, a level with better ones takes its place, and each disk moves there when it
// next crosses a side.
//
// Source: cells without lists, one crossing event a body, Smallenburg, Eur. Phys. J. E 45 (2022)
// 22; cages wider than their cells as in Bannerman, Sargant, Lue, J. Comput. Chem. 32 (2011) 3329.
// Deviation: only what is new to a disk is looked at when it crosses.

#include "broad_phase/aabb.hpp"
#include "broad_phase/cell_store.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace stoss::engine {

class DiskCells {
 public:
  using Cell = CellStore::Cell;
  /// A square that its disk's centre stays in, with the disk's cell.
  struct Cage {
    double x = 0;     ///< m, of its middle
    double y = 0;     ///< m
    double half = 0;  ///< m
    Cell cell;
  };

  bool contains(std::int32_t disk) const { return store_.contains(disk); }
  /// REQUIRES: contained.
  Cell cell_of(std::int32_t disk) const { return store_.cell_of(disk); }

  /// REQUIRES: contained.
  Cage cage_of(std::int32_t disk) const {
    const Cell cell = store_.cell_of(disk);
    for (const Level& level : levels_) {
      if (level.id == cell.level) return cage_in(level, cell);
    }
    return {};
  }
  /// Asks for what collect_around() will read of this one, and of those around it. REQUIRES:
  /// contained.
  void prefetch_block(std::int32_t disk) const { store_.prefetch_block(disk); }
  void prefetch_around(std::int32_t disk) const { store_.prefetch_around(disk); }

  /// Puts a disk in whose centre is at (x, y), off by less than 1e-10 of `radius`. None where cells
  /// do not suit it: too far out for their numbers, or much larger than most. `least`: m, that
  /// a cage should leave it to go. REQUIRES: not in.
  std::optional<Cage> enter(std::int32_t disk, double x, double y, double radius, double least);
  /// Brings a disk to the cell where it is now, of its own level. None, and nothing is done, where
  /// it should enter() anew. REQUIRES: contained.
  std::optional<Cage> move(std::int32_t disk, double x, double y);
  /// REQUIRES: contained.
  void leave(std::int32_t disk);

  /// Writes all disks of the level that this one may meet; returns where it has stopped. REQUIRES:
  /// contained; room at `to` for all disks that there are and one more.
  std::int32_t* collect_around(std::int32_t disk, std::int32_t* to) const {
    return store_.collect_around(disk, to);
  }

  /// The same for those alone that it could not meet while it stood in `before`, of its level.
  std::int32_t* collect_new_around(std::int32_t disk, const Cell& before, std::int32_t* to) const {
    const Cell own = store_.cell_of(disk);
    const std::int64_t dx = own.x - before.x;
    const std::int64_t dy = own.y - before.y;
    if (dx < -1 || dx > 1 || dy < -1 || dy > 1) return collect_around(disk, to);
    CellStore::Range rest{own.x - 1, own.y - 1, own.x + 1, own.y + 1};
    if (dx != 0) {
      const std::int64_t x = own.x + dx;
      to = store_.collect_near(disk, {x, rest.y0, x, rest.y1}, to);
      (dx > 0 ? rest.x1 : rest.x0) -= dx;
    }
    if (dy == 0) return to;
    return store_.collect_near(disk, {rest.x0, own.y + dy, rest.x1, own.y + dy}, to);
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
    bool is_retired = false;
    std::uint64_t crossings = 0;  ///< from cell to cell, since they were last looked at
  };

  template <class Visit>
  void find_on(const Level& level, const Aabb& box, const Visit& visit) const {
    const double beyond = (kBeyond + 1e-6) * level.side + level.radius_max;
    const double left = (box.low_x - beyond) * level.inverse;
    const double low = (box.low_y - beyond) * level.inverse;
    const double right = (box.high_x + beyond) * level.inverse;
    const double high = (box.high_y + beyond) * level.inverse;
    if (!((right - left) * (high - low) <= 64 + store_.cells_max())) {
      return store_.for_each(level.id, visit);
    }
    store_.for_each({CellStore::floor_of(left),
                     CellStore::floor_of(low),
                     CellStore::floor_of(right),
                     CellStore::floor_of(high)},
                    level.id,
                    visit);
  }

  static double least_side(double radius_max) {
    constexpr double kRounding = 0x1p-8;  // of numbers up to kNumberMax, and much more
    return 2 * radius_max / (1 - 2 * kBeyond - kRounding);
  }
  /// Where a centre at (x, y) stands on a level; none beyond the range of its cells' numbers.
  static std::optional<Cage> cage_at(const Level& level, double x, double y);
  static Cage cage_in(const Level& level, const Cell& cell) {
    return {(static_cast<double>(cell.x) + 0.5) * level.side,
            (static_cast<double>(cell.y) + 0.5) * level.side,
            (0.5 + kBeyond) * level.side,
            cell};
  }
  Level& level_of(std::int32_t id);
  Level* level_for(double radius);
  Level& make_level(double radius_max, double side);
  void look_after(Level& level);

  static constexpr double kBeyond = 1.0 / 32;  // s in (1)
  static constexpr double kNumberMax = 0x1p40;

  CellStore store_;
  std::vector<Level> levels_;  // few
  std::int32_t next_id_ = 0;
};

}  // namespace stoss::engine

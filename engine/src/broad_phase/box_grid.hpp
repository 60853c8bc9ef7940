// SPDX-License-Identifier: Apache-2.0
#pragma once

// Square boxes of disks, of any size, anywhere, found by place in constant time.
//
// A box of half side h stands on a level whose cells are larger, 2^level > h, and hardly more so,
// in the one cell that holds its middle. A search looks, on every level that has boxes, at the
// cells within one cell of the box searched.
//
// Source: hierarchical grids, Mirtich, "Efficient algorithms for two-phase collision detection"
// (1997); with one cell a box and searches of all levels as in Ogarko, Luding, Comput. Phys.
// Commun. 183 (2012) 931.
//
// Invariant: an item's half side is below the cell of its level, and is padded by more than the
// rounding of its coordinates, so cell numbers fit into 54 bits.

#include "broad_phase/cell_store.hpp"
#include "broad_phase/place_table.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace stoss::engine {

class BoxGrid {
 public:
  /// The places of all bodies that stand here, and of whatever else the caller keeps with them.
  /// What the grid does not know of a place is the caller's to change.
  PlaceTable& places() { return places_; }
  const PlaceTable& places() const { return places_; }

  /// Puts a body in with a box that holds `tight` grown by `margin` on every side; returns the line
  /// of its place. REQUIRES: not in the grid; `tight` a square.
  std::int32_t insert(std::int32_t body, const Aabb& tight, double margin);
  /// Its place goes, too. REQUIRES: in the grid.
  void remove(std::int32_t line);

  /// The bodies whose boxes overlap `box`, or all but do; valid until the next call.
  std::span<const std::int32_t> find(const Aabb& box) const;

 private:
  struct Level {
    std::int32_t level = 0;
    std::int32_t items = 0;
    double cell = 1;     ///< m
    double inverse = 1;  ///< 1 / cell
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  Level& level_of(std::int32_t level);
  Level& level_for(double half);
  void find_on(const Level& level, const Extent& box) const;

  PlaceTable places_;
  CellStore store_;                          // of lines
  std::vector<Level> levels_;                // those that have items
  mutable std::vector<std::int32_t> found_;  // by the last search
};

}  // namespace stoss::engine

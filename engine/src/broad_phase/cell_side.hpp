// SPDX-License-Identifier: Apache-2.0
#pragma once

// How large the cells of moving disks should be, and how far a disk may go beyond its own.
//
//   W (1 - 2 s) >= 2 r                                                                        (1)
//   q = l^2 / (W (1.6 l + 2 s W))                                                             (2)
//   q (c + k / 3) + k,  k ~ W^2                                                               (3)
//
// W: side of a cell [m]; s: the part of it that a disk may go beyond each side before it is brought
// to another cell; r: the largest radius [m]. (1): two disks cannot touch unless their cells are
// neighbours. So much beyond its cell costs nothing, and who has just crossed a side does not come
// back over it at once. q: crossings a search of the nine cells around a disk; l: the way between
// two searches [m]; k: the disks that a search finds, a third of which are new after a crossing; c:
// what a crossing costs beside, in looks at a disk. The best side is that for which (3) is least,
// with the l that the crossings of late give by (2).
//
// Source: (1) as in Bannerman, Sargant, Lue, J. Comput. Chem. 32 (2011) 3329. (2) is an estimate: a
// walk with steps l between two sides that are 2 s W apart; 1.6 is fitted to a gas at an area
// fraction of 0.3, and suits one at 0.7. Any sides give the same events, by (1):
// tests/engine/cell_side_test.cpp.

#include <algorithm>

namespace stoss::engine {

/// In sides of cells, of places whose cells have numbers up to 2^40; and much more.
inline constexpr double kCellRounding = 0x1p-9;
/// c in (3). Measured; within a factor of two it hardly matters.
inline constexpr double kCrossingLooks = 30;
/// s in (1).
inline constexpr double kBeyondLeast = 1.0 / 32;
inline constexpr double kBeyondMost = 1.0 / 4;

/// The least side of cells, m, for disks up to this radius, m.
inline double least_side(double radius_max) {
  return 2 * radius_max / (1 - 2 * kBeyondLeast - 2 * kCellRounding);
}

/// s in (1), of cells that are as large as the least or larger.
inline double beyond_cell(double radius_max, double side) {
  return std::clamp(0.5 - kCellRounding - radius_max / side, kBeyondLeast, kBeyondMost);
}

/// What was done on cells of one size.
struct CellWork {
  double crossings = 0;  ///< from cell to cell
  double searches = 0;   ///< of the nine cells around a disk
  double looks = 0;      ///< at disks, in those
};

/// The side, m, for which the same work would have cost least: from half to four times what it was.
double best_side(double radius_max, double side, const CellWork& work);

}  // namespace stoss::engine

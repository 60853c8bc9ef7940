// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the broad phase keeps of a body: one cache line, for a search reads many of them.

#include "broad_phase/aabb.hpp"
#include "broad_phase/list_pool.hpp"

#include <cmath>
#include <cstdint>

namespace stoss::engine {

/// What a body is to the broad phase.
enum class Role : std::uint8_t { Wall, FixedDisk, DynamicDisk };

struct alignas(64) Place {
  static constexpr std::int32_t kNone = -1;

  double x = 0;  ///< m, of the middle of a disk's box; where a wall's start was
  double y = 0;
  double half = 0;    ///< m, from the middle of a disk's box to its sides
  double margin = 0;  ///< m, by how much the box is larger than the body was
  float x_low = 0;    ///< m, from (x, y) to where the body itself was
  float y_low = 0;
  PooledList list;                ///< of neighbours
  std::int32_t next = kNone;      ///< in the same cell of the grid
  std::int32_t previous = kNone;  ///< kNone: the first of its cell
  std::int32_t cell = kNone;      ///< kNone: not in the grid
  std::uint16_t work = 0;         ///< predictions looked at since the last renewal, at most
  Role role = Role::DynamicDisk;
  bool is_marked = false;

  bool keeps_list() const { return role == Role::DynamicDisk; }
  Aabb box() const { return {x - half, y - half, x + half, y + half}; }
};
static_assert(sizeof(Place) == 64);

/// Sides of a box as seen from its middle, and what rounding may add to them.
struct Extent {
  double x, y, half_x, half_y;

  explicit Extent(const Aabb& box)
      : x(0.5 * box.low_x + 0.5 * box.high_x),
        y(0.5 * box.low_y + 0.5 * box.high_y),
        half_x(padded(0.5 * box.high_x - 0.5 * box.low_x, x)),
        half_y(padded(0.5 * box.high_y - 0.5 * box.low_y, y)) {}

  static double padded(double half, double middle) {
    constexpr double kRounding = 8e-16;  // four units in the last place, of either number
    return half + kRounding * (half + std::abs(middle));
  }
};

/// Do the boxes overlap? Sure where they do.
inline bool overlaps(const Place& place, const Extent& box) {
  return std::abs(place.x - box.x) <= place.half + box.half_x &&
         std::abs(place.y - box.y) <= place.half + box.half_y;
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the broad phase keeps of a body: one cache line.

#include "broad_phase/aabb.hpp"

#include <cmath>
#include <cstdint>

namespace stoss::engine {

struct alignas(64) Place {
  double x = 0;  ///< m, of the middle of a disk's box; where a wall's start was
  double y = 0;
  double half = 0;    ///< m, from the middle of a disk's box to its sides; of a wall the rounding
  double margin = 0;  ///< m, by how much the box is larger than the body was
  float low_x = 0;    ///< of `half`: from (x, y) to where the body itself was
  float low_y = 0;    ///< likewise; not in m, for those may be beyond the range of a float
  std::uint32_t work = 0;  ///< predictions looked at since the last renewal, at most
  std::int32_t body = -1;  ///< whose place it is
  std::int32_t leaf = -1;  ///< of a wall, in the tree

  double x_low() const { return static_cast<double>(low_x) * half; }  ///< m
  double y_low() const { return static_cast<double>(low_y) * half; }  ///< m
  /// `x`, `y`: m, at most `half`.
  void set_low(double to_x, double to_y) {
    low_x = half > 0 ? static_cast<float>(to_x / half) : 0.0F;
    low_y = half > 0 ? static_cast<float>(to_y / half) : 0.0F;
  }
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

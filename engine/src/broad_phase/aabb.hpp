// SPDX-License-Identifier: Apache-2.0
#pragma once

// Axis-aligned boxes of the broad phase. They may be too large, never too small; no bit of a result
// depends on them.

#include <algorithm>
#include <cmath>

namespace stoss::engine {

struct Aabb {
  double low_x = 0;
  double low_y = 0;
  double high_x = 0;
  double high_y = 0;
};

inline bool overlaps(const Aabb& a, const Aabb& b) {
  return a.low_x <= b.high_x && b.low_x <= a.high_x && a.low_y <= b.high_y && b.low_y <= a.high_y;
}

inline Aabb merged(const Aabb& a, const Aabb& b) {
  return {std::min(a.low_x, b.low_x),
          std::min(a.low_y, b.low_y),
          std::max(a.high_x, b.high_x),
          std::max(a.high_y, b.high_y)};
}

/// Half the perimeter: what the tree keeps small.
inline double extent(const Aabb& a) { return (a.high_x - a.low_x) + (a.high_y - a.low_y); }

/// The box grown on every side by `margin` and by the rounding of its own coordinates.
inline Aabb grown(const Aabb& a, double margin) {
  constexpr double kRounding = 4e-16;  // two units in the last place of a coordinate
  const double pad_x = kRounding * std::max(std::abs(a.low_x), std::abs(a.high_x)) + margin;
  const double pad_y = kRounding * std::max(std::abs(a.low_y), std::abs(a.high_y)) + margin;
  return {a.low_x - pad_x, a.low_y - pad_y, a.high_x + pad_x, a.high_y + pad_y};
}

}  // namespace stoss::engine

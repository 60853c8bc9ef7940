// SPDX-License-Identifier: Apache-2.0
#pragma once

// Do immovable bodies that touch a disk leave it no velocity with which it would approach none of
// them?
//
//   u . n_i <= s_i for all i      n_i: unit normal from the disk to body i; s_i: its speed along
//   n_i
//
// In the plane such half-planes have no point in common if and only if two or three of them have
// none:
//   two:   n1 = -n2 and s1 + s2 < 0
//   three: l1 n1 + l2 n2 + l3 n3 = 0 with all l > 0 (they stand all round), and l1 s1 + l2 s2 + l3
//   s3 < 0,
//          with l1 = n2 x n3, l2 = n3 x n1, l3 = n1 x n2
// Then the room between them goes to zero, and the disk bounces in it without end.
//
// Source: Helly's theorem; Farkas' lemma for the multipliers l.

#include <stoss/engine/types.hpp>

#include <cmath>

namespace stoss::engine {

/// One body that touches the disk.
struct Jaw {
  Vector2 normal;    ///< unit, from the disk to it
  double speed = 0;  ///< its own along the normal, m/s; negative: it comes towards the disk
};

inline bool close_in(const Jaw& a, const Jaw& b) {
  constexpr double kParallel = 1e-9;  // rad; chosen: far above the rounding of a normal
  const double cross = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
  return a.normal.dot(b.normal) < 0 && std::abs(cross) < kParallel && a.speed + b.speed < 0;
}

inline bool close_in(const Jaw& a, const Jaw& b, const Jaw& c) {
  const auto cross = [](const Jaw& p, const Jaw& q) {
    return p.normal.x() * q.normal.y() - p.normal.y() * q.normal.x();
  };
  const double of_a = cross(b, c);
  const double of_b = cross(c, a);
  const double of_c = cross(a, b);
  // Grouped so that b and c may change places without changing a bit.
  const double sum = of_a * a.speed + (of_b * b.speed + of_c * c.speed);
  if (of_a > 0 && of_b > 0 && of_c > 0) return sum < 0;
  if (of_a < 0 && of_b < 0 && of_c < 0) return sum > 0;
  return false;
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Does it matter which of two simultaneous contacts of one body is resolved first?
//
// In configuration space, with lengths weighted by the square roots of the masses, a contact is a
// mirror. Two mirrors at the angle pi / n send every ray back alike whichever it meets first; at
// any other angle they do not. For the shared body 0 and the normals n1, n2 from it to bodies 1 and
// 2,
//
//   cos(theta) = -(n1 . n2) w0 / sqrt((w0 + w1) (w0 + w2)),    w = 1 / mass (0: immovable)      (1)
//
// theta = pi / n exactly if T_n(cos theta) = cos(n theta) = -1, with T_n Chebyshev's polynomials.
//
// Source: the unfolding of corners in billiards, Galperin, Regul. Chaotic Dyn. 8 (2003) 375.
// Deviation: angles below pi / 512 count as dependent on the order; no libm function is called, so
//   that every build marks the same contacts.
// Accuracy: T_n is evaluated by its recurrence, error below n^2 2^-50, so an angle within 1e-7 rad
// of
//   pi / n (n small) counts as pi / n; measured by tests/engine/world/simultaneous_test.cpp.

#include <stoss/engine/types.hpp>

#include <cmath>

namespace stoss::engine {

/// Two contacts of a body are simultaneous if it moves less than this part of a contact distance in
/// between. Chosen: ten thousand times the rounding of a position, far below any real spacing.
inline constexpr double kSimultaneousHop = 1e-11;

/// REQUIRES: n1, n2 unit vectors; weights >= 0 and w0 + w1 > 0, w0 + w2 > 0.
inline bool order_matters(const Vector2& n1, const Vector2& n2, double w0, double w1, double w2) {
  constexpr int kReflectionsMax = 512;
  constexpr double kRounding = 0x1p-50;
  const double x = -n1.dot(n2) * w0 / std::sqrt((w0 + w1) * (w0 + w2));
  double previous = 1;
  double value = x;
  for (int n = 2; n <= kReflectionsMax; ++n) {
    const double next = 2 * x * value - previous;
    const double tolerance = kRounding * n * n + 1e-14;
    if (next < -1 + tolerance) return next < -1 - tolerance;
    if (next > value) return true;  // passed -pi between two multiples of the angle
    previous = value;
    value = next;
  }
  return true;
}

/// Do two smooth contacts of a body commute although they lose energy? Only at a right angle.
inline bool commute(const Vector2& n1, const Vector2& n2) {
  constexpr double kRounding = 1e-14;
  return std::abs(n1.dot(n2)) <= kRounding;
}

}  // namespace stoss::engine

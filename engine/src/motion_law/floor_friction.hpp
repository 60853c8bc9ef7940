// SPDX-License-Identifier: Apache-2.0
// Dry friction with the floor: a constant deceleration to a stop, as on a billiard table.
//   (1) a = -k v / |v|     k: deceleration [m/s^2]; v: velocity [m/s] after the last physical event
//   (2) T = |v| / k        then the disk stops, at p + v T / 2, and stays
// Source: Coulomb's law of sliding friction; Marlow, The Physics of Pocket Billiards, section 4.
// Deviation: double words; the place of the stop is (2), not the parabola at a rounded instant, so
//   that a disk at rest stands where its equation puts it.
// Accuracy: a and T to 24 u^2: tests/engine/effects/floor_friction_test.cpp.
// Preconditions: k > 0.
#pragma once

#include "contact_time/contact_time.hpp"

#include <stoss/engine/motion.hpp>

#include <limits>

namespace stoss::engine {

template <class S>
struct Slowing {
  DoubleWord2<S> acceleration;  ///< m/s^2
  DoubleWord<S> moves_for;      ///< s; infinite for a disk at rest
};

/// (1) and (2) of a velocity in m/s and a deceleration in m/s^2.
template <class S>
[[nodiscard]] inline Slowing<S> slowing(const DoubleWord2<S>& velocity,
                                        const S& deceleration) noexcept {
  const S infinity = std::numeric_limits<S>::infinity();
  const int shift = detail::steps_into_range(detail::size_of(velocity));
  const DoubleWord2<S> v = detail::shifted(velocity, shift);
  const DoubleWord<S> speed = sqrt(square_norm(v));
  if (!(speed.hi > S(0))) return {{}, {infinity, S(0)}};
  const DoubleWord<S> k{deceleration, S(0)};
  return {{-(v.x * k) / speed, -(v.y * k) / speed}, detail::shifted(speed, -shift) / k};
}

/// Where a disk stops that moves for so long, (2).
template <class S>
[[nodiscard]] inline DoubleWord2<S> stopping_place(const Motion<S>& motion,
                                                   const DoubleWord<S>& moves_for) noexcept {
  const DoubleWord<S> half{S(moves_for.hi * S(0.5)), S(moves_for.lo * S(0.5))};
  return motion.position + motion.velocity * half;
}

}  // namespace stoss::engine

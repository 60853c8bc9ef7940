// SPDX-License-Identifier: Apache-2.0
// A stored motion with constant acceleration: what worlds, the daemon and replicas evaluate alike.
//   (1) x(t) = p + v (t - t0) + a (t - t0)^2 / 2      p [m], v [m/s]: at t0; a [m/s^2]
//   (2) u(t) = v + a (t - t0)
// Source: elementary.
// Deviation: double words; without acceleration the operations of uniform motion, to the same bits.
// Accuracy: as displacement_at() of contact_time/accelerated.hpp; tests/engine/effects and
//   tests/integration/client_late_joiner_test.cpp compare worlds and replicas bit for bit.
#pragma once

#include "contact_time/accelerated.hpp"

#include <stoss/engine/motion.hpp>
#include <stoss/engine/types.hpp>

namespace stoss::engine {

/// (1) at an instant before or after `since`.
template <class S>
[[nodiscard]] inline DoubleWord2<S> position_at(const Motion<S>& motion,
                                                const DoubleWord2<S>& acceleration,
                                                const Time<S>& instant) {
  if (instant == motion.since || detail::is_zero(acceleration)) return position_at(motion, instant);
  const DoubleWord<S> elapsed = difference<S>(instant, motion.since);
  const AcceleratedMotion<S> flight{motion.position, motion.velocity, acceleration, S(0)};
  return displacement_at(flight, Duration<S>{elapsed.hi, elapsed.lo});
}

/// (2) at an instant before or after `since`.
template <class S>
[[nodiscard]] inline DoubleWord2<S> velocity_at(const Motion<S>& motion,
                                                const DoubleWord2<S>& acceleration,
                                                const Time<S>& instant) {
  if (instant == motion.since || detail::is_zero(acceleration)) return motion.velocity;
  return motion.velocity + acceleration * difference<S>(instant, motion.since);
}

}  // namespace stoss::engine

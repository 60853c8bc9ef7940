// SPDX-License-Identifier: Apache-2.0
// A stored motion under linear drag: what worlds, the daemon and replicas evaluate alike.
//   (1) x(t) = p + v s + a f,  u(t) = v l + a s       p [m], v [m/s]: at the motion's instant; s,
//   f, l:
//       contact_time/drag_clock.hpp, of the time since; a [m/s^2]: what pulls, gravity say
// Source: elementary: u' = -m u + a, m: rate of the drag [1/s].
// Deviation: double words. Float's durations are formed in double. A disk on a moving wall is
// pulled
//   by m V besides, so that it keeps up with the wall.
// Accuracy: as drag_clock.hpp; tests/engine/effects/drag_test.cpp.
// Preconditions: m > 0; instants before the motion's own by no more than 700 / m.
#pragma once

#include "contact_time/drag_clock.hpp"

#include <stoss/engine/motion.hpp>

namespace stoss::engine {

namespace detail {

/// The durations of (1) from `since` to `instant`.
template <class S>
[[nodiscard]] inline DragClock<S> drag_clock_between(const Time<S>& since,
                                                     const Time<S>& instant,
                                                     const S& rate) noexcept {
  using Wide = Inner<S>;
  const auto clock = drag_clock<Wide>(difference<Wide>(instant, since), static_cast<Wide>(rate));
  return {stored_words<S>(clock.run), stored_words<S>(clock.fall), stored_words<S>(clock.left)};
}

/// Durations in plain doubles, for screens.
struct RoughDragClock {
  double run = 0, fall = 0, left = 1;
};

/// The durations of (1) to 1e-14 of themselves. By halves of y = m t until a series of twenty terms
/// is exact, and back by e^(-2 y) = (e^-y)^2.
[[nodiscard]] inline RoughDragClock rough_drag_clock(double t, double rate) noexcept {
  constexpr double kNear = 0.5;
  constexpr int kTerms = 16;
  double y = t * rate;
  if (!(y < kSpent)) return {1 / rate, (t - 1 / rate) / rate, 0};
  int halvings = 0;
  double near = y;
  for (; near > kNear; ++halvings) near *= 0.5;
  double mean = 0;  // (y - 1 + e^-y) / y^2 = 1/2! - y/3! + ...
  for (int n = kTerms; n > 0; --n) mean = (1 - mean * near) / (n + 1);
  double left = 1 - near * (1 - near * mean);
  if (halvings == 0) return {t * (1 - near * mean), t * t * mean, left};
  for (; halvings > 0; --halvings) left *= left;
  const double run = (1 - left) / rate;
  return {run, (t - run) / rate, left};
}

}  // namespace detail

/// Position and velocity in double words.
template <class S>
struct Flight {
  DoubleWord2<S> position;  ///< m
  DoubleWord2<S> velocity;  ///< m/s
};

/// (1) at an instant.
template <class S>
[[nodiscard]] inline Flight<S> flight_at(const Motion<S>& motion,
                                         const DoubleWord2<S>& pull,
                                         const S& rate,
                                         const Time<S>& instant) noexcept {
  if (instant == motion.since) return {motion.position, motion.velocity};
  const detail::DragClock<S> clock = detail::drag_clock_between<S>(motion.since, instant, rate);
  return {motion.position + motion.velocity * clock.run + pull * clock.fall,
          motion.velocity * clock.left + pull * clock.run};
}

}  // namespace stoss::engine

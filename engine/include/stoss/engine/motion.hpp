// SPDX-License-Identifier: Apache-2.0
#pragma once

// Uniform motion: the closed form that the daemon, its replicas and the collision kernels share.
//
//   x(t) = p + v (t - t0)                                                            (1)
//
// p, v: position (m) and velocity (m/s) stored as unevaluated sums hi + lo; t0: the instant of the
// body's last physical event; t - t0 is an exact integer of the time grid, split into hi + lo.
//
// Source: NUMERICS: "double-word arithmetic", Joldes, Muller, Popescu, ACM TOMS 44 (2017) 15.
// Deviation: positions are stored in double-words so that a body far from the origin keeps the
//   accuracy that it has near it, and velocities so that a heavy body answers to light ones.
// Accuracy: (1) is evaluated in double-word arithmetic and rounded once, so the result is within
// one
//   ulp of the exact value for the stored numbers; measured by tests/engine/motion_test.cpp.

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>

namespace stoss::engine {

/// Where a body was at `since`, and how it moves from then on. Written by physical events only.
template <class S>
struct Motion {
  DoubleWord2<S> position;  ///< m
  DoubleWord2<S> velocity;  ///< m/s
  Time<S> since;
};

/// Equation (1) at an instant before or after `since`, as a double-word.
template <class S>
[[gnu::always_inline]] inline DoubleWord2<S> position_at(const Motion<S>& motion,
                                                         const Time<S>& instant) {
  if (instant == motion.since) return motion.position;
  const DoubleWord<S> elapsed = difference<S>(instant, motion.since);
  return motion.position + motion.velocity * elapsed;
}

namespace detail {

/// Each component rounded once to double.
template <class S>
[[nodiscard]] inline Vector2 rounded(const DoubleWord2<S>& v) {
  return {static_cast<double>(to_scalar(v.x)), static_cast<double>(to_scalar(v.y))};
}

}  // namespace detail

/// Splits a value of any arithmetic up to 106 bits into two doubles, exactly.
template <class S>
SplitNumber to_split(const DoubleWord<S>& value) {
  if constexpr (kCompensated<S>) {
    return {static_cast<double>(value.hi), static_cast<double>(value.lo)};
  } else {
    const auto high = static_cast<double>(value.hi);
    return {high, static_cast<double>(value.hi - S(high))};
  }
}

template <class S>
DoubleWord<S> from_split(const SplitNumber& value) {
  if constexpr (kCompensated<S>) {
    return {static_cast<S>(value.high), static_cast<S>(value.low)};
  } else {
    return {S(value.high) + S(value.low), S(0)};
  }
}

template <class S>
Motion<S> from_record(const MotionRecord& record) {
  return {{from_split<S>(record.x), from_split<S>(record.y)},
          {from_split<S>(record.vx), from_split<S>(record.vy)},
          from_instant<Time<S>>(record.since)};
}

template <class S>
MotionRecord to_record(Id id, const Motion<S>& motion) {
  return {id,
          to_split(motion.position.x),
          to_split(motion.position.y),
          to_split(motion.velocity.x),
          to_split(motion.velocity.y),
          to_instant(motion.since)};
}

/// Evaluates a recorded motion as a world in `arithmetic` does. Exact to the bit for Float and
/// Double; a LongDouble world's times are finer than an Instant, and wider arithmetics do not fit a
/// record, so for those the result is that of the nearest record.
Vector2 evaluate(const MotionRecord& motion, Arithmetic arithmetic, const Instant& instant);

/// The same in a world of these periods (0: open): the image in [0, period), as BodyState shows it.
Vector2 evaluate(const MotionRecord& motion,
                 Arithmetic arithmetic,
                 const Instant& instant,
                 const Vector2& period);

/// A wall in such a world, in the same sense, as WallState shows it.
WallState evaluate_wall(const MotionRecord& motion,
                        const BodyRecord& body,
                        Arithmetic arithmetic,
                        const Instant& instant,
                        const Vector2& period);

/// The velocity of a recorded motion, m/s, in the same sense.
Vector2 evaluate_velocity(const MotionRecord& motion,
                          Arithmetic arithmetic,
                          const Instant& instant);

/// The radius of a recorded disk, m, in the same sense.
double evaluate_radius(const MotionRecord& motion,
                       const BodyRecord& body,
                       Arithmetic arithmetic,
                       const Instant& instant);

/// angle + spin (instant - since), each step rounded once to double; rad.
double turned(double angle, double spin, const Instant& since, const Instant& instant);

}  // namespace stoss::engine

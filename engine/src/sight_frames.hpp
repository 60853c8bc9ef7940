// SPDX-License-Identifier: Apache-2.0
#pragma once

// Sights of disks that gravity and drag move alike: seen from a frame that moves as one of them
// does, and by a clock that slows down as they do, each moves uniformly, and sight.hpp knows the
// rest.
//
//   (1) gravity: x(t) - g t^2 / 2 = x' + v' (t - t0),  v' = v - g t0
//   (2) drag: x(t) - g f(t) = x' + v' (s(t) - s(t0)),  v' = (v - g s(t0)) e^(m t0)
//       s(t) = (1 - e^(-m t)) / m,  f(t) = (t - s(t)) / m
//       t, t0: s after the epoch's beginning; m: rate of the drag, 1/s
//   (3) a run of s seconds by that clock lasts t = -log(1 - m s e^(m t1)) / m from t1 on
//
// x, v: place and velocity at t0; x' = x - g t0^2 / 2 or x - g f(t0).
// Source: elementary (the relative motion of two such disks knows no pull: NUMERICS.md).
// Deviation: plain doubles, every error in Sight::off, so that bounds stay bounds. g t^2 and e^(m
// t)
//   are what costs digits: fine_epoch() says up to when they cost none that matter. The frame may
//   be much faster than the disks, so under gravity a bound says nothing about what comes later
//   than kEpochsAhead. (3) is cut off where a series leaves positive terms out, or 1e-12 of it is
//   taken away.
// Accuracy: as sight.hpp: tests/engine/sight_test.cpp.
// Preconditions: motions written at the epoch's beginning or after it; m > 0.

#include "elementary.hpp"
#include "motion_law/drag.hpp"
#include "sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::engine {

/// What pulls and slows all these disks.
struct CommonPull {
  double x = 0;  ///< m/s^2
  double y = 0;
  double drag = 0;  ///< 1/s
};

/// Sights of disks of about this radius lose no digits that matter for so long, s. Chosen: so that
/// what rounding adds to a place is 1e-8 of a radius (float: 4e-6), below the slack of the bounds.
inline double fine_epoch(const CommonPull& pull, double radius) {
  constexpr double kRadiiFallen = 1e6;
  constexpr double kTimesSlowed = 8;  // 1 / m
  const double strength = std::abs(pull.x) + std::abs(pull.y);
  double fine = std::numeric_limits<double>::infinity();
  if (strength > 0) fine = std::sqrt(kRadiiFallen * radius / strength);
  if (pull.drag > 0) fine = std::min(fine, kTimesSlowed / pull.drag);
  return fine;
}

/// Sight::off covers so many lengths of an epoch from its beginning: a prediction made in it looks
/// ahead by one at least. No unit.
inline constexpr double kEpochsAhead = 2;

/// How far one of these disks that starts from rest has come after t seconds, for a pull of 1, and
/// how fast it is; how far and fast one of speed 1 that is not pulled.
struct CommonMotion {
  double fallen = 0;  ///< s^2
  double gained = 0;  ///< s
  double run = 0;     ///< s
  double left = 1;
};
inline CommonMotion common_motion(double t, double drag) {
  if (!(drag > 0)) return {0.5 * t * t, t, t, 1};
  const detail::RoughDragClock clock = detail::rough_drag_clock(t, drag);
  return {clock.fall, clock.run, clock.run, clock.left};
}

/// How fast a disk was, and how far it came, in a flight that was under way before the epoch.
struct FlownBefore {
  double speed = 0;  ///< m/s
  double way = 0;    ///< m
};
template <class S>
FlownBefore flown_before(const DoubleWord2<S>& velocity, const CommonPull& pull, double seconds) {
  const CommonMotion flown = common_motion(seconds, pull.drag);
  const double strength = std::abs(pull.x) + std::abs(pull.y);
  const double speed =
      std::abs(static_cast<double>(velocity.x.hi)) + std::abs(static_cast<double>(velocity.y.hi));
  return {speed + strength * flown.gained, speed * flown.run + strength * flown.fallen};
}

/// (1) or (2). REQUIRES: the motion is written for the epoch's beginning or later; `before`: what
/// it was worked out from.
template <class S>
Sight falling_sight_of(const Motion<S>& motion,
                       const S& radius,
                       const CommonPull& pull,
                       const FlownBefore& before,
                       const Epoch<S>& epoch) {
  constexpr double kSlack = 4 * kFlightSlack<S>;
  Sight sight = sight_of(motion, radius, BodyType::Dynamic, epoch);
  const CommonMotion begun = common_motion(sight.since, pull.drag);
  const CommonMotion ended =
      common_motion(std::max(sight.since, kEpochsAhead * epoch.length), pull.drag);
  const double strength = std::abs(pull.x) + std::abs(pull.y);
  const double place = std::abs(sight.x) + std::abs(sight.y);
  const double speed = std::abs(sight.vx) + std::abs(sight.vy) + before.speed;
  const double fastest = (speed + 2 * strength * begun.gained) / begun.left;
  sight.off = kSlack * (place + before.way + fastest * ended.run + strength * ended.fallen) +
              kClock * (fastest + strength * ended.gained);
  keep_in_range(sight);
  sight.x -= pull.x * begun.fallen;
  sight.y -= pull.y * begun.fallen;
  sight.vx = (sight.vx - pull.x * begun.gained) / begun.left;
  sight.vy = (sight.vy - pull.y * begun.gained) / begun.left;
  sight.since = begun.run;
  return sight;
}

/// (3), or less: `run` s by the clock of disks that are slowed at this rate, from now on; infinity
/// if it never shows that.
inline double least_time_of_run(double run, double drag) {
  if (!(run > 0)) return 0;
  constexpr double kNearly = 1 - 1e-9;
  constexpr double kSlight = 1e-4;  // below it the terms left out are below 1e-12
  const double slowed = drag * run;
  if (slowed > 1 + 1e-9) return std::numeric_limits<double>::infinity();
  if (slowed < kSlight) return run * (1 + slowed * (0.5 + slowed * (1.0 / 3)));
  const double y = std::min(slowed, kNearly);
  return -detail::coarse_log1p(-y, 1 - y) * (1 - 1e-12) / drag;
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// A cheap look in plain doubles, before a kernel is asked: can this pair meet before a given time?
//
// For disks, with p, v the relative position and velocity at the present, d the reach:
//   b = p.v,  c = p.p - d d,  D = (v.v) d d - (p x v)^2,  t >= c / (sqrt(D) - b)
// For a disk and a wall, with h = e x p, w = e x v, L = |e|:  t >= (|h| - r L) / |w|
//
// Every quantity is widened by its error, so "no" is certain and "maybe" costs only a kernel call.
// No bit of a result depends on it: tests/engine/broad_phase_test.cpp compares with all pairs.
//
// Source: interval filters as in CGAL's filtered predicates; Deviation: static relative bounds.
// Accuracy: the relative slack below is a million times the rounding of the terms that it covers.

#include "body.hpp"
#include "motion_law/drag.hpp"

#include <stoss/engine/instant.hpp>

#include <algorithm>
#include <cmath>

namespace stoss::engine {

/// By how much a kernel's answer may differ from the exact one, as a part of the contact distance,
/// and more. Chosen: far above the 2^-50 (float: 2^-18) that rounding costs, far below what would
/// ask kernels in vain.
template <class S>
inline constexpr double kScreenSlack = 1e-9;
template <>
inline constexpr double kScreenSlack<float> = 3e-5;

/// The rounding of a position in S, as a part of the way flown, and more: a hundred times 2^-53 for
/// the sums here; float worlds compute in double words of 2^-46.
template <class S>
inline constexpr double kFlightSlack = 1e-14;
template <>
inline constexpr double kFlightSlack<float> = 4e-12;

/// s; a hundred times the rounding of a number of seconds from rough_seconds().
inline constexpr double kClock = 1e-14;

/// Position and velocity at the present, in doubles, and how far off the position may be.
struct Glance {
  double x = 0;
  double y = 0;
  double x_low = 0;  ///< kept apart: far from the origin the difference of two bodies needs it
  double y_low = 0;
  double vx = 0;
  double vy = 0;
  double error = 0;  ///< m
};

/// `later` - `earlier` to about 2^-53 s or 2^-52 of itself.
inline double rough_seconds(const Instant& later, const Instant& earlier) {
  const Int128 n = ticks(later) - ticks(earlier);
  const auto whole = static_cast<double>(static_cast<std::int64_t>(n >> 64));
  const auto part =
      static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(n) >> 11));
  return whole + part * 0x1p-53;
}
inline double rough_seconds(const WideInstant& later, const WideInstant& earlier) {
  return rough_seconds(later.coarse, earlier.coarse);
}

template <class S>
Glance glance(const Motion<S>& motion, const Time<S>& now) {
  Glance g;
  g.vx = static_cast<double>(motion.velocity.x.hi) + static_cast<double>(motion.velocity.x.lo);
  g.vy = static_cast<double>(motion.velocity.y.hi) + static_cast<double>(motion.velocity.y.lo);
  const double elapsed = rough_seconds(now, motion.since);
  const double flown_x = g.vx * elapsed;
  const double flown_y = g.vy * elapsed;
  g.x = static_cast<double>(motion.position.x.hi);
  g.y = static_cast<double>(motion.position.y.hi);
  g.x_low = static_cast<double>(motion.position.x.lo) + flown_x;
  g.y_low = static_cast<double>(motion.position.y.lo) + flown_y;
  const double speed = std::abs(g.vx) + std::abs(g.vy);
  g.error = kFlightSlack<S> * (std::abs(flown_x) + std::abs(flown_y)) + kClock * speed;
  return g;
}

/// The same under drag, with what pulls besides.
template <class S>
Glance dragged_glance(const Motion<S>& motion,
                      const DoubleWord2<S>& pull,
                      double rate,
                      const Time<S>& now) {
  Glance g;
  const detail::RoughDragClock clock =
      detail::rough_drag_clock(rough_seconds(now, motion.since), rate);
  const auto fly = [&](const DoubleWord<S>& p, const DoubleWord<S>& v, const DoubleWord<S>& a) {
    const double speed = static_cast<double>(v.hi) + static_cast<double>(v.lo);
    const double gained = static_cast<double>(a.hi) * clock.run;
    const double flown = speed * clock.run;
    const double fallen = static_cast<double>(a.hi) * clock.fall;
    g.error += 4 * kFlightSlack<S> * (std::abs(flown) + std::abs(fallen)) +
               kClock * (std::abs(speed) + std::abs(gained)) +
               1e-16 * std::abs(static_cast<double>(p.lo));
    struct Axis {
      double low, v;
    };
    return Axis{static_cast<double>(p.lo) + flown + fallen, speed * clock.left + gained};
  };
  const auto x = fly(motion.position.x, motion.velocity.x, pull.x);
  const auto y = fly(motion.position.y, motion.velocity.y, pull.y);
  g.x = static_cast<double>(motion.position.x.hi);
  g.y = static_cast<double>(motion.position.y.hi);
  g.x_low = x.low;
  g.y_low = y.low;
  g.vx = x.v;
  g.vy = y.v;
  return g;
}

/// No motion under drag goes further than that of this many times 1 / m, a little more than 1.
inline constexpr double kLastOfDrag = 1 + 1e-6;

/// Are the centres closer than `reach`, or may rounding hide that they are?
inline bool disks_are_within(const Glance& a, const Glance& b, double reach, double slack) {
  const double px = (b.x - a.x) + (b.x_low - a.x_low);
  const double py = (b.y - a.y) + (b.y_low - a.y_low);
  const double off = a.error + b.error + slack * (std::abs(px) + std::abs(py) + reach);
  return !(px * px + py * py > (reach + off) * (reach + off));
}

/// No body with this speed (m/s) and a pull of at most so much (m/s^2) along an axis goes `way`
/// metres sooner; s.
inline double shortest_crossing(double way, double speed, double pull) {
  if (!(way > 0)) return 0;
  return 2 * way / (speed + std::sqrt(speed * speed + 2 * pull * way));
}

/// False if disks with these motions certainly do not meet within `horizon` seconds from now.
/// `slack`: kScreenSlack of the arithmetic.
inline bool disks_may_meet(
    const Glance& a, const Glance& b, double reach, double horizon, double slack) {
  const double px = (b.x - a.x) + (b.x_low - a.x_low);
  const double py = (b.y - a.y) + (b.y_low - a.y_low);
  const double vx = b.vx - a.vx;
  const double vy = b.vy - a.vy;
  const double off = a.error + b.error + slack * (std::abs(px) + std::abs(py) + reach);
  const double speed = std::abs(vx) + std::abs(vy);
  const double approach = -(px * vx + py * vy) + off * speed;
  if (approach < 0) return false;
  const double near_reach = reach + off;
  const double moment = std::abs(px * vy - py * vx) - off * speed;
  const double sweep = (vx * vx + vy * vy) * near_reach * near_reach;
  constexpr double kLeast = 1e-280, kMost = 1e280;  // beyond, D loses digits or says nothing
  if (speed > 0 && !(sweep > kLeast && sweep < kMost)) [[unlikely]]
    return true;
  const double disc = sweep * (1 + slack) - (moment > 0 ? moment * moment : 0.0);
  if (disc < 0) return false;
  const double gap2 = px * px + py * py - near_reach * near_reach;
  const double slack2 = off * (std::abs(px) + std::abs(py) + near_reach);
  // Written so that a NaN from overflow asks the kernel.
  return !(gap2 - slack2 > horizon * (approach + std::sqrt(disc)) * (1 + slack));
}

/// False if the disk certainly does not meet the wall within `horizon` seconds from now. `edge` in
/// m.
inline bool disk_may_meet_wall(const Glance& disk,
                               const Glance& wall,
                               double radius,
                               double edge_x,
                               double edge_y,
                               double horizon,
                               double slack) {
  const double px = (disk.x - wall.x) + (disk.x_low - wall.x_low);
  const double py = (disk.y - wall.y) + (disk.y_low - wall.y_low);
  const double vx = disk.vx - wall.vx;
  const double vy = disk.vy - wall.vy;
  const double length = std::sqrt(edge_x * edge_x + edge_y * edge_y);
  const double off = disk.error + wall.error + slack * (std::abs(px) + std::abs(py) + radius);
  const double h = edge_x * py - edge_y * px;
  const double w = edge_x * vy - edge_y * vx;
  const double slack_w = slack * length * (std::abs(vx) + std::abs(vy));
  const double distance = std::abs(h) - length * (radius + off) * (1 + slack);
  const double closing = (h > 0 ? -w : w) + slack_w;
  return !(distance > horizon * std::max(closing, 0.0) * (1 + slack));
}

/// False if the disk's centre certainly crosses no rim of this radius within `horizon` seconds from
/// now, be it inside or outside. `bend`: by how far it may leave its straight line, m.
inline bool may_cross_rim(const Glance& disk,
                          const Glance& zone,
                          double radius,
                          double horizon,
                          double bend,
                          double slack) {
  const double px = (disk.x - zone.x) + (disk.x_low - zone.x_low);
  const double py = (disk.y - zone.y) + (disk.y_low - zone.y_low);
  const double off = disk.error + slack * (std::abs(px) + std::abs(py) + radius);
  const double to_rim = std::abs(std::sqrt(px * px + py * py) - radius) - off;
  const double speed = std::sqrt(disk.vx * disk.vx + disk.vy * disk.vy);
  return !(to_rim > (horizon * speed + bend) * (1 + slack));
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// A body as its neighbours look at it: its uniform motion in plain doubles, one cache line, and the
// earliest time at which it can meet another. A prediction reads these lines alone; the double
// words are read when a contact is due.
//
//   x(t) = x + v (t - since)       t, since: seconds after the epoch of all sights (1) b = p.v,  c
//   = p.p - d d,  D = (v.v) d d - (p x v)^2,  t >= c / (sqrt(D) - b)                  (2)
//
// p, v: relative position (m) and velocity (m/s) at t; d: the sum of the radii (m).
//
// Source: (2) as in contact_time/disk_disk.hpp; interval filters as in CGAL's filtered predicates.
// Deviation: every quantity is widened by its error, so that (2) is a lower bound and "never" is
//   certain. Errors of (1): `off` covers the rounding of x and of v (t - since), with t up to the
//   end of the epoch; Epoch chooses that end so that it stays far below the slack of (2).
// Accuracy: (2) is below the kernel's time by 1e-9 of itself (float: 3e-5) and a little, and never
//   above: tests/engine/sight_test.cpp, tests/engine/world/properties_test.cpp.

#include "lanes.hpp"
#include "screen.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace stoss::engine {

struct alignas(64) Sight {
  double x = 0;  ///< m, of the centre at `since`; of a wall's start
  double y = 0;
  double vx = 0;  ///< m/s
  double vy = 0;
  double since = 0;   ///< s after the epoch
  double radius = 0;  ///< m
  double off = 0;     ///< m; by how much (1) may be wrong until the epoch ends
  double unlike = 0;  ///< 0: a dynamic disk; 1: anything else
};

/// The instant that sights count from, and how long they may.
template <class S>
struct Epoch {
  Time<S> begin;
  double length = 1;  ///< s

  /// Whether sights must be taken anew; `events`: since the last time; `bodies`: how many there
  /// are. Long epochs cost nothing and short ones are exact: one lasts some hundred events a body.
  void renew(const Time<S>& now, std::uint64_t events, std::uint64_t bodies) {
    begin = now;
    if (events < 64 * bodies) length = std::min(4 * length, 0x1p60);
    if (events > 1024 * bodies) length = std::max(length / 4, 0x1p-60);
  }
};

/// The sight of a body with this motion, until `length` seconds after the epoch's beginning.
template <class S>
Sight sight_of(const Motion<S>& motion, const S& radius, BodyType type, const Epoch<S>& epoch) {
  Sight sight;
  sight.x = static_cast<double>(motion.position.x.hi) + static_cast<double>(motion.position.x.lo);
  sight.y = static_cast<double>(motion.position.y.hi) + static_cast<double>(motion.position.y.lo);
  sight.vx = static_cast<double>(motion.velocity.x.hi) + static_cast<double>(motion.velocity.x.lo);
  sight.vy = static_cast<double>(motion.velocity.y.hi) + static_cast<double>(motion.velocity.y.lo);
  sight.since = rough_seconds(motion.since, epoch.begin);
  sight.radius = static_cast<double>(radius);
  sight.unlike = type == BodyType::Dynamic ? 0 : 1;
  constexpr double kRounding = 1e-15;  // a few units in the last place of a coordinate
  const double speed = std::abs(sight.vx) + std::abs(sight.vy);
  const double way = speed * (std::abs(sight.since) + epoch.length);
  sight.off =
      kRounding * (std::abs(sight.x) + std::abs(sight.y)) + kFlightSlack<S> * way + kClock * speed;
  return sight;
}

/// An instant `seconds` >= 0 later, or less by up to 2^-63 s and 2^-52 of itself; never() for what
/// is beyond the end of time.
inline Instant roughly_later(const Instant& from, double seconds) {
  if (!(seconds < 0x1p60)) return Instant::never();
  const auto whole = static_cast<std::int64_t>(seconds);
  const auto part = static_cast<std::uint64_t>((seconds - static_cast<double>(whole)) * 0x1p63);
  const Instant later = instant_from_ticks(
      ticks(from) + ((static_cast<Int128>(whole) << 64) | static_cast<Int128>(part << 1)));
  return in_range(later) ? later : Instant::never();
}
inline WideInstant roughly_later(const WideInstant& from, double seconds) {
  const Instant later = roughly_later(from.coarse, seconds);
  return {later, later == Instant::never() ? 0 : from.fine};
}

/// `later` - `earlier`, two numbers of seconds >= 0, and rather less; >= 0.
inline float safe_difference(double later, double earlier) {
  const double less = (later - earlier) * (1 - 1e-6) - 1e-12 * earlier;
  return less > 0 ? static_cast<float>(less) : 0.0F;
}

/// What (2) needs of a body, at the present.
struct Present {
  double x, y, vx, vy, radius, off;
};
[[gnu::always_inline]] inline Present present_of(const Sight& sight, double now) {
  return {sight.x + sight.vx * (now - sight.since),
          sight.y + sight.vy * (now - sight.since),
          sight.vx,
          sight.vy,
          sight.radius,
          sight.off};
}

/// Of one sight (V = double) or of four.
template <class V>
struct SightsOf {
  V x, y, vx, vy, since, radius, off;
};

/// Equation (2): seconds after `now` (after the epoch) before which two disks certainly do not
/// meet; infinity if they never do. `slack`: kScreenSlack of the arithmetic.
template <class V>
[[gnu::always_inline]] inline V soonest_contact(const Present& a,
                                                const SightsOf<V>& b,
                                                double now,
                                                double slack) {
  using lanes::magnitude;
  const V vx = b.vx - a.vx;
  const V vy = b.vy - a.vy;
  const V px = (b.x + b.vx * (now - b.since)) - a.x;
  const V py = (b.y + b.vy * (now - b.since)) - a.y;
  const V reach = a.radius + b.radius;
  const V off = (a.off + b.off) + slack * (magnitude(px) + magnitude(py) + reach);
  const V speed = magnitude(vx) + magnitude(vy);
  const V approach = off * speed - (px * vx + py * vy);
  const V near_reach = reach + off;
  const V moment = magnitude(py * vx - px * vy) - off * speed;
  const V least = moment > 0 ? moment : V{};
  const V disc = (vx * vx + vy * vy) * near_reach * near_reach * (1 + slack) - least * least;
  const V gap2 = (px * px + py * py - near_reach * near_reach) -
                 off * (magnitude(px) + magnitude(py) + near_reach);
  const V soonest = gap2 / ((approach + lanes::root(disc)) * (1 + slack));
  const V never = V{} + std::numeric_limits<double>::infinity();
  const V if_any = gap2 > 0 ? soonest : V{};  // at once also for NaN, from overflow
  return ((approach < 0) | (disc < 0)) ? never : if_any;
}

inline double soonest_contact(const Sight& a, const Sight& b, double now, double slack) {
  return soonest_contact<double>(
      present_of(a, now), {b.x, b.y, b.vx, b.vy, b.since, b.radius, b.off}, now, slack);
}

/// What a body has before it among others: bounds of its contacts, s from now.
struct SoonestTwo {
  double first = std::numeric_limits<double>::infinity();
  double second = std::numeric_limits<double>::infinity();
  Slot partner = -1;        ///< of the first
  bool has_others = false;  ///< there are some that were not looked at

  void note(Slot other, double soonest) {
    if (soonest < first) {
      second = first;
      first = soonest;
      partner = other;
    } else if (soonest < second) {
      second = soonest;
    }
  }
};

/// Is this one for the bodies that soonest_contacts() passes over?
inline bool is_passed_over(const Sight& sight, double radius_min) {
  return sight.unlike != 0 || !(sight.radius >= radius_min);
}

/// Of the dynamic disks in a list with at least this radius, the soonest two contacts with the body
/// of this slot, by soonest_contact(). REQUIRES: `list` is in memory up to the next multiple of
/// four, and what stands there are slots of `sights`, whichever.
SoonestTwo soonest_contacts(Slot slot,
                            std::span<const Slot> list,
                            const std::vector<Sight>& sights,
                            double radius_min,
                            double now,
                            double slack);

}  // namespace stoss::engine

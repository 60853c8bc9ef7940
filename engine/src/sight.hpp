// SPDX-License-Identifier: Apache-2.0
#pragma once

// A body as its neighbours look at it: its uniform motion in plain doubles, one cache line, and the
// earliest time at which it can meet another. A prediction reads these lines alone; the double
// words are read when a contact is due.
//
//   (1) x(t) = x + v (t - since)       t, since: seconds after the epoch of all sights
//   (2) b = p.v,  c = p.p - d d,  D = (v.v) d d - (p x v)^2,  t >= c / (sqrt(D) - b)
//
// p, v: relative position (m) and velocity (m/s) at t; d: the sum of the radii (m). Where all radii
// grow by m/2 a second,
//
//   (3) b = p.v - d m,  D = |d v - m p|^2 - (p x v)^2
//
// and disks that recede meet too if |v| < m. What gravity and drag make straight: sight_frames.hpp.
//
// Source: (2), (3) as in contact_time/disk_disk.hpp, growing.hpp; interval filters as in CGAL's
//   filtered predicates.
// Deviation: every quantity is widened by its error, so that (2) is a lower bound and "never" is
//   certain. Errors of (1): `off` covers the rounding of x and of v (t - since), with t up to the
//   end of the epoch; Epoch chooses that end so that it stays far below the slack of (2).
// Accuracy: (2) is below the kernel's time by 1e-9 of itself (float: 3e-5) and a little, and never
//   above: tests/engine/sight_test.cpp, tests/engine/world/properties_test.cpp.

#include "screen.hpp"

#include <stoss/engine/lanes.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace stoss::engine {

/// What all sights say.
struct Look {
  double x = 0;  ///< m, of the centre at `since`; of a wall's start
  double y = 0;
  double vx = 0;  ///< m/s
  double vy = 0;
  double since = 0;  ///< s after the epoch
  double size = -1;  ///< m, which says who holds a pair; < 0: not a disk that moves like the rest
  double off = 0;    ///< m; by how much (1) may be wrong until the epoch ends
};

struct alignas(64) Sight : Look {
  double radius = 0;  ///< m; of a growing disk: at the epoch's beginning
  double reach() const { return radius; }
};

/// In a world where the numbers of (1) are what the motion's high words say. There the size is that
/// of the radius, and one more place is left for what a guess takes down of its partner.
struct alignas(64) PlainSight : Look {
  std::uint32_t changes = 0;  ///< of the body, as in Body
  BodyType type = BodyType::Dynamic;
  double reach() const { return std::abs(size); }
};

/// What all bodies have in common besides (1): nothing.
struct Steady {
  static constexpr bool kGrows = false;
  static constexpr bool kRepeats = false;
};

/// The reach of every two disks grows.
struct Growing {
  static constexpr bool kGrows = true;
  static constexpr bool kRepeats = false;
  double gained = 0;  ///< m, since the epoch's beginning
  double rate = 0;    ///< m/s
};

/// And the world repeats itself: of two bodies the nearest images alone can meet.
template <class Common>
struct Repeating : Common {
  static constexpr bool kRepeats = true;
  /// m; 0 along an open axis
  double length_x = 0;
  double length_y = 0;

  /// Of a difference of coordinates that of the nearest images. REQUIRES: below 2^50 periods.
  template <class V>
  [[gnu::always_inline]] static V nearest(const V& p, double length) {
    constexpr double kToWhole = 0x1.8p52;  // numbers beside it have no fraction
    const double periods = length > 0 ? 1 / length : 0;
    const V whole = (p * periods + kToWhole) - kToWhole;
    return p - whole * length;
  }
};

/// An instant `seconds` >= 0 later, or less by up to 2^-63 s and 2^-52 of itself; never() for what
/// is beyond the end of time.
[[gnu::always_inline]] inline Instant roughly_later(const Instant& from, double seconds) {
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

/// The instant that sights count from, and how long they may.
template <class S>
struct Epoch {
  Time<S> begin;
  double length = 1;  ///< s
  Time<S> end{};      ///< kept by start()

  void start(const Time<S>& now) {
    begin = now;
    end = roughly_later(now, length);
  }

  /// Sights are taken anew; `events`: since the last time; `bodies`: how many there are. That is a
  /// moment without any event, so epochs are long: some ten thousand events a body, after which a
  /// body's way since the epoch's beginning still adds less to `off` than a bound gives away
  /// between two of its events. Where they had to be longer than `fine`, s, for that, some ten.
  void renew(const Time<S>& now,
             std::uint64_t events,
             std::uint64_t bodies,
             double fine = std::numeric_limits<double>::infinity()) {
    const bool is_coarse = length > fine;
    const bool becomes_coarse = 4 * length > fine;
    if (events < (is_coarse ? 1 : becomes_coarse ? 64 : 4096) * bodies) {
      length = std::min(4 * length, 0x1p60);
    }
    if (events > (is_coarse ? 16 : 65'536) * bodies) length = std::max(length / 4, 0x1p-60);
    start(now);
  }
};

/// Rounding of a coordinate in double: a few units in the last place.
inline constexpr double kSightRounding = 1e-15;

/// Makes a sight with lengths or speeds for which terms of (2) would leave the range of double one
/// of a body that may be anywhere: then the kernel is asked.
template <class AnySight>
void keep_in_range(AnySight& sight) {
  constexpr double kMost = 1e70;  // m, m/s; its fourth power is in range
  // m. Who needs less than 2^61 s for more than the slack of such a reach has a speed that squared
  // and multiplied with its square is in range.
  constexpr double kLeast = 1e-60;
  const double reach = sight.reach();
  const bool is_in_range =
      sight.off < kSightRounding * kMost && reach < kMost && (reach > kLeast || reach == 0);
  if (!is_in_range) [[unlikely]]
    sight.off = std::numeric_limits<double>::infinity();
}

/// Makes a sight that shows where and how fast a body is count from the epoch's beginning, until
/// `length` seconds after it. `since`: when the body was there.
template <class AnySight, class S>
void date(AnySight& sight, const Time<S>& since, const Epoch<S>& epoch) {
  sight.since = rough_seconds(since, epoch.begin);
  const double speed = std::abs(sight.vx) + std::abs(sight.vy);
  const double way = speed * (std::abs(sight.since) + epoch.length);
  sight.off = kSightRounding * (std::abs(sight.x) + std::abs(sight.y)) + kFlightSlack<S> * way +
              kClock * speed;
  keep_in_range(sight);
}

/// The sight of a body with this motion.
template <class S>
Sight sight_of(const Motion<S>& motion, const S& radius, BodyType type, const Epoch<S>& epoch) {
  Sight sight;
  sight.x = static_cast<double>(motion.position.x.hi) + static_cast<double>(motion.position.x.lo);
  sight.y = static_cast<double>(motion.position.y.hi) + static_cast<double>(motion.position.y.lo);
  sight.vx = static_cast<double>(motion.velocity.x.hi) + static_cast<double>(motion.velocity.x.lo);
  sight.vy = static_cast<double>(motion.velocity.y.hi) + static_cast<double>(motion.velocity.y.lo);
  sight.radius = static_cast<double>(radius);
  sight.size = type == BodyType::Dynamic ? sight.radius : -1;
  date(sight, motion.since, epoch);
  return sight;
}

/// The same of a body whose radius grows; `grown`: its radius at the motion's instant, m. The size
/// stays that with which it came.
template <class S>
Sight growing_sight_of(const Motion<S>& motion,
                       const S& radius,
                       const DoubleWord<S>& grown,
                       double growth,
                       BodyType type,
                       const Epoch<S>& epoch) {
  Sight sight = sight_of(motion, radius, type, epoch);
  const double since_growth = growth * (std::abs(sight.since) + epoch.length);
  sight.radius = static_cast<double>(grown.hi) + static_cast<double>(grown.lo);
  sight.off += kSightRounding * sight.radius + kFlightSlack<S> * since_growth + kClock * growth;
  keep_in_range(sight);
  sight.radius -= growth * sight.since;
  return sight;
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
template <class AnySight>
[[gnu::always_inline]] inline Present present_of(const AnySight& sight, double now) {
  return {sight.x + sight.vx * (now - sight.since),
          sight.y + sight.vy * (now - sight.since),
          sight.vx,
          sight.vy,
          sight.reach(),
          sight.off};
}

/// Of one sight (V = double) or of four.
template <class V>
struct SightsOf {
  V x, y, vx, vy, since, radius, off;
};

/// (3), of a relative position and velocity; `off`: by how much the position may be wrong.
template <class V>
[[gnu::always_inline]] inline V soonest_growing_contact(const V& px,
                                                        const V& py,
                                                        const V& vx,
                                                        const V& vy,
                                                        const V& reach,
                                                        const V& off,
                                                        double rate,
                                                        double slack) {
  using lanes::magnitude;
  const V speed = magnitude(vx) + magnitude(vy);
  const V near_reach = reach + off;
  const V approach = (near_reach * rate - (px * vx + py * vy)) + off * (speed + rate);
  const V moment = magnitude(py * vx - px * vy) - off * speed;
  const V least = moment > 0 ? moment : V{};
  const auto skew = [&](const V& p, const V& v) {
    return magnitude(near_reach * v - rate * p) +
           slack * (near_reach * magnitude(v) + rate * magnitude(p));
  };
  const V skew_x = skew(px, vx);
  const V skew_y = skew(py, vy);
  const V disc = (skew_x * skew_x + skew_y * skew_y) * (1 + slack) - least * least;
  const V gap2 = (px * px + py * py - near_reach * near_reach) -
                 off * (magnitude(px) + magnitude(py) + near_reach);
  const V soonest =
      gap2 / ((approach + lanes::root(disc)) * (1 + slack) + slack * magnitude(approach));
  const V never = V{} + std::numeric_limits<double>::infinity();
  const V if_any = gap2 > 0 ? soonest : V{};  // at once also for NaN, from overflow
  const auto outruns = vx * vx + vy * vy > rate * rate * (1 + slack);
  return (((approach < 0) & outruns) | (disc < 0)) ? never : if_any;
}

/// Equation (2): seconds after `now` (after the epoch) before which two disks certainly do not
/// meet; infinity if they never do. `slack`: kScreenSlack of the arithmetic.
template <class V, class Common>
[[gnu::always_inline]] inline V soonest_contact(const Present& a,
                                                const SightsOf<V>& b,
                                                double now,
                                                double slack,
                                                [[maybe_unused]] const Common& common) {
  using lanes::magnitude;
  const V vx = b.vx - a.vx;
  const V vy = b.vy - a.vy;
  V px = (b.x + b.vx * (now - b.since)) - a.x;
  V py = (b.y + b.vy * (now - b.since)) - a.y;
  if constexpr (Common::kRepeats) {
    px = common.nearest(px, common.length_x);
    py = common.nearest(py, common.length_y);
  }
  V reach = a.radius + b.radius;
  if constexpr (Common::kGrows) reach = reach + common.gained;
  const V off = (a.off + b.off) + slack * (magnitude(px) + magnitude(py) + reach);
  if constexpr (Common::kGrows) {
    return soonest_growing_contact<V>(px, py, vx, vy, reach, off, common.rate, slack);
  }
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

template <class AnySight, class Common = Steady>
double soonest_contact(
    const AnySight& a, const AnySight& b, double now, double slack, const Common& common = {}) {
  return soonest_contact<double>(
      present_of(a, now), {b.x, b.y, b.vx, b.vy, b.since, b.reach(), b.off}, now, slack, common);
}

/// What a body has before it among others: bounds of its contacts, s from now.
struct SoonestTwo {
  double first = std::numeric_limits<double>::infinity();
  double second = std::numeric_limits<double>::infinity();
  Slot partner = -1;    ///< of the first
  int passed_over = 0;  ///< so many others there are that may meet it, too

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

/// Does the body move like most, so that four of them can be looked at together?
inline bool is_like(const Look& sight) { return sight.size >= 0; }

/// One that soonest_contacts() passes over.
struct PassedOver {
  Slot slot = -1;
  double soonest = -1;  ///< s from now; < 0: not known, it is not like the rest
};

/// Of the disks in a list that are like the rest and have at least this size, the soonest two
/// contacts with the body of this slot, by soonest_contact(). REQUIRES: size_min >= 0; `list` is in
/// memory up to the next multiple of four, and what stands there are slots of `sights`, whichever.
/// `others` gets those that it passes over, in the list's order, but for the smaller that it never
/// meets; memory for the whole list is there.
template <class AnySight, class Common>
SoonestTwo soonest_contacts(Slot slot,
                            std::span<const Slot> list,
                            const std::vector<AnySight>& sights,
                            double size_min,
                            double now,
                            double slack,
                            const Common& common,
                            PassedOver* others);

}  // namespace stoss::engine

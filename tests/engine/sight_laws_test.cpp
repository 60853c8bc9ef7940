// SPDX-License-Identifier: Apache-2.0
// What a prediction sees under gravity, drag and growth, against the kernels of these laws: never
// later than the contact, and hardly sooner. Environment: STOSS_SEED, STOSS_CASES (per family).
#include "laws.hpp"
#include "motion_law/accelerated.hpp"
#include "motion_law/drag.hpp"
#include "motion_law/growth.hpp"
#include "periodic.hpp"
#include "sight.hpp"
#include "sight_frames.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace stoss::engine {
namespace {

using test::Random;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A law with its numbers: pull in m/s^2, drag in 1/s, growth in m/s.
template <class S, class AnyLaws>
struct Law {
  using Scalar = S;
  using Laws = AnyLaws;
  DoubleWord2<S> pull;
  S drag{};
  S growth{};

  Flight<S> at(const Motion<S>& motion, const Time<S>& instant) const {
    if constexpr (Laws::kDragged) return flight_at(motion, pull, drag, instant);
    return {position_at(motion, pull, instant), velocity_at(motion, pull, instant)};
  }
  CommonPull common_pull() const {
    return {detail::rough(pull.x), detail::rough(pull.y), static_cast<double>(drag)};
  }
};

template <class S>
DoubleWord<S> word(double x) {
  const S high = static_cast<S>(x);
  return {high, static_cast<S>(x - static_cast<double>(high))};
}

/// A disk as its last event left it.
template <class S>
struct Disk {
  Motion<S> motion;
  DoubleWord<S> radius;
};

/// Where two disks are at the present, seen from the first, in units of the scene's scale.
struct Meeting {
  double px, py, vx, vy, radius;
};

enum class Family { Anywhere, Grazing, NearTouching, Fast };

Meeting random_meeting(Random& random, Family family) {
  Meeting m{random.uniform(-3, 3),
            random.uniform(-3, 3),
            random.uniform(-1, 1),
            random.uniform(-1, 1),
            random.uniform(0.01, 1)};
  const double distance = std::hypot(m.px, m.py);
  const double reach = 2 * m.radius;
  if (family == Family::Grazing) {  // the line of flight passes at the reach, and hardly more
    const double by = reach * (1 + random.either_sign(random.decades(-14, -1)));
    const double sine = std::min(by / distance, 0.999);
    const double cosine = std::sqrt(1 - sine * sine);
    const double speed = random.uniform(0.1, 1);
    m.vx = -speed * (m.px * cosine - m.py * sine) / distance;
    m.vy = -speed * (m.py * cosine + m.px * sine) / distance;
  }
  if (family == Family::NearTouching) {
    const double away = reach * (1 + random.decades(-12, -1)) / distance;
    m.px *= away;
    m.py *= away;
  }
  if (family == Family::Fast) {
    const double times = random.decades(0, 6);
    m.vx *= times;
    m.vy *= times;
  }
  return m;
}

/// A disk that is there at the present, back to an event up to `ago` seconds earlier.
template <class L, class S = typename L::Scalar>
Disk<S> disk_since(
    Random& random, const L& law, const Motion<S>& present, double radius, double ago) {
  const double growth = static_cast<double>(law.growth);
  if (growth > 0) ago = std::min(ago, 0.9 * radius / growth);
  const double back = random.one_in(8) ? 0 : random.uniform(0, ago);
  const Time<S> since = *later_by(present.since, S(-back), S(0));
  const Flight<S> then = law.at(present, since);
  return {{then.position, then.velocity, since},
          grown_by(word<S>(radius), law.growth, present.since, since)};
}

/// By the kernel, s after `now`; infinity if never.
template <class L, class S = typename L::Scalar>
double exact_contact(const L& law, const Disk<S>& a, const Disk<S>& b, const Time<S>& now) {
  using Laws = typename L::Laws;
  const Flight<S> from = law.at(a.motion, now);
  const Flight<S> to = law.at(b.motion, now);
  typename Laws::template Relative<S> relative{};
  relative.position = to.position - from.position;
  relative.velocity = to.velocity - from.velocity;
  if constexpr (Laws::kDragged) relative.rate = law.drag;
  const auto radius = [&](const Disk<S>& disk) {
    return grown_by(disk.radius, law.growth, disk.motion.since, now);
  };
  typename Laws::template Reach<S> reach;
  if constexpr (Laws::kGrows) {
    reach = {radius(a) + radius(b), two_sum(law.growth, law.growth)};
  } else {
    reach = radius(a) + radius(b);
  }
  const auto after =
      Laws::template pair_contact<S>(relative, reach, std::numeric_limits<S>::infinity());
  return after ? static_cast<double>(after->hi) : kNever;
}

/// As a world sees it: of a motion from before the epoch what is left at its beginning.
template <class L, class S = typename L::Scalar>
Sight see(const L& law, const Disk<S>& disk, const Epoch<S>& epoch) {
  const S radius = disk.radius.hi;
  if constexpr (L::Laws::kGrows) {
    return growing_sight_of<S>(disk.motion,
                               radius,
                               disk.radius,
                               static_cast<double>(law.growth),
                               BodyType::Dynamic,
                               epoch);
  } else {
    if (!(disk.motion.since < epoch.begin))
      return falling_sight_of<S>(disk.motion, radius, law.common_pull(), {}, epoch);
    const Flight<S> left = law.at(disk.motion, epoch.begin);
    const double flown = rough_seconds(epoch.begin, disk.motion.since);
    return falling_sight_of<S>({left.position, left.velocity, epoch.begin},
                               radius,
                               law.common_pull(),
                               flown_before<S>(disk.motion.velocity, law.common_pull(), flown),
                               epoch);
  }
}

/// By sights, s after `now`.
template <class L, class S = typename L::Scalar>
double seen_contact(
    const L& law, const Disk<S>& a, const Disk<S>& b, const Epoch<S>& epoch, const Time<S>& now) {
  const double seconds = rough_seconds(now, epoch.begin);
  const Sight see_a = see(law, a, epoch);
  const Sight see_b = see(law, b, epoch);
  if constexpr (L::Laws::kGrows) {
    const double rate = 2 * static_cast<double>(law.growth);
    return soonest_contact(see_a, see_b, seconds, kScreenSlack<S>, Growing{rate * seconds, rate});
  } else if constexpr (L::Laws::kDragged) {
    const auto rate = static_cast<double>(law.drag);
    const auto clock = detail::rough_drag_clock(seconds, rate);
    const double run = soonest_contact(see_a, see_b, clock.run, kScreenSlack<S>);
    return least_time_of_run(run / clock.left, rate);
  } else {
    return soonest_contact(see_a, see_b, seconds, kScreenSlack<S>);
  }
}

struct Tally {
  int contacts = 0;
  int loose = 0;
};

/// One case; `scale`: m, and m/s.
template <class L, class S = typename L::Scalar>
void compare(Random& random, const L& law, const Meeting& m, double scale, Tally& tally) {
  constexpr double kLength = 8;  // s
  const Time<S> begin = from_instant<Time<S>>(
      Instant{static_cast<std::int64_t>(random.below(1000)) - 500, random.bits()});
  const double present = random.uniform(0, kLength);
  const Time<S> now = *later_by(begin, S(present), S(0));
  const double place = random.one_in(4) ? scale * random.decades(0, 3) : 0;
  const double drift = scale * random.uniform(-1, 1);
  const auto moving = [&](double x, double y, double vx, double vy) {
    return Motion<S>{{word<S>(place + scale * x), word<S>(scale * y - place)},
                     {word<S>(drift + scale * vx), word<S>(scale * vy - drift)},
                     now};
  };
  const double ago = random.one_in(3) ? 4 * kLength : present;  // from before the epoch
  const Disk<S> a = disk_since(random, law, moving(0, 0, 0, 0), scale * m.radius, ago);
  const Disk<S> b = disk_since(random, law, moving(m.px, m.py, m.vx, m.vy), scale * m.radius, ago);
  const double exact = exact_contact(law, a, b, now);
  const double soonest = seen_contact(law, a, b, Epoch<S>{begin, kLength}, now);
  const bool is_pulled = !detail::is_zero(law.pull);
  if (is_pulled && exact > kEpochsAhead * kLength - present) return;  // nothing is said of these
  ASSERT_LE(soonest, exact);
  if (exact == kNever) return;
  ++tally.contacts;
  constexpr double kLoose = 1e3 * kScreenSlack<S>;
  if (soonest < exact * (1 - kLoose) - kLoose) ++tally.loose;
}

/// Families of meetings under laws of all strengths.
template <class L, class S = typename L::Scalar, class MakeLaw>
void expect_bounds(const MakeLaw& make_law) {
  Random random(test::seed_of_run());
  const auto cases = test::environment_number("STOSS_CASES", 40'000);
  for (const Family family :
       {Family::Anywhere, Family::Grazing, Family::NearTouching, Family::Fast}) {
    Tally tally;
    for (std::uint64_t i = 0; i < cases; ++i) {
      SCOPED_TRACE(testing::Message() << "family " << static_cast<int>(family) << " case " << i);
      const double scale = random.decades(-3, 3);
      const L law = make_law(random, scale);
      compare(random, law, random_meeting(random, family), scale, tally);
      if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(tally.contacts, static_cast<int>(cases / 100));
    if (family == Family::Anywhere) {
      EXPECT_LT(tally.loose, tally.contacts / 100);  // those that all but graze
    }
  }
}

template <class S>
Law<S, AcceleratedLaws> random_gravity(Random& random, double scale) {
  const double g = scale * random.decades(-3, 2);
  return {{word<S>(random.uniform(-g, g)), word<S>(-g)}, S(0), S(0)};
}

template <class S>
Law<S, DragLaws> random_drag(Random& random, double scale) {
  Law<S, DragLaws> law;
  law.drag = static_cast<S>(random.decades(-4, 0));
  const double g = random.one_in(2) ? 0 : scale * random.decades(-3, 1);
  law.pull = {word<S>(random.uniform(-g, g)), word<S>(-g)};
  return law;
}

template <class S>
Law<S, GrowingLaws> random_growth(Random& random, double scale) {
  Law<S, GrowingLaws> law;
  if (!random.one_in(8)) law.growth = static_cast<S>(scale * random.decades(-3, 1));
  return law;
}

TEST(SightLaws, BoundEveryContactOfFallingDisks) {
  expect_bounds<Law<double, AcceleratedLaws>>(random_gravity<double>);
}
TEST(SightLaws, BoundEveryContactOfFallingDisksInFloat) {
  expect_bounds<Law<float, AcceleratedLaws>>(random_gravity<float>);
}
TEST(SightLaws, BoundEveryContactUnderDrag) {
  expect_bounds<Law<double, DragLaws>>(random_drag<double>);
}
TEST(SightLaws, BoundEveryContactUnderDragInFloat) {
  expect_bounds<Law<float, DragLaws>>(random_drag<float>);
}
TEST(SightLaws, BoundEveryContactOfGrowingDisks) {
  expect_bounds<Law<double, GrowingLaws>>(random_growth<double>);
}
TEST(SightLaws, BoundEveryContactOfGrowingDisksInFloat) {
  expect_bounds<Law<float, GrowingLaws>>(random_growth<float>);
}

TEST(SightLaws, ARunByTheClockOfDragNeverLastsLonger) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 100'000; ++i) {
    const double rate = random.decades(-6, 3);
    const double slowed = random.one_in(2) ? random.uniform(0, 1) : random.decades(-12, 0);
    const double run = slowed / rate;
    const double least = least_time_of_run(run, rate);
    const long double exact = -std::log1p(-static_cast<long double>(rate) * run) / rate;
    ASSERT_GE(least, 0);
    ASSERT_LE(static_cast<long double>(least), exact * (1 + 4e-16L));
    if (slowed < 0.999) {
      ASSERT_GT(least, static_cast<double>(exact) * (1 - 1e-11));
    }
  }
  EXPECT_EQ(least_time_of_run(1.01, 1), kNever);
  EXPECT_EQ(least_time_of_run(kNever, 1e-3), kNever);
  EXPECT_EQ(least_time_of_run(0, 1), 0);
}

TEST(SightLaws, LongEpochsWithoutEventsAreNotCutShort) {
  Epoch<double> epoch{{}, 100};
  epoch.renew({100, 0}, 500, 100, 10);
  EXPECT_EQ(epoch.length, 100);
  epoch.renew({200, 0}, 99, 100, 10);
  EXPECT_EQ(epoch.length, 400);
  epoch.renew({600, 0}, 1'601, 100, 10);
  EXPECT_EQ(epoch.length, 100);
  epoch.renew({700, 0}, 6'400, 100, 399);
  EXPECT_EQ(epoch.length, 100);
}

TEST(SightLaws, EpochsLastTenThousandEventsABody) {
  Epoch<double> epoch{{}, 100};
  epoch.renew({100, 0}, 409'599, 100);
  EXPECT_EQ(epoch.length, 400);
  epoch.renew({500, 0}, 409'600, 100);
  EXPECT_EQ(epoch.length, 400);
  epoch.renew({900, 0}, 6'553'600, 100);
  EXPECT_EQ(epoch.length, 400);
  epoch.renew({1300, 0}, 6'553'601, 100);
  EXPECT_EQ(epoch.length, 100);
}

}  // namespace
}  // namespace stoss::engine

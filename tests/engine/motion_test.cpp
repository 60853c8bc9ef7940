// SPDX-License-Identifier: Apache-2.0
// Motions evaluated against exact arithmetic, and their records.
#include "support/oracle.hpp"
#include "support/random.hpp"

#include <stoss/engine/motion.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace stoss::engine {
namespace {

using test::Random;
using test::Real;

Real exact(const Instant& t) { return Real(t.seconds) + ldexp(Real(t.fraction), -64); }

DoubleWord<double> random_word(Random& random, double low, double high) {
  const double hi = random.either_sign(random.decades(low, high));
  return two_sum(hi, random.either_sign(random.uniform(0, 0.5)) * hi * 0x1p-53);
}

Motion<double> random_motion(Random& random) {
  Motion<double> motion;
  motion.position = {random_word(random, -6, 12), random_word(random, -6, 12)};
  motion.velocity = {random_word(random, -12, 6), random_word(random, -12, 6)};
  motion.since = {static_cast<std::int64_t>(random.below(1U << 30)), random.bits()};
  return motion;
}

Instant random_later(Random& random, const Instant& from) {
  return *offset_by(from, random.either_sign(random.decades(-12, 9)));
}

TEST(Motion, IsEvaluatedInDoubleWordsAndRoundedOnce) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 50000; ++i) {
    const Motion<double> motion = random_motion(random);
    const Instant at = random_later(random, motion.since);
    const Real flown = test::exact(motion.velocity.x) * (exact(at) - exact(motion.since));
    const Real truth = test::exact(motion.position.x) + flown;
    const DoubleWord<double> x = position_at(motion, at).x;
    const Real terms = abs(test::exact(motion.position.x)) + abs(flown);
    EXPECT_LE(abs(test::exact(x) - truth), terms * Real(0x1p-102));
    const Real ulp = abs(truth) * Real(0x1p-52);
    EXPECT_LE(abs(Real(to_scalar(x)) - truth), ulp + terms * Real(0x1p-102));
  }
}

TEST(Motion, AtItsOwnInstantIsItself) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 1000; ++i) {
    const Motion<double> motion = random_motion(random);
    const DoubleWord2<double> p = position_at(motion, motion.since);
    EXPECT_EQ(p.x.hi, motion.position.x.hi);
    EXPECT_EQ(p.x.lo, motion.position.x.lo);
    EXPECT_EQ(p.y.hi, motion.position.y.hi);
    EXPECT_EQ(p.y.lo, motion.position.y.lo);
  }
}

TEST(Motion, AtRestStaysWhereItIs) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 1000; ++i) {
    Motion<double> motion = random_motion(random);
    motion.velocity = {};
    const DoubleWord2<double> p = position_at(motion, random_later(random, motion.since));
    EXPECT_EQ(p.x.hi, motion.position.x.hi);
    EXPECT_EQ(p.x.lo, motion.position.x.lo);
  }
}

TEST(Motion, SurvivesItsRecord) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 1000; ++i) {
    const Motion<double> motion = random_motion(random);
    const MotionRecord record = to_record(7, motion);
    EXPECT_EQ(record.id, 7U);
    const Motion<double> again = from_record<double>(record);
    const Instant at = random_later(random, motion.since);
    const DoubleWord2<double> p = position_at(motion, at);
    EXPECT_EQ(position_at(again, at).x.hi, p.x.hi);
    EXPECT_EQ(position_at(again, at).x.lo, p.x.lo);
    // A replica evaluates with the very code of the daemon.
    EXPECT_EQ(evaluate(record, Arithmetic::Double, at), Vector2(to_scalar(p.x), to_scalar(p.y)));
  }
}

TEST(Motion, OfALongDoubleSurvivesItsRecordExactly) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 1000; ++i) {
    const long double value = std::ldexp(static_cast<long double>(random.bits()),
                                         static_cast<int>(random.below(80)) - 70);
    const SplitNumber split = to_split(DoubleWord<long double>{value, 0});
    EXPECT_EQ(from_split<long double>(split).hi, value);
  }
}

TEST(Motion, TurnsWithItsSpin) {
  EXPECT_EQ(turned(0.25, -2, {3, 0}, {5, 0}), -3.75);
  EXPECT_EQ(turned(0.25, 0, {3, 0}, {5000, 0}), 0.25);
  EXPECT_EQ(turned(1, 1, {5, 0}, {3, std::uint64_t{1} << 63}), -0.5);
}

}  // namespace
}  // namespace stoss::engine

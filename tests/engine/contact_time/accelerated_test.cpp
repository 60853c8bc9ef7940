// SPDX-License-Identifier: Apache-2.0
// Contacts of disks on relative parabolas against 400 bits: adversarial families, and single cases
// by hand. The faces of walls are in accelerated_wall_test.cpp.
#include "contact_time/accelerated_disk_disk.hpp"
#include "support/accelerated_cases.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace stoss::engine {
namespace {

using test::Census;
using test::CurvedCase;
using test::CurvedFamily;
using test::Random;
using test::Real;

template <class S>
Census census_of(const CurvedFamily& family, bool low_words, const std::string& scalar) {
  Census census(scalar + (low_words ? " two words, " : ", ") + family.name);
  Random random(test::seed_of_run());
  const std::uint64_t cases =
      test::environment_number("STOSS_CASES", test::campaign(1000, 100'000));
  for (std::uint64_t i = 0; i < cases; ++i) {
    const CurvedCase<S> c = test::make_curved<S>(family.shape(random), random, low_words);
    census.add(accelerated_disk_contact(c.motion, c.reach, c.t_max), test::exact_contact(c));
  }
  census.print();
  return census;
}

// Tolerances: of 10^5 cases per family the worst is off by 0.501 ulp; without acceleration, where
// the kernel for straight motion answers, by 4.1, as in disk_disk_test.cpp.
constexpr double kUlpMax = 0.51;
constexpr double kUlpMaxStraight = 6;

template <class S>
void expect_exact_families(const std::string& scalar) {
  for (const bool low_words : {false, true}) {
    for (const CurvedFamily& family : test::curved_families(test::kDecades<S>)) {
      SCOPED_TRACE(family.name + (low_words ? ", two words" : ""));
      Census census = census_of<S>(family, low_words, scalar);
      EXPECT_EQ(census.missed(), 0);
      EXPECT_EQ(census.falses(), 0);
      EXPECT_LE(census.max(), family.name == "no acceleration" ? kUlpMaxStraight : kUlpMax);
    }
  }
}

TEST(Accelerated, DoubleMissesNothingAndIsRoundedOnce) { expect_exact_families<double>("double"); }

TEST(Accelerated, FloatMissesNothingAndIsRoundedOnce) { expect_exact_families<float>("float"); }

template <class S>
AcceleratedMotion<S> flying(S px, S py, S vx, S vy, S ax, S ay) {
  return {{{px, S(0)}, {py, S(0)}}, {{vx, S(0)}, {vy, S(0)}}, {{ax, S(0)}, {ay, S(0)}}};
}

template <class S>
std::optional<Duration<S>> meet(const AcceleratedMotion<S>& motion,
                                S reach,
                                S t_max = std::numeric_limits<S>::infinity()) {
  return accelerated_disk_contact(motion, DoubleWord<S>{reach, S(0)}, t_max);
}

template <class S>
class AcceleratedByHand : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(AcceleratedByHand, Scalars);

// t = sqrt(2 h / g), g = 8: one second for 4 m.
TYPED_TEST(AcceleratedByHand, DropOnAPointTakesTheRootOfTwiceTheHeight) {
  using S = TypeParam;
  const auto motion = flying<S>(S(0), S(5), S(0), S(0), S(0), S(-8));
  const auto t = meet(motion, S(1));
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(1));
  EXPECT_EQ(t->lo, S(0));
  EXPECT_TRUE(meet(motion, S(1), S(1)).has_value());
  EXPECT_FALSE(meet(motion, S(1), S(0.999)).has_value());
}

// Up with 4 m/s against 8 m/s^2: back after a second.
TYPED_TEST(AcceleratedByHand, TouchingAndSeparatingComesDownAgain) {
  using S = TypeParam;
  const auto t = meet(flying<S>(S(0), S(1), S(0), S(4), S(0), S(-8)), S(1));
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(1));
}

TYPED_TEST(AcceleratedByHand, TouchingWithoutClosingSpeedIsDecidedByTheAcceleration) {
  using S = TypeParam;
  const auto pressed = meet(flying<S>(S(0), S(1), S(0), S(0), S(0), S(-8)), S(1));
  ASSERT_TRUE(pressed.has_value());
  EXPECT_EQ(pressed->hi, S(0));
  EXPECT_FALSE(meet(flying<S>(S(0), S(1), S(0), S(0), S(0), S(8)), S(1)).has_value());
  // Sliding over the top: v^2 / d against g decides.
  EXPECT_TRUE(meet(flying<S>(S(0), S(1), S(1), S(0), S(0), S(-2)), S(1)).has_value());
  EXPECT_FALSE(meet(flying<S>(S(0), S(1), S(2), S(0), S(0), S(-2)), S(1)).has_value());
}

// Overlapping by 2^-10 and rising too slowly to come off: it meets where it turns.
TYPED_TEST(AcceleratedByHand, OverlapThatDoesNotComeOffMeetsWhereItTurns) {
  using S = TypeParam;
  const S place = S(1) - S(0x1p-10), speed = S(0x1p-6);
  const auto t = meet(flying<S>(S(0), place, S(0), speed, S(0), S(-8)), S(1));
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(0x1p-9));
}

TYPED_TEST(AcceleratedByHand, ParabolaThatTouchesOnlyIsNoContact) {
  using S = TypeParam;
  // Thrown up so that the apex touches a disk above.
  EXPECT_FALSE(meet(flying<S>(S(0), S(-5), S(0), S(8), S(0), S(-8)), S(1)).has_value());
  EXPECT_TRUE(meet(flying<S>(S(0), S(-5), S(0), S(8.125), S(0), S(-8)), S(1)).has_value());
}

TYPED_TEST(AcceleratedByHand, SecondBranchIsHitWhereTheFirstPassesBy) {
  using S = TypeParam;
  // Past the point on the way up, 2 m beside it, and down on it.
  const S t(3);
  const S vx = S(4) / t, g(8), vy = g * t / S(2);
  const auto hit = meet(flying<S>(S(-4), S(0), vx, vy, S(0), -g), S(0.5));
  ASSERT_TRUE(hit.has_value());
  EXPECT_LT(hit->hi, t);
  EXPECT_GT(hit->hi, S(2.8));
}

TYPED_TEST(AcceleratedByHand, NotANumberAndInfinityNeverMeet) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), inf, S(-inf)}) {
    EXPECT_FALSE(meet(flying<S>(bad, S(5), S(0), S(0), S(0), S(-8)), S(1)).has_value());
    EXPECT_FALSE(meet(flying<S>(S(0), bad, S(0), S(0), S(0), S(-8)), S(1)).has_value());
    EXPECT_FALSE(meet(flying<S>(S(0), S(5), bad, S(0), S(0), S(-8)), S(1)).has_value());
    EXPECT_FALSE(meet(flying<S>(S(0), S(5), S(0), bad, S(0), S(-8)), S(1)).has_value());
    EXPECT_FALSE(meet(flying<S>(S(0), S(5), S(0), S(0), bad, S(-8)), S(1)).has_value());
    EXPECT_FALSE(meet(flying<S>(S(0), S(5), S(0), S(0), S(0), bad), S(1)).has_value());
    EXPECT_FALSE(meet(flying<S>(S(0), S(5), S(0), S(0), S(0), S(-8)), bad).has_value());
  }
  EXPECT_FALSE(meet(flying<S>(S(0), S(5), S(0), S(0), S(0), S(-8)), S(1), S(-1)).has_value());
  const auto motion = flying<S>(S(0), S(5), S(0), S(0), S(0), S(-8));
  EXPECT_FALSE(meet(motion, S(1), std::numeric_limits<S>::quiet_NaN()).has_value());
}

// Powers of two change no digit, be the sizes within the kernel's range or not.
TEST(Accelerated, SizesOutsideTheRangeAreShifted) {
  const auto motion = flying(0.75, 5.5, -0.5, 2.0, 0.25, -9.81);
  const auto expected = meet(motion, 0.75);
  ASSERT_TRUE(expected.has_value());
  for (const int length : {-400, -200, 0, 200, 400}) {
    for (const int time : {-200, 0, 150}) {
      const double l = std::ldexp(1, length), v = std::ldexp(1, length - time);
      const double a = std::ldexp(1, length - 2 * time);
      const auto t =
          meet(flying(0.75 * l, 5.5 * l, -0.5 * v, 2.0 * v, 0.25 * a, -9.81 * a), 0.75 * l);
      ASSERT_TRUE(t.has_value()) << length << " " << time;
      EXPECT_EQ(t->hi, std::ldexp(expected->hi, time)) << length << " " << time;
    }
  }
}

TEST(Accelerated, LongFlightHasASecondWord) {
  const auto motion = flying(-1e6, 0.25, 1e3, 0.0, 1.0, 0.0);
  const auto t = meet(motion, 1.0);
  ASSERT_TRUE(t.has_value());
  EXPECT_NE(t->lo, 0.0);
  const test::Real2 at = test::exact(displacement_at(motion, *t));
  const Real miss = abs(sqrt(test::dot(at, at)) - 1);
  EXPECT_LE(miss.convert_to<double>(), 1e-20);
}

}  // namespace
}  // namespace stoss::engine

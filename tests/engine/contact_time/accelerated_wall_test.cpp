// SPDX-License-Identifier: Apache-2.0
// Contacts of disks on parabolas with the faces of walls against 400 bits: adversarial families,
// and single cases by hand.
#include "contact_time/accelerated_disk_wall.hpp"
#include "support/accelerated_cases.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::Census;
using test::FacedCase;
using test::FacedFamily;
using test::Random;
using test::Real;

template <class S>
Census census_of(const FacedFamily& family, bool low_words, const std::string& scalar) {
  Census census(scalar + (low_words ? " two words, " : ", ") + family.name);
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(3000);
  for (std::uint64_t i = 0; i < cases; ++i) {
    const FacedCase<S> c = test::make_faced<S>(family.shape(random), random, low_words);
    const test::ExactLanding truth = test::exact_landing(c);
    if (truth.is_at_an_end) continue;
    census.add(accelerated_face_contact(c.motion, c.edge, c.radius, c.t_max), truth.t);
  }
  census.print();
  return census;
}

// Tolerance: of 10^6 cases per family the worst is off by 0.505 ulp.
constexpr double kUlpMax = 0.51;

template <class S>
void expect_exact_families(const std::string& scalar) {
  for (const bool low_words : {false, true}) {
    for (const FacedFamily& family : test::faced_families(test::kDecades<S>)) {
      SCOPED_TRACE(family.name + (low_words ? ", two words" : ""));
      Census census = census_of<S>(family, low_words, scalar);
      EXPECT_EQ(census.missed(), 0);
      EXPECT_EQ(census.falses(), 0);
      EXPECT_LE(census.max(), kUlpMax);
    }
  }
}

TEST(AcceleratedWall, DoubleMissesNothingAndIsRoundedOnce) {
  expect_exact_families<double>("double");
}

TEST(AcceleratedWall, FloatMissesNothingAndIsRoundedOnce) { expect_exact_families<float>("float"); }

template <class S>
AcceleratedMotion<S> flying(S px, S py, S vx, S vy, S ax, S ay) {
  return {{{px, S(0)}, {py, S(0)}}, {{vx, S(0)}, {vy, S(0)}}, {{ax, S(0)}, {ay, S(0)}}};
}

/// With the wall from (0, 0) to (4, 0) and a radius of 1.
template <class S>
std::optional<Duration<S>> meet(const AcceleratedMotion<S>& motion,
                                S t_max = std::numeric_limits<S>::infinity()) {
  return accelerated_face_contact(motion, DoubleWord2<S>{{S(4), S(0)}, {S(0), S(0)}}, S(1), t_max);
}

template <class S>
class AcceleratedWallByHand : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(AcceleratedWallByHand, Scalars);

TYPED_TEST(AcceleratedWallByHand, DropOnEitherFaceTakesTheRootOfTwiceTheHeight) {
  using S = TypeParam;
  for (const S side : {S(1), S(-1)}) {
    const auto motion = flying<S>(S(2), side * S(5), S(0), S(0), S(0), side * S(-8));
    const auto t = meet(motion);
    ASSERT_TRUE(t.has_value());
    EXPECT_EQ(t->hi, S(1));
    EXPECT_TRUE(meet(motion, S(1)).has_value());
    EXPECT_FALSE(meet(motion, S(0.999)).has_value());
  }
}

// Down past the start of the wall, against a pull upwards, and up on its other face.
TYPED_TEST(AcceleratedWallByHand, BallThatFliesPastAnEndLandsOnTheOtherFace) {
  using S = TypeParam;
  const auto t = meet(flying<S>(S(-4), S(3), S(1), S(-8), S(0), S(2)));
  ASSERT_TRUE(t.has_value());
  // 3 - 8 t + t^2 = -1 rising: t = 4 + sqrt(12), x = t - 4
  EXPECT_FALSE(meet(flying<S>(S(-9), S(3), S(1), S(-8), S(0), S(2))).has_value());
  EXPECT_NEAR(static_cast<double>(t->hi), 4 + std::sqrt(12.0), 1e-6);
}

TYPED_TEST(AcceleratedWallByHand, BallThrownUpPastAnEndComesDownOnTheFace) {
  using S = TypeParam;
  // From beside the wall's start, below it, over its edge.
  const auto t = meet(flying<S>(S(-2), S(-3), S(1), S(16), S(0), S(-8)));
  ASSERT_TRUE(t.has_value());
  EXPECT_NEAR(static_cast<double>(t->hi), 2 + std::sqrt(3.0), 1e-6);  // -3 + 16 t - 4 t^2 = 1
}

TYPED_TEST(AcceleratedWallByHand, TouchingWithoutClosingSpeedIsDecidedByTheAcceleration) {
  using S = TypeParam;
  const auto pressed = meet(flying<S>(S(2), S(1), S(1), S(0), S(0), S(-8)));
  ASSERT_TRUE(pressed.has_value());
  EXPECT_EQ(pressed->hi, S(0));
  EXPECT_FALSE(meet(flying<S>(S(2), S(1), S(1), S(0), S(0), S(8))).has_value());
  EXPECT_FALSE(meet(flying<S>(S(2), S(1), S(1), S(0), S(1), S(0))).has_value());
}

TYPED_TEST(AcceleratedWallByHand, BounceComesDownAgain) {
  using S = TypeParam;
  const auto t = meet(flying<S>(S(2), S(1), S(0), S(4), S(0), S(-8)));
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(1));
  // Overlapping by 2^-10 it does not come off, and meets where it turns.
  const auto turn = meet(flying<S>(S(2), S(1) - S(0x1p-10), S(0), S(0x1p-6), S(0), S(-8)));
  ASSERT_TRUE(turn.has_value());
  EXPECT_EQ(turn->hi, S(0x1p-9));
}

TYPED_TEST(AcceleratedWallByHand, ApexThatTouchesACeilingIsNoContact) {
  using S = TypeParam;
  EXPECT_FALSE(meet(flying<S>(S(2), S(-5), S(0), S(8), S(0), S(-8))).has_value());
  EXPECT_TRUE(meet(flying<S>(S(2), S(-5), S(0), S(8.125), S(0), S(-8))).has_value());
}

TYPED_TEST(AcceleratedWallByHand, NotANumberAndInfinityNeverMeet) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), inf, S(-inf)}) {
    EXPECT_FALSE(meet(flying<S>(bad, S(5), S(0), S(0), S(0), S(-8))).has_value());
    EXPECT_FALSE(meet(flying<S>(S(2), bad, S(0), S(0), S(0), S(-8))).has_value());
    EXPECT_FALSE(meet(flying<S>(S(2), S(5), bad, S(0), S(0), S(-8))).has_value());
    EXPECT_FALSE(meet(flying<S>(S(2), S(5), S(0), bad, S(0), S(-8))).has_value());
    EXPECT_FALSE(meet(flying<S>(S(2), S(5), S(0), S(0), bad, S(-8))).has_value());
    EXPECT_FALSE(meet(flying<S>(S(2), S(5), S(0), S(0), S(0), bad)).has_value());
  }
}

TEST(AcceleratedWall, SizesOutsideTheRangeAreShifted) {
  const auto land = [](double l, double v, double a) {
    return accelerated_face_contact(
        flying(2.25 * l, 5.5 * l, -0.5 * v, 2.0 * v, 0.25 * a, -9.81 * a),
        DoubleWord2<double>{{4 * l, 0}, {0.3 * l, 0}},
        0.75 * l,
        std::numeric_limits<double>::infinity());
  };
  const auto expected = land(1, 1, 1);
  ASSERT_TRUE(expected.has_value());
  for (const int length : {-400, -200, 0, 200, 400}) {
    for (const int time : {-200, 0, 150}) {
      const auto t = land(
          std::ldexp(1, length), std::ldexp(1, length - time), std::ldexp(1, length - 2 * time));
      ASSERT_TRUE(t.has_value()) << length << " " << time;
      EXPECT_EQ(t->hi, std::ldexp(expected->hi, time)) << length << " " << time;
    }
  }
}

}  // namespace
}  // namespace stoss::engine

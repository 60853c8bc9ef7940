// SPDX-License-Identifier: Apache-2.0
// Contact times of disks with the faces of walls against 400 bits: adversarial families for
// resting and moving walls, and single cases by hand. The ends are in wall_end_test.cpp.
#include "contact_time/disk_wall.hpp"

#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace stoss::engine {
namespace {

using test::Census;
using test::Random;
using test::Real;
using test::WallCase;
using test::WallFamily;

template <class S>
WallCase<S> wall_case(S px, S py, S vx, S vy, S edge_x, S edge_y, S radius) {
  return {{{{px, S(0)}, {py, S(0)}}, {{vx, S(0)}, {vy, S(0)}}},
          {{edge_x, S(0)}, {edge_y, S(0)}},
          radius};
}

template <class S>
std::optional<Duration<S>> meet(const WallCase<S>& c) {
  return disk_wall_face_contact(c.motion, c.edge, c.radius);
}

/// A wall that moves: what the kernel is given is the difference of two velocities.
template <class S>
void set_in_motion(WallCase<S>& c, Random& random) {
  DoubleWord2<S>& v = c.motion.velocity;
  const S speed = detail::size_of(v);
  const S wall_x = static_cast<S>(random.uniform(-3, 3)) * speed;
  const S wall_y = static_cast<S>(random.uniform(-3, 3)) * speed;
  const DoubleWord2<S> disk = {v.x + wall_x, v.y + wall_y};
  v = {disk.x - wall_x, disk.y - wall_y};
}

template <class S>
Census census_of(const WallFamily& family, bool low_words, bool moving, const std::string& name) {
  Census census(name + (low_words ? " two words, " : ", ") + family.name +
                (moving ? ", moving" : ""));
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(15000);
  const Real margin = 4096 * Real(std::numeric_limits<S>::epsilon());
  for (std::uint64_t i = 0; i < cases; ++i) {
    WallCase<S> c = test::make_wall<S>(family.shape(random), random, low_words);
    if (moving) set_in_motion(c, random);
    const auto truth = test::exact_line_contact(test::exact(c.motion.position),
                                                test::exact(c.motion.velocity),
                                                test::exact(c.edge),
                                                Real(c.radius));
    if (truth && (abs(truth->s) < margin || abs(truth->s - 1) < margin)) continue;
    const bool on_wall = truth && truth->s > 0 && truth->s < 1;
    census.add(meet(c), on_wall ? std::optional<Real>(truth->t) : std::nullopt);
  }
  census.print();
  return census;
}

// Tolerances: of 10^6 cases per family the worst is off by 3.2 ulp, and 99.9 % are within 1.8.
constexpr double kUlpMax = 4;
constexpr double kUlpMost = 2;

template <class S>
void expect_exact_families(const std::string& scalar, bool moving) {
  for (const bool low_words : {false, true}) {
    for (const WallFamily& family : test::wall_families(test::kDecades<S>)) {
      SCOPED_TRACE(family.name + (low_words ? ", two words" : ""));
      Census census = census_of<S>(family, low_words, moving, scalar);
      EXPECT_EQ(census.missed(), 0);
      EXPECT_EQ(census.falses(), 0);
      EXPECT_LE(census.max(), kUlpMax);
      EXPECT_LE(census.quantile(0.999), kUlpMost);
    }
  }
}

TEST(DiskWall, DoubleMissesNothingAndIsWithinFourUlp) {
  expect_exact_families<double>("double", false);
}

TEST(DiskWall, FloatMissesNothingAndIsWithinFourUlp) {
  expect_exact_families<float>("float", false);
}

TEST(DiskWall, MovingWallIsAsExactAsAResting) { expect_exact_families<double>("double", true); }

template <class S>
class DiskWallByHand : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(DiskWallByHand, Scalars);

TYPED_TEST(DiskWallByHand, BothFacesAreHitAtGapOverSpeed) {
  using S = TypeParam;
  for (const S side : {S(1), S(-1)}) {
    for (const S direction : {S(1), S(-1)}) {
      const S start = direction > 0 ? S(2) : S(-2);
      const auto t =
          meet(wall_case<S>(start, side * S(3), S(0), side * S(-2), direction * S(4), S(0), S(1)));
      ASSERT_TRUE(t.has_value());
      EXPECT_EQ(t->hi, S(1));
    }
  }
}

TYPED_TEST(DiskWallByHand, FlightPastTheEndIsNotTheFacesBusiness) {
  using S = TypeParam;
  EXPECT_FALSE(meet(wall_case<S>(S(5), S(3), S(0), S(-1), S(4), S(0), S(2))).has_value());
  EXPECT_FALSE(meet(wall_case<S>(S(-1), S(3), S(0), S(-1), S(4), S(0), S(2))).has_value());
}

TYPED_TEST(DiskWallByHand, EndOfTheWallBelongsToTheFaceToo) {
  using S = TypeParam;
  EXPECT_TRUE(meet(wall_case<S>(S(0), S(3), S(0), S(-1), S(4), S(0), S(1))).has_value());
  EXPECT_TRUE(meet(wall_case<S>(S(4), S(3), S(0), S(-1), S(4), S(0), S(1))).has_value());
}

TYPED_TEST(DiskWallByHand, TouchingDiskMeetsNowIfItApproachesAndNeverOtherwise) {
  using S = TypeParam;
  const auto now = meet(wall_case<S>(S(2), S(1), S(1), S(-1), S(4), S(0), S(1)));
  ASSERT_TRUE(now.has_value());
  EXPECT_EQ(now->hi, S(0));
  EXPECT_FALSE(meet(wall_case<S>(S(2), S(1), S(1), S(0), S(4), S(0), S(1))).has_value());
  EXPECT_FALSE(meet(wall_case<S>(S(2), S(1), S(1), S(1), S(4), S(0), S(1))).has_value());
  EXPECT_FALSE(meet(wall_case<S>(S(2), S(1), S(0), S(0), S(4), S(0), S(1))).has_value());
}

TYPED_TEST(DiskWallByHand, WallWithoutLengthHasNoFace) {
  using S = TypeParam;
  EXPECT_FALSE(meet(wall_case<S>(S(2), S(1), S(-1), S(-1), S(0), S(0), S(1))).has_value());
  const WallCase<S> c = wall_case<S>(S(3), S(0), S(-1), S(0), S(0), S(0), S(1));
  const auto t = disk_point_contact(c.motion, c.radius);
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(2));
  EXPECT_FALSE(projects_inside(c.motion, c.edge, *t));
}

TYPED_TEST(DiskWallByHand, NotANumberAndInfinityNeverMeet) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), inf, S(-inf)}) {
    EXPECT_FALSE(meet(wall_case<S>(bad, S(3), S(0), S(-1), S(4), S(0), S(1))).has_value());
    EXPECT_FALSE(meet(wall_case<S>(S(2), bad, S(0), S(-1), S(4), S(0), S(1))).has_value());
    EXPECT_FALSE(meet(wall_case<S>(S(2), S(3), bad, S(-1), S(4), S(0), S(1))).has_value());
    EXPECT_FALSE(meet(wall_case<S>(S(2), S(3), S(0), bad, S(4), S(0), S(1))).has_value());
    EXPECT_FALSE(meet(wall_case<S>(S(2), S(3), S(0), S(-1), bad, S(0), S(1))).has_value());
    EXPECT_FALSE(meet(wall_case<S>(S(2), S(3), S(0), S(-1), S(4), bad, S(1))).has_value());
    EXPECT_FALSE(meet(wall_case<S>(S(2), S(3), S(0), S(-1), S(4), S(0), bad)).has_value());
  }
}

TEST(DiskWall, SizesAndSpeedsBeyondTheSquaresAreShifted) {
  for (const double size : {1e-300, 1e-200, 1.0, 1e200, 1e300}) {
    for (const double speed : {1e-300, 1e-200, 1.0, 1e200, 1e300}) {
      const auto t = meet(wall_case(2 * size, 3 * size, 0.0, -speed, 4 * size, 0.0, size));
      const double expected = 2 * (size / speed);
      if (expected > std::numeric_limits<double>::max() || expected == 0) continue;
      ASSERT_TRUE(t.has_value()) << size << " " << speed;
      EXPECT_NEAR(t->hi / expected, 1.0, 1e-15) << size << " " << speed;
    }
  }
}

}  // namespace
}  // namespace stoss::engine

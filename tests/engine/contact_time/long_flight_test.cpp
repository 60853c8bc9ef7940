// SPDX-License-Identifier: Apache-2.0
// Contacts at the end of long flights: a bullet from 10^12 reaches away has a time whose ulp is
// 10^-4 reaches of flight. The second word of the time must make up for it: the time as a double
// word, and the contact's normal, are compared with 400 bits.
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>

namespace stoss::engine {
namespace {

using test::PairCase;
using test::Random;
using test::Real;
using test::Real2;

Real length_of(const Real2& a) { return sqrt(test::dot(a, a)); }

/// The angle between two vectors, for small angles.
double angle_between(const Real2& a, const Real2& b) {
  const Real sine = abs(test::cross(a, b)) / (length_of(a) * length_of(b));
  return sine.convert_to<double>();
}

struct Worst {
  double time = 0;    ///< relative error of hi + lo
  double normal = 0;  ///< angle
  double reach = 0;   ///< | |displacement| - reach | / reach
};

template <class S>
Worst worst_of_bullets(double decades, bool low_words) {
  Worst worst;
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(30000);
  for (std::uint64_t i = 0; i < cases; ++i) {
    const test::PairShape shape{Real(std::pow(10.0, decades)), Real(random.uniform(0, 0.95)), 1, 1};
    const PairCase<S> c = test::make_pair<S>(shape, random, low_words);
    const Real2 p = test::exact(c.motion.position), v = test::exact(c.motion.velocity);
    const Real reach = test::exact(c.reach);
    const std::optional<Real> truth = test::exact_pair_contact(p, v, reach);
    const auto t = disk_disk_contact(c.motion, c.reach);
    if (!truth || !t) {
      EXPECT_EQ(truth.has_value(), t.has_value());
      continue;
    }
    const Real2 at{p.x + v.x * *truth, p.y + v.y * *truth};
    const Real2 found = test::exact(displacement_at(c.motion, *t));
    const Real error = abs(test::exact(*t) - *truth) / *truth;
    const Real miss = abs(length_of(found) - reach) / reach;
    worst.time = std::max(worst.time, error.convert_to<double>());
    worst.normal = std::max(worst.normal, angle_between(at, found));
    worst.reach = std::max(worst.reach, miss.convert_to<double>());
  }
  std::printf("bullets from 1e%g reaches%s: time %.2g, normal %.2g rad, reach %.2g\n",
              decades,
              low_words ? " (two words)" : "",
              worst.time,
              worst.normal,
              worst.reach);
  return worst;
}

// Double words resolve 2^-104 of the distance, which at 10^12 reaches is 5e-20 of a reach; a hit at
// 0.95 reaches off the centre multiplies it by 3. The normal itself is rounded to 1e-16.
TEST(LongFlight, BulletInDoubleHasTimeAndNormalToTheLastPlace) {
  for (const bool low_words : {false, true}) {
    for (const double decades : {2.0, 6.0, 12.0}) {
      const Worst worst = worst_of_bullets<double>(decades, low_words);
      EXPECT_LE(worst.time, 1e-30);
      EXPECT_LE(worst.normal, 1e-15);
      EXPECT_LE(worst.reach, 1e-15);
    }
  }
}

TEST(LongFlight, BulletInFloatHasTimeAndNormalToTheLastPlace) {
  for (const bool low_words : {false, true}) {
    for (const double decades : {2.0, 5.0}) {
      const Worst worst = worst_of_bullets<float>(decades, low_words);
      EXPECT_LE(worst.time, 1e-13);
      EXPECT_LE(worst.normal, 5e-7);
      EXPECT_LE(worst.reach, 5e-7);
    }
  }
}

// The threshold of the refinement: below 32 reaches one word must do.
TEST(LongFlight, ShortFlightsHaveNoSecondWord) {
  const RelativeMotion<double> near{{{-30, 0}, {0.25, 0}}, {{1, 0}, {0, 0}}};
  const RelativeMotion<double> far{{{-34, 0}, {0.25, 0}}, {{1, 0}, {0, 0}}};
  const DoubleWord<double> reach{1, 0};
  ASSERT_TRUE(disk_disk_contact(near, reach).has_value());
  ASSERT_TRUE(disk_disk_contact(far, reach).has_value());
  EXPECT_EQ(disk_disk_contact(near, reach)->lo, 0.0);
  EXPECT_NE(disk_disk_contact(far, reach)->lo, 0.0);
}

TEST(LongFlight, DiskFromAfarStandsOnTheWallToTheLastPlace) {
  double worst_gap = 0, worst_time = 0;
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(30000);
  for (std::uint64_t i = 0; i < cases; ++i) {
    test::WallShape shape;
    shape.gap = Real(1e12);
    shape.place = random.uniform(0.05, 0.95);
    shape.slope = random.uniform(0.3, 1);
    const auto c = test::make_wall<double>(shape, random, (i & 1U) != 0);
    const Real2 p = test::exact(c.motion.position), v = test::exact(c.motion.velocity);
    const Real2 edge = test::exact(c.edge);
    const auto truth = test::exact_line_contact(p, v, edge, Real(c.radius));
    const auto t = disk_wall_face_contact(c.motion, c.edge, c.radius);
    ASSERT_EQ(truth && truth->s > 0 && truth->s < 1, t.has_value());
    if (!t) continue;
    const Real2 at = test::exact(displacement_at(c.motion, *t));
    const Real gap = abs(test::cross(edge, at)) / length_of(edge) - c.radius;
    worst_gap = std::max(worst_gap, abs(gap).convert_to<double>());
    worst_time =
        std::max(worst_time, Real(abs(test::exact(*t) / truth->t - 1)).convert_to<double>());
  }
  std::printf("walls from 1e12 m: time %.2g, gap %.2g m\n", worst_time, worst_gap);
  EXPECT_LE(worst_time, 1e-30);
  EXPECT_LE(worst_gap, 1e-17);
}

}  // namespace
}  // namespace stoss::engine

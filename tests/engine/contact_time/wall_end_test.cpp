// SPDX-License-Identifier: Apache-2.0
// Nothing slips between the faces and the ends of walls: disks aimed at the end of a segment, and
// disks that slide along chains of walls. The way in which the parts are put together here is the
// contract of disk_wall.hpp: a face, two full end circles, those that project inside dropped.
#include "contact_time/disk_wall.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>

namespace stoss::engine {
namespace {

using test::Census;
using test::Random;
using test::Real;
using test::Real2;
using test::WallCase;

template <class S>
RelativeMotion<S> seen_from_end(const WallCase<S>& c) {
  return {c.motion.position - c.edge, c.motion.velocity};
}

template <class S>
std::optional<Duration<S>> first_contact(const WallCase<S>& c) {
  std::optional<Duration<S>> first = disk_wall_face_contact(c.motion, c.edge, c.radius);
  for (const RelativeMotion<S>& motion : {c.motion, seen_from_end(c)}) {
    const auto t = disk_point_contact(motion, c.radius);
    if (!t || projects_inside(c.motion, c.edge, *t)) continue;
    if (!first || t->hi < first->hi || (t->hi == first->hi && t->lo < first->lo)) first = t;
  }
  return first;
}

template <class S>
std::optional<Real> exact_first_contact(const WallCase<S>& c) {
  const Real2 p = test::exact(c.motion.position), v = test::exact(c.motion.velocity);
  const Real2 edge = test::exact(c.edge);
  const Real radius(c.radius);
  std::optional<Real> first;
  const auto face = test::exact_line_contact(p, v, edge, radius);
  if (face && face->s >= 0 && face->s <= 1) first = face->t;
  for (const Real2& from : {p, Real2{p.x - edge.x, p.y - edge.y}}) {
    const auto t = test::exact_pair_contact(from, v, radius);
    if (t && (!first || *t < *first)) first = t;
  }
  return first;
}

/// Aims a disk so that it touches the wall's line at `off` metres before the wall's start (or past
/// its end).
template <class S>
WallCase<S> aimed_at_end(Random& random, const Real& off, bool low_words) {
  const double length = random.uniform(1, 10);
  const bool at_end = (random.bits() & 1U) != 0;
  test::WallShape shape;
  shape.gap = Real(random.uniform(0, 5));
  shape.place = at_end ? 1 : 0;
  shape.slope = random.uniform(0.05, 1);
  shape.length = length;
  shape.radius = random.uniform(0.1, 1);
  WallCase<S> c = test::make_wall<S>(shape, random, low_words);
  const Real2 edge = test::exact(c.edge), p = test::exact(c.motion.position);
  const Real share = (at_end ? off : Real(-off)) / length;
  c.motion.position =
      test::rounded<S>(Real2{p.x + edge.x * share, p.y + edge.y * share}, low_words);
  return c;
}

template <class S>
void expect_no_leak(double finest, double coarsest, double ulp_max) {
  for (const bool low_words : {false, true}) {
    Census census(low_words ? "aimed at an end, two words" : "aimed at an end");
    Random random(test::seed_of_run());
    const std::uint64_t cases = test::cases_per_family(60000);
    for (std::uint64_t i = 0; i < cases; ++i) {
      const Real off(random.either_sign(random.decades(finest, coarsest)));
      const WallCase<S> c = aimed_at_end<S>(random, off, low_words);
      census.add(first_contact(c), exact_first_contact(c));
    }
    census.print();
    EXPECT_EQ(census.missed(), 0);
    EXPECT_EQ(census.falses(), 0);
    EXPECT_LE(census.max(), ulp_max);
  }
}

TEST(WallEnd, DiskAimedAtAnEndIsNeverMissedInDouble) { expect_no_leak<double>(-18, -11, 6); }

TEST(WallEnd, DiskAimedNearAnEndIsNeverMissedInDouble) { expect_no_leak<double>(-11, 0, 6); }

TEST(WallEnd, DiskAimedAtAnEndIsNeverMissedInFloat) { expect_no_leak<float>(-9, 0, 6); }

// A disk that slides along a chain of walls at its contact distance must not trip over a vertex:
// an end circle is dropped if the contact projects inside any of the walls that share the point.
TEST(WallEnd, DiskSlidingAlongAFlatChainMeetsNoVertex) {
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(60000);
  int dropped = 0, tripped = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    test::WallShape shape;
    shape.gap = 0;
    shape.place = random.uniform(0.05, 0.95);
    shape.slope = 0;
    shape.length = random.uniform(1, 10);
    const WallCase<double> c = test::make_wall<double>(shape, random, (i & 1U) != 0);
    // The neighbour continues the wall past its end, on one line to the last bit.
    const RelativeMotion<double> vertex = seen_from_end(c);
    const auto t = disk_point_contact(vertex, c.radius);
    if (!t) continue;
    const bool inside =
        projects_inside(c.motion, c.edge, *t) || projects_inside(vertex, c.edge, *t);
    ++(inside ? dropped : tripped);
  }
  EXPECT_EQ(tripped, 0);
  EXPECT_GT(dropped, 0);
}

TEST(WallEnd, EndCircleIsDroppedInsideAndKeptOutside) {
  const DoubleWord2<double> edge{{4, 0}, {0, 0}};
  const Duration<double> now{0, 0};
  const auto at = [](double x) {
    return RelativeMotion<double>{{{x, 0}, {1, 0}}, {{0, 0}, {-1, 0}}};
  };
  EXPECT_TRUE(projects_inside(at(2.0), edge, now));
  EXPECT_TRUE(projects_inside(at(1e-12), edge, now));
  EXPECT_TRUE(projects_inside(at(0.0), edge, now));
  EXPECT_TRUE(projects_inside(at(4.0), edge, now));
  EXPECT_FALSE(projects_inside(at(-1e-12), edge, now));
  EXPECT_FALSE(projects_inside(at(-1.0), edge, now));
  EXPECT_FALSE(projects_inside(at(4 + 1e-12), edge, now));
  EXPECT_FALSE(projects_inside(at(5.0), edge, now));
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// What a prediction sees of a wall, against the kernels: never later than the contact, and hardly
// sooner.
#include "wall_sight.hpp"

#include "contact_time/disk_wall.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace stoss::engine {
namespace {

using test::Random;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Pair {
  Motion<double> disk;
  double radius = 0;
  Motion<double> wall;
  DoubleWord2<double> edge;
};

DoubleWord<double> word(double x) { return {x, 0}; }
DoubleWord2<double> words(double x, double y) { return {word(x), word(y)}; }

/// By the kernels, s after `now`; infinity if never.
double exact_contact(const Pair& pair, const Instant& now) {
  const RelativeMotion<double> from_start{position_at(pair.disk, now) - position_at(pair.wall, now),
                                          pair.disk.velocity - pair.wall.velocity,
                                          0};
  RelativeMotion<double> from_end = from_start;
  from_end.position = from_start.position - pair.edge;
  const auto seconds = [](const std::optional<Duration<double>>& after) {
    return after ? after->hi : kNever;
  };
  return std::min({seconds(disk_wall_face_contact(from_start, pair.edge, pair.radius)),
                   seconds(disk_point_contact(from_start, pair.radius)),
                   seconds(disk_point_contact(from_end, pair.radius))});
}

double soonest_contact(const Pair& pair, const Instant& now, const Epoch<double>& epoch) {
  const double at = rough_seconds(now, epoch.begin);
  return WallView(present_of(sight_of(pair.disk, pair.radius, BodyType::Dynamic, epoch), at),
                  present_of(sight_of(pair.wall, 0.0, BodyType::Wall, epoch), at),
                  pair.edge.x.hi,
                  pair.edge.y.hi,
                  kScreenSlack<double>)
      .soonest_contact();
}

/// A wall `length` times as long as the disk's surroundings are wide, or less.
Pair random_pair(Random& random, const Instant& begin, double scale, double length) {
  const double place = random.one_in(4) ? scale * random.decades(0, 6) : 0;
  const auto within = [&](double most) { return random.uniform(-most, most); };
  Pair pair;
  pair.radius = scale * random.uniform(0.01, 1);
  pair.disk.velocity = words(within(1), within(1));
  pair.disk.since = *later_by(begin, scale * random.uniform(0, 4), 0.0);
  pair.disk.position = words(place + within(3 * scale), -place + within(3 * scale));
  pair.wall.since = begin;
  if (random.one_in(2)) pair.wall.velocity = words(within(1), within(1));
  const double from = random.uniform(0, 1);
  const double x = within(scale * length), y = within(scale * length);
  pair.wall.position =
      words(place + within(3 * scale) - from * x, -place + within(3 * scale) - from * y);
  pair.edge = words(x, y);
  return pair;
}

TEST(WallSight, BoundsEveryContactFromBelowAndClosely) {
  Random random(test::seed_of_run());
  int contacts = 0;
  int passes = 0;
  int loose = 0;
  int in_vain = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double scale = random.decades(-3, 3);
    const Instant begin{static_cast<std::int64_t>(random.below(1000)) - 500, 0};
    const Pair pair = random_pair(random, begin, scale, random.decades(-2, 3));
    const Instant now = *later_by(begin, 5 * scale, 0.0);
    const double soonest = soonest_contact(pair, now, {begin, 8 * scale});
    const double exact = exact_contact(pair, now);
    ASSERT_LE(soonest, exact) << "case " << i;
    if (exact == kNever) {
      ++passes;
      in_vain += soonest < kNever ? 1 : 0;
    } else {
      ++contacts;
      loose += soonest < exact * (1 - 1e-5) - 1e-5 * scale ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 5'000);
  EXPECT_GT(passes, 5'000);
  EXPECT_LT(loose, contacts / 1000);  // those that all but graze
  EXPECT_LT(in_vain, passes / 1000);
}

/// m, from the disk to the wall; below zero where they overlap.
double gap_between(const Pair& pair, const Instant& now) {
  const DoubleWord2<double> p = position_at(pair.disk, now) - position_at(pair.wall, now);
  const DoubleWord<double> length2 = square_norm(pair.edge);
  const double share = dot(p, pair.edge).hi / length2.hi;
  if (!(share > 0)) return std::hypot(p.x.hi, p.y.hi) - pair.radius;
  const DoubleWord2<double> from_end = p - pair.edge;
  if (!(share < 1)) return std::hypot(from_end.x.hi, from_end.y.hi) - pair.radius;
  return std::abs(cross(pair.edge, p).hi) / std::sqrt(length2.hi) - pair.radius;
}

// There the end of a wall is off by its rounding, and so is which side of it a disk is on that
// overlaps it, which none does.
TEST(WallSight, BoundsContactsWithLongWalls) {
  Random random(test::seed_of_run());
  int contacts = 0;
  for (int i = 0; i < 200'000; ++i) {
    Pair pair = random_pair(random, {}, 1, random.decades(3, 12));
    if (random.one_in(2)) {  // one end is near
      pair.wall.position =
          words(random.uniform(-3, 3) - pair.edge.x.hi, random.uniform(-3, 3) - pair.edge.y.hi);
    }
    const Instant now{5, 0};
    if (gap_between(pair, now) < 1e-6) continue;
    const double exact = exact_contact(pair, now);
    ASSERT_LE(soonest_contact(pair, now, {{}, 8}), exact) << "case " << i;
    contacts += exact < kNever ? 1 : 0;
  }
  EXPECT_GT(contacts, 5'000);
}

/// A disk of radius 1 that meets a wall from (0, 0) to (4, 0) at none of its ends.
Pair beside_wall(double x, double y, double vx, double vy) {
  Pair pair;
  pair.radius = 1;
  pair.disk.position = words(x, y);
  pair.disk.velocity = words(vx, vy);
  pair.edge = words(4, 0);
  return pair;
}

TEST(WallSight, TellsFacesFromEndsAndBothFromPassingBy) {
  const Epoch<double> epoch;
  const auto see = [&](const Pair& pair) { return soonest_contact(pair, {}, epoch); };
  EXPECT_NEAR(see(beside_wall(2, 3, 0, -1)), 2, 1e-7);
  EXPECT_NEAR(see(beside_wall(2, -3, 0, 1)), 2, 1e-7);
  EXPECT_NEAR(see(beside_wall(-3, 0, 1, 0)), 2, 1e-7);          // the start
  EXPECT_NEAR(see(beside_wall(7, 0, -1, 0)), 2, 1e-7);          // the end
  EXPECT_NEAR(see(beside_wall(4.6, 3, 0, -1)), 3 - 0.8, 1e-7);  // beyond it, but near
  EXPECT_NEAR(see(beside_wall(-5, 6, 1, -1)), 6 - std::sqrt(0.5), 1);
  EXPECT_EQ(see(beside_wall(5.1, 3, 0, -1)), kNever);
  EXPECT_EQ(see(beside_wall(2, 3, 0, 1)), kNever);
  EXPECT_GT(see(beside_wall(2, 3, 1, 0)), 1e6);
  EXPECT_EQ(see(beside_wall(7, 0.5, 1, 0)), kNever);
}

// It comes from there: the kernel need not be asked again.
TEST(WallSight, WhoLeavesAFaceDoesNotMeetItAgain) {
  const Epoch<double> epoch;
  for (const double x : {1e-3, 1.0, 2.0, 3.999}) {
    EXPECT_EQ(soonest_contact(beside_wall(x, 1, 0.5, 1e-3), {}, epoch), kNever);
    EXPECT_EQ(soonest_contact(beside_wall(x, 1 - 1e-12, 0.5, 1e-3), {}, epoch), kNever);
    EXPECT_EQ(soonest_contact(beside_wall(x, -1, 0.5, -1e-3), {}, epoch), kNever);
  }
}

// Rounding hides whether it comes to the face: the kernel is to be asked.
TEST(WallSight, WhoSlidesAlongAFaceMayMeetItAtOnce) {
  const Epoch<double> epoch;
  EXPECT_EQ(soonest_contact(beside_wall(2, 1, 1, 0), {}, epoch), 0);
  EXPECT_EQ(soonest_contact(beside_wall(-5, 1, 1, -1e-14), {}, epoch), 0);
  EXPECT_EQ(soonest_contact(beside_wall(5.5, 1, 1, 0), {}, epoch), kNever);  // beyond it
}

// There products of lengths and speeds leave the range of double.
TEST(WallSight, MissesNothingThatIsVeryLargeOrSmall) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 20'000; ++i) {
    const double scale = random.one_in(2) ? random.decades(60, 180) : random.decades(-180, -60);
    Pair pair = random_pair(random, {}, 1, random.decades(-2, 3));
    for (DoubleWord2<double>* some : {&pair.disk.position, &pair.wall.position, &pair.edge}) {
      *some = words(some->x.hi * scale, some->y.hi * scale);
    }
    pair.radius *= scale;
    pair.disk.since = pair.wall.since = {};
    ASSERT_LE(soonest_contact(pair, {}, {}), exact_contact(pair, {})) << "case " << i;
  }
}

}  // namespace
}  // namespace stoss::engine

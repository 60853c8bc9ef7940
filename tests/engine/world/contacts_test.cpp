// SPDX-License-Identifier: Apache-2.0
// What happens in the hard cases of contact: touching, tangent and simultaneous; rows, wedges,
// corners, pistons; packings without room.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace stoss::engine {
namespace {

using test::disk;
using test::must_spawn;
using test::run_for;
using test::run_until;
using test::seconds;
using test::state;
using test::wall;

TEST(Touching, AndApproachingIsAnEventNowAndOnce) {
  World world(WorldOptions{.start = seconds(5)});
  must_spawn(world, {disk(1, {0, 0}, {1, 0}, 2), disk(2, {3, 4}, {0, -0.5}, 3)});
  const auto log = run_for(world, 100);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, seconds(5));
  EXPECT_EQ(log[0].normal, Vector2(0.6, 0.8));
}

TEST(Touching, AndSeparatingSlidingOrAtRestIsNone) {
  for (const Vector2& velocity : {Vector2(0.5, 0.25), Vector2(-4, 3), Vector2(0, 0)}) {
    World world;
    must_spawn(world, {disk(1, {0, 0}, {0, 0}, 2), disk(2, {3, 4}, velocity, 3)});
    EXPECT_TRUE(run_for(world, 100).empty());
  }
}

TEST(Touching, AWallAndApproachingIsAnEventNowAndOnce) {
  World world;
  const std::vector<WallSpec> walls = {wall(2, {0, 0}, {8, 6})};
  must_spawn(world, {disk(1, {4 - 3, 3 + 4}, {0.75, -1}, 5)}, walls);
  const auto log = run_for(world, 100);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, Instant{});
  EXPECT_EQ(log[0].velocity_a, Vector2(-0.75, 1));
}

TEST(Touching, AWallAndSlidingLeavingOrAtRestIsNone) {
  for (const Vector2& velocity : {Vector2(1, 0.75), Vector2(-1, 1), Vector2(0, 0)}) {
    World world;
    const std::vector<WallSpec> walls = {wall(2, {0, 0}, {8, 6})};
    must_spawn(world, {disk(1, {4 - 3, 3 + 4}, velocity, 5)}, walls);
    EXPECT_TRUE(run_for(world, 100).empty());
  }
}

TEST(Touching, OverlapWithinRoundingIsTouching) {
  const auto overlapping = [](double speed) {
    World world;
    must_spawn(world,
               {disk(1, {0, 0}, {0, 0}, 0.5), disk(2, {1 - 0x1p-40, 0}, {speed, 0.25}, 0.5)});
    return run_for(world, 10);
  };
  EXPECT_TRUE(overlapping(1).empty());
  EXPECT_TRUE(overlapping(0).empty() || overlapping(0).size() == 1);
  const auto log = overlapping(-1);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, Instant{});
  EXPECT_EQ(log[0].velocity_a, Vector2(-1, 0));
  EXPECT_EQ(log[0].velocity_b, Vector2(0, 0.25));  // nobody is pushed apart
}

TEST(Tangent, PassesAreNone) {
  World world;
  const std::vector<WallSpec> walls = {wall(9, {20, 1}, {30, 1})};
  must_spawn(world, {disk(1, {-10, 0.5}, {1, 0}, 0.5), disk(2, {0, -0.5}, {0, 0}, 0.5)}, walls);
  EXPECT_TRUE(run_for(world, 100).empty());
}

TEST(Tangent, GrazesOneUnitInTheLastPlaceDeepAreEvents) {
  World world;
  must_spawn(world, {disk(1, {-10, 0.5 - 0x1p-53}, {1, 0}, 0.5), disk(2, {0, -0.5}, {0, 0}, 0.5)});
  const auto log = run_for(world, 100);
  ASSERT_EQ(log.size(), 1U);
  // A graze of depth d deflects by sqrt(2 d / reach) of the speed, twice: keep it.
  EXPECT_NEAR(log[0].approach_speed, std::sqrt(2 * 0x1p-53), 1e-12);
}

// Three kinds of contact, all at 2 s; ids such that neither insertion nor geometry gives the order.
TEST(Simultaneous, DisjointContactsComeByKindThenLowerThenHigherId) {
  const std::vector<DiskSpec> disks = {disk(1, {0, 100}, {0, -1}, 0.5),  // end of wall 21
                                       disk(2, {0, 50}, {0, -1}, 0.5),   // face of wall 20
                                       disk(9, {0, 10}, {1, 0}, 0.5),
                                       disk(3, {5, 10}, {-1, 0}, 0.5),  // each other
                                       disk(4, {0, 0}, {1, 0}, 0.5),
                                       disk(8, {5, 0}, {-1, 0}, 0.5),  // each other
                                       disk(10, {0, -20}, {1, 0}, 0.5),
                                       disk(11, {5, -20}, {-1, 0}, 0.5),  // each other
                                       disk(7, {0, 150}, {0, -1}, 0.5)};  // face of wall 19
  const std::vector<WallSpec> walls = {wall(20, {-1, 47.5}, {1, 47.5}),
                                       wall(21, {0, 97.5}, {0, 90}),
                                       wall(19, {-1, 147.5}, {1, 147.5})};
  const std::vector<std::pair<Id, Id>> expected = {
      {3, 9}, {4, 8}, {10, 11}, {2, 20}, {7, 19}, {1, 21}};
  test::Random random(test::seed_of_run());
  for (int trial = 0; trial < 20; ++trial) {
    auto shuffled = disks;
    for (std::size_t i = shuffled.size(); i > 1; --i) {
      std::swap(shuffled[i - 1], shuffled[random.below(i)]);
    }
    for (const BroadPhaseKind kind : {BroadPhaseKind::Neighbours, BroadPhaseKind::AllPairs}) {
      World world(WorldOptions{.start = {}, .broad_phase = kind});
      must_spawn(world, shuffled, walls);
      std::vector<std::pair<Id, Id>> order;
      for (const Collision& c : run_until(world, seconds(2))) {
        EXPECT_EQ(c.instant, seconds(2));
        EXPECT_FALSE(c.order_dependent);
        order.emplace_back(c.a, c.b);
      }
      EXPECT_EQ(order, expected);
    }
  }
}

/// A row of equal disks, `gap` apart but for the striker's way, the first `striking` moving.
World cradle(int count, int striking, double gap) {
  World world;
  std::vector<DiskSpec> row;
  for (int i = 0; i < count; ++i) {
    const double x = i * (1 + gap) + (i < striking ? 0 : 2);
    row.push_back(disk(static_cast<Id>(i + 1), {x, 0}, {i < striking ? 1.0 : 0.0, 0}, 0.5));
  }
  must_spawn(world, row);
  return world;
}

TEST(Cradle, AsManyGoOutAsCameInTouchingOrNot) {
  for (const double gap : {0.0, 0.125, 1e-9}) {
    for (int count = 2; count <= 7; ++count) {
      for (int striking = 1; striking < count; ++striking) {
        World world = cradle(count, striking, gap);
        const auto log = run_for(world, 100);
        EXPECT_EQ(log.size(), static_cast<std::size_t>(striking * (count - striking)));
        for (int i = 0; i < count; ++i) {
          const Vector2 expected(i >= count - striking ? 1 : 0, 0);
          EXPECT_EQ(state(world, static_cast<Id>(i + 1)).velocity, expected);
        }
        for (const Collision& c : log) EXPECT_FALSE(c.order_dependent);  // equal masses in line
      }
    }
  }
}

TEST(Cradle, SwingsForEverBetweenTwoWalls) {
  World world = cradle(5, 1, 0);
  const std::vector<WallSpec> walls = {wall(90, {-1, -1}, {-1, 1}), wall(91, {8, -1}, {8, 1})};
  must_spawn(world, {}, walls);
  const auto log = run_for(world, 10000);
  EXPECT_GT(log.size(), 5000U);
  for (const Collision& c : log) EXPECT_EQ(c.approach_speed, 1);
  EXPECT_EQ(world.conserved().kinetic_energy, 0.5);
}

/// Reflections of a disk that flies to the tip of a wedge along its bisector.
std::vector<Collision> into_wedge(double angle, Vector2& velocity_after) {
  World world;
  const auto ray = [](double phi) { return Vector2(std::cos(phi), std::sin(phi)); };
  const Vector2 vertices[] = {10 * ray(angle / 2), {0, 0}, 10 * ray(-angle / 2)};
  must_spawn(world, {disk(1, {8, 0}, {-1, 0}, 0.125)}, test::chain(10, vertices));
  auto log = run_for(world, 60);
  velocity_after = state(world, 1).velocity;
  return log;
}

TEST(Wedge, OfAnAngleThatDividesAHalfTurnSendsTheDiskBackWhateverWallComesFirst) {
  for (const int n : {2, 3, 4, 5, 6, 10}) {
    SCOPED_TRACE(n);
    Vector2 after;
    const auto log = into_wedge(std::numbers::pi / n, after);
    EXPECT_EQ(log.size(), static_cast<std::size_t>(n));
    EXPECT_LT((after - Vector2(1, 0)).norm(), 1e-14);
    for (const Collision& c : log) EXPECT_FALSE(c.order_dependent) << test::describe(c);
  }
}

TEST(Wedge, OfAnyAngleReflectsAtMostAsOftenAsItUnfolds) {
  test::Random random(test::seed_of_run());
  for (int trial = 0; trial < 200; ++trial) {
    const double angle = random.uniform(0.1, 3);
    Vector2 after;
    const auto log = into_wedge(angle, after);
    EXPECT_GE(log.size(), 1U);
    EXPECT_LE(log.size(), static_cast<std::size_t>(std::ceil(std::numbers::pi / angle)) + 1);
    EXPECT_NEAR(after.norm(), 1, 1e-15);
  }
}

TEST(Wedge, OfARightAngleIsExact) {
  World world;
  const Vector2 vertices[] = {{10, 0}, {0, 0}, {0, 10}};
  must_spawn(world, {disk(1, {3, 3}, {-1, -1}, 0.5)}, test::chain(10, vertices));
  const auto log = run_for(world, 5);
  ASSERT_EQ(log.size(), 2U);
  for (const Collision& c : log) EXPECT_EQ(c.instant, seconds(2.5));
  EXPECT_EQ(log[0].b, 10U);  // the tie goes to the lower id
  EXPECT_EQ(log[1].b, 11U);
  EXPECT_EQ(state(world, 1).velocity, Vector2(1, 1));
}

// cos(theta) = -1/4 is no pi/n: the outcome depends on the order, which is by ids, and is marked.
TEST(Simultaneous, ABreakIsResolvedByIdsAndMarked) {
  World world;
  must_spawn(world,
             {disk(1, {-3, 0}, {1, 0}, 0.5),
              disk(2, {0, 0.5}, {0, 0}, 0.5),
              disk(3, {0, -0.5}, {0, 0}, 0.5)});
  const auto log = run_for(world, 10);
  ASSERT_GE(log.size(), 2U);
  EXPECT_EQ(log[0].a, 1U);
  EXPECT_EQ(log[0].b, 2U);
  EXPECT_EQ(log[1].b, 3U);
  EXPECT_TRUE(log[0].order_dependent);
  EXPECT_TRUE(log[1].order_dependent);
  const double s = std::sqrt(3) / 8;
  EXPECT_LT((state(world, 1).velocity - Vector2(-0.125, -s)).norm(), 1e-14);
  EXPECT_LT((state(world, 2).velocity - Vector2(0.75, 2 * s)).norm(), 1e-14);
  EXPECT_LT((state(world, 3).velocity - Vector2(0.375, -s)).norm(), 1e-14);
}

TEST(WallEnds, AreMetAsPoints) {
  World world;
  const std::vector<WallSpec> walls = {wall(2, {0, 0}, {4, 0})};
  must_spawn(world, {disk(1, {-0.25, 3}, {0, -1}, 0.5)}, walls);
  const auto log = run_for(world, 10);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].kind, ContactKind::DiskWallEnd);
  EXPECT_NEAR(seconds_between({}, log[0].instant), 3 - std::sqrt(3) / 4, 1e-15);
  EXPECT_LT((log[0].point - Vector2(0, 0)).norm(), 2e-16);
  EXPECT_LT((log[0].velocity_a - Vector2(-std::sqrt(3) / 2, 0.5)).norm(), 1e-15);
}

TEST(WallEnds, AreMissedByOneUnitInTheLastPlace) {
  World world;
  const std::vector<WallSpec> walls = {wall(2, {0, 0}, {4, 0})};
  must_spawn(world, {disk(1, {-0.5 - 0x1p-53, 3}, {0, -1}, 0.5)}, walls);
  EXPECT_TRUE(run_for(world, 10).empty());
}

TEST(WallEnds, ThatMoveAreMetAsPointsToo) {
  World world;
  const std::vector<WallSpec> walls = {wall(2, {-1, 0}, {-9, 0}, {2, 0})};
  must_spawn(world, {disk(1, {4, 0}, {0, 0}, 0.5)}, walls);
  const auto log = run_for(world, 2.5);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, seconds(2.25));
  EXPECT_EQ(log[0].kind, ContactKind::DiskWallEnd);
  EXPECT_EQ(log[0].velocity_a, Vector2(4, 0));
  EXPECT_EQ(log[0].velocity_b, Vector2(2, 0));
}

TEST(Pistons, TurnVelocitiesToTwiceTheirOwnMinusWhatTheyWere) {
  World world;
  const std::vector<WallSpec> walls = {wall(2, {0, -1}, {0, 1}, {1.5, 0})};
  must_spawn(world, {disk(1, {3, 0}, {-2, 0.25}, 0.5)}, walls);
  const auto log = run_for(world, 5);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].velocity_a, Vector2(5, 0.25));
  EXPECT_NEAR(seconds_between({}, log[0].instant), 2.5 / 3.5, 2e-16);
}

// Slow compression keeps |v| times the free length (the adiabatic invariant of one degree of
// freedom) but for the ratio of the speeds; exactly kept is v L at the piston's hits, by unfolding.
TEST(Pistons, CompressSlowlyAtConstantAction) {
  World world;
  const double slow = 1e-4;
  const std::vector<WallSpec> walls = {wall(2, {0, -1}, {0, 1}),
                                       wall(3, {11, -1}, {11, 1}, {-slow, 0})};
  must_spawn(world, {disk(1, {0.5, 0}, {1, 0}, 0.5)}, walls);
  const double compression = 0.5;
  run_until(world, seconds(10 * compression / slow));
  const double speed = state(world, 1).velocity.norm();
  EXPECT_NEAR(speed * 10 * (1 - compression), 10, 10 * 4 * slow);
  const VectorFor back{3, {slow, 0}};  // and back again: the way is reversible
  ASSERT_TRUE(world.set_velocity(std::span(&back, 1)).ok());
  run_for(world, 10 * compression / slow);
  EXPECT_NEAR(state(world, 1).velocity.norm(), 1, 4 * slow);
}

// Three walls that close in leave a disk no way out; the world stops before it bounces for ever.
TEST(Squeezes, BetweenThreeBodiesStopTheWorldAndNameTheDisk) {
  const auto closing = [](double speed) {
    World world;
    std::vector<WallSpec> walls;
    for (int i = 0; i < 3; ++i) {
      const double angle = 0.3 + 2 * std::numbers::pi * i / 3;
      const Vector2 out(std::cos(angle), std::sin(angle));
      const Vector2 along(-out.y(), out.x());
      walls.push_back(wall(static_cast<Id>(10 + i),
                           2 * out - 9 * along,
                           2 * out + 9 * along,
                           i == 0 ? Vector2(-speed * out) : Vector2(0, 0)));
    }
    must_spawn(world, {disk(1, {0, 0}, {1.5, 1}, 0.5)}, walls);
    return world.advance_to(seconds(60), nullptr, 1'000'000).value();
  };
  const AdvanceReport report = closing(1);
  EXPECT_EQ(report.stop, Stop::Stalled);
  EXPECT_EQ(report.stalled, 1U);
  EXPECT_EQ(closing(0).stop, Stop::Reached);
  EXPECT_EQ(closing(-1).stop, Stop::Reached);
}

// Touching disks between touching walls have no room: contacts follow each other without end at one
// instant. The world says so, at the same contact under all circumstances.
World packing(BroadPhaseKind kind, bool backwards) {
  test::Random random(test::seed_of_run());
  World world(WorldOptions{.start = {}, .broad_phase = kind});
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 16; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(disk(static_cast<Id>(1 + (5 * i) % 16), {i % 4, i / 4}, velocity, 0.5));
  }
  if (backwards) std::reverse(disks.begin(), disks.end());
  must_spawn(world, disks, test::box(20, {-0.5, -0.5}, {3.5, 3.5}));
  return world;
}

TEST(Packings, WithoutRoomStallAtTheSameContactHoweverTheyAreRun) {
  World base = packing(BroadPhaseKind::Neighbours, false);
  const AdvanceReport report = base.advance_to(seconds(1)).value();
  EXPECT_EQ(report.stop, Stop::Stalled);
  EXPECT_TRUE(base.contains(report.stalled));
  EXPECT_EQ(base.now(), Instant{});
  World in_pieces = packing(BroadPhaseKind::AllPairs, true);
  const auto stop = [&](std::uint64_t events) {
    return in_pieces.advance_to(seconds(0), nullptr, events).value().stop;
  };
  EXPECT_EQ(stop(10'000), Stop::EventBudget);
  in_pieces = World::deserialise(in_pieces.serialise()).value();
  while (stop(10'000) == Stop::EventBudget) in_pieces = World(in_pieces);
  EXPECT_EQ(test::fingerprint(in_pieces), test::fingerprint(base));
  for (World* world : {&base, &in_pieces}) {
    World again = World::deserialise(world->serialise()).value();
    EXPECT_EQ(again.advance_to(seconds(1)).value().stop, Stop::Stalled);
    EXPECT_EQ(test::fingerprint(again), test::fingerprint(base));
  }
}

TEST(Packings, GoOnWhenACommandGivesThemRoom) {
  World world = packing(BroadPhaseKind::Neighbours, false);
  EXPECT_EQ(world.advance_to(seconds(1)).value().stop, Stop::Stalled);
  ASSERT_TRUE(world.remove(std::vector<Id>{20, 21, 22, 23}).ok());
  EXPECT_EQ(world.advance_to(seconds(1)).value().stop, Stop::Reached);
}

}  // namespace
}  // namespace stoss::engine

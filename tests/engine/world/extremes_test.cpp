// SPDX-License-Identifier: Apache-2.0
// The ends of the range: very far, very fast, very slow, very large beside very small. What holds
// there holds exactly, and nothing hangs.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
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

// An ulp of a flight of 1e12 m is 1e-4 m: a normal taken from p + v t in one word would be that
// blunt.
TEST(Bullets, FromFarAwayHitWhereTheyAim) {
  for (const double distance : {1e3, 1e6, 1e9, 1e12}) {
    for (const double aside : {0.0, 0.25, -0.9, 0.999}) {
      World world;
      must_spawn(world, {disk(1, {0, 0}, {0, 0}, 0.5), disk(2, {distance, aside}, {-1e6, 0}, 0.5)});
      const auto log = run_until(world, seconds(2e6));
      ASSERT_EQ(log.size(), 1U);
      const double along = std::sqrt(1 - aside * aside);
      EXPECT_NEAR(log[0].normal.x(), along, 4e-16);
      EXPECT_NEAR(log[0].normal.y(), aside, 4e-16);
      EXPECT_LT(test::deepest_overlap(world), 1e-15);
    }
  }
}

TEST(Bullets, FromFarAwayGrazeWithinAUnitOfTheLastPlace) {
  const double aside = 1 - 0x1p-53;  // of a reach of 1
  World world;
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 0.5), disk(2, {1e12, aside}, {-1e6, 0}, 0.5)});
  EXPECT_EQ(run_until(world, seconds(2e6)).size(), 1U);
  World miss;
  must_spawn(miss, {disk(1, {0, 0}, {0, 0}, 0.5), disk(2, {1e12, 1}, {-1e6, 0}, 0.5)});
  EXPECT_TRUE(run_until(miss, seconds(2e6)).empty());
}

TEST(Bullets, MeetThinWallsAtAHundredThousandMetresASecond) {
  World world;
  std::vector<WallSpec> walls = test::box(10, {0, 0}, {10, 10});
  walls.push_back(wall(20, {5, 0}, {5, 10}));  // two rooms
  must_spawn(world,
             {disk(1, {2.5, 3}, {1e5, 1.7e4}, 1e-3), disk(2, {7.5, 3}, {-9e4, 2.2e4}, 1e-3)},
             walls);
  const auto log = run_until(world, seconds(3));
  EXPECT_GT(log.size(), 100'000U);
  EXPECT_LT(state(world, 1).position.x(), 5);
  EXPECT_GT(state(world, 2).position.x(), 5);
}

/// A gas, its origin at `centre`.
World gas_at(const Vector2& centre) {
  test::Random random(test::seed_of_run());
  World world;
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 9; ++i) {
    const Vector2 velocity(std::round(random.uniform(-64, 64)) / 32,
                           std::round(random.uniform(-64, 64)) / 32);
    disks.push_back(
        disk(static_cast<Id>(i + 1), centre + Vector2(2 * (i % 3), 2 * (i / 3)), velocity, 0.5));
  }
  must_spawn(world, disks, test::box(100, centre - Vector2(1, 1), centre + Vector2(5, 5)));
  return world;
}

// Positions are double words: at 2^40 m from the origin, where an ulp of a double is 2^-12 m, a gas
// does what it does at the origin.
TEST(Distance, FromTheOriginChangesNothing) {
  World here = gas_at({0, 0});
  World there = gas_at({0x1p40, -0x1p40});
  const auto log = run_for(here, 4);
  const auto log_there = run_for(there, 4);
  ASSERT_GT(log.size(), 20U);
  ASSERT_EQ(log.size(), log_there.size());
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_EQ(log[i].a, log_there[i].a);
    EXPECT_EQ(log[i].b, log_there[i].b);
    EXPECT_NEAR(seconds_between(log[i].instant, log_there[i].instant), 0, 1e-12);
    EXPECT_LT((log[i].velocity_a - log_there[i].velocity_a).norm(), 1e-12);
  }
  EXPECT_LT(test::deepest_overlap(there), 1e-14);
}

TEST(Distance, OpenSpaceCostsAFewEventsHoweverFarADiskFlies) {
  World world;
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 20; ++i) {
    const double angle = 0.3 * i;
    disks.push_back(disk(static_cast<Id>(i + 1),
                         2 * i * Vector2(std::cos(angle), std::sin(angle)),
                         1e6 * Vector2(std::cos(angle), std::sin(angle)),
                         0.5));
  }
  must_spawn(world, disks, test::chain(100, std::vector<Vector2>{{-1000, -50}, {1000, -50}}));
  const AdvanceReport report = world.advance_to(seconds(1e6)).value();
  EXPECT_EQ(report.stop, Stop::Reached);
  EXPECT_LT(report.events, 100 * disks.size());
  EXPECT_NEAR(state(world, 1).position.norm(), 1e12, 1);
}

TEST(Distance, ALoneDiskReturnsAfterALongWay) {
  World world;
  const std::vector<WallSpec> walls = {wall(2, {1e12, -1}, {1e12, 1}), wall(3, {-1, -1}, {-1, 1})};
  must_spawn(world, {disk(1, {0, 0}, {1e6, 0}, 0.5)}, walls);
  const AdvanceReport report = world.advance_to(seconds(2e6)).value();
  EXPECT_EQ(report.collisions, 2U);  // at 1e12 m, and 0.5 us before the end at the other wall
  EXPECT_NEAR(state(world, 1).position.x(), 0, 1e-9);
}

// A wall a million times longer than the disks, met along its whole length.
TEST(Sizes, LongWallsAreMetAnywhere) {
  World world;
  std::vector<DiskSpec> disks;
  for (int i = 0; i <= 100; ++i) {
    disks.push_back(disk(static_cast<Id>(i + 1), {1e4 * i, 3}, {0, -1}, 0.5));
  }
  const std::vector<WallSpec> walls = {wall(1000, {0, 0}, {1e6, 0})};
  must_spawn(world, disks, walls);
  const auto log = run_until(world, seconds(5));
  ASSERT_EQ(log.size(), disks.size());
  for (const Collision& c : log) {
    EXPECT_EQ(c.instant, seconds(2.5));
    EXPECT_EQ(c.kind, ContactKind::DiskWall);
  }
}

TEST(Sizes, AGrainMeetsAPlanet) {
  World world;
  must_spawn(world,
             {disk(1, {0, 0}, {0, 0}, 1e9, 1e30), disk(2, {1e9 + 2, 3}, {-1, 0}, 1e-9, 1e-9)});
  const auto log = run_until(world, seconds(10));
  ASSERT_EQ(log.size(), 1U);
  EXPECT_NEAR(seconds_between({}, log[0].instant), 2.0000000034999999, 1e-15);
  EXPECT_NEAR(log[0].velocity_b.x(), 1, 1e-15);
}

TEST(Speeds, OfAllSizesInOpenSpaceDoNotHang) {
  test::Random random(test::seed_of_run());
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    World world;
    std::vector<DiskSpec> disks;
    for (int i = 0; i < 12; ++i) {
      const double speed = random.decades(-300, 149);
      disks.push_back(disk(static_cast<Id>(i + 1),
                           {3.0 * (i % 4), 3.0 * (i / 4)},
                           {random.either_sign(speed), random.either_sign(speed * 0.7)},
                           0.5));
    }
    must_spawn(world, disks);
    test::Log log;
    const AdvanceReport report = world.advance_to(seconds(1e9), &log, 100'000).value();
    EXPECT_EQ(report.stop, Stop::Reached);
    world.for_each_disk([](const BodyState& body) {
      EXPECT_TRUE(body.position.allFinite());
      EXPECT_TRUE(body.velocity.allFinite());
    });
  }
}

TEST(Speeds, BeyondAllReasonInABoxStopAtTheBudget) {
  World world;
  must_spawn(world,
             {disk(1, {0, 0}, {1e150, 1e149}, 0.5), disk(2, {2, 1}, {1e-300, 0}, 0.5)},
             test::box(10, {-5, -5}, {5, 5}));
  const AdvanceReport report = world.advance_to(seconds(1), nullptr, 10'000).value();
  EXPECT_NE(report.stop, Stop::Stalled);
  EXPECT_LE(report.events, 10'000U);
}

TEST(Speeds, TooSlowToMeetBeforeTheEndOfTimeNeverMeet) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {1e-300, 0}, 0.5), disk(2, {3, 0}, {-1e-300, 0}, 0.5)});
  const AdvanceReport report = world.advance_to(Instant{kSecondsMax - 1, 0}).value();
  EXPECT_EQ(report.collisions, 0U);
  EXPECT_LT(report.events, 10U);
}

/// At 2^57 s a bullet meets a disk that goes against it at 2^-62 m/s. Many others rest, and one
/// goes to and fro, so that the present is never far behind the next event.
std::vector<Collision> meeting_late(BroadPhaseKind broad_phase) {
  WorldOptions options;
  options.broad_phase = broad_phase;
  World world(options);
  std::vector<DiskSpec> disks{disk(1, {0.5, 0.5}, {-0x1p-62, 0}, 0.5),
                              disk(2, {-7.5, 0.5}, {7 * 0x1p-57, 0}, 0.5),
                              test::static_disk(3, {0, 30}, 0.5),
                              disk(4, {1 + 0x1p-6, 30}, {0x1p-51, 0}, 0.5),
                              test::static_disk(5, {2 + 0x1p-5, 30}, 0.5)};
  for (Id id = 6; id < 50; ++id) {
    disks.push_back(disk(id, {2.0 * static_cast<double>(id), 9}, {0, 0}, 0.5));
  }
  must_spawn(world, disks);
  test::Log log;
  for (int power = 0; power <= 58; ++power) {  // through many epochs of sights
    EXPECT_TRUE(world.advance_to(Instant{std::int64_t{1} << power, 0}, &log).ok());
  }
  std::erase_if(log.collisions, [](const Collision& c) { return c.a != 1; });
  return log.collisions;
}

TEST(Speeds, WhoHardlyMovesIsMetWhereItHasCome) {
  const auto log = meeting_late(BroadPhaseKind::Neighbours);
  const auto log_of_all_pairs = meeting_late(BroadPhaseKind::AllPairs);
  ASSERT_EQ(log.size(), 1U);
  ASSERT_EQ(log_of_all_pairs.size(), 1U);
  EXPECT_EQ(log[0].instant, log_of_all_pairs[0].instant);
  EXPECT_LT(log[0].point.x(), -0x1p-6);
}

TEST(Speeds, SlowContactsComeInTheirTime) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {0x1p-40, 0}, 0.5), disk(2, {3, 0}, {-0x1p-40, 0}, 0.5)});
  const auto log = run_until(world, Instant{std::int64_t{1} << 41, 0});
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, (Instant{std::int64_t{1} << 40, 0}));
}

TEST(Masses, OfAllSizesKeepEnergyAndMomentum) {
  test::Random random(test::seed_of_run());
  for (int trial = 0; trial < 2000; ++trial) {
    World world;
    const double heavy = random.decades(-100, 100);
    const double light = heavy * random.decades(-17, 0);
    must_spawn(world,
               {disk(1, {0, 0}, {random.uniform(-1, 1), random.uniform(-1, 1)}, 0.5, heavy),
                disk(2, {3, random.uniform(-1, 1)}, {-5, random.uniform(-1, 1)}, 0.5, light)});
    const Conserved before = world.conserved();
    run_for(world, 10);
    const Conserved after = world.conserved();
    EXPECT_NEAR(after.kinetic_energy / before.kinetic_energy, 1, 3e-16);
    EXPECT_LT((after.momentum - before.momentum).norm(), 3e-16 * (heavy + 5 * light));
  }
}

TEST(EndOfTime, IsReachedAndNotPassed) {
  World world(WorldOptions{.start = {kSecondsMax - 2, 0}});
  must_spawn(world, {disk(1, {0, 0}, {1, 0}, 0.5), disk(2, {5, 0}, {0, 0}, 0.5)});
  const AdvanceReport report = world.advance_to({kSecondsMax - 1, 0}).value();
  EXPECT_EQ(report.stop, Stop::Reached);
  EXPECT_EQ(report.collisions, 0U);
  EXPECT_EQ(state(world, 1).position, Vector2(1, 0));
}

}  // namespace
}  // namespace stoss::engine

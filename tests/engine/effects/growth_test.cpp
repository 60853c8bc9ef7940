// SPDX-License-Identifier: Apache-2.0
// Worlds of growing disks: when they touch, what contacts do, one story whatever the ticks, and the
// jam of a packing.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stoss::engine {
namespace {

using test::run_for;

WorldOptions with_growth(double rate, BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects.growth = Growth{rate};
  options.broad_phase = kind;
  return options;
}

/// Disks of three sizes in a box with a static disk, a kinematic one and a moving wall.
World growing_gas(const WorldOptions& options) {
  World world(options);
  test::Random random(23);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 64; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(test::disk(
        kNoId, {1.5 * (i % 8) + 1, 1.5 * (i / 8) + 1}, velocity, 0.2 + 0.1 * (i % 3), 1 + i % 2));
  }
  disks.push_back(test::static_disk(900, {6.25, 13}, 0.4));
  disks.push_back(test::kinematic_disk(901, {3, 13.1}, {0.05, 0}, 0.3));
  std::vector<WallSpec> walls = test::box(1'000, {0, 0}, {14, 14});
  walls.push_back(test::wall(1'010, {9, 12.7}, {12, 13.3}, {-0.1, 0.02}));
  test::must_spawn(world, disks, walls);
  return world;
}

TEST(GrowthWorld, DisksAtRestTouchWhenTheyHaveGrownSoFar) {
  World world(with_growth(0.125));
  test::must_spawn(world, {test::disk(1, {0, 0}, {0, 0}, 0.5), test::disk(2, {3, 4}, {0, 0}, 0.5)});
  const auto log = run_for(world, 16);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, test::seconds(16));
  EXPECT_EQ(log[0].approach_speed, 0.25);
  EXPECT_EQ(test::state(world, 1).radius, 2.5);
  EXPECT_EQ(world.body(2).value().radius, 2.5);
  // They part as fast as they grow, reversed: u' . n = 2 m.
  EXPECT_NEAR((test::state(world, 2).velocity - Vector2(0.15, 0.2)).norm(), 0, 1e-16);
  EXPECT_NEAR((test::state(world, 1).velocity + Vector2(0.15, 0.2)).norm(), 0, 1e-16);
}

TEST(GrowthWorld, EverythingGrowsButWalls) {
  World world(with_growth(0.25));
  const std::vector<WallSpec> walls = {test::wall(9, {-5, -3.5}, {5, -3.5}),
                                       test::wall(8, {4, 0}, {9, 0})};
  test::must_spawn(
      world, {test::disk(1, {0, 0}, {0, 0}, 1), test::static_disk(2, {0, 6}, 1)}, walls);
  run_for(world, 4);
  EXPECT_EQ(test::state(world, 2).radius, 2);
  const std::vector<Id> inside = world.region({-0.1, -1.9}, {0.1, -1.8});
  EXPECT_EQ(inside, std::vector<Id>{1}) << "a question sees the radius of the instant";
  EXPECT_EQ(world.ray({0, 3}, {0, 1}, 10)->distance, 1);
  const auto log = run_for(world, 4);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, test::seconds(8));
  EXPECT_EQ(log[0].kind, ContactKind::DiskDisk);
}

TEST(GrowthWorld, AContactTurnsTheVelocityOfTheSurfaces) {
  for (const double e : {1.0, 0.5, 0.0}) {
    WorldOptions options = with_growth(0.1);
    options.effects.restitution = Restitution{e, e, 0, 0};
    World world(options);
    test::must_spawn(
        world,
        {test::disk(1, {0, 0}, {1, 0.2}, 0.5, 2), test::disk(2, {4, 0.3}, {-1, 0}, 0.7, 3)},
        std::vector<WallSpec>{test::wall(9, {9, -9}, {9, 9}, {-0.5, 0})});
    const auto log = run_for(world, 3);
    ASSERT_GE(log.size(), 1U);
    const Vector2 u = Vector2(-1, 0) - Vector2(1, 0.2);
    const Vector2 after = log[0].velocity_b - log[0].velocity_a;
    const double m = 0.2;
    EXPECT_NEAR(after.dot(log[0].normal), m + e * (m - u.dot(log[0].normal)), 1e-15);
    EXPECT_NEAR(log[0].approach_speed, m - u.dot(log[0].normal), 1e-15);
    const Vector2 momentum = 2 * log[0].velocity_a + 3 * log[0].velocity_b;
    EXPECT_NEAR((momentum - Vector2(-1, 0.4)).norm(), 0, 1e-15);
  }
}

// What the contacts put in and take out, by (3) of contact_law/growing.hpp, is all that the energy
// changes by.
TEST(GrowthWorld, KeepsTheBooksOfEnergyAndMomentum) {
  WorldOptions options = with_growth(0.01);
  options.effects.restitution = Restitution{0.8, 1, 0, 0};
  World world(options);
  test::Random random(5);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 36; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(
        test::disk(static_cast<Id>(i + 1), {1.0 * (i % 6), 1.0 * (i / 6)}, velocity, 0.3, 1));
  }
  test::must_spawn(world, disks);
  const Conserved before = world.conserved();
  test::Log log;
  double gained = 0;
  const double m = 0.02;
  ASSERT_TRUE(world.advance_to(test::seconds(5), &log).ok());
  ASSERT_GT(log.collisions.size(), 30U);
  for (const Collision& c : log.collisions) {
    const double closing = c.approach_speed;  // m - u . n
    gained += 0.9 * 0.5 * closing * (1.8 * m + 0.2 * (m - closing));
  }
  const Conserved after = world.conserved();
  EXPECT_NEAR(after.kinetic_energy, before.kinetic_energy + gained, 1e-14 * before.kinetic_energy);
  EXPECT_NEAR((after.momentum - before.momentum).norm(), 0, 1e-14);
  EXPECT_EQ(world.census().overlaps, 0U);
  EXPECT_EQ(world.census().missed, 0U);
}

TEST(GrowthWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  for (const double rate : {0.01, 0.03}) {
    const auto gas = [&](BroadPhaseKind kind) { return growing_gas(with_growth(rate, kind)); };
    World once = gas(BroadPhaseKind::Neighbours);
    EXPECT_GT(run_for(once, 5).size(), 100U);
    EXPECT_LT(once.census().deepest, 1e-13);
    const World end = test::expect_one_story(gas, 5, 250, 2);
    EXPECT_EQ(end.census().missed, 0U);
  }
}

TEST(GrowthWorld, TellsOneStoryAroundAPeriodUnderAThermostat) {
  const auto gas = [](BroadPhaseKind kind) {
    WorldOptions options = with_growth(0.02, kind);
    options.effects.thermostat = Thermostat{0.5, 0.3, 9};
    options.period = {12, 11};
    World world(options);
    test::Random random(3);
    std::vector<DiskSpec> disks;
    for (int i = 0; i < 36; ++i) {
      const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
      disks.push_back(test::disk(kNoId, {2.0 * (i % 6), 1.8 * (i / 6)}, velocity, 0.3));
    }
    test::must_spawn(world, disks);
    return world;
  };
  World once = gas(BroadPhaseKind::Neighbours);
  EXPECT_GT(run_for(once, 10).size(), 50U);
  EXPECT_EQ(once.census().missed, 0U);
  test::expect_one_story(gas, 10, 100, 5);
}

TEST(GrowthWorld, ThatDoesNotGrowIsThePlainWorld) {
  World plain = growing_gas({});
  World still = growing_gas(with_growth(0));
  const auto a = run_for(plain, 10);
  const auto b = run_for(still, 10);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 200U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].instant, b[i].instant);
    ASSERT_EQ(a[i].velocity_a, b[i].velocity_a);
  }
}

TEST(GrowthWorld, StartsAnywhereInTimeAlike) {
  WorldOptions late = with_growth(0.02);
  late.start = {std::int64_t{1} << 40, 0};
  World early = growing_gas(with_growth(0.02));
  World aged = growing_gas(late);
  const auto a = run_for(early, 6);
  const auto b = run_for(aged, 6);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].instant.fraction, b[i].instant.fraction);
    ASSERT_EQ(a[i].instant.seconds + late.start.seconds, b[i].instant.seconds);
    ASSERT_EQ(a[i].velocity_a, b[i].velocity_a);
  }
}

TEST(GrowthWorld, ADiskComesInWithItsRadiusAndFindsThoseOfTheInstant) {
  World world(with_growth(0.5));
  test::must_spawn(world, {test::disk(1, {0, 0}, {0, 0}, 0.5)});
  run_for(world, 3);  // 2 m by now
  const DiskSpec near = test::disk(2, {3, 0}, {0, 0}, 1.5);
  const auto refused = world.spawn({std::span(&near, 1), {}});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.reject().code, Code::Overlap);
  EXPECT_EQ(refused.reject().clearance, -0.5);
  test::must_spawn(world, {test::disk(3, {4, 0}, {0, 0}, 1.5)});
  EXPECT_EQ(test::state(world, 3).radius, 1.5);
  const VectorFor away{3, {9, 0}};
  ASSERT_TRUE(world.set_velocity(std::span(&away, 1)).ok());
  run_for(world, 1);
  EXPECT_EQ(test::state(world, 3).radius, 2);
  EXPECT_EQ(test::state(world, 1).radius, 2.5);
}

/// A hundred disks of two sizes that grow in a box, and lose what the growth puts in.
World packing(std::uint64_t events) {
  WorldOptions options = with_growth(0.3);
  options.effects.restitution = Restitution{0.9, 0.9, 0, 0};
  World world(options);
  test::Random random(101);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 100; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    const double radius = i % 2 == 0 ? 0.05 : 0.15;
    disks.push_back(test::disk(kNoId, {i % 10 + 0.5, i / 10 + 0.5}, 0.2 * velocity, radius));
  }
  test::must_spawn(world, disks, test::box(1'000, {0, 0}, {10, 10}));
  const auto report = world.advance_to(test::seconds(100), nullptr, events);
  EXPECT_TRUE(report.ok() && report.value().stop == Stop::EventBudget);
  return world;
}

/// Pairs of disks whose gap is below `share` of their contact distance.
int contacts(const World& world, double share) {
  std::vector<BodyState> disks;
  world.for_each_disk([&](const BodyState& disk) { disks.push_back(disk); });
  int count = 0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double reach = disks[i].radius + disks[j].radius;
      if ((disks[i].position - disks[j].position).norm() < (1 + share) * reach) ++count;
    }
  }
  return count;
}

TEST(GrowthWorld, APackingJams) {
  const World world = packing(250'000);
  double area = 0;
  world.for_each_disk(
      [&](const BodyState& disk) { area += std::numbers::pi * disk.radius * disk.radius / 100; });
  std::printf("packing: area fraction %.4f at %.6f s, %d gaps below 1e-5\n",
              area,
              seconds_between({}, world.now()),
              contacts(world, 1e-5));
  EXPECT_GT(area, 0.78);
  EXPECT_GT(contacts(world, 1e-5), 100) << "a hundred disks hold each other";
  EXPECT_EQ(world.census().missed, 0U);
  EXPECT_LT(world.census().deepest, 1e-15);
}

// Two walls a hand's breadth apart, and then no room: the world stops before the last hit and names
// the disk, as it does for walls that close in.
TEST(GrowthWorld, StopsWhereThereIsNoRoomLeft) {
  World world(with_growth(0.1));
  const std::vector<WallSpec> walls = {test::wall(8, {-5, -1}, {5, -1}),
                                       test::wall(9, {-5, 1}, {5, 1})};
  test::must_spawn(world, {test::disk(1, {0, 0.1}, {0.1, 0.4}, 0.5)}, walls);
  const auto report = world.advance_to(test::seconds(10)).value();
  EXPECT_EQ(report.stop, Stop::Stalled);
  EXPECT_EQ(report.stalled, 1U);
  EXPECT_NEAR(seconds_between({}, world.now()), 5, 0.01);
  EXPECT_NEAR(test::state(world, 1).radius, 1, 1e-3);
  EXPECT_LT(world.census().deepest, 1e-15);
}

TEST(GrowthWorld, IsSwitchedOnAndOffWhileTheWorldLives) {
  World world;
  test::must_spawn(world, {test::disk(1, {0, 0}, {1, 0}, 0.5), test::static_disk(2, {9, 9}, 0.5)});
  run_for(world, 1);
  Effects growing;
  growing.growth = Growth{0.25};
  ASSERT_TRUE(world.set_effects(growing).ok());
  run_for(world, 2);
  EXPECT_EQ(test::state(world, 1).radius, 1);
  growing.growth = Growth{0.5};
  ASSERT_TRUE(world.set_effects(growing).ok());
  run_for(world, 1);
  EXPECT_EQ(test::state(world, 2).radius, 1.5);
  ASSERT_TRUE(world.set_effects({}).ok());
  run_for(world, 5);
  EXPECT_EQ(test::state(world, 1).radius, 1.5);
  EXPECT_EQ(test::state(world, 2).radius, 1.5);
  EXPECT_EQ(test::state(world, 1).position, Vector2(9, 0));
}

TEST(GrowthWorld, RefusesWhatHasNoExactTreatment) {
  Effects effects;
  effects.growth = Growth{-1};
  EXPECT_EQ(check_effects(effects)->code, Code::InvalidArgument);
  EXPECT_EQ(check_effects(effects)->field, "growth.rate");
  effects.growth = Growth{std::nan("")};
  EXPECT_EQ(check_effects(effects)->field, "growth.rate");
  effects.growth = Growth{1};
  EXPECT_FALSE(check_effects(effects).has_value());
  effects.gravity = Gravity{{0, -1}};
  EXPECT_EQ(check_effects(effects)->code, Code::Unimplemented);
  EXPECT_EQ(check_effects(effects)->field, "growth");
  effects.gravity.reset();
  effects.rough = Rough{0, 1};
  EXPECT_EQ(check_effects(effects)->field, "growth");
  effects.rough.reset();
  effects.floor_friction = FloorFriction{1};
  EXPECT_EQ(check_effects(effects)->field, "growth");
}

}  // namespace
}  // namespace stoss::engine

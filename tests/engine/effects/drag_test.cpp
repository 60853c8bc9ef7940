// SPDX-License-Identifier: Apache-2.0
// Worlds under linear drag, with gravity and without: flights by the book, the plain world in
// warped time, moving walls, rest, one story whatever the ticks.
#include "motion_law/drag.hpp"

#include "support/oracle.hpp"
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stoss::engine {
namespace {

using test::run_for;

WorldOptions with_drag(double rate,
                       const Vector2& gravity = Vector2::Zero(),
                       BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects.drag = Drag{rate};
  if (gravity != Vector2::Zero()) options.effects.gravity = Gravity{gravity};
  options.broad_phase = kind;
  return options;
}

/// Disks of three sizes, thrown about in a box with walls that have ends, a static disk, a
/// kinematic one and a moving wall.
World thick_gas(const WorldOptions& options) {
  World world(options);
  test::Random random(31);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 64; ++i) {
    const Vector2 velocity(random.uniform(-3, 3), random.uniform(-3, 3));
    disks.push_back(test::disk(
        kNoId, {1.5 * (i % 8) + 1, 1.5 * (i / 8) + 1}, velocity, 0.3 + 0.1 * (i % 3), 1 + i % 2));
  }
  disks.push_back(test::static_disk(900, {6.25, 13}, 0.4));
  disks.push_back(test::kinematic_disk(901, {3, 13.2}, {0.1, -0.02}, 0.3));
  std::vector<WallSpec> walls = test::box(1'000, {0, 0}, {14, 14});
  walls.push_back(test::wall(1'010, {9, 12.7}, {12, 13.3}, {-0.1, 0.02}));
  test::must_spawn(world, disks, walls);
  return world;
}

TEST(DragWorld, AFlightEndsWhereTheMediumHoldsIt) {
  World world(with_drag(0.5));
  test::must_spawn(world, {test::disk(1, {1, 2}, {3, 4}, 0.5)});
  run_for(world, 2);
  const double left = std::exp(-1.0);
  EXPECT_NEAR((test::state(world, 1).velocity - left * Vector2(3, 4)).norm(), 0, 1e-15);
  EXPECT_NEAR((test::state(world, 1).position - Vector2(7, 10) + 2 * left * Vector2(3, 4)).norm(),
              0,
              1e-14);
  run_for(world, 1e6);
  EXPECT_EQ(test::state(world, 1).position, Vector2(7, 10));
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
  EXPECT_EQ(world.advance_to(test::seconds(1e12)).value().events, 0U) << "it costs nothing";
}

TEST(DragWorld, AFallTendsToItsTerminalVelocity) {
  World world(with_drag(2, {0, -10}));
  test::must_spawn(world, {test::disk(1, {0, 0}, {1, 0}, 0.5)});
  run_for(world, 1);
  const double left = std::exp(-2.0), run = (1 - left) / 2;
  EXPECT_NEAR(test::state(world, 1).position.x(), run, 1e-15);
  EXPECT_NEAR(test::state(world, 1).position.y(), -10 * (1 - run) / 2, 1e-14);
  EXPECT_NEAR(test::state(world, 1).velocity.y(), -10 * run, 1e-15);
  run_for(world, 1e3);
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, -5));
  EXPECT_NEAR(test::state(world, 1).position.y(), -5 * (1001 - 0.5), 1e-12);
}

// With drag alone a gas runs through the collisions of the plain gas, in a time that comes to an
// end.
TEST(DragWorld, WithoutGravityIsThePlainWorldInWarpedTime) {
  constexpr double kRate = 0.25;
  const auto gas = [](const WorldOptions& options) {
    World world(options);
    test::Random random(8);
    std::vector<DiskSpec> disks;
    for (int i = 0; i < 36; ++i) {
      const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
      disks.push_back(
          test::disk(static_cast<Id>(i + 1), {i % 6 + 1.0, i / 6 + 1.0}, velocity, 0.3, 1 + i % 3));
    }
    test::must_spawn(world, disks, test::box(1'000, {0, 0}, {7, 7}));
    return world;
  };
  World plain = gas({});
  World thick = gas(with_drag(kRate));
  const auto a = run_for(plain, 2.5);
  const auto b = run_for(thick, -std::log1p(-kRate * 2.5) / kRate);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 70U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double s = seconds_between({}, a[i].instant);
    EXPECT_NEAR(seconds_between({}, b[i].instant), -std::log1p(-kRate * s) / kRate, 1e-9);
    EXPECT_EQ(a[i].a, b[i].a);
    EXPECT_EQ(a[i].b, b[i].b);
  }
  const double left = 1 - kRate * 2.5;
  EXPECT_NEAR(
      thick.conserved().kinetic_energy, left * left * plain.conserved().kinetic_energy, 1e-13);
  run_for(thick, 1e5);
  EXPECT_EQ(thick.conserved().kinetic_energy, 0);
  EXPECT_EQ(thick.census().overlaps, 0U);
}

TEST(DragWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  for (const Vector2& gravity : {Vector2(0, 0), Vector2(0.3, -2)}) {
    const auto gas = [&](BroadPhaseKind kind) {
      WorldOptions options = with_drag(0.2, gravity, kind);
      options.effects.restitution = Restitution{0.95, 0.9, 1e-3, 1e-2};
      return thick_gas(options);
    };
    World once = gas(BroadPhaseKind::Neighbours);
    EXPECT_GT(run_for(once, 5).size(), 200U);
    EXPECT_EQ(once.census().missed, 0U);
    EXPECT_LT(once.census().deepest, 1e-13);
    test::expect_one_story(gas, 5, 250, 3);
  }
}

TEST(DragWorld, TellsOneStoryAroundAPeriodUnderAThermostat) {
  const auto gas = [](BroadPhaseKind kind) {
    WorldOptions options = with_drag(0.5, {1, -2}, kind);
    options.effects.thermostat = Thermostat{1, 0.5, 9};
    options.effects.restitution = Restitution{0.9, 0.8, 1e-3, 1e-2};
    options.period = {12, 0};
    World world(options);
    test::Random random(3);
    std::vector<DiskSpec> disks;
    for (int i = 0; i < 36; ++i) {
      const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
      disks.push_back(test::disk(kNoId, {2.0 * (i % 6), 1.8 * (i / 6) + 1}, velocity, 0.4));
    }
    const std::vector<WallSpec> walls = {test::wall(100, {0, 0}, {12, 0}),
                                         test::wall(101, {3, 11.5}, {6, 12.5}, {0.2, 0})};
    test::must_spawn(world, disks, walls);
    return world;
  };
  World once = gas(BroadPhaseKind::Neighbours);
  EXPECT_GT(run_for(once, 6).size(), 50U);
  EXPECT_EQ(once.census().missed, 0U);
  test::expect_one_story(gas, 6, 100, 3);
}

TEST(DragWorld, TellsOneStoryInFloatAndWithRoughDisks) {
  const auto gas = [](BroadPhaseKind kind) {
    WorldOptions options = with_drag(0.2, {0, 0}, kind);
    options.arithmetic = Arithmetic::Float;
    options.effects.rough = Rough{0.5, 0.4};
    return thick_gas(options);
  };
  test::expect_one_story(gas, 4, 100, 2);
}

TEST(DragWorld, ThatHoldsNothingIsTheWorldWithout) {
  for (const Vector2& gravity : {Vector2(0, 0), Vector2(0.3, -2)}) {
    WorldOptions without = with_drag(0, gravity);
    without.effects.drag.reset();
    World bare = thick_gas(without);
    World thin = thick_gas(with_drag(0, gravity));
    const auto a = run_for(bare, 4);
    const auto b = run_for(thin, 4);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].instant, b[i].instant);
  }
}

TEST(DragWorld, StartsAnywhereInTimeAlike) {
  WorldOptions late = with_drag(0.1, {0.3, -2});
  late.start = {std::int64_t{1} << 40, 0};
  World early = thick_gas(with_drag(0.1, {0.3, -2}));
  World aged = thick_gas(late);
  const auto a = run_for(early, 4);
  const auto b = run_for(aged, 4);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].instant.fraction, b[i].instant.fraction);
    ASSERT_EQ(a[i].instant.seconds + late.start.seconds, b[i].instant.seconds);
    ASSERT_EQ(a[i].velocity_a, b[i].velocity_a);
  }
}

// A wall of 1 m/s catches up with a disk that the medium holds, again and again, and in the end
// pushes it.
TEST(DragWorld, AMovingWallPushesADiskThroughTheMedium) {
  WorldOptions options = with_drag(1);
  options.effects.restitution = Restitution{0.5, 0.5, 0, 1e-6};
  World world(options);
  test::must_spawn(world,
                   {test::disk(1, {2, 0}, {0, 0.25}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {0, -9}, {0, 9}, {1, 0})});
  const auto log = run_for(world, 20);
  ASSERT_GT(log.size(), 10U);
  EXPECT_NEAR(seconds_between({}, log[0].instant), 1.5, 1e-15);
  EXPECT_NEAR(log[0].velocity_a.x(), 1.5, 1e-15);
  const double rebound =
      test::exact(difference<double>(log[1].instant, log[0].instant)).convert_to<double>();
  EXPECT_NEAR(1.5 * (1 - std::exp(-rebound)), rebound, 1e-14) << "where both are at one place";
  const std::uint64_t events = world.advance_to(test::seconds(1e6)).value().events;
  EXPECT_LT(events, 100U) << "it rides on the wall";
  EXPECT_EQ(test::state(world, 1).velocity.x(), 1);
  EXPECT_NEAR(test::state(world, 1).position.x() - world.wall(2).value().start.x(), 0.5, 1e-9);
  EXPECT_NEAR(test::state(world, 1).position.y(), 0.25, 1e-9) << "where the medium has held it";
}

// Down an inclined wall with drag: terminal velocity along it, and off at its end.
TEST(DragWorld, ADiskSlidesDownAWallAtTerminalVelocity) {
  WorldOptions options = with_drag(2, {0, -10});
  options.effects.restitution = Restitution{0.3, 0.3, 0, 1e-2};
  World world(options);
  test::must_spawn(world,
                   {test::disk(1, {-0.3, 0.4 + 1e-3}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-4, -3}, {40, 30})});
  run_for(world, 1);
  const double expected = -10 * 0.6 / 2 * (1 - std::exp(-2.0));
  const Vector2 v = test::state(world, 1).velocity;
  EXPECT_NEAR(v.dot(Vector2(0.8, 0.6)), expected, 0.02);
  EXPECT_NEAR(v.dot(Vector2(-0.6, 0.8)), 0, 1e-15);
  run_for(world, 9);
  EXPECT_NEAR(test::state(world, 1).velocity.y(), -5, 1e-5) << "beyond the end it falls";
  EXPECT_NEAR(test::state(world, 1).velocity.x(), 0, 1e-5);
}

TEST(DragWorld, ADiskComesToRestInABoxAndCostsNothing) {
  WorldOptions options = with_drag(0.5, {0, -9.81});
  options.effects.restitution = Restitution{0.5, 0.5, 1e-3, 0.02};
  World world(options);
  test::must_spawn(world, {test::disk(1, {3, 5}, {1, 0}, 0.5)}, test::box(10, {0, 0}, {9, 9}));
  run_for(world, 100);
  EXPECT_NEAR(test::state(world, 1).position.y(), 0.5, 1e-9);
  EXPECT_LT(std::abs(test::state(world, 1).velocity.x()), 1e-15);
  EXPECT_LT(world.advance_to(test::seconds(1e9)).value().events, 10U);
}

TEST(DragWorld, LeavesKinematicAndStaticBodiesAlone) {
  World world(with_drag(3));
  test::must_spawn(
      world,
      {test::kinematic_disk(1, {0, 0}, {1, 0}, 0.5), test::static_disk(2, {9, 9}, 0.5)},
      std::vector<WallSpec>{test::wall(3, {0, 20}, {1, 20}, {0, 1})});
  run_for(world, 2);
  EXPECT_EQ(test::state(world, 1).position, Vector2(2, 0));
  EXPECT_EQ(test::state(world, 2).position, Vector2(9, 9));
  EXPECT_EQ(world.wall(3).value().start, Vector2(0, 22));
}

TEST(DragWorld, CommandsFindTheVelocityOfTheInstant) {
  World world(with_drag(1));
  test::must_spawn(world, {test::disk(1, {0, 0}, {8, 0}, 0.5, 2)});
  run_for(world, 1);
  const VectorFor up{1, {0, 2}};
  ASSERT_TRUE(world.apply_impulse(std::span(&up, 1)).ok());
  EXPECT_NEAR(test::state(world, 1).velocity.x(), 8 * std::exp(-1.0), 1e-15);
  EXPECT_EQ(test::state(world, 1).velocity.y(), 1);
}

TEST(DragWorld, IsSwitchedOnAndOffWhileTheWorldLives) {
  World world;
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {1, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {0, 9}, {1, 9}, {0, 1})});
  run_for(world, 1);
  ASSERT_TRUE(world.set_effects(with_drag(1).effects).ok());
  run_for(world, 1);
  EXPECT_NEAR(test::state(world, 1).velocity.x(), std::exp(-1.0), 1e-15);
  ASSERT_TRUE(world.set_effects({}).ok());
  run_for(world, 1);
  EXPECT_NEAR(test::state(world, 1).velocity.x(), std::exp(-1.0), 1e-15);
  EXPECT_NEAR(test::state(world, 1).position.x(), 2, 1e-15);
  EXPECT_EQ(world.wall(2).value().start, Vector2(0, 12));
}

TEST(DragWorld, RefusesWhatHasNoExactTreatment) {
  Effects effects;
  effects.drag = Drag{-1};
  EXPECT_EQ(check_effects(effects)->code, Code::InvalidArgument);
  EXPECT_EQ(check_effects(effects)->field, "drag.rate");
  effects.drag = Drag{1e-13};
  EXPECT_EQ(check_effects(effects)->field, "drag.rate");
  effects.drag = Drag{1};
  effects.gravity = Gravity{{0, -1e13}};
  EXPECT_EQ(check_effects(effects)->field, "gravity.acceleration");
  effects.gravity = Gravity{{0, -1}};
  EXPECT_FALSE(check_effects(effects).has_value());
  effects.gravity.reset();
  effects.floor_friction = FloorFriction{1};
  EXPECT_EQ(check_effects(effects)->field, "drag");
  effects.floor_friction.reset();
  effects.growth = Growth{1};
  EXPECT_EQ(check_effects(effects)->field, "growth");
}

}  // namespace
}  // namespace stoss::engine

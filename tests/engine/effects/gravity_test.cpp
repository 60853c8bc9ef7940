// SPDX-License-Identifier: Apache-2.0
// Worlds with gravity: parabolas, energy, the corner and the ceiling, one story whatever the ticks.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stoss::engine {
namespace {

using test::run_for;

WorldOptions with_gravity(const Vector2& acceleration,
                          BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects.gravity = Gravity{acceleration};
  options.broad_phase = kind;
  return options;
}

/// Disks of three sizes thrown about in a box, under slanted gravity.
World falling_gas(const WorldOptions& options) {
  World world(options);
  test::Random random(11);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 64; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(test::disk(
        kNoId, {1.5 * (i % 8) + 1, 1.5 * (i / 8) + 1}, velocity, 0.3 + 0.1 * (i % 3), 1 + i % 2));
  }
  disks.push_back(test::static_disk(900, {6.25, 13}, 0.4));
  test::must_spawn(world, disks, test::box(1'000, {0, 0}, {14, 14}));
  return world;
}

TEST(GravityWorld, AThrownDiskFliesItsParabola) {
  World world(with_gravity({0, -9.81}));
  test::must_spawn(world, {test::disk(1, {1, 2}, {3, 4}, 0.5)});
  ASSERT_TRUE(world.advance_to(test::seconds(0.5)).ok());
  EXPECT_EQ(test::state(world, 1).position, Vector2(2.5, 2 + 2 - 9.81 / 8));
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(3, 4 - 9.81 / 2));
  const Conserved conserved = world.conserved();
  EXPECT_NEAR(conserved.kinetic_energy + conserved.potential_energy, 12.5 + 2 * 9.81, 1e-13);
}

TEST(GravityWorld, ADroppedDiskBouncesForEverAndAlwaysAsHigh) {
  World world(with_gravity({0, -9.81}));
  test::must_spawn(world,
                   {test::disk(1, {0, 1.5}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0})});
  const auto log = run_for(world, 1'000);
  const double fall = std::sqrt(2 / 9.81);
  ASSERT_EQ(log.size(), static_cast<std::size_t>((1'000 / fall + 1) / 2));
  for (std::size_t i = 0; i < log.size(); ++i) {
    const double when = fall * (2 * static_cast<double>(i) + 1);
    EXPECT_NEAR(seconds_between({}, log[i].instant), when, 1e-12);
    EXPECT_NEAR(log[i].velocity_a.y(), std::sqrt(2 * 9.81), 1e-14);
  }
}

TEST(GravityWorld, KeepsEnergyThroughThousandsOfContacts) {
  World world = falling_gas(with_gravity({0.3, -2}));
  const auto total = [&] {
    const Conserved c = world.conserved();
    return c.kinetic_energy + c.potential_energy;
  };
  const double before = total();
  EXPECT_GT(run_for(world, 30).size(), 3'000U);
  EXPECT_NEAR(total(), before, 4e-15 * before);
  EXPECT_EQ(world.census().overlaps, 0U);
  EXPECT_EQ(world.census().missed, 0U);
}

TEST(GravityWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  const auto gas = [](BroadPhaseKind kind) { return falling_gas(with_gravity({0.3, -2}, kind)); };
  test::expect_one_story(gas, 5, 250, 5);
}

TEST(GravityWorld, WithoutPullIsThePlainWorld) {
  World plain = falling_gas({});
  World still = falling_gas(with_gravity({0, 0}));
  const auto a = run_for(plain, 10);
  const auto b = run_for(still, 10);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].instant, b[i].instant);
}

TEST(GravityWorld, StartsAnywhereInTimeAlike) {
  WorldOptions late = with_gravity({0.3, -2});
  late.start = {std::int64_t{1} << 40, 0};
  World early = falling_gas(with_gravity({0.3, -2}));
  World aged = falling_gas(late);
  const auto a = run_for(early, 6);
  const auto b = run_for(aged, 6);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].instant.fraction, b[i].instant.fraction);
    ASSERT_EQ(a[i].instant.seconds + late.start.seconds, b[i].instant.seconds);
    ASSERT_EQ(a[i].velocity_a, b[i].velocity_a);
  }
}

TEST(GravityWorld, LeavesKinematicAndStaticBodiesAlone) {
  World world(with_gravity({0, -9.81}));
  test::must_spawn(
      world,
      {test::kinematic_disk(1, {0, 0}, {1, 0}, 0.5), test::static_disk(2, {9, 9}, 0.5)},
      std::vector<WallSpec>{test::wall(3, {0, 20}, {1, 20}, {0, 1})});
  run_for(world, 2);
  EXPECT_EQ(test::state(world, 1).position, Vector2(2, 0));
  EXPECT_EQ(test::state(world, 2).position, Vector2(9, 9));
  EXPECT_EQ(world.wall(3).value().start, Vector2(0, 22));
}

TEST(GravityWorld, CommandsFindTheVelocityOfTheInstant) {
  World world(with_gravity({0, -10}));
  test::must_spawn(world, {test::disk(1, {0, 0}, {0, 0}, 0.5, 2)});
  run_for(world, 1);
  const VectorFor up{1, {0, 20}};
  ASSERT_TRUE(world.apply_impulse(std::span(&up, 1)).ok());
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
  run_for(world, 1);
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, -10));
  EXPECT_EQ(test::state(world, 1).position, Vector2(0, -10));
}

TEST(GravityWorld, RefusesWhatHasNoExactTreatment) {
  Effects effects;
  effects.gravity = Gravity{{0, -9.81}};
  effects.rough = Rough{0, 1};
  EXPECT_EQ(check_effects(effects)->code, Code::Unimplemented);
  EXPECT_EQ(check_effects(effects)->field, "rough");
  effects.rough.reset();
  effects.floor_friction = FloorFriction{1};
  EXPECT_EQ(check_effects(effects)->field, "floor_friction");
  effects.floor_friction.reset();
  effects.gravity->acceleration.x() = std::nan("");
  EXPECT_EQ(check_effects(effects)->field, "gravity.acceleration");
}

}  // namespace
}  // namespace stoss::engine

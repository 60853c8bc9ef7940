// SPDX-License-Identifier: Apache-2.0
// Worlds of rough disks: a contact by the book, angles that follow spins, what is conserved, and
// one story whatever the ticks.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stoss::engine {
namespace {

using test::run_for;

World rough_world(const Rough& rough, double restitution = 1) {
  WorldOptions options;
  options.effects.rough = rough;
  if (restitution != 1) options.effects.restitution = Restitution{restitution, restitution, 0, 0};
  return World(options);
}

/// Spinning disks of several sizes in a box.
World spinning_gas(const Rough& rough, double restitution, BroadPhaseKind kind) {
  WorldOptions options;
  options.effects.rough = rough;
  options.effects.restitution = Restitution{restitution, restitution, 0, 0};
  options.broad_phase = kind;
  World world(options);
  test::Random random(3);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 49; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    DiskSpec spec = test::disk(kNoId,
                               {1.5 * (i % 7 + 0.6), 1.5 * (i / 7 + 0.6)},
                               velocity,
                               0.3 + 0.1 * (i % 4),
                               1 + i % 3);
    spec.spin = random.uniform(-2, 2);
    disks.push_back(spec);
  }
  test::must_spawn(world, disks, test::box(1'000, {0, 0}, {11.3, 11.3}));
  return world;
}

// A disk that hits a wall at 45 degrees and sticks (beta = 0): the surface velocity of 1 vanishes,
// a third of it from the centre and two thirds from the spin.
TEST(RoughWorld, ADiskThatSticksToAWallRollsOff) {
  World world = rough_world({0, 100});
  test::must_spawn(world,
                   {test::disk(1, {0, 2}, {1, -1}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0})});
  const auto log = run_for(world, 3);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_NEAR(log[0].velocity_a.x(), 2.0 / 3, 1e-15);
  EXPECT_EQ(log[0].velocity_a.y(), 1);
  EXPECT_NEAR(log[0].spin_a, -(2.0 / 3) / 0.5, 1e-15);
  const BodyState state = test::state(world, 1);
  EXPECT_NEAR(state.angle, log[0].spin_a * 1.5, 1e-15) << "1.5 s after the contact";
  EXPECT_NEAR(world.conserved().kinetic_energy, 0.5 * (4.0 / 9 + 1 + (4.0 / 9) / 2), 1e-15);
}

// The same with mu = 0.1: |J_t| = 0.1 J_n = 0.2.
TEST(RoughWorld, ADiskThatSlidesObeysCoulomb) {
  World world = rough_world({0, 0.1});
  test::must_spawn(world,
                   {test::disk(1, {0, 2}, {1, -1}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0})});
  const auto log = run_for(world, 3);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_NEAR(log[0].velocity_a.x(), 0.8, 1e-15);
  EXPECT_NEAR(log[0].spin_a, -0.8, 1e-15);
}

TEST(RoughWorld, PerfectlyRoughDisksKeepEnergyAndOthersNeverGain) {
  World perfect = spinning_gas({1, 1e6}, 1, BroadPhaseKind::Neighbours);
  const double before = perfect.conserved().kinetic_energy;
  run_for(perfect, 30);
  EXPECT_NEAR(perfect.conserved().kinetic_energy, before, 1e-13 * before);

  World lossy = spinning_gas({0.3, 0.4}, 0.9, BroadPhaseKind::Neighbours);
  double energy = lossy.conserved().kinetic_energy;
  for (int i = 0; i < 60; ++i) {
    run_for(lossy, 0.25);
    const double now = lossy.conserved().kinetic_energy;
    EXPECT_LE(now, energy * (1 + 1e-15));
    energy = now;
  }
  EXPECT_LT(energy, 0.7 * before);
}

TEST(RoughWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  const auto gas = [](BroadPhaseKind kind) { return spinning_gas({0.5, 0.3}, 0.95, kind); };
  test::expect_one_story(gas, 5, 250, 5);
}

TEST(RoughWorld, RefusesNumbersOutOfRange) {
  const auto field = [](const Rough& rough) {
    Effects effects;
    effects.rough = rough;
    const auto reject = check_effects(effects);
    return reject ? reject->field : std::string();
  };
  EXPECT_EQ(field({1.5, 0}), "rough.tangential_restitution");
  EXPECT_EQ(field({0, -1}), "rough.friction");
  EXPECT_EQ(field({-1, 0}), "");
}

}  // namespace
}  // namespace stoss::engine

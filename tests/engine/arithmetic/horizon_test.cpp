// SPDX-License-Identifier: Apache-2.0
// The horizon: where two runs that start one unit in the last place apart part ways.
//
// Reference: the gas of 100 disks at area fraction 0.2 costs 0.74 decimal digits a pair collision
// and disk; a double then holds for about 16 collisions a disk, binary128 for about 40.

#include <stoss/engine/horizon.hpp>
#include <stoss/wide/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace stoss::engine;

World gas(Arithmetic arithmetic, std::uint64_t seed) {
  World world = stoss::wide::make_world({{}, arithmetic, BroadPhaseKind::Neighbours});
  std::mt19937_64 random(seed);
  std::normal_distribution<double> component;
  const double side = std::sqrt(100 * std::numbers::pi * 0.25 / 0.2);
  std::vector<DiskSpec> disks(100);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    disks[i].position = {(static_cast<double>(i % 10) + 0.5) * side / 10,
                         (static_cast<double>(i / 10) + 0.5) * side / 10};
    disks[i].velocity = {component(random), component(random)};
    disks[i].radius = 0.5;
  }
  const Vector2 corners[] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  std::vector<WallSpec> walls(4);
  for (std::size_t i = 0; i < 4; ++i) {
    walls[i].start = corners[i];
    walls[i].end = corners[(i + 1) % 4];
  }
  EXPECT_TRUE(world.spawn({disks, walls}).ok());
  EXPECT_TRUE(world.advance_to({.seconds = 20}).ok());  // off the lattice
  return world;
}

double mean_horizon(Arithmetic arithmetic) {
  constexpr int kRuns = 6;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const auto horizon = measure_horizon(gas(arithmetic, seed), {.seconds = 1000}, 1'000'000, seed);
    EXPECT_FALSE(horizon.value().reached_end);
    sum += horizon.value().collisions_per_disk;
  }
  return sum / kRuns;
}

TEST(Horizon, OfADoubleIsAboutSixteenCollisionsADisk) {
  const double mean = mean_horizon(Arithmetic::Double);
  EXPECT_GT(mean, 14);
  EXPECT_LT(mean, 20);
}

TEST(Horizon, OfBinary128IsAboutFortyCollisionsADisk) {
  if (!stoss::wide::is_available(Arithmetic::Float128)) GTEST_SKIP() << "not in this build";
  const double mean = mean_horizon(Arithmetic::Float128);
  EXPECT_GT(mean, 37);
  EXPECT_LT(mean, 45);
}

TEST(Horizon, LeavesTheWorldAsItWas) {
  World world = gas(Arithmetic::Double, 9);
  const auto bytes = world.serialise();
  ASSERT_TRUE(measure_horizon(world, {.seconds = 30}, 1000).ok());
  EXPECT_EQ(world.serialise(), bytes);
}

// A single disk in a box is not chaotic: it agrees with its twin up to the end.
TEST(Horizon, OfARegularMotionIsTheWholeRun) {
  World world;
  DiskSpec disk;
  disk.position = {1, 1};
  disk.velocity = {0.75, 0.25};
  disk.radius = 0.5;
  WallSpec left;
  left.start = {0, -100};
  left.end = {0, 100};
  WallSpec right;
  right.start = {10, -100};
  right.end = {10, 100};
  const std::vector<WallSpec> walls{left, right};
  ASSERT_TRUE(world.spawn({{&disk, 1}, walls}).ok());
  const auto horizon = measure_horizon(world, {.seconds = 300}, 1'000'000);
  EXPECT_TRUE(horizon.value().reached_end);
  EXPECT_EQ(horizon.value().instant, (Instant{.seconds = 300}));
}

}  // namespace

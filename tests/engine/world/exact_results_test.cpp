// SPDX-License-Identifier: Apache-2.0
// Runs whose results are known in closed form: the digits of pi, a disk in a box by unfolding,
// heavy bodies under a rain of light ones.

#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

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

/// A block of mass 100^k, a unit mass and a wall, as Galperin has them.
World galperin(int k, Arithmetic arithmetic) {
  World world(WorldOptions{.start = {}, .arithmetic = arithmetic});
  const std::vector<WallSpec> walls = {wall(3, {0, -1}, {0, 1})};
  const double mass = std::pow(100.0, k);
  must_spawn(world, {disk(1, {2, 0}, {0, 0}, 0.5), disk(2, {8, 0}, {-1, 0}, 0.5, mass)}, walls);
  return world;
}

// G. Galperin, "Playing pool with pi", Regul. Chaotic Dyn. 8 (2003) 375: ceil(pi / theta) - 1
// collisions with theta = atan sqrt(m / M); the block leaves with -cos(2 j theta), j = ceil(N / 2).
TEST(Galperin, CountsTheDigitsOfPiInEveryArithmetic) {
  const std::uint64_t digits[] = {3, 31, 314, 3141, 31415};
  for (const Arithmetic arithmetic :
       {Arithmetic::Float, Arithmetic::Double, Arithmetic::LongDouble}) {
    for (int k = 0; k <= 4; ++k) {
      World world = galperin(k, arithmetic);
      // The block turns round after 7 s or later (k = 0: the disks exchange velocities).
      ASSERT_TRUE(world.advance_to(seconds(1000)).ok());
      EXPECT_EQ(world.counters().collisions, digits[k]) << "k = " << k;
      const double theta = std::atan(std::pow(0.1, k));
      const double j = std::ceil(static_cast<double>(digits[k]) / 2);
      const double tolerance = arithmetic == Arithmetic::Float ? 1e-4 : 2e-16 * (j + 1);
      EXPECT_NEAR(state(world, 2).velocity.x(), -std::cos(2 * j * theta), tolerance) << "k = " << k;
    }
  }
}

TEST(Galperin, KeepsEnergyToTheLastBit) {
  World world = galperin(4, Arithmetic::Double);
  const double before = world.conserved().kinetic_energy;
  ASSERT_TRUE(world.advance_to(seconds(1000)).ok());
  EXPECT_EQ(world.conserved().kinetic_energy, before);
}

// Unfolded, the disk flies straight: the coordinate is |x0 + v T| folded into the free length.
double unfolded(long double x0, long double v, long double time, long double length) {
  const long double way = std::fmod(x0 + v * time, 2 * length);
  const long double inside = way < 0 ? way + 2 * length : way;
  return static_cast<double>(inside <= length ? inside : 2 * length - inside);
}

TEST(Box, AMillionSecondsAreExactByUnfolding) {
  World world;
  must_spawn(world, {disk(1, {3, 2}, {1.25, 0.6875}, 0.5)}, test::box(2, {0, 0}, {10, 7}));
  ASSERT_TRUE(world.advance_to(seconds(1e6)).ok());
  EXPECT_EQ(world.counters().collisions, 253472U);
  const Vector2 position = state(world, 1).position;
  // A contact's instant is rounded to half an ulp of its flight, 4.4e-16 s: at most 8e-11 m in all.
  EXPECT_NEAR(position.x(), 0.5 + unfolded(2.5L, 1.25L, 1e6L, 9), 2e-11);
  EXPECT_NEAR(position.y(), 0.5 + unfolded(1.5L, 0.6875L, 1e6L, 6), 2e-11);
  EXPECT_EQ(state(world, 1).velocity.cwiseAbs(), Vector2(1.25, 0.6875));
}

TEST(Box, OddNumbersAreExactToo) {
  World world;
  const Vector2 p(3.1, 2.2);
  const Vector2 v(1.2345678, -0.7654321);
  must_spawn(world, {disk(1, p, v, 0.3)}, test::box(2, {0.1, 0.2}, {10.3, 7.7}));
  const double time = 123456.789;
  ASSERT_TRUE(world.advance_to(seconds(time)).ok());
  const auto expected = [&](int axis, double low, double high) {
    const long double start = static_cast<long double>(low) + 0.3L;
    return static_cast<double>(start) +
           unfolded(p[axis] - start, v[axis], time, static_cast<long double>(high) - low - 0.6L);
  };
  EXPECT_NEAR(state(world, 1).position.x(), expected(0, 0.1, 10.3), 1e-9);
  EXPECT_NEAR(state(world, 1).position.y(), expected(1, 0.2, 7.7), 1e-9);
}

// A unit mass meets a heavy one again and again, each time coming at -1 m/s: each hit takes
// V - u to (1 - 2 / (M + 1)) (V - u). Held in one word, V would not move at all for M = 1e17.
TEST(Heavy, BodiesDoNotStagnate) {
  for (const double mass : {1e8, 1e15, 1e17}) {
    World world;
    must_spawn(world, {disk(1, {0, 0}, {1, 0}, 0.5, mass), disk(2, {1, 0}, {-1, 0}, 0.5)});
    const int hits = 100'000;
    for (int i = 0; i < hits; ++i) {
      const VectorFor again{2, {-1, 0}};
      ASSERT_TRUE(world.set_velocity(std::span(&again, 1)).ok());
      ASSERT_TRUE(world.advance_to(world.now()).ok());
    }
    EXPECT_EQ(world.counters().collisions, static_cast<std::uint64_t>(hits));
    const SplitNumber v = world.motion(1).value().vx;
    const double change = (v.high - 1) + v.low;
    const double expected = 2 * std::expm1(hits * std::log1p(-2 / (mass + 1)));
    EXPECT_NEAR(change / expected, 1, 1e-12) << "mass " << mass;
  }
}

// A light disk between a heavy one and a wall: billions of times lighter, it turns the heavy one
// round; energy is kept, and the turning point is that of the adiabatic invariant.
TEST(Heavy, ALightDiskTurnsAHeavyOneRound) {
  World world;
  const std::vector<WallSpec> walls = {wall(3, {0, -1}, {0, 1})};
  const double mass = 1e6;
  must_spawn(
      world, {disk(1, {1, 0}, {100, 0}, 0.5), disk(2, {8, 0}, {-0.05, 0}, 0.5, mass)}, walls);
  const double energy = world.conserved().kinetic_energy;
  run_for(world, 1000);
  EXPECT_GT(state(world, 2).velocity.x(), 0);
  EXPECT_NEAR(world.conserved().kinetic_energy / energy, 1, 1e-15);
}

// The piston test of relativity: seen from a frame in motion, collisions are at the same instants.
TEST(Frames, MovingTogetherSeeTheSameCollisions) {
  const auto run = [](const Vector2& frame) {
    World world;
    auto walls = test::box(10, {0, 0}, {8, 8});
    for (WallSpec& w : walls) w.velocity = frame;
    must_spawn(world,
               {disk(1, {2, 2}, frame + Vector2(1, 0.5), 0.5),
                disk(2, {5, 5}, frame + Vector2(-0.75, 0.25), 0.75, 3)},
               walls);
    return run_for(world, 60);
  };
  const auto at_rest = run({0, 0});
  const auto in_motion = run({16, -4});
  ASSERT_EQ(at_rest.size(), in_motion.size());
  ASSERT_GT(at_rest.size(), 20U);
  for (std::size_t i = 0; i < at_rest.size(); ++i) {
    EXPECT_EQ(at_rest[i].b, in_motion[i].b);
    EXPECT_NEAR(seconds_between(at_rest[i].instant, in_motion[i].instant), 0, 1e-9);
  }
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// Worlds with floor friction: stops by the book, conservation in contacts, one story whatever the
// ticks, and a pool shot against high-precision integration.
#include "motion_law/floor_friction.hpp"

#include "support/oracle.hpp"
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stoss::engine {
namespace {

using test::Real;
using test::run_for;

WorldOptions with_friction(double deceleration, BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects.floor_friction = FloorFriction{deceleration};
  options.broad_phase = kind;
  return options;
}

TEST(FloorFriction, IsExactToTheLowWords) {
  test::Random random(test::seed_of_run());
  double worst = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double x = random.either_sign(random.decades(-30, 30));
    const DoubleWord2<double> v{{x, 0}, {random.uniform(-2, 2) * x, 0}};
    const double k = random.decades(-3, 3);
    const Slowing<double> slow = slowing<double>(v, k);
    const Real speed = sqrt(test::dot(test::exact(v), test::exact(v)));
    const Real unit2 = ldexp(Real(1), -106);
    const Real off = abs(test::exact(slow.moves_for) * Real(k) / speed - 1) / unit2;
    const Real along = abs(test::exact(slow.acceleration.x) / Real(k) + Real(x) / speed) / unit2;
    worst = std::max({worst, off.convert_to<double>(), along.convert_to<double>()});
  }
  std::printf("floor friction: worst %.1f u^2\n", worst);
  EXPECT_LE(worst, 24);
}

TEST(FloorFrictionWorld, ADiskStopsWhereItShouldAndStays) {
  World world(with_friction(0.5));
  test::must_spawn(world, {test::disk(1, {0, 0}, {3, 4}, 0.5)});
  run_for(world, 5);
  EXPECT_NEAR((test::state(world, 1).velocity - Vector2(1.5, 2)).norm(), 0, 1e-15);
  run_for(world, 1e6);
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
  EXPECT_NEAR((test::state(world, 1).position - Vector2(15, 20)).norm(), 0, 1e-14);
  const std::uint64_t events = world.advance_to(test::seconds(1e9)).value().events;
  EXPECT_EQ(events, 0U) << "a world at rest costs nothing";
}

TEST(FloorFrictionWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  const auto table = [](BroadPhaseKind kind) {
    World world(with_friction(0.3, kind));
    test::Random random(5);
    std::vector<DiskSpec> disks;
    for (int i = 0; i < 30; ++i) {
      const Vector2 velocity(random.uniform(-4, 4), random.uniform(-4, 4));
      disks.push_back(
          test::disk(kNoId, {1.2 * (i % 6) + 1, 1.2 * (i / 6) + 1}, velocity, 0.5, 1 + i % 2));
    }
    test::must_spawn(world, disks, test::box(100, {0, 0}, {9, 8}));
    return world;
  };
  World break_shot = table(BroadPhaseKind::Neighbours);
  EXPECT_GT(run_for(break_shot, 4).size(), 100U);
  const World end = test::expect_one_story(table, 4, 400, 100);
  EXPECT_EQ(end.conserved().kinetic_energy, 0) << "all have stopped";
  EXPECT_EQ(end.census().overlaps, 0U);
}

// A cue ball at 4 m/s against two others, followed by steps of 1e-5 s in long double: positions and
// velocities agree as well as such steps allow.
TEST(FloorFrictionWorld, APoolShotAgreesWithIntegration) {
  World world(with_friction(0.8));
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {4, 0.05}, 0.0286, 0.17),
                    test::disk(2, {1, 0.0135}, {0, 0}, 0.0286, 0.17),
                    test::disk(3, {1.3, 0.03}, {0, 0}, 0.0286, 0.17)});
  struct Ball {
    long double x, y, vx, vy;
  };
  Ball balls[] = {{0, 0, 4, 0.05L}, {1, 0.0135L, 0, 0}, {1.3L, 0.03L, 0, 0}};
  constexpr long double kStep = 1e-5L;
  for (int step = 0; step < 150'000; ++step) {
    for (Ball& b : balls) {
      const long double speed = std::sqrt(b.vx * b.vx + b.vy * b.vy);
      b.x += kStep * b.vx;
      b.y += kStep * b.vy;
      const long double keep = speed > 0.8L * kStep ? 1 - 0.8L * kStep / speed : 0;
      b.vx *= keep;
      b.vy *= keep;
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = i + 1; j < 3; ++j) {
        const long double px = balls[j].x - balls[i].x;
        const long double py = balls[j].y - balls[i].y;
        const long double closing =
            px * (balls[j].vx - balls[i].vx) + py * (balls[j].vy - balls[i].vy);
        const long double square = px * px + py * py;
        if (square > 0.0572L * 0.0572L || closing >= 0) continue;
        const long double k = closing / square;
        balls[i].vx += k * px;
        balls[i].vy += k * py;
        balls[j].vx -= k * px;
        balls[j].vy -= k * py;
      }
    }
  }
  run_for(world, 1.5);
  for (Id id = 1; id <= 3; ++id) {
    const BodyState state = test::state(world, id);
    const Ball& ball = balls[id - 1];
    EXPECT_NEAR(state.position.x(), static_cast<double>(ball.x), 5e-3);
    EXPECT_NEAR(state.position.y(), static_cast<double>(ball.y), 5e-3);
  }
  EXPECT_GE(world.counters().collisions, 2U);
}

}  // namespace
}  // namespace stoss::engine

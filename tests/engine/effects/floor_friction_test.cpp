// SPDX-License-Identifier: Apache-2.0
// Worlds with floor friction: stops by the book, conservation in contacts, one story whatever the
// ticks, and a pool shot against high-precision integration.
#include "motion_law/floor_friction.hpp"

#include "support/oracle.hpp"
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

/// A ball of the reference: in 400 bits, on its parabola from 0 s of its own on.
struct Ball {
  Real x, y, vx, vy;

  /// After t seconds of slowing down.
  Ball after(const Real& t, const Real& deceleration) const {
    const Real speed = sqrt(vx * vx + vy * vy);
    if (speed == 0) return *this;
    const Real stop = speed / deceleration;
    const Real time = t < stop ? t : stop;
    const Real path = time - time * time / (2 * stop);  // times the velocity
    const Real left = 1 - time / stop;
    return {x + vx * path, y + vy * path, vx * left, vy * left};
  }
};

/// Equal balls of diameter d over a span of time, in steps of a millisecond that end at the first
/// contact, found by bisection to 2^-300 of a step.
void play(std::vector<Ball>& balls, const Real& span, const Real& d, const Real& deceleration) {
  const auto approach = [&](const Ball& a, const Ball& b) {  // d^2 below the square of the distance
    const Real px = b.x - a.x, py = b.y - a.y;
    return Real(px * px + py * py - d * d);
  };
  const auto closing = [](const Ball& a, const Ball& b) {
    return Real((b.x - a.x) * (b.vx - a.vx) + (b.y - a.y) * (b.vy - a.vy));
  };
  Real left = span;
  while (left > 0) {
    Real step = left < Real(1) / 1000 ? left : Real(1) / 1000;
    std::size_t first = 0, second = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      for (std::size_t j = i + 1; j < balls.size(); ++j) {
        const auto gap = [&](const Real& t) {
          return approach(balls[i].after(t, deceleration), balls[j].after(t, deceleration));
        };
        if (gap(step) >= 0 || closing(balls[i], balls[j]) >= 0) continue;
        Real low = 0, high = step;
        for (int k = 0; k < 300; ++k) {
          const Real middle = (low + high) / 2;
          (gap(middle) < 0 ? high : low) = middle;
        }
        step = low;
        first = i;
        second = j;
      }
    }
    for (Ball& ball : balls) ball = ball.after(step, deceleration);
    left -= step;
    if (first == second) continue;
    Ball& a = balls[first];
    Ball& b = balls[second];
    const Real k = closing(a, b) / (d * d);
    const Real px = b.x - a.x, py = b.y - a.y;
    a.vx += k * px;
    a.vy += k * py;
    b.vx -= k * px;
    b.vy -= k * py;
  }
}

// A cue ball at 4 m/s against two others, followed in 400 bits: contacts, motions and stops agree
// to the rounding of the positions.
TEST(FloorFrictionWorld, APoolShotAgreesWithIntegrationInHighPrecision) {
  constexpr double kRadius = 0.0286, kDeceleration = 0.8;
  World world(with_friction(kDeceleration));
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {4, 0.05}, kRadius, 0.17),
                    test::disk(2, {1, 0.0135}, {0, 0}, kRadius, 0.17),
                    test::disk(3, {1.3, 0.03}, {0, 0}, kRadius, 0.17)});
  std::vector<Ball> balls = {
      {0, 0, 4, Real(0.05)}, {1, Real(0.0135), 0, 0}, {Real(1.3), Real(0.03), 0, 0}};
  for (const double span : {0.5, 1.0, 8.0}) {
    run_for(world, span);
    play(balls, Real(span), 2 * Real(kRadius), Real(kDeceleration));
    for (Id id = 1; id <= 3; ++id) {
      const BodyState state = test::state(world, id);
      const Ball& ball = balls[id - 1];
      EXPECT_NEAR(state.position.x(), ball.x.convert_to<double>(), 1e-14);
      EXPECT_NEAR(state.position.y(), ball.y.convert_to<double>(), 1e-14);
      EXPECT_NEAR(state.velocity.x(), ball.vx.convert_to<double>(), 1e-13);
      EXPECT_NEAR(state.velocity.y(), ball.vy.convert_to<double>(), 1e-13);
    }
  }
  EXPECT_GE(world.counters().collisions, 2U);
  EXPECT_EQ(world.conserved().kinetic_energy, 0) << "all have stopped";
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The same world in other units. Powers of two change no digit of a number, and lengths and speeds
// in the same units no time: so the same happens, though products of a few lengths and speeds leave
// the range of double. Rounding differs where kernels carry third words that leave it.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

constexpr double kSide = 6;

struct Law {
  std::string name;
  std::function<Effects(double)> with;  ///< in a unit
  int range = 460;                      ///< of the unit, as a power of two
};

World world_in(const Law& law, double unit) {
  test::Random random(test::seed_of_run());
  WorldOptions options;
  options.effects = law.with(unit);
  World world(options);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 9; ++i) {
    const Vector2 velocity(random.uniform(-2, 2), random.uniform(-2, 2));
    const Vector2 place(1 + 2 * (i % 3), 1 + 2 * (i / 3));
    disks.push_back(test::disk(static_cast<Id>(i + 1), unit * place, unit * velocity, unit * 0.5));
  }
  disks[4].kind = BodyKind::Static;
  disks[4].velocity = Vector2::Zero();
  std::vector<WallSpec> walls = test::box(100, {0, 0}, {unit * kSide, unit * kSide});
  walls.push_back(test::wall(200, unit * Vector2(1.7, 2), unit * Vector2(2.3, 2)));
  test::must_spawn(world, disks, walls);
  return world;
}

/// No effects but those that `add` adds, in a unit.
Law law(const std::string& name, const std::function<void(Effects&, double)>& add) {
  const auto with = [add](double unit) {
    Effects effects;
    add(effects, unit);
    return effects;
  };
  return {name, with};
}

std::vector<Law> laws() {
  std::vector<Law> all;
  all.push_back(law("plain", [](Effects&, double) {}));
  all.push_back(law("gravity", [](Effects& effects, double unit) {
    effects.gravity = Gravity{{0, -9 * unit}};
    effects.restitution = Restitution{0.9, 0.9, 0, 1e-9 * unit};
  }));
  all.push_back(law("floor friction", [](Effects& effects, double unit) {
    effects.floor_friction = FloorFriction{0.1 * unit};
  }));
  all.push_back(law("rough", [](Effects& effects, double) { effects.rough = Rough{0.5, 0.3}; }));
  all.push_back(
      law("growth", [](Effects& effects, double unit) { effects.growth = Growth{0.01 * unit}; }));
  all.push_back(law("drag", [](Effects& effects, double unit) {
    effects.drag = Drag{0.1};
    effects.restitution = Restitution{1, 1, 0, 1e-9 * unit};
  }));
  all.back().range = 120;  // of what its kernels take
  return all;
}

using Log = std::vector<Collision>;

void expect_same(const Log& log, const Log& scaled, double unit) {
  ASSERT_EQ(log.size(), scaled.size());
  constexpr double kGrown = 1e-8;  // rounding, by the collisions that follow it
  for (std::size_t i = 0; i < log.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(log[i].a, scaled[i].a);
    ASSERT_EQ(log[i].b, scaled[i].b);
    ASSERT_NEAR(seconds_between(log[i].instant, scaled[i].instant), 0, kGrown);
    ASSERT_LT((unit * log[i].velocity_a - scaled[i].velocity_a).stableNorm(), unit * kGrown);
    ASSERT_LT((unit * log[i].velocity_b - scaled[i].velocity_b).stableNorm(), unit * kGrown);
  }
}

TEST(Units, OfAnySizeChangeNothing) {
  for (const Law& law : laws()) {
    World world = world_in(law, 1);
    const auto log = test::run_for(world, 4);
    EXPECT_GT(log.size(), 10U) << law.name;
    for (const int power : {-460, -300, -260, -200, -120, 120, 200, 260, 300, 460}) {
      const double unit = std::ldexp(1.0, power);
      if (std::abs(power) > law.range || check_effects(law.with(unit))) continue;
      SCOPED_TRACE(law.name + " in units of 2^" + std::to_string(power));
      World scaled = world_in(law, unit);
      ASSERT_NO_FATAL_FAILURE(expect_same(log, test::run_for(scaled, 4), unit));
    }
  }
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The example scenes with effects: each loads, runs for a while and shows what it is for.
#include <stoss/engine/world.hpp>
#include <stoss/idl/scene_file.hpp>
#include <stoss/translate/scene.hpp>

#include <gtest/gtest.h>
#include <scene.pb.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stoss::translate {
namespace {

engine::World load(const std::string& name) {
  const auto loaded = idl::load_scene(std::string(STOSS_SCENE_DIR) + "/" + name + ".json");
  if (!std::holds_alternative<Scene>(loaded)) throw std::runtime_error(name + " does not load");
  auto world = make_world(std::get<Scene>(loaded), {});
  if (!world) throw std::runtime_error(name + ": " + world.reject().reason);
  return std::move(world).value();
}

/// Runs for so many seconds; nothing stalls, overlaps or is missed.
void run(engine::World& world, double seconds) {
  const auto report = world.advance_to(*engine::offset_by(world.now(), seconds));
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report.value().stop, engine::Stop::Reached) << "around body " << report.value().stalled;
  EXPECT_EQ(world.census().overlaps, 0U);
  EXPECT_EQ(world.census().missed, 0U);
}

template <class Visit>
void for_each_dynamic(const engine::World& world, const Visit& visit) {
  world.for_each_disk([&](const engine::BodyState& s) {
    if (s.kind == engine::BodyKind::Dynamic) visit(s);
  });
}

TEST(EffectScenes, TheCoolingGasCools) {
  engine::World world = load("cooling-gas");
  const double before = world.conserved().kinetic_energy;
  run(world, 10);
  EXPECT_LT(world.conserved().kinetic_energy, 0.5 * before);
  EXPECT_GT(world.counters().collisions, 1'000U);
}

TEST(EffectScenes, TheThermostatGasStaysWarm) {
  engine::World world = load("thermostat-gas");
  run(world, 20);
  const double temperature =
      world.conserved().kinetic_energy / static_cast<double>(world.disk_count());
  EXPECT_GT(temperature, 0.5);
  EXPECT_LT(temperature, 1.1);
  EXPECT_EQ(world.effects().thermostat->seed, 1980U);
  EXPECT_GT(world.counters().kicks, 2'000U);
}

TEST(EffectScenes, TheGaltonBoardSpreadsItsBalls) {
  engine::World world = load("galton-board");
  run(world, 12);
  int through = 0;
  double sum = 0, squares = 0;
  for_each_dynamic(world, [&](const engine::BodyState& s) {
    if (s.position.y() > -1.6) return;
    ++through;
    sum += s.position.x();
    squares += s.position.x() * s.position.x();
  });
  ASSERT_GT(through, 80);
  const double mean = sum / through;
  EXPECT_LT(std::abs(mean), 0.15);
  EXPECT_GT(squares / through - mean * mean, 0.01 * 0.01);
}

TEST(EffectScenes, TheHourglassRuns) {
  engine::World world = load("hourglass");
  const auto below = [&] {
    int count = 0;
    for_each_dynamic(world, [&](const engine::BodyState& s) { count += s.position.y() < -0.2; });
    return count;
  };
  EXPECT_EQ(below(), 0);
  run(world, 8);
  const int first = below();
  EXPECT_GT(first, 3);
  run(world, 15);
  EXPECT_GT(below(), first);
  for_each_dynamic(world, [](const engine::BodyState& s) {
    EXPECT_LT(std::abs(s.position.x()), 2);
    EXPECT_LT(std::abs(s.position.y()), 4);
  });
}

TEST(EffectScenes, ThePistonsWorkOnTheGas) {
  engine::World world = load("pistons");
  const double before = world.conserved().kinetic_energy;
  run(world, 20);
  EXPECT_NE(world.conserved().kinetic_energy, before);
  double left = 0;
  world.for_each_wall([&](const engine::WallState& w) {
    if (w.velocity.x() > 0.18) left = w.start.x();
  });
  EXPECT_NEAR(left, 4, 1e-12);
  for_each_dynamic(world, [&](const engine::BodyState& s) {
    EXPECT_GT(s.position.x(), left);
    EXPECT_LT(s.position.x(), 33);
  });
}

TEST(EffectScenes, TheSwarmTakesVelocityCommands) {
  engine::World world = load("swarm");
  EXPECT_GT(world.wall_count(), 1'000U);
  std::vector<engine::VectorFor> drive, stop;
  world.for_each_disk([&](const engine::BodyState& s) {
    if (s.kind != engine::BodyKind::Kinematic) return;
    drive.push_back({s.id, {0.3, 0}});
    stop.push_back({s.id, {0, 0}});
  });
  ASSERT_GT(drive.size(), 100U);
  run(world, 2);
  ASSERT_TRUE(world.set_velocity(drive).ok());
  run(world, 1);
  ASSERT_TRUE(world.set_velocity(stop).ok());
  const engine::Vector2 stood = world.state(stop.front().id).value().position;
  run(world, 5);
  EXPECT_EQ(world.state(stop.front().id).value().position, stood);
  for_each_dynamic(world, [](const engine::BodyState& s) {
    EXPECT_GT(s.position.minCoeff(), 0);
    EXPECT_LT(s.position.x(), 100);
    EXPECT_LT(s.position.y(), 80);
  });
}

}  // namespace
}  // namespace stoss::translate

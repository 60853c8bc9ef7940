// SPDX-License-Identifier: Apache-2.0
// Gravity, rest, floor friction, growth and drag.

#include "hard_cases/case.hpp"

namespace stoss::hard_cases {

namespace {

using engine::Collision;
using engine::Instant;
using engine::Vector2;
using engine::WallSpec;
using engine::World;

/// A world under the case's gravity, with its coefficient of restitution.
World falling_world(const Case& c, const Vector2& gravity) {
  engine::Effects effects = effects_of(c);
  effects.gravity = engine::Gravity{gravity};
  return World(engine::WorldOptions{.start = {}, .effects = effects});
}

/// The first contact is when and where it should be, and has the right velocity after.
void expect_first_contact(const Case& c, World& world) {
  const bool event = c.expected().at("event").get<bool>();
  const double when = event ? Case::real(c.expected().at("t")).convert_to<double>() : 100;
  const auto log = test::run_for(world, when * (1 + 1e-12));
  ASSERT_EQ(log.empty(), !event);
  if (!event) return;
  expect_time(c, {}, log[0].instant);
  const Vector2& v = log[0].velocity_a;
  expect_vector(c, {Real(v.x()), Real(v.y())}, Case::real2(c.expected().at("v_after")), 0);
}

}  // namespace

std::string run_gravity_segment(const Case& c) {
  World world = falling_world(c, c.vector("gravity"));
  const WallSpec wall = test::wall(2, c.vector("a"), c.vector("b"));
  test::must_spawn(world, {disk_of(c)}, std::span(&wall, 1));
  expect_first_contact(c, world);
  return "";
}

// The corner is the start of a wall that leads away to the right.
std::string run_gravity_corner(const Case& c) {
  World world = falling_world(c, c.vector("gravity"));
  const Vector2 corner = c.vector("corner");
  const WallSpec wall = test::wall(2, corner, corner + Vector2(100, 0));
  test::must_spawn(world, {disk_of(c)}, std::span(&wall, 1));
  expect_first_contact(c, world);
  return "";
}

std::string run_bounce_series(const Case& c) {
  World world = falling_world(c, {0, -c.number("g")});
  const WallSpec floor = test::wall(2, {-9, 0}, {9, 0});
  test::must_spawn(world,
                   {test::disk(1, {0, c.number("height") + 0.5}, {0, c.number("v0")}, 0.5)},
                   std::span(&floor, 1));
  const auto log = test::run_for(world, 10);
  const json& times = c.expected().at("impact_times");
  EXPECT_GE(log.size(), times.size());
  for (std::size_t i = 0; i < log.size() && i < times.size(); ++i) {
    const Real truth = Case::real(times.at(i));
    const Real off = abs(seconds_from({}, log[i].instant) - truth);
    EXPECT_LE(off, truth * Real(c.tolerance("t_rel", 0)) + grid()) << "impact " << i;
  }
  // Rest begins with the last bounce that counts, a little before the series would end.
  const Real end = Case::real(c.expected().at("rest_time"));
  const Real last = seconds_from({}, log.back().instant);
  EXPECT_LE(abs(last - end), Real(2e-9) / (c.number("g") * (1 - c.number("e"))));
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
  return "";
}

std::string run_resting(const Case& c) {
  World world = falling_world(c, c.vector("gravity"));
  std::vector<WallSpec> walls;
  for (const json& segment : c.inputs().at("segments")) {
    walls.push_back(
        test::wall(2 + walls.size(), Case::vector(segment.at(0)), Case::vector(segment.at(1))));
  }
  test::must_spawn(world, {disk_of(c)}, walls);
  const auto report = world.advance_to(test::seconds(c.number("T"))).value();
  EXPECT_LE(report.events, c.expected().at("max_events").get<std::uint64_t>());
  const engine::BodyState state = test::state(world, 1);
  const auto off = [](const Vector2& value, const Real2& truth) {
    return norm({Real(value.x()) - truth.x, Real(value.y()) - truth.y});
  };
  EXPECT_LE(off(state.position, Case::real2(c.expected().at("p_final"))),
            Real(c.tolerance("p_abs", 0)));
  EXPECT_LE(off(state.velocity, Case::real2(c.expected().at("v_final"))),
            Real(c.tolerance("v_abs", 0)));
  return "";
}

std::string run_friction_pair(const Case& c) {
  engine::Effects effects;
  effects.floor_friction = engine::FloorFriction{c.number("deceleration")};
  World world(engine::WorldOptions{.start = {}, .effects = effects});
  const double radius = c.number("d") / 2;
  test::must_spawn(world,
                   {test::disk(1, c.vector("p1"), c.vector("v1"), radius),
                    test::disk(2, c.vector("p2"), c.vector("v2"), radius)});
  const auto log = test::run_for(world, 100);
  const bool event = c.expected().at("event").get<bool>();
  EXPECT_EQ(log.empty(), !event);
  if (event && !log.empty()) {
    expect_time(c, {}, log[0].instant);
    return "";
  }
  const json& places = c.expected().at("rest_positions");
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector2 place = test::state(world, i + 1).position;
    const Real2 truth = Case::real2(places.at(i));
    EXPECT_LE(norm({Real(place.x()) - truth.x, Real(place.y()) - truth.y}), Real(1e-15));
  }
  return "";
}

// The reach and its growth are of both disks: each has half of them.
std::string run_growing_pair(const Case& c) {
  engine::Effects effects;
  effects.growth = engine::Growth{c.number("growth") / 2};
  World world(engine::WorldOptions{.start = {}, .effects = effects});
  const double radius = c.number("d0") / 2;
  test::must_spawn(
      world,
      {test::disk(1, {0, 0}, {0, 0}, radius), test::disk(2, c.vector("p"), c.vector("v"), radius)});
  const Real when = Case::real(c.expected().at("t"));
  const auto log = test::run_for(world, when.convert_to<double>() * (1 + 1e-12));
  EXPECT_TRUE(c.expected().at("event").get<bool>());
  EXPECT_EQ(log.size(), 1U);
  if (log.empty()) return "";
  expect_time(c, {}, log[0].instant);
  const Real reach = Real(test::state(world, 1).radius) + Real(test::state(world, 2).radius);
  const Real truth = Case::real(c.expected().at("contact_distance"));
  EXPECT_LE(abs(reach - truth), truth * Real(1e-11));
  return "";
}

std::string run_drag_pair(const Case& c) {
  engine::Effects effects;
  effects.drag = engine::Drag{c.number("gamma")};
  World world(engine::WorldOptions{.start = {}, .effects = effects});
  const double radius = c.number("d") / 2;
  test::must_spawn(
      world,
      {test::disk(1, {0, 0}, {0, 0}, radius), test::disk(2, c.vector("p"), c.vector("v"), radius)});
  const bool event = c.expected().at("event").get<bool>();
  const Instant end{event ? 100 : engine::kSecondsMax - 1, 0};
  const auto log = test::run_until(world, end);
  EXPECT_EQ(log.empty(), !event);
  if (!event || log.empty()) return "";
  expect_time(c, {}, log[0].instant);
  const Real2 speed = Case::real2(c.expected().at("v_at_contact"));
  // Of equal masses: what they have together at the contact, they have after it.
  const Vector2 together = log[0].velocity_a + log[0].velocity_b;
  EXPECT_LE(norm({Real(together.x()) - speed.x, Real(together.y()) - speed.y}), Real(1e-15));
  return "";
}

}  // namespace stoss::hard_cases

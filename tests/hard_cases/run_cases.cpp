// SPDX-License-Identifier: Apache-2.0
// Many contacts: counts, orders, final states.

#include "hard_cases/case.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace stoss::hard_cases {

namespace {

using engine::Code;
using engine::Collision;
using engine::ContactKind;
using engine::DiskSpec;
using engine::Id;
using engine::Instant;
using engine::Vector2;
using engine::WallSpec;
using engine::World;

/// The disks of a list {p, v, r, m}, with ids from 1.
std::vector<DiskSpec> disks_of(const json& list) {
  std::vector<DiskSpec> disks;
  for (const json& d : list) {
    disks.push_back(test::disk(disks.size() + 1,
                               Case::vector(d.at("p")),
                               Case::vector(d.at("v")),
                               Case::number(d.at("r")),
                               Case::number(d.at("m"))));
  }
  return disks;
}

std::size_t count_of(const std::vector<Collision>& log, ContactKind kind) {
  return static_cast<std::size_t>(
      std::count_if(log.begin(), log.end(), [=](const Collision& c) { return c.kind == kind; }));
}

}  // namespace

std::string run_galperin(const Case& c) {
  World world = world_of(c);
  const double x = c.number("x_wall");
  const WallSpec wall = test::wall(3, {x, -1}, {x, 1});
  test::must_spawn(
      world,
      {test::disk(1,
                  {c.number("x_small"), 0},
                  {c.number("v_small"), 0},
                  c.number("r_small"),
                  c.number("m")),
       test::disk(
           2, {c.number("x_big"), 0}, {c.number("v_big"), 0}, c.number("r_big"), c.number("M"))},
      std::span(&wall, 1));
  const auto log = test::run_for(world, 1000);
  const json& expected = c.expected();
  EXPECT_EQ(log.size(), expected.at("collisions").get<std::size_t>());
  EXPECT_EQ(count_of(log, ContactKind::DiskDisk),
            expected.at("pair_collisions").get<std::size_t>());
  EXPECT_EQ(count_of(log, ContactKind::DiskWall),
            expected.at("wall_collisions").get<std::size_t>());
  const auto expect_speed = [&](Id id, const char* key) {
    const Real truth = Case::real(expected.at(key));
    const Real allowed = Real(c.tolerance("V_rel", 0)) + Real(c.tolerance("V_abs", 0));
    EXPECT_LE(abs(velocity_of(world, id).x - truth), allowed);
  };
  expect_speed(2, "V_final");
  // The light disk's speed is sqrt(M / m) times as sensitive to the heavy one's.
  const Real truth = Case::real(expected.at("v_small_final"));
  EXPECT_LE(abs(velocity_of(world, 1).x - truth),
            Real(1e-13) * sqrt(Real(c.number("M")) / Real(c.number("m"))));
  return "";
}

std::string run_cradle(const Case& c) {
  World world = world_of(c);
  std::vector<DiskSpec> disks;
  for (std::size_t i = 0; i < c.inputs().at("x").size(); ++i) {
    const auto at = [&](const char* key) { return Case::number(c.inputs().at(key).at(i)); };
    disks.push_back(
        test::disk(i + 1, {at("x"), at("y")}, {at("v"), 0}, c.number("r"), c.number("m")));
  }
  test::must_spawn(world, disks);
  EXPECT_EQ(test::run_for(world, 100).size(), c.expected().at("collisions").get<std::size_t>());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    expect_vector(
        c, velocity_of(world, i + 1), {Case::real(c.expected().at("v_final").at(i)), Real(0)}, 0);
  }
  return "";
}

std::string run_box_long_run(const Case& c) {
  World world = world_of(c);
  test::must_spawn(world,
                   {test::disk(1, c.vector("p"), c.vector("v"), c.number("r"))},
                   test::box(2, {0, 0}, c.vector("L")));
  EXPECT_TRUE(world.advance_to(test::seconds(c.number("T"))).ok());
  EXPECT_EQ(world.counters().collisions, c.expected().at("wall_hits").get<std::uint64_t>());
  const Vector2 found = test::state(world, 1).position;
  const Real2 truth = Case::real2(c.expected().at("p_final"));
  EXPECT_LE(norm({Real(found.x()) - truth.x, Real(found.y()) - truth.y}),
            Real(c.tolerance("p_abs", 0)));
  return "";
}

std::string run_simultaneous_nonunique(const Case& c) {
  World world = world_of(c);
  std::vector<DiskSpec> disks;
  for (std::size_t i = 0; i < c.inputs().at("p").size(); ++i) {
    disks.push_back(test::disk(i + 1,
                               Case::vector(c.inputs().at("p").at(i)),
                               Case::vector(c.inputs().at("v").at(i)),
                               c.number("r"),
                               c.number("m")));
  }
  test::must_spawn(world, disks);
  const auto log = test::run_for(world, 5);
  EXPECT_GE(log.size(), 2U);
  for (const Collision& collision : log) {
    expect_time(c, {}, collision.instant);
    EXPECT_TRUE(collision.order_dependent);
  }
  const engine::Conserved sums = world.conserved();
  const json& invariants = c.expected().at("invariants");
  const Real2 momentum = Case::real2(invariants.at("momentum"));
  expect_vector(c, {Real(sums.momentum.x()), Real(sums.momentum.y())}, momentum, 0);
  EXPECT_LE(abs(Real(sums.kinetic_energy) - Case::real(invariants.at("kinetic_energy"))),
            Real(1e-15));
  // One of the policies, wholly.
  const auto follows = [&](const json& policy) {
    for (std::size_t i = 0; i < disks.size(); ++i) {
      const Real2 v = velocity_of(world, i + 1);
      const Real2 truth = Case::real2(policy.at("v").at(i));
      if (norm({v.x - truth.x, v.y - truth.y}) > Real(c.tolerance("v_rel", 0))) return false;
    }
    return true;
  };
  const json& accepted = c.expected().at("accepted");
  EXPECT_EQ(std::count_if(accepted.begin(), accepted.end(), follows), 1);
  return "";
}

std::string run_tie_order(const Case& c) {
  const auto disks = disks_of(c.inputs().at("disks"));
  auto backwards = disks;
  std::reverse(backwards.begin(), backwards.end());
  for (const auto& order : {disks, backwards}) {
    World world = world_of(c);
    test::must_spawn(world, order);
    const auto log = test::run_for(world, 2.5);
    const json& pairs = c.expected().at("order");
    EXPECT_EQ(log.size(), pairs.size());
    for (std::size_t i = 0; i < log.size() && i < pairs.size(); ++i) {
      EXPECT_EQ(Real(0) + seconds_from({}, log[i].instant), Case::real(c.expected().at("t")));
      EXPECT_EQ(log[i].a, pairs.at(i).at(0).get<Id>() + 1);
      EXPECT_EQ(log[i].b, pairs.at(i).at(1).get<Id>() + 1);
    }
  }
  return "";
}

std::string run_repeated_rule(const Case& c) {
  World world = world_of(c);
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {c.number("V0"), 0}, 0.5, c.number("M")),
                    test::disk(2, {1, 0}, {c.number("u"), 0}, 0.5, c.number("m"))});
  const auto hits = static_cast<std::uint64_t>(c.number("n"));
  const engine::VectorFor again{2, {c.number("u"), 0}};
  for (std::uint64_t i = 0; i < hits; ++i) {
    EXPECT_TRUE(world.set_velocity(std::span(&again, 1)).ok());
    EXPECT_TRUE(world.advance_to(world.now()).ok());
  }
  EXPECT_EQ(world.counters().collisions, hits);
  const Real change = velocity_of(world, 1).x - Real(c.number("V0"));
  const Real truth = Case::real(c.expected().at("dV"));
  EXPECT_LE(abs(change / truth - 1), Real(c.tolerance("dV_rel", 0)));
  return "";
}

std::string run_scene_events(const Case& c) {
  const auto disks = disks_of(c.inputs().at("disks"));
  World world = world_of(c);
  test::must_spawn(world, disks, test::box(101, {0, 0}, c.vector("box")));
  std::map<std::string, Id> ids = {
      {"wall_y-", 101}, {"wall_x+", 102}, {"wall_y+", 103}, {"wall_x-", 104}};
  for (const DiskSpec& d : disks) ids["disk" + std::to_string(d.id - 1)] = d.id;

  const json& expected = c.expected();
  // The last event is at the final time itself; a little more covers its tolerance.
  const double final_time = Case::real(expected.at("final_time")).convert_to<double>();
  const auto end = *engine::offset_by({}, final_time + c.tolerance("t_abs", 0));
  const auto log = test::run_until(world, end);
  const json& events = expected.at("events");
  EXPECT_EQ(log.size(), events.size());
  for (std::size_t i = 0; i < log.size() && i < events.size(); ++i) {
    const Real off = seconds_from({}, log[i].instant) - Case::real(events.at(i).at("t"));
    EXPECT_LE(abs(off), Real(c.tolerance("t_abs", 0))) << "event " << i;
    const Id a = ids.at(events.at(i).at("a").get<std::string>());
    const Id b = ids.at(events.at(i).at("b").get<std::string>());
    EXPECT_EQ(log[i].a, std::min(a, b)) << "event " << i;
    EXPECT_EQ(log[i].b, std::max(a, b)) << "event " << i;
  }
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const engine::BodyState state = test::state(world, disks[i].id);
    const auto off = [](const Vector2& value, const Real2& truth) {
      return norm({Real(value.x()) - truth.x, Real(value.y()) - truth.y});
    };
    const Real allowed(c.tolerance("p_abs", 0));
    EXPECT_LE(off(state.position, Case::real2(expected.at("p_final").at(i))), allowed);
    EXPECT_LE(off(state.velocity, Case::real2(expected.at("v_final").at(i))), allowed);
  }
  return "";
}

std::string run_invalid_input(const Case& c) {
  World world = world_of(c);
  test::must_spawn(world, {test::disk(1, {50, 50}, {1, 0}, 1)});
  const auto before = test::fingerprint(world);
  const DiskSpec bad = test::disk(2, c.vector("p"), c.vector("v"), c.number("r"), c.number("m"));
  const auto outcome = world.spawn({std::span(&bad, 1), {}});
  EXPECT_EQ(!outcome.ok(), c.expected().at("rejected").get<bool>());
  if (outcome.ok()) return "";
  EXPECT_EQ(outcome.reject().code, Code::InvalidArgument);
  EXPECT_EQ(outcome.reject().body, 2U);
  EXPECT_EQ(test::fingerprint(world), before);
  return "";
}

}  // namespace stoss::hard_cases

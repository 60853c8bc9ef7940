// SPDX-License-Identifier: Apache-2.0
// Commands that are obeyed: ids, kinds, velocities, impulses, removal, turning, budgets, and worlds
// in every arithmetic.

#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <string>
#include <utility>
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

class EveryArithmetic : public testing::TestWithParam<Arithmetic> {
 protected:
  World empty() const { return World(WorldOptions{.start = {}, .arithmetic = GetParam()}); }
};

std::string name_of(const testing::TestParamInfo<Arithmetic>& tested) {
  if (tested.param == Arithmetic::Float) return "Float";
  return tested.param == Arithmetic::Double ? "Double" : "LongDouble";
}

INSTANTIATE_TEST_SUITE_P(Commands,
                         EveryArithmetic,
                         testing::Values(Arithmetic::Float,
                                         Arithmetic::Double,
                                         Arithmetic::LongDouble),
                         name_of);

TEST(Commands, IdsAreAssignedUpwardsDisksFirstAfterEveryExplicitOne) {
  World world;
  const std::vector<DiskSpec> disks = {
      disk(kNoId, {0, 0}, {0, 0}, 1), disk(9, {5, 0}, {0, 0}, 1), disk(kNoId, {10, 0}, {0, 0}, 1)};
  const std::vector<WallSpec> walls = {wall(4, {0, 5}, {1, 5}), wall(kNoId, {0, 6}, {1, 6})};
  EXPECT_EQ(must_spawn(world, disks, walls), (std::vector<Id>{10, 9, 11, 4, 12}));
  EXPECT_EQ(world.ids(), (std::vector<Id>{4, 9, 10, 11, 12}));
  // A number below the highest that was never used may still be asked for.
  EXPECT_EQ(must_spawn(world, {disk(7, {0, 20}, {0, 0}, 1)}), (std::vector<Id>{7}));
  EXPECT_EQ(must_spawn(world, {disk(kNoId, {0, 30}, {0, 0}, 1)}), (std::vector<Id>{13}));
}

TEST(Commands, IdsAreNeverUsedAgain) {
  World world;
  for (Id expected = 1; expected <= 20; ++expected) {
    EXPECT_EQ(must_spawn(world, {disk(kNoId, {0, 0}, {0, 0}, 1)}), (std::vector<Id>{expected}));
    EXPECT_TRUE(world.remove(std::span(&expected, 1)).ok());
    EXPECT_FALSE(world.contains(expected));
  }
  World again = World::deserialise(world.serialise()).value();
  for (World* w : {&world, &again}) {
    const DiskSpec old = disk(13, {0, 0}, {0, 0}, 1);
    EXPECT_EQ(w->spawn({std::span(&old, 1), {}}).reject().code, Code::AlreadyExists);
    EXPECT_EQ(must_spawn(*w, {disk(kNoId, {0, 0}, {0, 0}, 1)}), (std::vector<Id>{21}));
  }
}

TEST(Commands, AnEmptySpawnIsNothing) {
  World world;
  const auto before = test::fingerprint(world);
  EXPECT_TRUE(world.spawn({}).ok());
  EXPECT_EQ(test::fingerprint(world), before);
}

TEST(Commands, SpawningRemovingAndSettingTakeEffectNow) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {1, 2}, 1)});
  run_until(world, seconds(3));
  const VectorFor velocity{1, {-1, 0}};
  ASSERT_TRUE(world.set_velocity(std::span(&velocity, 1)).ok());
  const MotionRecord motion = world.motion(1).value();
  EXPECT_EQ(motion.since, seconds(3));
  EXPECT_EQ(motion.x.high, 3);
  EXPECT_EQ(motion.y.high, 6);
  EXPECT_EQ(motion.vx.high, -1);
  run_until(world, seconds(4));
  EXPECT_EQ(state(world, 1).position, Vector2(2, 6));
}

TEST(Commands, ARemovedBodyIsInNobodysWay) {
  World world;
  must_spawn(
      world,
      {disk(1, {0, 0}, {1, 0}, 0.5), disk(2, {5, 0}, {0, 0}, 0.5), disk(3, {10, 0}, {0, 0}, 0.5)});
  const Id ids[] = {2};
  ASSERT_TRUE(world.remove(ids).ok());
  const auto log = run_until(world, seconds(20));
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, seconds(9));
  EXPECT_EQ(log[0].b, 3U);
}

TEST(Commands, ASpawnedBodyIsMet) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {1, 0}, 0.5), disk(3, {10, 0}, {0, 0}, 0.5)});
  run_until(world, seconds(2));
  const std::vector<WallSpec> walls = {wall(2, {6, -1}, {6, 1})};
  must_spawn(world, {}, walls);
  const auto log = run_until(world, seconds(20));
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, seconds(5.5));
  EXPECT_EQ(log[0].kind, ContactKind::DiskWall);
  EXPECT_EQ(log[0].b, 2U);
}

TEST_P(EveryArithmetic, KinematicDisksAndWallsPushAndAreNotPushed) {
  World world = empty();
  const std::vector<DiskSpec> disks = {disk(1, {0, 0}, {0, 0}, 0.5),
                                       test::kinematic_disk(2, {-4, 0}, {1, 0}, 0.5),
                                       test::static_disk(3, {0, 50}, 1)};
  const std::vector<WallSpec> walls = {wall(4, {20, -5}, {20, 5}, {-1, 0})};
  must_spawn(world, disks, walls);
  const auto log = run_until(world, seconds(8.75));
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log[0].instant, seconds(3));
  EXPECT_EQ(log[0].velocity_a, Vector2(2, 0));  // 2 V
  EXPECT_EQ(log[0].velocity_b, Vector2(1, 0));
  EXPECT_EQ(log[0].impulse, 2);
  EXPECT_EQ(log[0].approach_speed, 1);
  EXPECT_EQ(log[1].kind, ContactKind::DiskWall);
  EXPECT_EQ(log[1].velocity_a, Vector2(-4, 0));  // 2 V - v
  EXPECT_EQ(log[1].velocity_b, Vector2(-1, 0));
  EXPECT_EQ(world.motion(2).value().since, Instant{});  // nothing of theirs was written
  EXPECT_EQ(world.motion(4).value().since, Instant{});
}

TEST_P(EveryArithmetic, AnImpulseAddsItsShareOfTheMass) {
  World world = empty();
  must_spawn(world, {disk(1, {0, 0}, {1, 0}, 0.5, 4)});
  const VectorFor impulse{1, {2, -8}};
  ASSERT_TRUE(world.apply_impulse(std::span(&impulse, 1)).ok());
  EXPECT_EQ(state(world, 1).velocity, Vector2(1.5, -2));
  EXPECT_EQ(world.conserved().momentum, Vector2(6, -8));
  EXPECT_EQ(world.conserved().kinetic_energy, 0.5 * 4 * (1.5 * 1.5 + 4));
}

TEST(Commands, ABatchOfVelocitiesActsAtOnce) {
  // Set one after the other, the first disk would see the second still coming.
  World world;
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 0.5), disk(2, {1, 0}, {0, 0}, 0.5)});
  const VectorFor velocities[] = {{1, {1, 0}}, {2, {1, 0}}};
  ASSERT_TRUE(world.set_velocity(velocities).ok());
  EXPECT_TRUE(run_for(world, 10).empty());
}

TEST(Commands, EventsAtAnInstantComeBeforeTheNextCommandAtIt) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {1, 0}, 0.5), disk(2, {3, 0}, {0, 0}, 0.5)});
  run_until(world, seconds(2));  // the contact is at 2 s, and is over
  EXPECT_EQ(state(world, 1).velocity, Vector2(0, 0));
  EXPECT_EQ(state(world, 2).velocity, Vector2(1, 0));
  // A command that makes a contact now: it happens when the world is advanced to now.
  const VectorFor velocity{1, {5, 0}};
  ASSERT_TRUE(world.set_velocity(std::span(&velocity, 1)).ok());
  EXPECT_EQ(run_until(world, seconds(2)).size(), 1U);
  EXPECT_EQ(state(world, 2).velocity, Vector2(5, 0));
}

TEST(Commands, TurningIsCarriedThroughContactsAndEvaluatedExactly) {
  World world;
  DiskSpec turning = disk(1, {0, 0}, {1, 0}, 0.5);
  turning.angle = 0.25;
  turning.spin = -2;
  const std::vector<DiskSpec> disks = {turning, disk(2, {3, 0}, {0, 0}, 0.5)};
  must_spawn(world, disks);
  run_until(world, seconds(1));
  EXPECT_EQ(state(world, 1).angle, -1.75);
  const auto log = run_until(world, seconds(4));
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].spin_a, -2);  // frictionless: as before
  EXPECT_EQ(log[0].spin_b, 0);
  EXPECT_EQ(state(world, 1).angle, 0.25 - 8);
  EXPECT_EQ(state(world, 1).spin, -2);
  EXPECT_EQ(world.motion(1).value().angle, 0.25 - 4);  // at the contact, 2 s
  EXPECT_EQ(world.motion(1).value().since, seconds(2));
  EXPECT_EQ(state(world, 2).spin, 0);
}

TEST(Commands, TurningChangesNoTrajectory) {
  const auto run = [](double spin) {
    World world;
    DiskSpec turning = disk(1, {0, 0.125}, {1, 0}, 0.5);
    turning.spin = spin;
    const auto walls = test::box(10, {-5, -5}, {5, 5});
    const std::vector<DiskSpec> disks = {turning, disk(2, {3, 0}, {0, 0.5}, 0.5)};
    must_spawn(world, disks, walls);
    auto log = run_until(world, seconds(100));
    for (Collision& c : log) c.spin_a = c.spin_b = 0;
    return log;
  };
  EXPECT_EQ(test::difference(run(0), run(17)), "");
}

TEST(Commands, AnAdvanceStopsAtItsBudgetAndGoesOnFromThere) {
  const auto make = [] {
    World world;
    const auto walls = test::box(10, {-5, -5}, {5, 5});
    const std::vector<DiskSpec> disks = {disk(1, {0, 0}, {3, 1}, 0.5),
                                         disk(2, {3, 0}, {1, 2}, 0.5)};
    must_spawn(world, disks, walls);
    return world;
  };
  World whole = make();
  World stepped = make();
  test::Log log;
  std::uint64_t events = 0;
  for (;;) {
    const AdvanceReport report = stepped.advance_to(seconds(30), &log, 1).value();
    EXPECT_LE(report.events, 1U);
    events += report.events;
    if (report.stop == Stop::Reached) break;
    EXPECT_EQ(report.stop, Stop::EventBudget);
    ASSERT_LT(events, 100000U);
  }
  EXPECT_EQ(stepped.now(), seconds(30));
  EXPECT_EQ(test::difference(run_until(whole, seconds(30)), log.collisions), "");
  EXPECT_EQ(test::fingerprint(whole), test::fingerprint(stepped));
}

TEST(Commands, AWorldIsAValue) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {1, 0}, 0.5)});
  World fork = world;
  const Id ids[] = {1};
  ASSERT_TRUE(fork.remove(ids).ok());
  EXPECT_TRUE(world.contains(1));
  world = fork;
  EXPECT_FALSE(world.contains(1));
  World moved = std::move(fork);
  EXPECT_EQ(moved.disk_count(), 0U);
}

TEST_P(EveryArithmetic, OneScriptRunsInEveryArithmetic) {
  World world = empty();
  EXPECT_EQ(world.arithmetic(), GetParam());
  const auto walls = test::box(10, {-5, -5}, {5, 5});
  const std::vector<DiskSpec> disks = {disk(1, {0.1, 0}, {3, 1}, 0.5),
                                       disk(2, {3, 0.1}, {1, 2}, 0.25)};
  must_spawn(world, disks, walls);
  const double energy = world.conserved().kinetic_energy;
  const auto first = run_until(world, seconds(5));
  EXPECT_FALSE(first.empty());
  const World copy = World::deserialise(world.serialise()).value();
  EXPECT_EQ(copy.arithmetic(), GetParam());
  EXPECT_EQ(test::fingerprint(copy), test::fingerprint(world));
  run_until(world, seconds(20));
  const double eps = GetParam() == Arithmetic::Float ? 1e-6 : 1e-14;
  EXPECT_NEAR(world.conserved().kinetic_energy / energy, 1, eps);
}

TEST(Commands, ArithmeticsAgreeUntilChaosParts) {
  const auto run = [](Arithmetic arithmetic) {
    World world(WorldOptions{.start = {}, .arithmetic = arithmetic});
    const auto walls = test::box(10, {-5, -5}, {5, 5});
    const std::vector<DiskSpec> disks = {disk(1, {0.1, 0}, {3, 1}, 0.5),
                                         disk(2, {3, 0.1}, {1, 2}, 0.25),
                                         disk(3, {-3, 0.1}, {1, -2}, 0.75)};
    must_spawn(world, disks, walls);
    run_until(world, seconds(4));
    return world;
  };
  const World in_double = run(Arithmetic::Double);
  for (const auto& [arithmetic, tolerance] :
       {std::pair{Arithmetic::Float, 1e-4}, std::pair{Arithmetic::LongDouble, 1e-12}}) {
    const World other = run(arithmetic);
    EXPECT_EQ(other.counters().collisions, in_double.counters().collisions);
    for (const Id id : {Id{1}, Id{2}, Id{3}}) {
      EXPECT_LT((state(other, id).position - state(in_double, id).position).norm(), tolerance);
    }
  }
}

}  // namespace
}  // namespace stoss::engine

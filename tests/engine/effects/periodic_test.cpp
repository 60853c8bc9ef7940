// SPDX-License-Identifier: Apache-2.0
// Periodic worlds: images meet as bodies in open space do, nothing is lost at a border or a corner,
// walls close around the world without a seam, and one story whatever the circumstances.
#include "engine/effects/periodic_reference.hpp"
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace stoss::engine {
namespace {

using test::run_for;

WorldOptions with_period(const Vector2& period, BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.period = period;
  options.broad_phase = kind;
  return options;
}

/// `columns`^2 disks of three sizes and two masses on a lattice over the cell [0, side)^2.
std::vector<DiskSpec> lattice(int columns, double side, std::uint64_t seed) {
  test::Random random(seed);
  const double pitch = side / columns;
  std::vector<DiskSpec> disks;
  for (int i = 0; i < columns * columns; ++i) {
    disks.push_back(test::disk(static_cast<Id>(i + 1),
                               pitch * Vector2(i % columns, i / columns),
                               {random.uniform(-1, 1), random.uniform(-1, 1)},
                               pitch * (0.25 + 0.1 * (i % 3)),
                               1 + i % 2));
  }
  return disks;
}

World gas(const WorldOptions& options, int columns = 7) {
  World world(options);
  test::must_spawn(world, lattice(columns, 10, 5));
  return world;
}

void expect_sound(const World& world) {
  const Census census = world.census();
  EXPECT_EQ(census.overlaps, 0U);
  EXPECT_EQ(census.missed, 0U);
  EXPECT_LT(census.deepest, 1e-13);
  EXPECT_GT(census.pairs, 0U);
}

// -- Images are bodies

/// Two disks, the second of which is met across the border or, in open space, a period away.
std::vector<Collision> meet(const WorldOptions& options, const Vector2& away) {
  World world(options);
  test::must_spawn(world,
                   {test::disk(1, {9.25, 0.5}, {1.5, 0.125}, 0.5, 2),
                    test::disk(2, Vector2(1.375, 9.875) + away, {-0.75, 0.25}, 0.375, 3)});
  return run_for(world, 1);
}

TEST(PeriodicWorld, AMeetingAcrossTheBorderIsThatInOpenSpaceToTheBit) {
  auto across = meet(with_period({10, 10}), {0, 0});
  const auto open = meet({}, {10, -10});
  ASSERT_EQ(across.size(), 1U);
  EXPECT_NEAR(across[0].point.x(), open[0].point.x() - 10, 2e-15);
  EXPECT_EQ(across[0].point.y(), open[0].point.y());
  across[0].point = open[0].point;
  EXPECT_EQ(test::difference(across, open), "");
}

TEST(PeriodicWorld, OfManyPeriodsTheRightImagesMeet) {
  // They fly side by side, though their own motions are two thousand million periods apart.
  World world(with_period({1, 0}));
  const double far = 0x1p30;
  test::must_spawn(world,
                   {test::disk(1, {far + 0.25, 0}, {1'024, 0}, 0.125),
                    test::disk(2, {0.75 - far, 0}, {1'023.75, 0}, 0.125)});
  const auto log = run_for(world, 1);
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].instant, test::seconds(1));
  EXPECT_EQ(log[0].normal, Vector2(1, 0));
  EXPECT_EQ(log[0].point, Vector2(0.375, 0));
  EXPECT_EQ(test::state(world, 1).position, Vector2(0.25, 0));
  EXPECT_EQ(test::state(world, 2).position, Vector2(0.5, 0));
}

TEST(PeriodicWorld, ThatIsLargerThanItsGasIsOpenSpaceToTheBit) {
  const auto play = [](const WorldOptions& options) {
    World world(options);
    std::vector<DiskSpec> disks = lattice(6, 10, 3);
    for (DiskSpec& d : disks) d.position += Vector2(4, 4);
    test::must_spawn(world, disks, test::box(1'000, {2, 2}, {15, 15}));
    return run_for(world, 60);
  };
  const auto open = play({});
  EXPECT_GT(open.size(), 1'000U);
  EXPECT_EQ(test::difference(play(with_period({1'000, 1'000})), open), "");
  // Walls around the border: the images are there, but out of sight.
  EXPECT_EQ(test::difference(play(with_period({20, 0})), open), "");
}

TEST(PeriodicWorld, AGasIsThatOfABruteForceRunWithNineImages) {
  const std::vector<DiskSpec> disks = lattice(4, 10, 9);
  World world(with_period({10, 10}));
  test::must_spawn(world, disks);
  test::BruteForceGas reference(disks, {10, 10});
  const auto log = run_for(world, 30);
  ASSERT_GT(log.size(), 120U);
  const double period = 10;
  for (std::size_t i = 0; i < 120; ++i) {
    const auto hit = reference.next();
    ASSERT_EQ(log[i].a, hit.a) << i;
    ASSERT_EQ(log[i].b, hit.b) << i;
    EXPECT_NEAR(seconds_between({}, log[i].instant), hit.at.convert_to<double>(), 1e-9) << i;
    const Vector2 off =
        log[i].point - Vector2(hit.point.x.convert_to<double>(), hit.point.y.convert_to<double>());
    EXPECT_LT(std::abs(std::remainder(off.x(), period)), 1e-9) << i;
    EXPECT_LT(std::abs(std::remainder(off.y(), period)), 1e-9) << i;
  }
}

// -- What is shown

TEST(PeriodicWorld, ShowsEveryBodyInTheCellAndNeverRewritesItThere) {
  World world(with_period({1, 2}));
  test::must_spawn(world, {test::disk(1, {0.5, 0.5}, {-0.75, 1}, 0.1)});
  const auto before = world.serialise();
  for (int i = 1; i <= 400; ++i) {  // through the corner every 8 s
    ASSERT_TRUE(world.advance_to(test::seconds(0.25 * i)).ok());
    const Vector2 shown = test::state(world, 1).position;
    const double x = 0.5 - 0.1875 * i;
    const double y = 0.5 + 0.25 * i;
    EXPECT_EQ(shown, Vector2(x - std::floor(x), y - 2 * std::floor(y / 2)));
    EXPECT_EQ(evaluate(world.motion(1).value(), Arithmetic::Double, world.now(), world.period()),
              shown);
  }
  EXPECT_EQ(test::exact_position(world, 1).x.hi, 0.5 - 75);
  World again = World::deserialise(before).value();
  EXPECT_EQ(again.state_hash(), world.state_hash());
}

TEST(PeriodicWorld, WhatRoundsUpToThePeriodIsShownAtZero) {
  World world(with_period({1, 0}));
  test::must_spawn(world,
                   {test::disk(1, {-0x1p-80, 0}, {0, 0}, 0.1)},
                   std::vector<WallSpec>{test::wall(2, {-0x1p-80, 1}, {0.5, 1})});
  EXPECT_EQ(test::state(world, 1).position.x(), 0);
  EXPECT_EQ(world.wall(2).value().start.x(), 0);
  EXPECT_EQ(world.wall(2).value().end.x(), 0.5);
}

// -- Walls

TEST(PeriodicWorld, AWallAcrossTheBorderStandsOnBothSides) {
  World world(with_period({10, 0}));
  test::must_spawn(world,
                   {test::disk(1, {1, 2}, {0, -1}, 0.5), test::disk(2, {9, 2}, {0, -1}, 0.5)},
                   std::vector<WallSpec>{test::wall(3, {8, 0}, {12, 0})});
  const auto log = run_for(world, 2);
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log[0].kind, ContactKind::DiskWall);
  EXPECT_EQ(log[1].kind, ContactKind::DiskWall);
  EXPECT_EQ(log[0].instant, test::seconds(1.5));
  EXPECT_EQ(log[1].instant, test::seconds(1.5));
  EXPECT_EQ(log[0].point, Vector2(1, 0));
  EXPECT_EQ(log[1].point, Vector2(9, 0));
}

TEST(PeriodicWorld, AWallAroundTheWorldHasNoSeam) {
  for (const BroadPhaseKind kind : {BroadPhaseKind::Neighbours, BroadPhaseKind::AllPairs}) {
    World world(with_period({4, 0}, kind));
    const WallSpec walls[] = {test::wall(8, {1, 0}, {5, 0}), test::wall(9, {7, 3}, {3, 3})};
    test::must_spawn(world, {test::disk(1, {0.75, 1}, {0.25, -0.5}, 0.5)}, walls);
    // It meets the floor exactly at the joint, and the walls for ever after on faces.
    const auto log = run_for(world, 2'000);
    ASSERT_EQ(log.size(), 500U);
    EXPECT_EQ(log[0].point, Vector2(1, 0));
    for (std::size_t i = 0; i < log.size(); ++i) {
      EXPECT_EQ(log[i].velocity_a, Vector2(0.25, i % 2 == 0 ? 0.5 : -0.5));
      EXPECT_EQ(log[i].instant, test::seconds(1 + 4.0 * static_cast<double>(i)));
    }
    ASSERT_TRUE(world.set_velocity(std::vector<VectorFor>{{8, {0.75, 0}}}).ok());
    EXPECT_EQ(run_for(world, 100).size(), 25U);
    EXPECT_EQ(test::state(world, 1).velocity, Vector2(0.25, 0.5));
    ASSERT_TRUE(world.remove(std::vector<Id>{8}).ok());
    EXPECT_EQ(run_for(world, 100).size(), 1U);  // the ceiling
  }
}

TEST(PeriodicWorld, ADiskMeetsAWallAndItsImageInTurn) {
  World world(with_period({0, 4}));
  test::must_spawn(world,
                   {test::disk(1, {0, 2}, {0, 1}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-1, 0}, {1, 0})});
  const auto log = run_for(world, 30);
  ASSERT_EQ(log.size(), 10U);
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_EQ(log[i].instant, test::seconds(1.5 + 3.0 * static_cast<double>(i)));
    EXPECT_EQ(log[i].normal, Vector2(0, i % 2 == 0 ? 1 : -1));
    EXPECT_EQ(log[i].point, Vector2(0, 0));
  }
}

TEST(PeriodicWorld, AMovingWallSweepsThroughTheWorldAgainAndAgain) {
  World world(with_period({10, 0}));
  test::must_spawn(world,
                   {test::disk(1, {5, 0}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {1, -1}, {1, 1}, {1, 0})});
  const auto log = run_for(world, 100);
  // Hit at 3.5 s, the disk flies off at 2 m/s, around the world, and comes up behind the wall after
  // it has gained a period less its own diameter.
  ASSERT_GE(log.size(), 2U);
  EXPECT_EQ(log[0].instant, test::seconds(3.5));
  EXPECT_EQ(log[0].velocity_a, Vector2(2, 0));
  EXPECT_EQ(log[1].instant, test::seconds(12.5));
  EXPECT_EQ(log[1].velocity_a, Vector2(0, 0));
  EXPECT_EQ(log[2].instant, test::seconds(21.5));
}

// -- Conservation and stories

TEST(PeriodicWorld, KeepsMomentumAndEnergyAsOpenSpaceDoes) {
  World world = gas(with_period({10, 10}));
  const Conserved before = world.conserved();
  EXPECT_GT(run_for(world, 60).size(), 2'000U);
  const Conserved after = world.conserved();
  EXPECT_NEAR(after.kinetic_energy, before.kinetic_energy, 1e-15 * before.kinetic_energy);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-15 * before.momentum.norm() + 1e-15);
  expect_sound(world);
}

TEST(PeriodicWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  const auto both = [](BroadPhaseKind kind) { return gas(with_period({10, 10}, kind)); };
  EXPECT_EQ(test::expect_one_story(both, 8, 230, 4).period(), Vector2(10, 10));
  const auto channel = [](BroadPhaseKind kind) {
    World world = gas(with_period({10, 0}, kind));
    const WallSpec walls[] = {test::wall(901, {0, -2}, {10, -2}),
                              test::wall(902, {10, 12}, {0, 11}),
                              test::wall(903, {10, 11}, {10, 12}),
                              test::wall(904, {8, -1.5}, {13, -1.2}, {0.25, 0})};
    test::must_spawn(world, {}, walls);
    return world;
  };
  const World after = test::expect_one_story(channel, 8, 230, 4);
  expect_sound(after);
}

TEST(PeriodicWorld, WithOtherEffectsTellsOneStory) {
  const auto with = [](const Effects& effects) {
    return [effects](BroadPhaseKind kind) {
      WorldOptions options = with_period({10, 10}, kind);
      options.effects = effects;
      return gas(options);
    };
  };
  Effects rough;
  rough.restitution = Restitution{0.9, 0.8, 1e-4, 0};
  rough.rough = Rough{0.3, 0.4};
  expect_sound(test::expect_one_story(with(rough), 6, 150, 3));
  Effects floor;
  floor.floor_friction = FloorFriction{0.1};
  expect_sound(test::expect_one_story(with(floor), 4, 150, 3));
  Effects falling;
  falling.gravity = Gravity{{0.3, -2}};
  expect_sound(test::expect_one_story(with(falling), 4, 150, 3));
  Effects kicked;
  kicked.thermostat = Thermostat{0.3, 0.5, 7};
  expect_sound(test::expect_one_story(with(kicked), 4, 150, 3));
  Effects dragged;
  dragged.drag = Drag{0.2};
  dragged.gravity = Gravity{{0.1, 0}};
  expect_sound(test::expect_one_story(with(dragged), 4, 150, 3));
  Effects growing;
  growing.growth = Growth{0.01};
  expect_sound(test::expect_one_story(with(growing), 4, 150, 3));
}

TEST(PeriodicWorld, ADiskGrowsUntilItIsAboutToTouchItself) {
  WorldOptions options = with_period({2, 0});
  options.effects.growth = Growth{0.125};
  World world(options);
  test::must_spawn(world, {test::disk(1, {0, 0}, {0.5, 0}, 0.5)});
  const auto report = world.advance_to(test::seconds(10));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.value().stop, Stop::Stalled);
  EXPECT_EQ(report.value().stalled, 1U);
  EXPECT_LT(test::state(world, 1).radius, 1);
  EXPECT_GT(test::state(world, 1).radius, 0.99);
}

TEST(PeriodicWorld, SwitchesItsEffectsAndKeepsItsPeriods) {
  const auto play = [](BroadPhaseKind kind) {
    World world = gas(with_period({10, 10}, kind));
    run_for(world, 3);
    Effects effects;
    effects.gravity = Gravity{{0, -1}};
    effects.restitution = Restitution{0.9, 0.9, 1e-3, 0};
    EXPECT_TRUE(world.set_effects(effects).ok());
    run_for(world, 1);
    EXPECT_TRUE(world.set_effects({}).ok());
    EXPECT_EQ(world.period(), Vector2(10, 10));
    EXPECT_GT(run_for(world, 2).size(), 50U);
    expect_sound(world);
    return world.serialise();
  };
  EXPECT_EQ(play(BroadPhaseKind::Neighbours), play(BroadPhaseKind::AllPairs));
}

TEST(PeriodicWorld, IsAsOldAsItLikes) {
  const auto play = [](std::int64_t start) {
    WorldOptions options = with_period({10, 10});
    options.start = {start, 0};
    World world = gas(options);
    return test::earlier_by(run_for(world, 20), start);
  };
  EXPECT_EQ(test::difference(play(std::int64_t{1} << 40), play(0)), "");
}

// -- Gravity and rest

TEST(PeriodicWorld, ADiskRollsDownAFloorAroundTheWorldAndMeetsNoSeam) {
  World world = [] {
    WorldOptions options = with_period({4, 0});
    options.effects.gravity = Gravity{{0, -10}};
    options.effects.restitution = Restitution{0, 0, 0, 0};
    return World(options);
  }();
  test::must_spawn(world,
                   {test::disk(1, {0.5, 1}, {0.5, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {1, 0}, {5, 0})});
  run_for(world, 1'000);
  const BodyState end = test::state(world, 1);
  EXPECT_NEAR(end.velocity.x(), 0.5, 1e-12);
  EXPECT_NEAR(end.position.y(), 0.5, 1e-12);
  EXPECT_NEAR(end.position.x(), 0.5, 1e-8);
  EXPECT_LT(world.counters().collisions, 1'000U);
}

TEST(PeriodicWorld, DisksComeToRestInASawtoothAcrossTheBorder) {
  const auto make = [](BroadPhaseKind kind) {
    WorldOptions options = with_period({4, 0}, kind);
    options.effects.gravity = Gravity{{0, -10}};
    options.effects.restitution = Restitution{0.5, 0.5, 0, 1e-3};
    World world(options);
    const Vector2 teeth[] = {{3, 1}, {4, 0}, {5.5, 1}, {6, 0}, {7, 1}};
    test::must_spawn(world,
                     {test::disk(1, {3.5, 2}, {0.1, 0}, 0.25), test::disk(2, {2, 3}, {0, 0}, 0.2)},
                     test::chain(11, teeth));
    return world;
  };
  World world = test::expect_one_story(make, 5, 77, 40);
  EXPECT_EQ(run_for(world, 1'000).size(), 0U);
  expect_sound(world);
}

// -- Refusals

TEST(PeriodicWorld, RefusesPeriodsThatAreNone) {
  for (const double bad : {-1.0, std::nan(""), double{INFINITY}, 1e-30, 1e30}) {
    EXPECT_EQ(check_period({bad, 1}).value().field, "period.x");
    EXPECT_EQ(check_period({1, bad}).value().field, "period.y");
    EXPECT_THROW(World(with_period({bad, 1})), std::invalid_argument);
  }
  EXPECT_FALSE(check_period({0, 5}).has_value());
}

TEST(PeriodicWorld, RefusesWhatHasNoPlaceAmongItsImages) {
  World world(with_period({10, 0}));
  const auto refusal = [&](const DiskSpec& d) {
    const auto before = test::fingerprint(world);
    const auto outcome = world.spawn({std::span(&d, 1), {}});
    EXPECT_FALSE(outcome.ok());
    EXPECT_EQ(test::fingerprint(world), before);
    return outcome.ok() ? Reject{} : outcome.reject();
  };
  EXPECT_EQ(refusal(test::disk(1, {0, 0}, {0, 0}, 5)).field, "disks[0].radius");
  EXPECT_EQ(refusal(test::disk(1, {1e20, 0}, {0, 0}, 1)).field, "disks[0].position");
  EXPECT_EQ(refusal(test::disk(1, {0, 0}, {1e20, 0}, 1)).field, "disks[0].velocity");
  test::must_spawn(world, {test::disk(1, {0.5, 0}, {0, 0}, 1)});
  const Reject overlap = refusal(test::disk(2, {9.5, 0.5}, {0, 0}, 0.5));
  EXPECT_EQ(overlap.code, Code::Overlap);
  EXPECT_EQ(overlap.other, 1U);
  EXPECT_NEAR(overlap.clearance, std::hypot(1, 0.5) - 1.5, 1e-15);
  const WallSpec endless = test::wall(3, {0, 5}, {1e6, 5});
  EXPECT_EQ(world.spawn({{}, std::span(&endless, 1)}).reject().field, "walls[0].end");
  test::must_spawn(world, {test::disk(4, {-500, 100}, {0, 0}, 4.75)});
}

TEST(PeriodicWorld, BytesTellThePeriod) {
  const World world = gas(with_period({10, 12}));
  auto bytes = world.serialise();
  EXPECT_EQ(World::deserialise(bytes).value().period(), Vector2(10, 12));
  const double bad = -10;
  std::memcpy(&bytes[3 * sizeof bad], &bad, sizeof bad);
  EXPECT_EQ(World::deserialise(bytes).reject().field, "bytes");
  World same_without = gas({});
  EXPECT_NE(same_without.serialise(), world.serialise());
}

// -- Questions

TEST(PeriodicWorld, QuestionsSeeEveryImage) {
  World world(with_period({10, 10}));
  test::must_spawn(world,
                   {test::disk(1, {9.75, 5}, {0, 0}, 0.5), test::disk(2, {4, 4}, {0, 0}, 1)},
                   std::vector<WallSpec>{test::wall(3, {8, 9}, {13, 11})});
  EXPECT_EQ(world.region({0, 4}, {0.2, 6}), std::vector<Id>{1});
  EXPECT_EQ(world.region({100, 4}, {100.2, 6}), std::vector<Id>{1});
  EXPECT_EQ(world.region({3, 0.9}, {3.5, 1.1}), std::vector<Id>{3});
  EXPECT_EQ(world.region({-50, -50}, {50, 50}), (std::vector<Id>{1, 2, 3}));
  EXPECT_TRUE(world.region({6, 6}, {7, 7}).empty());

  const auto near = world.nearest({-9.5, 15}, 2);  // shown at (0.5, 5)
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].id, 1U);
  EXPECT_NEAR(near[0].distance, 0.25, 1e-15);

  const auto hit = world.ray({6, 5.25}, {2, 0}, 100);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->id, 1U);
  const auto around = world.ray({0.5, 4}, {-1, 0}, 100);  // across the border, below disk 1
  ASSERT_TRUE(around.has_value());
  EXPECT_EQ(around->id, 2U);
  EXPECT_NEAR(around->distance, 5.5, 1e-12);
  EXPECT_NEAR(around->point.x(), 5, 1e-12);
  EXPECT_EQ(world.ray({0.5, 4}, {-1, 0}, 5.4), std::nullopt);
  EXPECT_EQ(world.ray({0.5, 7}, {1, 0}, INFINITY), std::nullopt);
}

}  // namespace
}  // namespace stoss::engine

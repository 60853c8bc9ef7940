// SPDX-License-Identifier: Apache-2.0
// Rest under gravity: entries, exits, and that it costs no events.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stoss::engine {
namespace {

using test::run_for;

constexpr double kPull = 9.81;

World world_with(double restitution, const Vector2& gravity = {0, -kPull}) {
  WorldOptions options;
  options.effects.gravity = Gravity{gravity};
  if (restitution < 1) options.effects.restitution = Restitution{restitution, restitution, 0, 0};
  return World(options);
}

/// Neither events nor drift in a simulated year.
void expect_at_rest(World world) {
  const std::vector<std::byte> before = world.serialise();
  std::vector<Vector2> places;
  world.for_each_disk([&](const BodyState& s) { places.push_back(s.position); });
  const Instant year = *offset_by(world.now(), 3.15e7);
  EXPECT_EQ(world.advance_to(year).value().events, 0U);
  std::size_t i = 0;
  world.for_each_disk([&](const BodyState& s) { EXPECT_EQ(s.position, places[i++]); });
  EXPECT_EQ(world.census().overlaps, 0U);
  EXPECT_EQ(world.census().missed, 0U);
}

TEST(Rest, ADiskThatBouncesOutLies) {
  World world = world_with(0.5);
  test::must_spawn(world,
                   {test::disk(1, {0, 1.5}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0})});
  const auto log = run_for(world, 10);
  const double impact = std::sqrt(2 * kPull);
  const double first = impact / kPull;
  for (std::size_t i = 0; i < 12; ++i) {  // t_n = t_1 + 2 u (e + ... + e^(n-1)) / g
    const double sum = 2 * (0.5 - std::pow(0.5, static_cast<double>(i) + 1));
    EXPECT_NEAR(seconds_between({}, log[i].instant), first + 2 * impact * sum / kPull, 4e-15);
  }
  EXPECT_LT(log.size(), 40U);
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
  EXPECT_NEAR(test::state(world, 1).position.y(), 0.5, 1e-15);
  expect_at_rest(world);
}

TEST(Rest, BeginsAtOnceForADiskThatIsPutDown) {
  World world = world_with(1);
  test::must_spawn(world,
                   {test::disk(1, {0, 0.5}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0})});
  EXPECT_LE(world.advance_to(test::seconds(1)).value().events, 4U);
  expect_at_rest(world);
}

TEST(Rest, OnASlopeIsASlideWithThePullAlongIt) {
  World world = world_with(0.3);  // a slope of 3 : 4
  test::must_spawn(world,
                   {test::disk(1, {-8 + 0.3, 6 + 0.4}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-8, 6}, {0, 0})});
  run_for(world, 1);
  const Vector2 along = 0.6 * kPull * Vector2(0.8, -0.6);
  EXPECT_NEAR((test::state(world, 1).velocity - along).norm(), 0, 1e-14);
  EXPECT_NEAR((test::state(world, 1).position - Vector2(-7.7, 6.4) - 0.5 * along).norm(), 0, 1e-14);
}

TEST(Rest, EndsWhereTheWallEnds) {
  World world = world_with(0.5);
  test::must_spawn(world,
                   {test::disk(1, {0, 0.5}, {3, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-5, 0}, {6, 0})});
  run_for(world, 3);  // slides off after 2 s
  EXPECT_NEAR((test::state(world, 1).position - Vector2(9, 0.5 - kPull / 2)).norm(), 0, 1e-14);
}

TEST(Rest, GoesOnOverTheJointsOfAFlatFloor) {
  World world = world_with(0.5);
  const Vector2 floor[] = {{-5, 0}, {1, 0}, {2, 0}, {7, 0}, {7, 9}};
  test::must_spawn(world, {test::disk(1, {0, 0.5}, {2, 0}, 0.5)}, test::chain(2, floor));
  run_for(world, 3);
  EXPECT_NEAR((test::state(world, 1).position - Vector2(6, 0.5)).norm(), 0, 1e-13);
  run_for(world, 1);  // the wall at x = 7 is met at 3.25 s and gives back half the speed
  EXPECT_NEAR((test::state(world, 1).position - Vector2(5.75, 0.5)).norm(), 0, 1e-13);
}

TEST(Rest, InAGrooveHoldsTheDiskStill) {
  for (const Vector2& gravity : {Vector2(0, -kPull), Vector2(1.5, -kPull)}) {
    World world = world_with(0.5, gravity);
    test::must_spawn(
        world,
        {test::disk(1, {0.7, 3}, {0.2, 0}, 0.5)},
        std::vector<WallSpec>{test::wall(2, {-5, 8}, {0, 0}), test::wall(3, {0, 0}, {5, 3})});
    run_for(world, 100);
    EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
    expect_at_rest(world);
  }
}

TEST(Rest, EndsWithACommandAndWithAHit) {
  World world = world_with(0.5);
  test::must_spawn(world,
                   {test::disk(1, {0, 0.5}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-90, 0}, {90, 0})});
  run_for(world, 1);
  const VectorFor up{1, {0, kPull}};
  ASSERT_TRUE(world.set_velocity(std::span(&up, 1)).ok());
  run_for(world, 1);
  EXPECT_NEAR(test::state(world, 1).position.y(), 0.5 + kPull / 2, 1e-14);
  run_for(world, 10);
  expect_at_rest(world);
  test::must_spawn(world, {test::disk(3, {-5, 0.75}, {2, 0}, 0.75)});
  run_for(world, 5);
  EXPECT_GT(test::state(world, 1).position.x(), 0.5) << "pushed along by the hit";
}

TEST(Rest, EndsWithItsSupport) {
  for (const bool removed : {true, false}) {
    World world = world_with(0.5);
    test::must_spawn(world,
                     {test::disk(1, {0, 0.5}, {0, 0}, 0.5)},
                     std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0})});
    run_for(world, 1);
    const Id support = 2;
    const VectorFor down{2, {0, -100}};
    if (removed) {
      ASSERT_TRUE(world.remove(std::span(&support, 1)).ok());
    } else {
      ASSERT_TRUE(world.set_velocity(std::span(&down, 1)).ok());
    }
    run_for(world, 1);
    EXPECT_NEAR(test::state(world, 1).position.y(), 0.5 - kPull / 2, 1e-14) << removed;
  }
}

TEST(Rest, RidesOnAMovingFloor) {
  World world = world_with(0.5);
  test::must_spawn(world,
                   {test::disk(1, {0, 0.5}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-9, 0}, {9, 0}, {0, 1})});
  run_for(world, 10);
  EXPECT_NEAR(test::state(world, 1).position.y(), 10.5, 1e-12);
  EXPECT_NEAR(test::state(world, 1).velocity.y(), 1, 1e-12);
}

TEST(Rest, AHundredDisksComeToItAndCostNothingForAYear) {
  WorldOptions options;
  options.effects.gravity = Gravity{{0, -kPull}};
  options.effects.restitution = Restitution{0.5, 0.5, 1e-3, 0.02};
  World world(options);
  test::Random random(1);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 100; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(test::disk(kNoId, {1.3 * i + 1, 1 + random.uniform(0, 3)}, velocity, 0.5));
  }
  test::must_spawn(world, disks, test::box(1'000, {0, 0}, {132, 50}));
  const AdvanceReport report = world.advance_to(test::seconds(3.15e7), nullptr, 3'000'000).value();
  EXPECT_EQ(report.stop, Stop::Reached);
  EXPECT_LT(report.events, 500'000U) << "all of them in the first minutes";
  const AdvanceReport later = world.advance_to(test::seconds(6.3e7), nullptr, 3'000'000).value();
  EXPECT_LT(later.events, 200U) << "what still slides meets a neighbour now and then";
  EXPECT_EQ(world.census().overlaps, 0U);
  world.for_each_disk([](const BodyState& s) { EXPECT_NEAR(s.position.y(), 0.5, 1e-3); });
}

TEST(Rest, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  const auto heap = [](BroadPhaseKind kind) {
    WorldOptions options;
    options.effects.gravity = Gravity{{0.2, -kPull}};
    options.effects.restitution = Restitution{0.4, 0.6, 1e-3, 0.05};
    options.broad_phase = kind;
    World world(options);
    test::Random random(2);
    std::vector<DiskSpec> disks;
    for (int i = 0; i < 20; ++i) {
      const Vector2 velocity(random.uniform(-1, 1), 0);
      disks.push_back(test::disk(
          kNoId, {2 * (i % 10) + 1, 2 + 1.5 * (i / 10)}, velocity, 0.4 + 0.05 * (i % 3)));
    }
    const Vector2 ground[] = {{0, 9}, {0, 0}, {10, 0}, {16, 1}, {22, 0.5}, {22, 9}};
    test::must_spawn(world, disks, test::chain(100, ground));
    return world;
  };
  test::expect_one_story(heap, 3, 300, 3);
}

}  // namespace
}  // namespace stoss::engine

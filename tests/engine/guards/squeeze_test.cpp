// SPDX-License-Identifier: Apache-2.0
// A disk between closing walls: hits without end as the room goes to zero. The world stops there
// and says so; it never hangs and never lets the disk through.

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace stoss::engine;

WallSpec wall_at(double x, double speed) {
  WallSpec wall;
  wall.start = {x, -10};
  wall.end = {x, 10};
  wall.velocity = {speed, 0};
  return wall;
}

World press(double speed) {
  World world;
  DiskSpec disk;
  disk.id = 7;
  disk.position = {0.3, 0};
  disk.velocity = {2, 0};
  disk.radius = 0.5;
  const std::vector<WallSpec> walls{wall_at(-2, 0), wall_at(2, -speed)};
  EXPECT_TRUE(world.spawn({{&disk, 1}, walls}).ok());
  return world;
}

TEST(Squeeze, StopsTheWorldBeforeTheRoomIsGoneAndNamesTheDisk) {
  World world = press(1);
  const auto report = world.advance_to({.seconds = 10}).value();
  EXPECT_EQ(report.stop, Stop::Stalled);
  EXPECT_EQ(report.stalled, 7U);
  // The walls touch both sides of the disk at t = 3.
  EXPECT_LT(seconds_between({}, world.now()), 3);
  EXPECT_GT(seconds_between({}, world.now()), 3 - 1e-3);
  EXPECT_GT(report.collisions, 1000U);
}

TEST(Squeeze, StaysStoppedUntilACommandFreesTheDisk) {
  World world = press(1);
  (void)world.advance_to({.seconds = 10});
  const Instant stopped = world.now();
  const auto again = world.advance_to({.seconds = 10}).value();
  EXPECT_EQ(again.stop, Stop::Stalled);
  EXPECT_EQ(again.events, 0U);
  EXPECT_EQ(world.now(), stopped);
  const Id disk = 7;
  ASSERT_TRUE(world.remove({&disk, 1}).ok());
  EXPECT_EQ(world.advance_to({.seconds = 10}).value().stop, Stop::Reached);
}

TEST(Squeeze, IsNotSeenWhereTheWallsOpen) {
  World world = press(-1);
  EXPECT_EQ(world.advance_to({.seconds = 1000}).value().stop, Stop::Reached);
}

TEST(Squeeze, IsTheSameInEveryBroadPhase) {
  World a = press(0.5);
  World b(WorldOptions{
      .start = {}, .arithmetic = Arithmetic::Double, .broad_phase = BroadPhaseKind::AllPairs});
  b = World::deserialise(a.serialise(), BroadPhaseKind::AllPairs).value();
  (void)a.advance_to({.seconds = 10});
  (void)b.advance_to({.seconds = 10});
  EXPECT_EQ(a.now(), b.now());
  EXPECT_EQ(a.serialise(), b.serialise());
}

}  // namespace

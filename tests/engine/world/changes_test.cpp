// SPDX-License-Identifier: Apache-2.0
// drain_changes(): what a replica is told.

#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace stoss::engine {

bool operator==(const Change& a, const Change& b) { return a.id == b.id && a.kind == b.kind; }

namespace {

using test::disk;
using test::must_spawn;
using test::run_until;
using test::seconds;
using test::wall;

using Changes = std::vector<Change>;

World three_in_a_row() {
  World world;
  must_spawn(
      world,
      {disk(3, {0, 0}, {1, 0}, 0.5), disk(1, {3, 0}, {0, 0}, 0.5), disk(2, {30, 0}, {0, 0}, 0.5)});
  return world;
}

TEST(Changes, TheFirstDrainNamesEveryBodyInTheOrderOfIds) {
  World world = three_in_a_row();
  run_until(world, seconds(5));
  EXPECT_EQ(
      world.drain_changes(),
      (Changes{{1, ChangeKind::Spawned}, {2, ChangeKind::Spawned}, {3, ChangeKind::Spawned}}));
  EXPECT_TRUE(world.drain_changes().empty());
}

TEST(Changes, TicksAndQuestionsChangeNothing) {
  World world = three_in_a_row();
  world.drain_changes();
  for (int i = 1; i < 16; ++i) run_until(world, seconds(0.1 * i));
  (void)world.state(1);
  (void)world.serialise();
  EXPECT_TRUE(world.drain_changes().empty());
}

TEST(Changes, BothPartiesOfAContactMoveOnceWhateverTheirNumberOfContacts) {
  World world = three_in_a_row();
  const std::vector<WallSpec> walls = {wall(9, {-1, -1}, {-1, 1}), wall(8, {5, -1}, {5, 1})};
  must_spawn(world, {}, walls);
  world.drain_changes();
  const auto log = run_until(world, seconds(12));
  EXPECT_GE(log.size(), 4U);
  EXPECT_EQ(world.drain_changes(), (Changes{{1, ChangeKind::Moved}, {3, ChangeKind::Moved}}));
}

TEST(Changes, CommandsMoveWhatTheyName) {
  World world = three_in_a_row();
  world.drain_changes();
  const VectorFor velocity{2, {0, 1}};
  ASSERT_TRUE(world.set_velocity(std::span(&velocity, 1)).ok());
  const VectorFor impulse{1, {0, 0}};
  ASSERT_TRUE(world.apply_impulse(std::span(&impulse, 1)).ok());
  EXPECT_EQ(world.drain_changes(), (Changes{{1, ChangeKind::Moved}, {2, ChangeKind::Moved}}));
}

TEST(Changes, ABodyThatMovedAndWasRemovedIsRemoved) {
  World world = three_in_a_row();
  world.drain_changes();
  run_until(world, seconds(5));
  const Id ids[] = {1};
  ASSERT_TRUE(world.remove(ids).ok());
  EXPECT_EQ(world.drain_changes(), (Changes{{1, ChangeKind::Removed}, {3, ChangeKind::Moved}}));
  EXPECT_TRUE(world.drain_changes().empty());
}

TEST(Changes, ABodySpawnedAndMovedIsSpawned) {
  World world = three_in_a_row();
  world.drain_changes();
  must_spawn(world, {disk(7, {1.5, 0}, {0, 0}, 0.5)});
  run_until(world, seconds(5));
  EXPECT_EQ(world.drain_changes(),
            (Changes{{1, ChangeKind::Moved}, {3, ChangeKind::Moved}, {7, ChangeKind::Spawned}}));
}

TEST(Changes, ABodyThatCameAndWentDoesNotAppear) {
  World world = three_in_a_row();
  world.drain_changes();
  must_spawn(world, {disk(7, {0, 10}, {0, 0}, 0.5), disk(8, {0, 20}, {0, 0}, 0.5)});
  const Id ids[] = {7};
  ASSERT_TRUE(world.remove(ids).ok());
  EXPECT_EQ(world.drain_changes(), (Changes{{8, ChangeKind::Spawned}}));
}

TEST(Changes, RefusedCommandsChangeNothing) {
  World world = three_in_a_row();
  world.drain_changes();
  const DiskSpec inside = disk(kNoId, {0, 0}, {0, 0}, 0.5);
  EXPECT_FALSE(world.spawn({std::span(&inside, 1), {}}).ok());
  const Id ids[] = {1, 99};
  EXPECT_FALSE(world.remove(ids).ok());
  const VectorFor velocities[] = {{1, {1, 1}}, {99, {1, 1}}};
  EXPECT_FALSE(world.set_velocity(velocities).ok());
  EXPECT_TRUE(world.drain_changes().empty());
}

TEST(Changes, AMirrorFedWithChangesEqualsTheWorld) {
  World world;
  const auto walls = test::box(100, {-5, -5}, {5, 5});
  const std::vector<DiskSpec> disks = {disk(1, {0.1, 0}, {3, 1}, 0.5),
                                       disk(2, {3, 0.1}, {1, 2}, 0.5),
                                       disk(3, {-3, 0.1}, {1, -2}, 0.75)};
  must_spawn(world, disks, walls);
  std::map<Id, MotionRecord> mirror;
  for (int tick = 0; tick < 200; ++tick) {
    run_until(world, seconds(0.1 * tick));
    if (tick == 50) must_spawn(world, {disk(kNoId, {-4, -4}, {0, 0}, 0.2)});
    if (tick == 100) {
      ASSERT_TRUE(world.remove(std::vector<Id>{2}).ok());
    }
    for (const Change& change : world.drain_changes()) {
      if (change.kind == ChangeKind::Removed) {
        mirror.erase(change.id);
      } else {
        mirror[change.id] = world.motion(change.id).value();
      }
    }
    std::size_t seen = 0;
    world.for_each_disk([&](const BodyState& body) {
      ++seen;
      ASSERT_TRUE(mirror.contains(body.id));
      EXPECT_EQ(evaluate(mirror[body.id], Arithmetic::Double, world.now()), body.position);
    });
    EXPECT_EQ(seen + walls.size(), mirror.size());
  }
}

}  // namespace
}  // namespace stoss::engine

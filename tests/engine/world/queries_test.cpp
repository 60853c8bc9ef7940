// SPDX-License-Identifier: Apache-2.0
// Questions to a world: region, nearest and ray, by hand and against the slow way.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stoss::engine {
namespace {

using test::disk;
using test::must_spawn;
using test::run_until;
using test::seconds;
using test::wall;

World by_hand() {
  World world;
  const std::vector<WallSpec> walls = {wall(4, {6, -3}, {6, 3}), wall(5, {-10, 5}, {10, 9})};
  must_spawn(world,
             {disk(3, {0, 0}, {0, 0}, 1), disk(1, {3, 0}, {0, 0}, 1), disk(2, {0, -4}, {0, 0}, 2)},
             walls);
  return world;
}

TEST(Queries, ARegionHoldsWhatTouchesItInTheOrderOfIds) {
  const World world = by_hand();
  EXPECT_EQ(world.region({0, -1}, {2, 1}), (std::vector<Id>{1, 3}));
  EXPECT_EQ(world.region({-20, -20}, {20, 20}), (std::vector<Id>{1, 2, 3, 4, 5}));
  EXPECT_EQ(world.region({-1, 1}, {0, 2}), (std::vector<Id>{3}));  // touches at (0, 1)
  // A corner of the bounding box of a disk or of a slanted wall is not the body.
  EXPECT_TRUE(world.region({0.9, 0.9}, {1, 1}).empty());
  EXPECT_TRUE(world.region({5, 5}, {8, 6}).empty());
  EXPECT_EQ(world.region({5.5, -0.5}, {6.5, 0.5}), (std::vector<Id>{4}));
}

TEST(Queries, TheNearestAreSortedByDistanceThenId) {
  World world = by_hand();
  const auto near = world.nearest({1.5, 0}, 3);
  ASSERT_EQ(near.size(), 3U);
  EXPECT_EQ(near[0].id, 1U);  // a tie with 3
  EXPECT_EQ(near[0].distance, 0.5);
  EXPECT_EQ(near[1].id, 3U);
  EXPECT_EQ(near[2].id, 2U);
  EXPECT_EQ(world.nearest({0, 0}, 1)[0].distance, -1);  // inside
  EXPECT_EQ(world.nearest({6.25, 4}, 9).size(), 5U);
  EXPECT_TRUE(world.nearest({0, 0}, 0).empty());
}

TEST(Queries, ARayMeetsTheFirstBodyAndSaysWhere) {
  const World world = by_hand();
  const auto hit = world.ray({-5, 0}, {10, 0}, 100);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->id, 3U);
  EXPECT_EQ(hit->distance, 4);
  EXPECT_EQ(hit->point, Vector2(-1, 0));
  EXPECT_EQ(hit->normal, Vector2(-1, 0));
  EXPECT_FALSE(world.ray({-5, 0}, {10, 0}, 3.99).has_value());
  EXPECT_FALSE(world.ray({-5, 0}, {0, 0}, 100).has_value());
  EXPECT_FALSE(world.ray({-5, 1.5}, {-1, 0}, 100).has_value());
  const auto at_wall = world.ray({5, 0}, {1, 0}, 100);
  ASSERT_TRUE(at_wall.has_value());
  EXPECT_EQ(at_wall->id, 4U);
  EXPECT_EQ(at_wall->normal, Vector2(-1, 0));
}

TEST(Queries, BothBroadPhasesAnswerAlikeInFlight) {
  test::Random random(test::seed_of_run());
  World neighbours;
  World all_pairs(WorldOptions{.start = {}, .broad_phase = BroadPhaseKind::AllPairs});
  std::vector<DiskSpec> disks;
  for (Id id = 1; id <= 60; ++id) {
    const auto i = static_cast<double>(id);
    disks.push_back(disk(id,
                         {std::fmod(i, 8) * 2, std::floor(i / 8) * 2},
                         {random.uniform(-2, 2), random.uniform(-2, 2)},
                         random.uniform(0.01, 0.9)));
  }
  const auto walls = test::box(100, {-2, -2}, {18, 18});
  must_spawn(neighbours, disks, walls);
  must_spawn(all_pairs, disks, walls);
  for (int i = 0; i < 300; ++i) {
    const Instant until = seconds(0.05 * i);
    run_until(neighbours, until);
    run_until(all_pairs, until);
    const Vector2 low(random.uniform(-3, 18), random.uniform(-3, 18));
    const Vector2 high = low + Vector2(random.uniform(0, 4), random.uniform(0, 4));
    EXPECT_EQ(neighbours.region(low, high), all_pairs.region(low, high));
    const auto near = neighbours.nearest(low, 5);
    const auto near_too = all_pairs.nearest(low, 5);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(near[k].id, near_too[k].id);
    const auto hit = neighbours.ray(low, high - low, 10);
    const auto hit_too = all_pairs.ray(low, high - low, 10);
    ASSERT_EQ(hit.has_value(), hit_too.has_value());
    if (hit) {
      EXPECT_EQ(hit->id, hit_too->id);
    }
  }
}

}  // namespace
}  // namespace stoss::engine

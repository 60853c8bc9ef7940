// SPDX-License-Identifier: Apache-2.0
// Chains of walls: no ghost hits where walls meet, no leaks either, and walls that come and go.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::chain;
using test::disk;
using test::must_spawn;
using test::run_for;
using test::run_until;
using test::seconds;
using test::state;
using test::wall;

/// Vertices at random distances along a line through `from` at `angle`, rounded as they come.
std::vector<Vector2> straight_line(test::Random& random, Vector2 from, double angle, int walls) {
  std::vector<Vector2> vertices = {from};
  double along = 0;
  for (int i = 0; i < walls; ++i) {
    along += random.uniform(0.2, 2);
    vertices.push_back(from + along * Vector2(std::cos(angle), std::sin(angle)));
  }
  return vertices;
}

class ChainsIn : public testing::TestWithParam<Arithmetic> {};

std::string name_of(const testing::TestParamInfo<Arithmetic>& tested) {
  if (tested.param == Arithmetic::Float) return "Float";
  return tested.param == Arithmetic::Double ? "Double" : "LongDouble";
}
INSTANTIATE_TEST_SUITE_P(Arithmetics,
                         ChainsIn,
                         testing::Values(Arithmetic::Float,
                                         Arithmetic::Double,
                                         Arithmetic::LongDouble),
                         name_of);

TEST_P(ChainsIn, ADiskSlidingAlongAnAxisMeetsNoVertex) {
  World world(WorldOptions{.start = {}, .arithmetic = GetParam()});
  test::Random random(test::seed_of_run());
  const auto walls = chain(10, straight_line(random, {0, 0}, 0, 100));
  must_spawn(world, {disk(1, {1, 0.5}, {1, 0}, 0.5)}, walls);
  EXPECT_TRUE(run_until(world, seconds(150)).empty());
  EXPECT_EQ(state(world, 1).position, Vector2(151, 0.5));
}

// A disk that slides along a chain whose vertices are rounded: it may touch a face again and again,
// by 1e-16 each, for the walls are not exactly in line; but no vertex turns it.
TEST_P(ChainsIn, ADiskSlidingAlongARoundedLineIsTurnedByNoVertex) {
  test::Random random(test::seed_of_run());
  const double eps = GetParam() == Arithmetic::Float ? 1e-6 : 1e-14;
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    World world(WorldOptions{.start = {}, .arithmetic = GetParam()});
    const double angle = random.uniform(-3, 3);
    const Vector2 along(std::cos(angle), std::sin(angle));
    const Vector2 up(-along.y(), along.x());
    const Vector2 from(random.uniform(-50, 50), random.uniform(-50, 50));
    must_spawn(world,
               {disk(1, from + 1.1 * along + 0.5 * up, along, 0.5)},
               chain(10, straight_line(random, from, angle, 100)));
    const auto log = run_until(world, seconds(80));
    EXPECT_LT(log.size(), 150U);
    const Vector2 velocity = state(world, 1).velocity;
    EXPECT_LT((velocity - along).norm(), 100 * eps);
    for (const Collision& c : log) EXPECT_NE(c.kind, ContactKind::DiskWallEnd) << test::describe(c);
  }
}

TEST_P(ChainsIn, BouncesOnAFlatChainAreThoseOnOneWall) {
  test::Random random(test::seed_of_run());
  const double eps = GetParam() == Arithmetic::Float ? 1e-5 : 1e-15;
  for (int trial = 0; trial < 20; ++trial) {
    const auto vertices = straight_line(random, {0, 0}, 0, 60);
    const auto run = [&](const std::vector<WallSpec>& floor) {
      World world(WorldOptions{.start = {}, .arithmetic = GetParam()});
      auto walls = floor;
      walls.push_back(wall(900, {-10, 2}, {200, 2}));
      must_spawn(world, {disk(1, {1, 1}, {0.3, 1}, 0.5)}, walls);
      return run_until(world, seconds(90));
    };
    const auto on_chain = run(chain(10, vertices));
    const auto on_wall = run({wall(10, vertices.front(), vertices.back())});
    ASSERT_EQ(on_chain.size(), on_wall.size());
    for (std::size_t i = 0; i < on_chain.size(); ++i) {
      EXPECT_EQ(on_chain[i].kind, ContactKind::DiskWall);
      EXPECT_NEAR(seconds_between(on_wall[i].instant, on_chain[i].instant), 0, eps);
      EXPECT_EQ(on_chain[i].velocity_a, on_wall[i].velocity_a);
    }
  }
}

// A convex corner is round for a disk: it meets a face, or the vertex under an angle between the
// two.
TEST_P(ChainsIn, ConvexCornersAreMetAsFacesOrAsAPoint) {
  test::Random random(test::seed_of_run());
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    World world(WorldOptions{.start = {}, .arithmetic = GetParam()});
    const std::vector<Vector2> roof = {
        {-5, -random.uniform(0.5, 5)}, {0, 0}, {5, -random.uniform(0.5, 5)}};
    must_spawn(world, {disk(1, {random.uniform(-1, 1), 4}, {0, -1}, 0.5)}, chain(10, roof));
    const auto log = run_until(world, seconds(6));
    ASSERT_EQ(log.size(), 1U);
    const Vector2 normal = -log[0].normal;  // from the roof to the disk
    const Vector2 left = (roof[1] - roof[0]).normalized();
    const Vector2 right = (roof[2] - roof[1]).normalized();
    const double eps = GetParam() == Arithmetic::Float ? 1e-6 : 1e-14;
    EXPECT_GE(normal.dot(left), -eps);
    EXPECT_LE(normal.dot(right), eps);
    EXPECT_EQ(log[0].kind == ContactKind::DiskWallEnd,
              normal.dot(left) > eps && normal.dot(right) < -eps);
  }
}

TEST_P(ChainsIn, ConcaveCornersAreMetAsTheirTwoFaces) {
  test::Random random(test::seed_of_run());
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    World world(WorldOptions{.start = {}, .arithmetic = GetParam()});
    const std::vector<Vector2> valley = {
        {-9, random.uniform(0.5, 12)}, {0, 0}, {9, random.uniform(0.5, 12)}};
    must_spawn(world, {disk(1, {random.uniform(-0.1, 0.1), 20}, {0, -1}, 0.5)}, chain(10, valley));
    const auto log = run_until(world, seconds(40));
    EXPECT_GE(log.size(), 1U);
    for (const Collision& c : log) EXPECT_EQ(c.kind, ContactKind::DiskWall);
    EXPECT_GT(state(world, 1).position.y(), 0);
  }
}

// Shots from inside a polygon at its vertices, at offsets from 1 down to 1e-18 of the radius:
// whatever a shot meets, it stays inside. Millions of shots behind STOSS_SHOTS.
TEST_P(ChainsIn, NothingLeaksThroughASharedVertex) {
  test::Random random(test::seed_of_run());
  const auto shots = test::environment_number("STOSS_SHOTS", 4000);
  for (std::uint64_t shot = 0; shot < shots; ++shot) {
    World world(WorldOptions{.start = {}, .arithmetic = GetParam()});
    const auto corners = static_cast<int>(3 + random.below(6));
    const double turn = random.uniform(0, 7);
    std::vector<Vector2> outline;
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + 2 * std::numbers::pi * i / corners;
      outline.emplace_back(4 * std::cos(angle), 4 * std::sin(angle));
    }
    outline.push_back(outline.front());
    const double r = random.decades(-3, -0.5);
    const Vector2 target = outline[random.below(outline.size())];
    const Vector2 from(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    const Vector2 aim = (target - from).normalized();
    const Vector2 aside(-aim.y(), aim.x());
    const Vector2 offset = random.either_sign(random.decades(-18, 0)) * r * aside;
    must_spawn(world, {disk(1, from + offset, 3 * aim, r)}, chain(10, outline));
    test::Log log;
    const AdvanceReport report = world.advance_to(seconds(20), &log, 100000).value();
    EXPECT_EQ(report.stop, Stop::Reached);
    ASSERT_LT(state(world, 1).position.norm(), 4) << "shot " << shot;
    EXPECT_FALSE(log.collisions.empty());
    if (GetParam() != Arithmetic::LongDouble) {
      ASSERT_LT(test::deepest_overlap(world), GetParam() == Arithmetic::Float ? 1e-5 : 1e-13);
    }
    if (HasFailure()) return;
  }
}

// The same with walls that do not know of each other: their ends are full circles.
TEST(Chains, NothingLeaksBetweenWallsThatEndNextToEachOther) {
  test::Random random(test::seed_of_run());
  for (int shot = 0; shot < 4000; ++shot) {
    World world;
    const double gap = random.one_in(4) ? 0 : random.decades(-18, -4);
    const std::vector<WallSpec> walls = {wall(10, {-5, random.uniform(-1, 1)}, {0, 0}),
                                         wall(11, {gap, 0}, {5, random.uniform(-1, 1)})};
    const double x = random.either_sign(random.decades(-18, 0));
    must_spawn(world, {disk(1, {x, 3}, {0, -1}, 0.25)}, walls);
    const auto log = run_until(world, seconds(5));
    EXPECT_GE(log.size(), 1U);
    ASSERT_GT(state(world, 1).position.y(), 0) << "gap " << gap << " x " << x;
  }
}

// A disk pressed 1e-9 of its radius into a flat chain, within what a spawn allows, moves along it.
// Faces let it slide; a vertex would turn it if it were not hidden by them.
class Pressed : public testing::Test {
 protected:
  Pressed() {
    const Vector2 vertices[] = {{0, 0}, {5, 0}, {10, 0}, {20, 0}};
    walls_ = chain(10, vertices);
    must_spawn(world_, {disk(1, {2, 0.5 - 2e-10}, {1, 0}, 0.5)}, walls_);
  }

  World world_;
  std::vector<WallSpec> walls_;
};

TEST_F(Pressed, ItSlidesOverTheVertices) { EXPECT_TRUE(run_until(world_, seconds(30)).empty()); }

TEST_F(Pressed, AWallThatIsTakenAwayBehindItLeavesNoContactInThePast) {
  EXPECT_TRUE(run_until(world_, seconds(4)).empty());  // over wall 11, past the vertex at 5
  ASSERT_TRUE(world_.remove(std::vector<Id>{10}).ok());
  for (const Collision& c : run_until(world_, seconds(30))) EXPECT_GE(c.instant, seconds(4));
}

TEST_F(Pressed, AWallThatMovesOffBehindItLeavesNoContactInThePast) {
  EXPECT_TRUE(run_until(world_, seconds(4)).empty());
  const VectorFor velocity{10, {0, -1}};
  ASSERT_TRUE(world_.set_velocity(std::span(&velocity, 1)).ok());
  for (const Collision& c : run_until(world_, seconds(30))) EXPECT_GE(c.instant, seconds(4));
}

TEST_F(Pressed, AWallThatIsTakenAwayAheadLaysTheVertexBare) {
  EXPECT_TRUE(run_until(world_, seconds(1)).empty());
  ASSERT_TRUE(world_.remove(std::vector<Id>{11}).ok());
  // The disk drops nowhere: there is no gravity. It passes over the bare end of wall 10, and meets
  // the bare start of wall 12 from the side on which no face hides it.
  const auto log = run_until(world_, seconds(30));
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log[0].kind, ContactKind::DiskWallEnd);
  EXPECT_EQ(log[0].b, 12U);
}

/// Two walls in line, moving together with a disk pressed to them that slides along.
World moving_chain(const Vector2& velocity) {
  World world;
  const Vector2 vertices[] = {{0.1, 0.3}, {5.3, 0.3}, {10.7, 0.3}, {21.1, 0.3}};
  auto walls = chain(10, vertices);
  for (WallSpec& w : walls) w.velocity = velocity;
  must_spawn(world, {disk(1, {2, 0.8 - 2e-10}, velocity + Vector2(1, 0), 0.5)}, walls);
  return world;
}

TEST(MovingChains, HaveNoGhosts) {
  World world = moving_chain({0.7, 0.4});
  EXPECT_TRUE(run_until(world, seconds(15)).empty());
}

TEST(MovingChains, HaveNoGhostsAfterASnapshot) {
  World world = moving_chain({0.7, 0.4});
  run_until(world, seconds(1.7));
  World again = World::deserialise(world.serialise()).value();
  EXPECT_TRUE(run_until(again, seconds(15)).empty());
}

TEST(MovingChains, StayChainsWhenTheyAreStoppedOrTurned) {
  World world = moving_chain({0.7, 0.4});
  run_until(world, seconds(1.7));
  std::vector<VectorFor> velocities = {{1, {1, 0}}};
  for (const Id id : {10U, 11U, 12U}) velocities.push_back({id, {0, 0}});
  ASSERT_TRUE(world.set_velocity(velocities).ok());
  EXPECT_TRUE(run_until(world, seconds(4.9)).empty());
  velocities = {{1, {0.9, 0.01}}};
  for (const Id id : {10U, 11U, 12U}) velocities.push_back({id, {-0.1, 0.01}});
  ASSERT_TRUE(world.set_velocity(velocities).ok());
  World again = World::deserialise(world.serialise()).value();
  EXPECT_TRUE(run_until(world, seconds(15)).empty());
  EXPECT_TRUE(run_until(again, seconds(15)).empty());
}

TEST(MovingChains, AreMadeOneByOneAsWell) {
  World world;
  run_until(world, seconds(1.3));
  const Vector2 vertices[] = {{0.1, 0.3}, {5.3, 0.3}, {10.7, 0.3}};
  std::vector<VectorFor> velocities;
  for (const WallSpec& w : chain(10, vertices)) {
    must_spawn(world, {}, std::span(&w, 1));
    velocities.push_back({w.id, {0.7, 0.4}});
  }
  ASSERT_TRUE(world.set_velocity(velocities).ok());
  must_spawn(world, {disk(1, {2, 0.8 - 2e-10}, {1.7, 0.4}, 0.5)});
  EXPECT_TRUE(run_until(world, seconds(8)).empty());
}

}  // namespace
}  // namespace stoss::engine

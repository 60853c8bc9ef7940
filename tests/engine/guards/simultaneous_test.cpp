// SPDX-License-Identifier: Apache-2.0
// Contacts of one instant that share a body: those whose outcome depends on the order are marked.

#include "simultaneous.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace stoss::engine;

class Log final : public CollisionSink {
 public:
  void on_collision(const Collision& c) override { collisions.push_back(c); }
  std::vector<Collision> collisions;
};

DiskSpec disk(double x, double y, double vx, double mass = 1) {
  DiskSpec spec;
  spec.position = {x, y};
  spec.velocity = {vx, 0};
  spec.radius = 0.5;
  spec.mass = mass;
  return spec;
}

std::vector<Collision> run(const std::vector<DiskSpec>& disks, const std::vector<WallSpec>& walls) {
  World world;
  EXPECT_TRUE(world.spawn({disks, walls}).ok());
  Log log;
  EXPECT_TRUE(world.advance_to({.seconds = 10}, &log).ok());
  return log.collisions;
}

bool marked(const std::vector<Collision>& collisions) {
  for (const Collision& c : collisions) {
    if (c.order_dependent) return true;
  }
  return false;
}

/// Two unit-mass mirrors at this angle: normals from the shared body, at pi - angle to each other
/// in the plane when the shared body is infinitely lighter than the others.
bool matters_at(double angle) {
  const Vector2 n1(1, 0);
  const Vector2 n2(-std::cos(angle), std::sin(angle));
  return order_matters(n1, n2, 1, 0, 0);  // weight 0 partners: cos(theta) = -n1.n2
}

TEST(OrderMatters, NotAtAnglesThatDivideAStraightOne) {
  for (int n = 2; n <= 60; ++n) EXPECT_FALSE(matters_at(std::numbers::pi / n)) << n;
}

TEST(OrderMatters, AtAllOtherAngles) {
  for (const double degrees : {104.0, 120.0, 91.0, 89.9, 72.0, 59.9, 60.1, 50.0, 44.0, 37.0, 7.7}) {
    EXPECT_TRUE(matters_at(degrees * std::numbers::pi / 180)) << degrees;
  }
}

TEST(OrderMatters, NotForTwoContactsOfAnImmovableBody) {
  EXPECT_FALSE(order_matters(Vector2(1, 0), Vector2(0.6, 0.8), 0, 1, 1));
}

// Equal masses in a line meet at pi/3: the cradle is well defined.
TEST(SimultaneousContacts, TouchingCradleOfEqualDisksIsNotMarked) {
  const auto collisions =
      run({disk(-3, 0, 1), disk(0, 0, 0), disk(1, 0, 0), disk(2, 0, 0), disk(3, 0, 0)}, {});
  EXPECT_EQ(collisions.size(), 4U);
  EXPECT_FALSE(marked(collisions));
}

TEST(SimultaneousContacts, TouchingCradleOfUnequalDisksIsMarked) {
  EXPECT_TRUE(marked(run({disk(-3, 0, 1), disk(0, 0, 0, 2), disk(1, 0, 0, 3)}, {})));
}

// cos(theta) = -1/4: one disk into two that touch.
TEST(SimultaneousContacts, BreakOfTwoTouchingDisksIsMarkedInBothContacts) {
  const auto collisions = run({disk(-3, 0, 1), disk(0, 0.5, 0), disk(0, -0.5, 0)}, {});
  ASSERT_GE(collisions.size(), 2U);
  EXPECT_TRUE(collisions[0].order_dependent);
  EXPECT_TRUE(collisions[1].order_dependent);
}

TEST(SimultaneousContacts, CornerOfARightAngleIsNotMarked) {
  WallSpec floor;
  floor.start = {0, 0};
  floor.end = {10, 0};
  WallSpec side;
  side.start = {0, 0};
  side.end = {0, 10};
  DiskSpec d = disk(3, 3, 0);
  d.velocity = {-1, -1};
  const auto collisions = run({d}, {floor, side});
  EXPECT_EQ(collisions.size(), 2U);
  EXPECT_FALSE(marked(collisions));
}

TEST(SimultaneousContacts, CollisionsOfDisjointPairsAreNotMarked) {
  EXPECT_FALSE(marked(run({disk(0, 0, 1), disk(5, 0, -1), disk(0, 10, 1), disk(5, 10, -1)}, {})));
}

}  // namespace

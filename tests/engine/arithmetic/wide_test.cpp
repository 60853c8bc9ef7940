// SPDX-License-Identifier: Apache-2.0
// Every arithmetic runs the same loop: the same story to its own precision, the same bytes from
// either broad phase, any ticks, a fork, and through serialisation.

#include <stoss/wide/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace stoss::engine;

class Meetings final : public CollisionSink {
 public:
  void on_collision(const Collision& c) override { collisions.push_back(c); }
  std::vector<Collision> collisions;
};

World table(Arithmetic arithmetic, BroadPhaseKind broad_phase = BroadPhaseKind::Neighbours) {
  World world = stoss::wide::make_world({{}, arithmetic, broad_phase});
  std::vector<DiskSpec> disks(12);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const auto n = static_cast<double>(i);
    // Off the lattice, so that no two contacts share an instant that rounding could order.
    disks[i].position = {1.0 + 1.25 * static_cast<double>(i % 4) + 0.013 * std::sin(3 * n),
                         1.0 + 1.5 * std::floor(n / 4) + 0.017 * std::cos(5 * n)};
    disks[i].velocity = {1.0 - 0.375 * static_cast<double>(i % 5),
                         0.25 * static_cast<double>(i % 3)};
    disks[i].radius = 0.375;
    disks[i].mass = 1 + 0.5 * static_cast<double>(i % 2);
  }
  const Vector2 corners[] = {{0, 0}, {6, 0}, {6, 5}, {0, 5}};
  std::vector<WallSpec> walls(4);
  for (std::size_t i = 0; i < 4; ++i) {
    walls[i].start = corners[i];
    walls[i].end = corners[(i + 1) % 4];
  }
  EXPECT_TRUE(world.spawn({disks, walls}).ok());
  return world;
}

class EveryArithmetic : public testing::TestWithParam<Arithmetic> {
 protected:
  void SetUp() override {
    if (!stoss::wide::is_available(GetParam())) GTEST_SKIP() << "not in this build";
  }
};

TEST_P(EveryArithmetic, GivesTheSameBytesWithEitherBroadPhaseAndAnyTicks) {
  World leap = table(GetParam());
  World ticks = table(GetParam(), BroadPhaseKind::AllPairs);
  ASSERT_TRUE(leap.advance_to({.seconds = 8}).ok());
  for (int i = 1; i <= 800; ++i) {
    ASSERT_TRUE(ticks.advance_to(*offset_by({}, 0.01 * i)).ok());
  }
  EXPECT_EQ(leap.serialise(), ticks.serialise());
  EXPECT_EQ(leap.state_hash(), ticks.state_hash());
}

TEST_P(EveryArithmetic, SurvivesItsOwnBytesAndRunsOnAlike) {
  World world = table(GetParam());
  ASSERT_TRUE(world.advance_to({.seconds = 3}).ok());
  const auto bytes = world.serialise();
  auto restored = stoss::wide::deserialise(bytes);
  ASSERT_TRUE(restored.ok());
  World again = std::move(restored).value();
  EXPECT_EQ(again.serialise(), bytes);
  ASSERT_TRUE(world.advance_to({.seconds = 9}).ok());
  ASSERT_TRUE(again.advance_to({.seconds = 9}).ok());
  EXPECT_EQ(again.serialise(), world.serialise());
}

// Up to two seconds the collisions are few and the story is that of the widest arithmetic, within
// what this one's rounding grows to.
TEST_P(EveryArithmetic, TellsTheStoryOfTheWidestOne) {
  World world = table(GetParam());
  World reference = table(Arithmetic::DoubleDouble);
  Meetings mine;
  Meetings theirs;
  ASSERT_TRUE(world.advance_to({.seconds = 2}, &mine).ok());
  ASSERT_TRUE(reference.advance_to({.seconds = 2}, &theirs).ok());
  const double tolerance = GetParam() == Arithmetic::Float ? 1e-3 : 1e-11;
  ASSERT_EQ(mine.collisions.size(), theirs.collisions.size());
  ASSERT_GT(mine.collisions.size(), 10U);
  for (std::size_t i = 0; i < mine.collisions.size(); ++i) {
    const Collision& a = mine.collisions[i];
    const Collision& b = theirs.collisions[i];
    EXPECT_EQ(a.a, b.a);
    EXPECT_EQ(a.b, b.b);
    EXPECT_NEAR(seconds_between({}, a.instant), seconds_between({}, b.instant), tolerance);
    EXPECT_NEAR((a.velocity_a - b.velocity_a).norm(), 0, tolerance);
  }
}

std::string name_of(const testing::TestParamInfo<Arithmetic>& tested) {
  const char* const names[] = {"Float", "Double", "LongDouble", "DoubleDouble", "Float128"};
  return names[static_cast<std::size_t>(tested.param)];
}

INSTANTIATE_TEST_SUITE_P(Arithmetics,
                         EveryArithmetic,
                         testing::Values(Arithmetic::Float,
                                         Arithmetic::Double,
                                         Arithmetic::LongDouble,
                                         Arithmetic::DoubleDouble,
                                         Arithmetic::Float128),
                         name_of);

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// The stepped baseline is honest: right where a stepped engine can be right, and wrong where it
// must be wrong.

#include "baseline/fixed_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace stoss::client::baseline {
namespace {

using engine::DiskSpec;
using engine::WallSpec;

class Log : public engine::CollisionSink {
 public:
  void on_collision(const engine::Collision& collision) override {
    collisions.push_back(collision);
  }
  std::vector<engine::Collision> collisions;
};

constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};

DiskSpec disk(engine::Id id, double x, double vx, double mass = 1) {
  return {.id = id, .position = {x, 0}, .velocity = {vx, 0}, .radius = 0.5, .mass = mass};
}

TEST(FixedStep, AHeadOnContactIsFoundLateByLessThanAStepAndSwapsVelocities) {
  const std::vector<DiskSpec> disks = {disk(1, 0, 1), disk(2, 3, -1)};
  FixedStep world(disks, {}, {}, 0.001);
  Log log;
  world.advance_to({2, 0}, &log, kNoLimit);
  ASSERT_EQ(log.collisions.size(), 1U);
  const engine::Collision& c = log.collisions.front();
  const double late = engine::seconds_between({1, 0}, c.instant);
  EXPECT_GE(late, 0);
  EXPECT_LE(late, 0.0011);
  EXPECT_EQ(c.velocity_a.x(), -1);
  EXPECT_EQ(c.velocity_b.x(), 1);
  EXPECT_EQ(c.approach_speed, 2);
  EXPECT_EQ(c.impulse, 2);
  EXPECT_EQ(world.now(), (engine::Instant{2, 0}));
}

TEST(FixedStep, EnergyAndMomentumAreKept) {
  const std::vector<DiskSpec> disks = {disk(1, 0, 2, 3), disk(2, 3, -1, 0.5), disk(3, 6, 0, 7)};
  FixedStep world(disks, {}, {}, 0.01);
  const engine::Conserved before = world.conserved();
  world.advance_to({10, 0}, nullptr, kNoLimit);
  EXPECT_GT(world.collisions(), 0U);
  EXPECT_NEAR(world.conserved().kinetic_energy, before.kinetic_energy, 1e-12);
  EXPECT_NEAR(world.conserved().momentum.x(), before.momentum.x(), 1e-12);
}

TEST(FixedStep, AWallSendsADiskBackAndAFastDiskTunnels) {
  const std::vector<WallSpec> walls = {{.id = 9, .start = {3, -1}, .end = {3, 1}}};
  FixedStep slow(std::vector{disk(1, 0, 1)}, walls, {}, 0.01);
  Log log;
  slow.advance_to({5, 0}, &log, kNoLimit);
  ASSERT_EQ(log.collisions.size(), 1U);
  EXPECT_EQ(log.collisions[0].kind, engine::ContactKind::DiskWall);
  EXPECT_EQ(log.collisions[0].velocity_a.x(), -1);
  FixedStep fast(std::vector{disk(1, 0, 1000)}, walls, {}, 0.01);
  fast.advance_to({5, 0}, &log, kNoLimit);
  EXPECT_EQ(fast.collisions(), 0U) << "ten metres a step: it must not see the wall";
}

TEST(FixedStep, TheLastStepIsAsShortAsItMustBe) {
  FixedStep world(std::vector{disk(1, 0, 1)}, {}, {}, 0.3);
  world.advance_to({1, 0}, nullptr, kNoLimit);
  EXPECT_EQ(world.steps(), 3U);
  world.for_each_disk([](const engine::BodyState& state) {
    EXPECT_NEAR(state.position.x(), 1, 1e-15);
    EXPECT_EQ(state.instant, (engine::Instant{1, 0}));
  });
}

// Steps of 3/64 s: the contact at 1 s lies within the 22nd, which ends 1/32 s later.
constexpr double kStep = 3.0 / 64;
constexpr double kLate = 1.0 / 32;
const std::vector<DiskSpec> kHeadOn = {disk(1, 0, 1), disk(2, 3, -1)};

std::vector<double> places_after(const StepRule& rule, const engine::Instant& until) {
  FixedStep world(kHeadOn, {}, {}, rule, false);
  world.step_up_to(until, nullptr, kNoLimit);
  std::vector<double> places;
  world.for_each_disk(
      [&places](const engine::BodyState& state) { places.push_back(state.position.x()); });
  return places;
}

TEST(FixedStep, WithBackUpAContactIsResolvedWhereItBegan) {
  const engine::Instant end = *engine::offset_by({}, 32 * kStep);
  const std::vector<double> found = places_after({.step = kStep}, end);
  EXPECT_EQ(found[0], 1 + kLate - (0.5 - kLate)) << "late by what it went too far, twice";
  const std::vector<double> backed = places_after({.step = kStep, .back_up = true}, end);
  EXPECT_NEAR(backed[0], 0.5, 1e-15);
  EXPECT_NEAR(backed[1], 2.5, 1e-15);
}

TEST(FixedStep, WithBackUpTheInstantOfAContactIsTold) {
  FixedStep world(kHeadOn, {}, {}, {.step = kStep, .back_up = true}, false);
  Log log;
  world.step_up_to({2, 0}, &log, kNoLimit);
  ASSERT_EQ(log.collisions.size(), 1U);
  EXPECT_NEAR(engine::seconds_between({}, log.collisions[0].instant), 1, 1e-15);
}

TEST(FixedStep, WithBackUpAWallsFaceAndEndThrowBackFromWhereTheyWereTouched) {
  const std::vector<WallSpec> face = {{.id = 9, .start = {2.5, -1}, .end = {2.5, 1}}};
  const std::vector<WallSpec> end = {{.id = 9, .start = {2.5, 0}, .end = {5, 0}}};
  for (const auto& walls : {face, end}) {
    FixedStep world(std::vector{disk(1, 0, 1)}, walls, {}, {.step = 0.375, .back_up = true}, false);
    world.step_up_to({3, 0}, nullptr, kNoLimit);
    world.for_each_disk([](const engine::BodyState& state) {
      EXPECT_NEAR(state.position.x(), 1, 1e-15) << "2 m there, 1 m back";
      EXPECT_EQ(state.velocity.x(), -1);
    });
  }
}

TEST(FixedStep, SubstepsFindWhatAsManyStepsWould) {
  const engine::Instant end = *engine::offset_by({}, 64 * kStep);
  EXPECT_EQ(places_after({.step = 4 * kStep, .substeps = 4}, end),
            places_after({.step = kStep}, end));
}

TEST(FixedStep, StoppingWithinAStepLosesNoTime) {
  FixedStep world(std::vector{disk(1, 0, 1)}, {}, {}, 0.25);
  for (int i = 1; i <= 10; ++i) {
    world.advance_to(*engine::offset_by({}, 0.1 * i), nullptr, kNoLimit);
  }
  world.for_each_disk(
      [](const engine::BodyState& state) { EXPECT_NEAR(state.position.x(), 1, 1e-15); });
}

TEST(StepAudit, CountsAContactThatASteppedWorldPassesOver) {
  const std::vector<WallSpec> walls = {{.id = 9, .start = {3, -1}, .end = {3, 1}}};
  FixedStep tunnel(std::vector{disk(1, 0, 1000)}, walls, {}, {.step = 0.01}, true);
  tunnel.step_up_to({1, 0}, nullptr, kNoLimit);
  EXPECT_EQ(tunnel.audit().missed(), 1U);
  const std::vector<DiskSpec> pair = {disk(1, 0, 1000), disk(2, 3, 0)};
  FixedStep shot(pair, {}, {}, {.step = 0.01}, true);
  shot.step_up_to({1, 0}, nullptr, kNoLimit);
  EXPECT_EQ(shot.audit().missed(), 1U);
}

TEST(StepAudit, TellsHowDeepAndMissesNothingWhereAStepIsFineEnough) {
  FixedStep world(kHeadOn, {}, {}, {.step = kStep}, true);
  world.step_up_to({2, 0}, nullptr, kNoLimit);
  EXPECT_EQ(world.audit().missed(), 0U);
  EXPECT_NEAR(world.audit().deepest(), 2 * kLate, 1e-15);
  const std::vector<WallSpec> walls = {{.id = 9, .start = {3, -1}, .end = {3, 1}}};
  FixedStep slow(std::vector{disk(1, 0, 1)}, walls, {}, {.step = 0.01}, true);
  slow.step_up_to({5, 0}, nullptr, kNoLimit);
  EXPECT_EQ(slow.audit().missed(), 0U);
}

TEST(UniformGrid, YieldsEveryPairThatTouchesExactlyOnce) {
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.399963 * i;
    disks.push_back(
        {.id = static_cast<engine::Id>(i + 1),
         .position = {0.3 * std::sqrt(i) * std::cos(angle), 0.3 * std::sqrt(i) * std::sin(angle)},
         .radius = i % 7 == 0 ? 0.5 : 0.1});
  }
  UniformGrid grid;
  grid.build(disks);
  std::set<std::pair<std::size_t, std::size_t>> seen;
  grid.for_each_pair([&](std::size_t a, std::size_t b) {
    EXPECT_LT(a, b);
    EXPECT_TRUE(seen.insert({a, b}).second);
  });
  for (std::size_t a = 0; a < disks.size(); ++a) {
    for (std::size_t b = a + 1; b < disks.size(); ++b) {
      const double reach = disks[a].radius + disks[b].radius;
      if ((disks[a].position - disks[b].position).norm() < reach) {
        EXPECT_TRUE(seen.contains({a, b})) << a << ' ' << b;
      }
    }
  }
}

}  // namespace
}  // namespace stoss::client::baseline

// SPDX-License-Identifier: Apache-2.0
// Replicas against the world that they copy: the same bits after every tick, whatever happens to
// the samples on the way.

#include "clients/motion_source.hpp"

#include <stoss/client/replica_model.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace stoss::client {
namespace {

using engine::Arithmetic;
using engine::BodyState;
using engine::WallState;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void expect_same_bits(const engine::Vector2& a, const engine::Vector2& b) {
  EXPECT_EQ(bits(a.x()), bits(b.x()));
  EXPECT_EQ(bits(a.y()), bits(b.y()));
}

/// Every disk and wall, at the world's present.
void expect_equal(const ReplicaModel& model, const engine::World& world) {
  ASSERT_TRUE(model.complete());
  ASSERT_EQ(model.size(), world.disk_count() + world.wall_count());
  engine::Id previous = engine::kNoId;
  model.for_each([&](const ReplicaBody& body) {
    EXPECT_GT(body.motion.id, previous);
    previous = body.motion.id;
    if (body.body.is_wall) {
      const WallState ours = model.wall_at(body, world.now());
      const WallState theirs = world.wall(body.motion.id).value();
      expect_same_bits(ours.start, theirs.start);
      expect_same_bits(ours.end, theirs.end);
      expect_same_bits(ours.velocity, theirs.velocity);
    } else {
      const BodyState ours = model.disk_at(body, world.now());
      const BodyState theirs = world.state(body.motion.id).value();
      expect_same_bits(ours.position, theirs.position);
      expect_same_bits(ours.velocity, theirs.velocity);
      EXPECT_EQ(bits(ours.radius), bits(theirs.radius));
      EXPECT_EQ(ours.kind, theirs.kind);
    }
  });
}

void apply_all(ReplicaModel& model, std::vector<MotionPart> parts) {
  for (MotionPart& part : parts) model.apply(std::move(part));
}

TEST(ReplicaModel, EqualsTheWorldToTheBitAfterEveryTick) {
  for (const Arithmetic arithmetic : {Arithmetic::Double, Arithmetic::Float}) {
    MotionSource source(1, arithmetic);
    ReplicaModel model(arithmetic);
    model.load(source.whole());
    for (int tick = 0; tick < 100; ++tick) {
      apply_all(model, source.tick());
      expect_equal(model, source.world());
      EXPECT_EQ(model.stamp().state_hash, source.world().state_hash());
    }
    EXPECT_EQ(model.counters().gaps, 0U);
    EXPECT_EQ(model.counters().contradictions, 0U);
  }
}

TEST(ReplicaModel, EqualsAPeriodicWorldToTheBit) {
  for (const Arithmetic arithmetic : {Arithmetic::Double, Arithmetic::Float}) {
    MotionSource source(7, arithmetic, {22.5, 0});
    ReplicaModel model(arithmetic, {22.5, 0});
    model.load(source.whole());
    bool is_elsewhere = false;  // a motion has run on across the border
    for (int tick = 0; tick < 100; ++tick) {
      apply_all(model, source.tick());
      expect_equal(model, source.world());
      EXPECT_EQ(model.period(), source.world().period());
      model.for_each([&](const ReplicaBody& body) {
        const double x = body.motion.x.high;
        is_elsewhere = is_elsewhere || x < 0 || x >= 22.5;
      });
    }
    EXPECT_TRUE(is_elsewhere);
    EXPECT_EQ(model.counters().contradictions, 0U);
  }
}

TEST(ReplicaModel, AnEvaluationAheadOfTheLastTickHoldsUntilTheNextEvent) {
  MotionSource source(2);
  ReplicaModel model;
  model.load(source.whole());
  engine::World ahead = source.world();
  // No disk meets another within a nanosecond of the beginning.
  const engine::Instant soon = {0, 18446744074U};
  ASSERT_EQ(ahead.advance_to(soon).value().collisions, 0U);
  expect_equal(model, ahead);
}

TEST(ReplicaModel, ATickIsSeenOnlyWhenItsLastPartIsThere) {
  MotionSource source(3);
  ReplicaModel model;
  model.load(source.whole());
  const engine::World before = source.world();
  std::vector<MotionPart> parts;
  while (parts.size() < 3) {
    apply_all(model, std::exchange(parts, {}));
    parts = source.tick(2);
  }
  const std::uint64_t tick = model.stamp().tick;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    model.apply(parts[i]);
    EXPECT_EQ(model.stamp().tick, tick);
  }
  model.apply(parts.back());
  EXPECT_EQ(model.stamp().tick, parts.back().tick);
  expect_equal(model, source.world());
}

TEST(ReplicaModel, BatchesThatCameBeforeTheWorldAreJoinedToIt) {
  MotionSource source(4);
  ReplicaModel model;
  apply_all(model, source.tick());
  apply_all(model, source.tick());
  const Answer whole = source.whole();
  apply_all(model, source.tick());
  apply_all(model, source.tick());
  EXPECT_FALSE(model.complete());
  model.load(whole);
  expect_equal(model, source.world());
  EXPECT_GT(model.counters().ignored, 0U);
}

TEST(ReplicaModel, AMissingBatchIsNoticedAndAnotherWorldMendsIt) {
  MotionSource source(5);
  ReplicaModel model;
  model.load(source.whole());
  apply_all(model, source.tick());
  std::vector<MotionPart> lost;
  while (lost.empty()) lost = source.tick();
  std::vector<MotionPart> after;
  while (after.empty()) after = source.tick();
  apply_all(model, std::move(after));
  EXPECT_FALSE(model.complete());
  EXPECT_EQ(model.counters().gaps, 1U);
  model.load(source.whole());
  expect_equal(model, source.world());
}

TEST(ReplicaModel, AWorldFromBeforeTheGapIsNotEnough) {
  MotionSource source(6);
  ReplicaModel model;
  const Answer old = source.whole();
  std::vector<MotionPart> lost;
  while (lost.empty()) lost = source.tick();
  apply_all(model, source.tick());
  std::vector<MotionPart> last;
  while (last.empty()) last = source.tick();
  apply_all(model, std::move(last));
  model.load(old);
  EXPECT_FALSE(model.complete());
  model.load(source.whole());
  expect_equal(model, source.world());
}

TEST(ReplicaModel, RepeatedAndLateBatchesChangeNothing) {
  MotionSource source(7);
  ReplicaModel model;
  model.load(source.whole());
  std::vector<MotionPart> all;
  for (int tick = 0; tick < 20; ++tick) {
    std::vector<MotionPart> parts = source.tick();
    apply_all(model, parts);
    all.insert(all.end(), parts.begin(), parts.end());
    apply_all(model, all);
  }
  expect_equal(model, source.world());
  EXPECT_GT(model.counters().ignored, 0U);
  EXPECT_EQ(model.counters().gaps, 0U);
}

TEST(ReplicaModel, WaitingBatchesMayComeInAnyOrder) {
  MotionSource source(8);
  ReplicaModel model;
  const Answer whole = source.whole();
  std::vector<MotionPart> all;
  for (int tick = 0; tick < 30; ++tick) {
    std::vector<MotionPart> parts = source.tick(3);
    all.insert(all.end(), parts.begin(), parts.end());
  }
  std::shuffle(all.begin(), all.end(), std::mt19937_64(9));
  apply_all(model, std::move(all));
  model.load(whole);
  expect_equal(model, source.world());
}

TEST(ReplicaModel, ANewEpochAsksForTheWorldAgain) {
  MotionSource source(10);
  ReplicaModel model;
  const Answer old = source.whole();
  model.load(old);
  model.apply(source.next_epoch());
  EXPECT_FALSE(model.complete());
  EXPECT_EQ(model.counters().epochs, 1U);
  model.load(old);
  EXPECT_FALSE(model.complete()) << "an answer of the old epoch must not count";
  model.load(source.whole());
  expect_equal(model, source.world());
  apply_all(model, source.tick());
  expect_equal(model, source.world());
  EXPECT_EQ(model.stamp().epoch, 2U);
}

TEST(ReplicaModel, WhatWaitsIsBounded) {
  MotionSource source(11);
  ReplicaModel model;
  MotionPart part;
  part.epoch = 1;
  for (std::uint64_t number = 1; number <= kPartsWaitingMax + 10; ++number) {
    part.number = number;
    model.apply(part);
  }
  EXPECT_EQ(model.waiting(), kPartsWaitingMax);
  EXPECT_EQ(model.counters().overflows, 10U);
}

TEST(ReplicaModel, AChangeOfABodyThatIsNotThereIsNoticed) {
  MotionSource source(12);
  ReplicaModel model;
  model.load(source.whole());
  MotionPart part;
  part.epoch = 1;
  part.number = model.stamp().number + 1;
  MotionChange change;
  change.motion.id = 999999;
  part.changes.push_back(change);
  model.apply(part);
  EXPECT_FALSE(model.complete());
  EXPECT_EQ(model.counters().contradictions, 1U);
  model.load(source.whole());
  expect_equal(model, source.world());
}

TEST(ReplicaModel, TellsOfEveryTickOnce) {
  MotionSource source(13);
  ReplicaModel model;
  std::vector<std::uint64_t> ticks;
  model.on_tick = [&ticks](const ReplicaModel& seen) { ticks.push_back(seen.stamp().tick); };
  model.load(source.whole());
  std::vector<std::uint64_t> expected = {0};
  for (int tick = 0; tick < 20; ++tick) {
    const std::vector<MotionPart> parts = source.tick(2);
    if (!parts.empty()) expected.push_back(parts.back().tick);
    apply_all(model, parts);
  }
  EXPECT_EQ(ticks, expected);
}

}  // namespace
}  // namespace stoss::client

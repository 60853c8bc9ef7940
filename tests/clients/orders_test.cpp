// SPDX-License-Identifier: Apache-2.0
// Putting samples in order: collisions without gaps, frames in whole, answers out of chunks.

#include "event_order.hpp"
#include "frame_order.hpp"
#include "pending.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

namespace stoss::client {
namespace {

using CollisionOrder = EventOrder<engine::Collision>;

std::vector<engine::Collision> collisions(std::uint64_t first, std::uint64_t count) {
  std::vector<engine::Collision> result(count);
  for (std::uint64_t i = 0; i < count; ++i) result[i].sequence = first + i;
  return result;
}

std::vector<std::uint64_t> numbers(const std::vector<engine::Collision>& run) {
  std::vector<std::uint64_t> result;
  for (const engine::Collision& collision : run) result.push_back(collision.sequence);
  return result;
}

using Numbers = std::vector<std::uint64_t>;

TEST(CollisionOrder, StartsWithTheFirstThatComes) {
  CollisionOrder order(std::nullopt);
  order.offer(1, collisions(40, 2));
  order.offer(1, collisions(42, 1));
  EXPECT_EQ(numbers(order.take()), (Numbers{40, 41, 42}));
  EXPECT_EQ(order.gaps(), 0U);
}

TEST(CollisionOrder, NamesWhatIsMissingAndGoesOnOnceItIsThere) {
  CollisionOrder order(std::nullopt);
  order.offer(1, collisions(1, 2));
  order.offer(1, collisions(6, 1));
  EXPECT_EQ(numbers(order.take()), (Numbers{1, 2}));
  ASSERT_TRUE(order.missing());
  EXPECT_EQ(order.missing()->first, 3U);
  EXPECT_EQ(order.missing()->count, 3U);
  order.offer(1, collisions(3, 3));
  EXPECT_EQ(numbers(order.take()), (Numbers{3, 4, 5, 6}));
  EXPECT_EQ(order.gaps(), 1U);
  EXPECT_EQ(order.lost(), 0U);
}

TEST(CollisionOrder, OverlappingAndRepeatedBatchesAreDeliveredOnce) {
  CollisionOrder order(5);
  order.offer(1, collisions(1, 6));
  order.offer(1, collisions(4, 5));
  order.offer(1, collisions(4, 5));
  EXPECT_EQ(numbers(order.take()), (Numbers{5, 6, 7, 8}));
  EXPECT_FALSE(order.missing());
}

TEST(CollisionOrder, WhatIsNoLongerToBeHadIsCountedAsLost) {
  CollisionOrder order(1);
  order.offer(1, collisions(4, 1));
  EXPECT_TRUE(order.take().empty());
  order.give_up();
  EXPECT_EQ(order.lost(), 3U);
  EXPECT_EQ(numbers(order.take()), (Numbers{4}));
}

TEST(CollisionOrder, ANewEpochBeginsAtOne) {
  CollisionOrder order(std::nullopt);
  order.offer(1, collisions(7, 1));
  static_cast<void>(order.take());
  order.offer(2, collisions(2, 1));
  ASSERT_TRUE(order.missing());
  EXPECT_EQ(order.missing()->first, 1U);
  order.offer(1, collisions(8, 1));  // from before the reset
  order.offer(2, collisions(1, 1));
  EXPECT_EQ(numbers(order.take()), (Numbers{1, 2}));
}

Frame chunk(std::uint64_t tick, std::initializer_list<engine::Id> ids) {
  Frame frame{.epoch = 1, .tick = tick, .at = {static_cast<std::int64_t>(tick), 0}, .bodies = {}};
  for (const engine::Id id : ids) frame.bodies.push_back({.id = id});
  return frame;
}

TEST(FrameOrder, AFrameIsWholeWhenAllItsChunksAreThere) {
  FrameOrder order;
  EXPECT_FALSE(order.add(chunk(1, {3}), 1, 2));
  const auto frame = order.add(chunk(1, {1, 2}), 0, 2);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->bodies.size(), 3U);
  EXPECT_EQ(frame->bodies[0].id, 1U);
  EXPECT_EQ(frame->bodies[2].id, 3U);
}

TEST(FrameOrder, ChunksOfTwoFramesMayMix) {
  FrameOrder order;
  EXPECT_FALSE(order.add(chunk(1, {1}), 0, 2));
  EXPECT_FALSE(order.add(chunk(2, {1}), 0, 2));
  EXPECT_TRUE(order.add(chunk(1, {2}), 1, 2));
  EXPECT_TRUE(order.add(chunk(2, {2}), 1, 2));
}

TEST(FrameOrder, AnOlderFrameIsNotShownAfterANewerOne) {
  FrameOrder order;
  EXPECT_FALSE(order.add(chunk(1, {1}), 0, 2));
  EXPECT_TRUE(order.add(chunk(2, {1}), 0, 1));
  EXPECT_FALSE(order.add(chunk(1, {2}), 1, 2));
}

TEST(FrameOrder, AWorldWithoutDisksHasFramesToo) {
  FrameOrder order;
  EXPECT_TRUE(order.add(chunk(1, {}), 0, 1));
  EXPECT_FALSE(order.add(chunk(2, {}), 3, 1)) << "a chunk beyond the count";
}

SteadyTime at(int milliseconds) { return SteadyTime{} + Milliseconds(milliseconds); }

Answer answer(std::uint64_t tick, engine::Id id) {
  Answer result;
  result.tick = tick;
  result.bodies.push_back({});
  result.bodies.back().state.id = id;
  return result;
}

TEST(PendingRequests, AnAnswerIsPutTogetherInTheOrderOfItsChunks) {
  PendingRequests pending;
  pending.add(1, PendingQuery{.deadline = at(1000), .resend = at(500)});
  EXPECT_FALSE(pending.add_chunk(1, 1, 2, answer(7, 20), at(0)));
  EXPECT_FALSE(pending.add_chunk(1, 1, 2, answer(7, 20), at(0))) << "the same chunk twice";
  const auto whole = pending.add_chunk(1, 0, 2, answer(7, 10), at(0));
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->bodies.size(), 2U);
  EXPECT_EQ(whole->bodies[0].state.id, 10U);
  EXPECT_EQ(whole->bodies[1].state.id, 20U);
}

TEST(PendingRequests, ChunksOfTwoAnswersToOneQuestionAreNotMixed) {
  PendingRequests pending;
  pending.add(1, PendingQuery{.deadline = at(1000), .resend = at(500)});
  EXPECT_FALSE(pending.add_chunk(1, 0, 2, answer(7, 10), at(0)));
  EXPECT_FALSE(pending.add_chunk(1, 0, 2, answer(8, 11), at(0)));
  const auto whole = pending.add_chunk(1, 1, 2, answer(8, 21), at(0));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->bodies[0].state.id, 11U);
}

TEST(PendingRequests, ChunksOfWhatWasNotAskedAreIgnored) {
  PendingRequests pending;
  EXPECT_FALSE(pending.add_chunk(9, 0, 1, answer(1, 1), at(0)));
  pending.add(1, PendingQuery{.deadline = at(1000), .resend = at(500)});
  EXPECT_FALSE(pending.add_chunk(1, 2, 2, answer(1, 1), at(0)));
  EXPECT_FALSE(pending.add_chunk(1, 0, 0, answer(1, 1), at(0)));
}

TEST(PendingRequests, CommandsAreSentAgainUntilTheirDeadline) {
  PendingRequests pending;
  pending.add(4, PendingCommand{.deadline = at(1000), .resend = at(200)});
  EXPECT_TRUE(pending.due(at(199)).commands_to_send.empty());
  EXPECT_EQ(pending.due(at(200)).commands_to_send, (std::vector<std::uint64_t>{4}));
  EXPECT_TRUE(pending.due(at(399)).commands_to_send.empty());
  EXPECT_EQ(pending.due(at(400)).commands_to_send.size(), 1U);
  const Due last = pending.due(at(1000));
  EXPECT_TRUE(last.commands_to_send.empty());
  EXPECT_EQ(last.silent_commands.size(), 1U);
  EXPECT_TRUE(pending.empty());
}

TEST(PendingRequests, AReplyCompletesItsCommandOnce) {
  PendingRequests pending;
  pending.add(4, PendingCommand{.deadline = at(1000), .resend = at(200)});
  EXPECT_TRUE(pending.take_command(4));
  EXPECT_FALSE(pending.take_command(4));
}

}  // namespace
}  // namespace stoss::client

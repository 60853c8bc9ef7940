// SPDX-License-Identifier: Apache-2.0
// The daemon's queues and tables on their own: their order and their bounds.
#include "fixture.hpp"

#include <admission.hpp>
#include <intake.hpp>
#include <log.hpp>
#include <pacer.hpp>
#include <reply_table.hpp>
#include <watch_table.hpp>
#include <world_lock.hpp>

namespace stoss::service::testing {
namespace {

TEST(AdmissionGate, HoldsToItsBoundsAndGivesPlacesBack) {
  Admission gate({2, 3, 100});
  auto first = gate.admit(client(1), 10);
  auto second = gate.admit(client(1), 10);
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(gate.admit(client(1), 10)) << "a client's own bound";
  EXPECT_FALSE(gate.admit(client(2), 90)) << "the bound of memory";
  auto third = gate.admit(client(2), 10);
  ASSERT_TRUE(third);
  EXPECT_FALSE(gate.admit(client(3), 10)) << "the bound of all";
  first.reset();
  EXPECT_TRUE(gate.admit(client(3), 10));
  EXPECT_EQ(gate.count(), 2U);
}

TEST(AdmissionGate, LetsInOneThatIsLargerThanTheBoundWhenItIsAlone) {
  Admission gate({2, 3, 100});
  const auto large = gate.admit(client(1), 1000);
  EXPECT_TRUE(large);
  EXPECT_FALSE(gate.admit(client(2), 1));
}

TEST(InboxQueue, TakesOneOfEachClientInTurnAndKeepsEachClientsOrder) {
  Inbox inbox;
  const auto push = [&](std::uint8_t name, std::uint64_t number) {
    CommandItem item;
    item.spec.request = {client(name), number};
    inbox.push(std::move(item));
  };
  for (std::uint64_t number = 1; number <= 4; ++number) push(1, number);
  push(2, 1);
  push(3, 1);
  std::vector<RequestId> order;
  for (const std::size_t most : {2U, 2U, 5U}) {
    for (const CommandItem& item : inbox.take_commands(most)) order.push_back(item.spec.request);
  }
  const std::vector<RequestId> expected = {{client(1), 1},
                                           {client(2), 1},
                                           {client(3), 1},
                                           {client(1), 2},
                                           {client(1), 3},
                                           {client(1), 4}};
  EXPECT_EQ(order, expected);
  EXPECT_FALSE(inbox.has_commands());
}

TEST(OutboxQueue, BoundsRefusalsThatHaveNoTicket) {
  Outbox outbox;
  for (std::size_t i = 0; i < kUnticketedMax; ++i) {
    ASSERT_TRUE(outbox.push_refusal(ReplyRecord{}));
  }
  EXPECT_FALSE(outbox.push_refusal(ReplyRecord{}));
  EXPECT_EQ(outbox.refusals_dropped(), 1U);
  EXPECT_EQ(outbox.take(Nanoseconds::zero()).size(), kUnticketedMax);
  EXPECT_TRUE(outbox.push_refusal(ReplyRecord{}));
}

TEST(Replies, AreKeptForTheLatestClientsOnly) {
  ReplyTable table;
  const auto numbered = [](std::size_t i) {
    ClientId id{};
    id[0] = static_cast<std::uint8_t>(i % 256);
    id[1] = static_cast<std::uint8_t>(i / 256);
    return id;
  };
  const RequestId waiting{client(0xff), 1};
  ASSERT_TRUE(std::holds_alternative<ReplyTable::New>(table.admit(waiting)));
  for (std::size_t i = 0; i < kClientsMax + 50; ++i) {
    ReplyRecord reply;
    reply.request = {numbered(i), 1};
    static_cast<void>(table.admit(reply.request));
    table.finish(reply);
  }
  EXPECT_LE(table.client_count(), kClientsMax);
  EXPECT_TRUE(std::holds_alternative<ReplyTable::Waiting>(table.admit(waiting)))
      << "a client whose reply is to come is not forgotten";
  EXPECT_TRUE(std::holds_alternative<ReplyTable::New>(table.admit({numbered(3), 1})));
  EXPECT_TRUE(std::holds_alternative<ReplyRecord>(table.admit({numbered(kClientsMax + 49), 1})));
}

TEST(Replies, TakeABoundedAmountOfMemory) {
  ReplyTable table;
  for (std::uint64_t number = 1; number <= 100; ++number) {
    ReplyRecord reply;
    reply.request = {client(1), number};
    reply.ids.resize(1024);
    static_cast<void>(table.admit(reply.request));
    table.finish(reply);
  }
  EXPECT_TRUE(std::holds_alternative<ReplyRecord>(table.admit({client(1), 100})));
  EXPECT_TRUE(std::holds_alternative<ReplyTable::Forgotten>(table.admit({client(1), 50})));
}

TEST(Refusals, AreRememberedForAWhile) {
  RefusalLog log;
  for (std::uint64_t number = 1; number <= kRefusalsKept + 1; ++number) {
    log.add({client(1), number});
  }
  EXPECT_FALSE(log.contains({client(1), 1}));
  EXPECT_TRUE(log.contains({client(1), 2}));
}

TEST(Watches, GiveOutSlotsAndTakeThemBack) {
  WatchTable table;
  std::vector<WatchRecord> news;
  const std::vector<engine::Id> ids = {10, 20, 20};
  ASSERT_TRUE(table.watch(client(1), ids, news));
  ASSERT_EQ(news.size(), 2U);
  EXPECT_EQ(news[1].slot, 1U);
  ASSERT_TRUE(table.watch(client(2), std::vector<engine::Id>{20}, news));
  EXPECT_EQ(news.size(), 2U) << "it is watched already";
  news.clear();
  table.unwatch(client(1), ids, news);
  ASSERT_EQ(news.size(), 1U) << "the other client still watches 20";
  EXPECT_EQ(news[0].slot, 0U);
  EXPECT_EQ(news[0].id, engine::kNoId);
  table.drop_client(client(2), news);
  EXPECT_EQ(table.size(), 0U);

  std::vector<engine::Id> many(WatchTable::kSlots + 1);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = i + 1;
  news.clear();
  EXPECT_FALSE(table.watch(client(1), many, news));
  EXPECT_EQ(table.size(), 0U) << "all or none";
  many.pop_back();
  EXPECT_TRUE(table.watch(client(1), many, news));
}

TEST(LogBudget, LetsABurstThroughAndThenATrickle) {
  LineBudget budget(3, 1);
  Nanoseconds now{1'000'000'000};
  int through = 0;
  for (int i = 0; i < 10; ++i) through += budget.take(now) ? 1 : 0;
  EXPECT_EQ(through, 3);
  EXPECT_EQ(budget.take_suppressed(), 7U);
  now += Nanoseconds(1'000'000'000);
  EXPECT_TRUE(budget.take(now));
  EXPECT_FALSE(budget.take(now));
}

TEST(Pace, DueTimesDoNotDriftOverALongRun) {
  Pacer pacer(60, 1);
  pacer.anchor(Nanoseconds(0), {});
  const auto clock = engine::TickClock::from_rate({}, 60).value();
  constexpr std::uint64_t kTicksOfAMonth = 60ULL * 86'400 * 30;
  EXPECT_NEAR(static_cast<double>(pacer.due(clock.instant_of(kTicksOfAMonth)).count()),
              86'400e9 * 30,
              1000);
}

TEST(Pace, CatchesUpFourTicksOrFiftyMilliseconds) {
  EXPECT_EQ(Pacer(60, 1).catch_up_ticks(), 4U);
  EXPECT_EQ(Pacer(1000, 1).catch_up_ticks(), 50U);
  EXPECT_EQ(Pacer(1000, 2).catch_up_ticks(), 100U);
  EXPECT_EQ(Pacer(1e6, 10).catch_up_ticks(), kCatchUpTicksMax);
}

TEST(NameOfAWorld, IsTakenByOneAtATime) {
  auto first = WorldLock::take(7, "queues-test");
  ASSERT_TRUE(first);
  EXPECT_FALSE(WorldLock::take(7, "queues-test"));
  EXPECT_TRUE(WorldLock::take(8, "queues-test"));
  EXPECT_TRUE(WorldLock::take(7, "queues-test-2"));
  first.reset();
  EXPECT_TRUE(WorldLock::take(7, "queues-test"));
}

}  // namespace
}  // namespace stoss::service::testing

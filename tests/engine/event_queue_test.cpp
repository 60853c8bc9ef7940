// SPDX-License-Identifier: Apache-2.0
// The event queue against a sorted list, with ties of every rank.
#include "event_queue.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;
using Queue = EventQueue<double>;
/// With so short a ring that most of a few hundred events are filed in stretches beyond it.
using QueueOfShortRing = EventQueue<double, 64>;

/// Slot s has id 1000 - s, so that the order of slots is not that of ids.
const auto kIds = [](std::int32_t slot, const Event<double>& event) {
  const auto own = static_cast<Id>(1000 - slot);
  const auto other = event.partner < 0 ? own : static_cast<Id>(1000 - event.partner);
  return own < other ? IdPair{own, other} : IdPair{other, own};
};

Event<double> event_at(std::int64_t seconds, EventKind kind, std::int32_t partner) {
  return {Instant{seconds, 0}, partner, 0, kind};
}

/// The slot of the first event, the slow way.
std::int32_t first_of(const std::map<std::int32_t, Event<double>>& events) {
  const auto first =
      std::min_element(events.begin(), events.end(), [](const auto& a, const auto& b) {
        return earlier(a.second, a.first, b.second, b.first, kIds);
      });
  return first->first;
}

TEST(EventQueue, OrdersByInstantThenKindThenLowerThenHigherId) {
  Queue queue;
  for (std::int32_t slot = 0; slot < 10; ++slot) queue.admit(slot);
  queue.set(0, event_at(5, EventKind::DiskWallEnd, 9), kIds);
  queue.set(1, event_at(5, EventKind::DiskWall, 9), kIds);
  queue.set(2, event_at(5, EventKind::DiskDisk, 3), kIds);  // ids 997, 998
  queue.set(4, event_at(5, EventKind::DiskDisk, 7), kIds);  // ids 993, 996
  queue.set(5, event_at(5, EventKind::DiskDisk, 7), kIds);  // ids 993, 995
  queue.set(6, event_at(5, EventKind::NeighbourRenewal, -1), kIds);
  queue.set(8, event_at(4, EventKind::DiskWallEnd, 9), kIds);
  std::vector<std::int32_t> order;
  while (!queue.empty()) {
    order.push_back(queue.top(kIds));
    queue.erase(queue.top(kIds), kIds);
  }
  EXPECT_EQ(order, (std::vector<std::int32_t>{8, 6, 5, 4, 2, 1, 0}));
}

TEST(EventQueue, AnEventThatNeverComesLeavesIt) {
  Queue queue;
  queue.admit(0);
  queue.set(0, event_at(5, EventKind::DiskDisk, 1), kIds);
  queue.set(0, Event<double>{}, kIds);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.event_of(0).at, Instant::never());
  queue.erase(0, kIds);  // absent: nothing happens
  EXPECT_TRUE(queue.empty());
}

TEST(EventQueue, AgreesWithASortedListUnderRandomWork) {
  Random random(test::seed_of_run());
  Queue queue;
  std::map<std::int32_t, Event<double>> reference;
  for (int i = 0; i < 200'000; ++i) {
    const auto slot = static_cast<std::int32_t>(random.below(60));
    queue.admit(slot);
    if (random.one_in(4)) {
      queue.erase(slot, kIds);
      reference.erase(slot);
    } else {
      // Few instants and kinds: ties all the time.
      const auto event = event_at(static_cast<std::int64_t>(random.below(6)),
                                  static_cast<EventKind>(random.below(4)),
                                  static_cast<std::int32_t>(random.below(60)));
      queue.set(slot, event, kIds);
      reference[slot] = event;
    }
    ASSERT_EQ(queue.empty(), reference.empty());
    if (reference.empty()) continue;
    const std::int32_t top = queue.top(kIds);
    const std::int32_t expected = first_of(reference);
    // Two slots may hold events of one pair; those are equal.
    ASSERT_FALSE(earlier(reference[top], top, reference[expected], expected, kIds));
    ASSERT_FALSE(earlier(reference[expected], expected, reference[top], top, kIds));
    ASSERT_EQ(queue.event_of(top).at, reference[top].at);
  }
}

/// Works a queue of `slots` off for a while: each event brings new ones, `step` after the last.
/// Half of the slots keep theirs until they come.
template <class AnyQueue = QueueOfShortRing, class Step>
void run_dry_against_a_sorted_list(std::int32_t slots, int rounds, Step&& step) {
  AnyQueue queue;
  std::map<std::int32_t, Event<double>> reference;
  const auto plan = [&](std::int32_t slot, const Instant& now) {
    Event<double> event{step(now), slot ^ 1, 0, EventKind::DiskDisk};
    queue.admit(slot);
    queue.set(slot, event, kIds);
    if (event.at == Instant::never()) {
      reference.erase(slot);
    } else {
      reference[slot] = event;
    }
  };
  for (std::int32_t slot = 0; slot < slots; ++slot) plan(slot, {});
  Instant last{-kSecondsMax, 0};
  for (int i = 0; i < rounds && !reference.empty(); ++i) {
    ASSERT_EQ(queue.size(), reference.size());
    const std::int32_t top = queue.top(kIds);
    const std::int32_t expected = first_of(reference);
    ASSERT_FALSE(earlier(reference[expected], expected, reference[top], top, kIds));
    ASSERT_GE(queue.event_of(top).at, last);
    last = queue.event_of(top).at;
    plan(top, last);
    plan((top * 7 + i) % (slots / 2), last);
  }
}

TEST(EventQueue, KeepsItsOrderWhileItsTimeScaleChangesByManyDecades) {
  Random random(test::seed_of_run());
  int events = 0;
  run_dry_against_a_sorted_list(300, 8'000, [&](const Instant& now) {
    const double scale = ++events % 3000 < 1500 ? 1e-12 : 1e3;
    return *later_by(now, scale * random.uniform(0, 1), 0.0);
  });
}

TEST(EventQueue, KeepsItsOrderWithEventsFarBeyondALapAndNever) {
  Random random(test::seed_of_run());
  run_dry_against_a_sorted_list(300, 8'000, [&](const Instant& now) {
    if (random.one_in(20)) return Instant::never();
    return *later_by(now, random.decades(-18, 9), 0.0);
  });
}

// The ring of buckets turns again and again, with ever some events beyond all stretches, and a few
// so far beyond that those turn, too, before they come.
TEST(EventQueue, KeepsItsOrderWhileItsBucketsGoRoundAndRound) {
  Random random(test::seed_of_run());
  const auto step = [&](const Instant& now) {
    const double wait = -std::log(random.uniform(1e-9, 1));
    return *later_by(now, random.one_in(50) ? 30 * wait : wait, 0.0);
  };
  run_dry_against_a_sorted_list<QueueOfShortRing>(300, 20'000, step);
  run_dry_against_a_sorted_list<Queue>(300, 20'000, step);
}

// Nobody's turn comes, so that nothing is ever looked through: the queue has to tidy up what has
// been rescheduled over and over.
TEST(EventQueue, KeepsItsOrderAndLittleMemoryWhileTimeStandsStillAndAllIsRescheduled) {
  Random random(test::seed_of_run());
  QueueOfShortRing queue;
  std::map<std::int32_t, Event<double>> reference;
  constexpr std::int32_t kSlots = 300;
  const auto plan = [&](std::int32_t slot) {
    const auto event =
        event_at(static_cast<std::int64_t>(random.below(1'000'000)), EventKind::DiskDisk, slot ^ 1);
    queue.admit(slot);
    queue.set(slot, event, kIds);
    reference[slot] = event;
  };
  for (std::int32_t slot = 0; slot < kSlots; ++slot) plan(slot);
  for (int again = 0; again < 3; ++again) {
    static_cast<void>(queue.top(kIds));  // so that buckets are cut
    for (int i = 0; i < 100'000; ++i) plan(static_cast<std::int32_t>(random.below(kSlots)));
    EXPECT_LT(queue.entries_kept(), 10'000U);
  }
  std::size_t left = 0;
  queue.for_each([&](std::int32_t) { ++left; });
  EXPECT_EQ(left, reference.size());
  while (!reference.empty()) {
    const std::int32_t top = queue.top(kIds);
    ASSERT_EQ(queue.event_of(top).at, reference[first_of(reference)].at);
    queue.erase(top, kIds);
    reference.erase(top);
  }
  EXPECT_TRUE(queue.empty());
}

// So few that most stretches are empty and are passed together, to where one begins, while some
// wait beyond them all.
TEST(EventQueue, KeepsItsOrderWhereFewWaitForTimesOfAllLengths) {
  Random random(test::seed_of_run());
  for (int world = 0; world < 200; ++world) {
    const auto long_wait = static_cast<std::int64_t>(1) << random.below(20);
    run_dry_against_a_sorted_list(8, 500, [&](const Instant& now) {
      const std::int64_t wait = random.one_in(2) ? long_wait : 1;
      return Instant{now.seconds + wait * static_cast<std::int64_t>(random.below(12)), 0};
    });
  }
}

// All wait for one that comes up again and again: most buckets are empty, and what is beyond the
// lap is most of all.
TEST(EventQueue, KeepsItsOrderWhereOneIsAMillionTimesAsFastAsTheRest) {
  Random random(test::seed_of_run());
  int events = 0;
  run_dry_against_a_sorted_list(300, 8'000, [&](const Instant& now) {
    const double scale = ++events <= 300 || random.one_in(200) ? 1e6 : 1;
    return *later_by(now, scale * random.uniform(0, 1), 0.0);
  });
}

TEST(EventQueue, KeepsItsOrderWhenAllEventsFallOnFewInstants) {
  Random random(test::seed_of_run());
  run_dry_against_a_sorted_list(300, 8'000, [&](const Instant& now) {
    return Instant{now.seconds + static_cast<std::int64_t>(random.below(2)), 0};
  });
}

TEST(EventQueue, TellsEventsATickApartWhereBucketsAreHoursWideAndInstantsNegative) {
  Random random(test::seed_of_run());
  constexpr Instant kBegin{-(std::int64_t{1} << 40), 0};
  run_dry_against_a_sorted_list(300, 8'000, [&](const Instant& now) {
    const std::int64_t hours = static_cast<std::int64_t>(random.below(500)) * 36'000;
    const auto few = static_cast<Int128>(random.below(3));
    const Instant from = now == Instant{} ? kBegin : now;
    return instant_from_ticks(ticks(from) + (static_cast<Int128>(hours) << 64) + few);
  });
}

TEST(EventQueue, TakesAnEventBeforeTheOneThatIsOpen) {
  Queue queue;
  for (std::int32_t slot = 0; slot < 3; ++slot) queue.admit(slot);
  queue.set(0, event_at(5, EventKind::DiskDisk, 1), kIds);
  queue.set(1, event_at(9, EventKind::DiskDisk, 2), kIds);
  EXPECT_EQ(queue.top(kIds), 0);
  queue.set(2, event_at(-4, EventKind::DiskDisk, 1), kIds);
  EXPECT_EQ(queue.top(kIds), 2);
}

}  // namespace
}  // namespace stoss::engine

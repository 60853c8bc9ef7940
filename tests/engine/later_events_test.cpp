// SPDX-License-Identifier: Apache-2.0
// Entries by stretches of time against lists of them, and what becomes of their memory.
#include "later_events.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;
/// Slots by their places.
using Entries = std::map<std::int32_t, std::int32_t>;

Entries entries_of(const LaterEvents& later, std::size_t stretch) {
  Entries found;
  later.for_each(stretch, [&](std::int32_t slot, std::int32_t place) { found[place] = slot; });
  return found;
}

TEST(LaterEvents, GivesEachEntryAPlaceOfItsOwnUntilItIsTaken) {
  Random random(test::seed_of_run());
  constexpr std::size_t kStretches = 8;
  LaterEvents later;
  later.set_stretches(kStretches);
  std::vector<Entries> expected(kStretches);
  for (int i = 0; i < 100'000; ++i) {
    const std::size_t stretch = random.below(kStretches);
    if (!random.one_in(200)) {
      const std::int32_t place = later.add(stretch, i);
      for (const Entries& entries : expected) ASSERT_FALSE(entries.contains(place));
      expected[stretch][place] = i;
      continue;
    }
    ASSERT_EQ(later.is_empty(stretch), expected[stretch].empty());
    ASSERT_EQ(entries_of(later, stretch), expected[stretch]);
    std::size_t announced = 0;
    Entries taken;
    later.take_all(
        stretch,
        [&](std::int32_t) { ++announced; },
        [&](std::int32_t slot, std::int32_t place) { taken[place] = slot; });
    ASSERT_EQ(announced, taken.size());
    ASSERT_EQ(taken, std::exchange(expected[stretch], {}));
    ASSERT_TRUE(later.is_empty(stretch));
  }
}

TEST(LaterEvents, TakesEntriesOfAStretchWhileOthersAreAddedToIt) {
  LaterEvents later;
  later.set_stretches(4);
  for (std::int32_t slot = 0; slot < 1000; ++slot) later.add(2, slot);
  Entries kept;
  later.take_all(
      2,
      [](std::int32_t) {},
      [&](std::int32_t slot, std::int32_t) {
        if (slot % 3 == 0) kept[later.add(2, slot)] = slot;
      });
  EXPECT_EQ(kept.size(), 334U);
  EXPECT_EQ(entries_of(later, 2), kept);
}

TEST(LaterEvents, UsesTheMemoryOfWhatWasTakenAgain) {
  LaterEvents later;
  later.set_stretches(4);
  constexpr std::int32_t kSlots = 1000;
  EXPECT_FALSE(later.is_wasteful(0));
  std::int32_t largest = 0;
  for (int round = 0; round < 10; ++round) {
    for (std::int32_t slot = 0; slot < kSlots; ++slot) {
      const std::int32_t place = later.add(static_cast<std::size_t>(slot % 4), slot);
      if (round == 0) largest = std::max(largest, place);
      ASSERT_LT(place, largest + 16);  // another order of the same memory
    }
    EXPECT_FALSE(later.is_wasteful(kSlots));
    EXPECT_TRUE(later.is_wasteful(kSlots / 4));
    EXPECT_GE(later.entries_kept(), std::size_t{kSlots});
    later.clear();
    EXPECT_EQ(later.entries_kept(), 0U);
  }
}

}  // namespace
}  // namespace stoss::engine

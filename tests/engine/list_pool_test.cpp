// SPDX-License-Identifier: Apache-2.0
// Lists in one piece of memory against lists of their own.
#include "broad_phase/list_pool.hpp"

#include "grow.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;
using Items = std::vector<std::int32_t>;

constexpr std::size_t kLists = 60;

struct Lists {
  ListPool pool;
  std::vector<PooledList> pooled = std::vector<PooledList>(kLists);
  std::vector<Items> expected = std::vector<Items>(kLists);

  void pack() {
    pool.pack([this](const auto& visit) {
      for (PooledList& list : pooled) visit(list);
    });
  }
  void expect_the_same() const {
    for (std::size_t i = 0; i < kLists; ++i) {
      const auto items = pool.items(pooled[i]);
      Items sorted(items.begin(), items.end());
      std::sort(sorted.begin(), sorted.end());
      ASSERT_EQ(sorted, expected[i]);
      ASSERT_EQ(pool.size(pooled[i]), expected[i].size());
    }
  }
};

Items random_items(Random& random) {
  Items items(random.one_in(4) ? 0 : random.below(70));
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = static_cast<std::int32_t>(3 * i);
  return items;
}

// Takes an item in that is not in, or out.
void push_or_erase(Lists& lists, std::size_t i, std::int32_t item) {
  Items& expected = lists.expected[i];
  const auto at = std::lower_bound(expected.begin(), expected.end(), item);
  if (at != expected.end() && *at == item) {
    lists.pool.erase(lists.pooled[i], item);
    expected.erase(at);
  } else {
    lists.pool.erase(lists.pooled[i], item);  // which is not there
    lists.pool.push(lists.pooled[i], item);
    expected.insert(at, item);
  }
}

TEST(ListPool, HoldsWhatListsOfTheirOwnWouldUnderRandomWork) {
  Random random(test::seed_of_run());
  Lists lists;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t which = random.below(kLists);
    if (random.one_in(20)) {
      lists.expected[which] = random_items(random);
      lists.pool.assign(lists.pooled[which], lists.expected[which]);
    } else if (random.one_in(20)) {
      lists.expected[which].clear();
      lists.pool.release(lists.pooled[which]);
    } else {
      push_or_erase(lists, which, static_cast<std::int32_t>(random.below(40)));
    }
    if (random.one_in(200)) lists.pack();
    ASSERT_NO_FATAL_FAILURE(lists.expect_the_same());
  }
}

// A list that becomes empty leaves its room to others; of many, their memory is given back.
TEST(ListPool, EmptyListsHaveNoRoom) {
  Lists lists;
  for (PooledList& list : lists.pooled) lists.pool.assign(list, Items(100, 1));
  EXPECT_FALSE(lists.pool.is_mostly_free(0));
  for (std::size_t i = 1; i < kLists; ++i) {
    for (int item = 0; item < 100; ++item) lists.pool.erase(lists.pooled[i], 1);
    EXPECT_EQ(lists.pooled[i].head, 0U);
  }
  EXPECT_TRUE(lists.pool.is_mostly_free(1000));
  lists.pack();
  EXPECT_FALSE(lists.pool.is_mostly_free(0));
  EXPECT_EQ(lists.pool.size(lists.pooled[0]), 100U);
}

TEST(Grow, LeavesLittleOfMuchIdle) {
  std::vector<std::int32_t> lines;
  std::size_t grown = 0;
  for (std::size_t i = 0; i < 1'000'000; ++i) {
    const std::size_t before = lines.capacity();
    make_line_of(i, lines);
    if (lines.capacity() == before) continue;
    ++grown;
    if (i > 100'000) {
      ASSERT_LE(4 * lines.capacity(), 5 * lines.size());
    }
  }
  EXPECT_LT(grown, 40U);
  make_room_for(5'000'000, lines);
  EXPECT_EQ(lines.capacity(), 6'000'000U);
}

}  // namespace
}  // namespace stoss::engine

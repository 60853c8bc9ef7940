// SPDX-License-Identifier: Apache-2.0
// Items in cells against a search through all of them.
#include "broad_phase/cell_store.hpp"

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
using Cell = CellStore::Cell;
using Range = CellStore::Range;

constexpr std::int32_t kItems = 400;

/// Some crowd into few cells, some stand by themselves far away; on two levels.
Cell random_cell(Random& random) {
  const auto number = [&](int far) {
    const auto near = static_cast<std::int64_t>(random.below(13)) - 6;
    return random.one_in(10)
               ? near * (std::int64_t{1} << random.below(static_cast<std::uint64_t>(far)))
               : near;
  };
  return {number(40), number(40), static_cast<std::int32_t>(random.below(2))};
}

std::vector<std::int32_t> items_in(const std::map<std::int32_t, Cell>& cells,
                                   const Range& range,
                                   std::int32_t level,
                                   std::int32_t but_for) {
  std::vector<std::int32_t> items;
  for (const auto& [item, cell] : cells) {
    const bool is_in = cell.level == level && cell.x >= range.x0 && cell.x <= range.x1 &&
                       cell.y >= range.y0 && cell.y <= range.y1;
    if (is_in && item != but_for) items.push_back(item);
  }
  return items;
}

std::vector<std::int32_t> sorted(std::vector<std::int32_t> items) {
  std::sort(items.begin(), items.end());
  return items;
}

Range around(const Cell& cell, std::int64_t by) {
  return {cell.x - by, cell.y - by, cell.x + by, cell.y + by};
}

// The three cells on each of the four sides.
void expect_found_beside(const CellStore& store,
                         const std::map<std::int32_t, Cell>& cells,
                         std::int32_t item) {
  const Cell& own = cells.at(item);
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const Range side{own.x + (dx != 0 ? dx : -1),
                     own.y + (dy != 0 ? dy : -1),
                     own.x + (dx != 0 ? dx : 1),
                     own.y + (dy != 0 ? dy : 1)};
    std::vector<std::int32_t> room(kItems + kWrittenBeyond);
    room.resize(
        static_cast<std::size_t>(store.collect_beside(item, dx, dy, room.data()) - room.data()));
    ASSERT_EQ(sorted(room), items_in(cells, side, own.level, item));
  }
}

void expect_found(const CellStore& store,
                  const std::map<std::int32_t, Cell>& cells,
                  std::int32_t item,
                  const Range& near) {
  const Cell& own = cells.at(item);
  ASSERT_EQ(store.cell_of(item), own);
  std::vector<std::int32_t> room(kItems + kWrittenBeyond);
  const auto written = [&room](const std::int32_t* end) {
    return sorted(std::vector<std::int32_t>(room.cbegin(), room.cbegin() + (end - room.data())));
  };
  ASSERT_EQ(written(store.collect_around(item, room.data())),
            items_in(cells, around(own, 1), own.level, item));
  ASSERT_EQ(written(store.collect_near(item, near, room.data())),
            items_in(cells, near, own.level, item));
  std::vector<std::int32_t> visited;
  store.for_each(near, own.level, [&](std::int32_t other) { visited.push_back(other); });
  ASSERT_EQ(sorted(visited), items_in(cells, near, own.level, CellStore::kNone));
}

TEST(CellStore, FindsWhatStandsInCellsUnderRandomWork) {
  Random random(test::seed_of_run());
  CellStore store;
  std::map<std::int32_t, Cell> cells;
  for (int i = 0; i < 30'000; ++i) {
    const auto item = static_cast<std::int32_t>(random.below(kItems));
    ASSERT_EQ(store.contains(item), cells.contains(item));
    if (cells.contains(item) && random.one_in(2)) {
      const auto dx = static_cast<std::int64_t>(random.below(5)) - 2;
      const auto dy = static_cast<std::int64_t>(random.below(5)) - 2;
      store.move(item, dx, dy);
      cells[item].x += dx;
      cells[item].y += dy;
    } else {
      if (cells.contains(item)) store.remove(item);
      cells.erase(item);
      if (random.one_in(4)) continue;
      cells[item] = random_cell(random);
      store.insert(item, cells[item]);
    }
    if (random.one_in(100)) store.pack([](PooledList&) {});
    ASSERT_NO_FATAL_FAILURE(expect_found_beside(store, cells, item));
    Range near = around(cells[item], static_cast<std::int64_t>(random.below(3)));
    near.x0 += static_cast<std::int64_t>(random.below(2));
    ASSERT_NO_FATAL_FAILURE(expect_found(store, cells, item, near));
  }
  for (std::int32_t level = 0; level < 2; ++level) {
    std::vector<std::int32_t> visited;
    store.for_each(level, [&](std::int32_t item) { visited.push_back(item); });
    constexpr std::int64_t kAnywhere = std::int64_t{1} << 60;
    ASSERT_EQ(sorted(visited), items_in(cells, around({}, kAnywhere), level, CellStore::kNone));
  }
}

// Its lists go with a block that is gone; what is kept for the others stays.
TEST(CellStore, PackedKeepsTheNotesOfBlocksInUse) {
  CellStore store;
  constexpr std::int32_t kFar = 200;
  for (std::int32_t item = 0; item < kFar; ++item) {
    store.insert(item, {CellStore::kBlockSide * item, 0, 0});
    *store.noted_block_of(item).note = {1, {static_cast<std::uint32_t>(item)}};
  }
  EXPECT_FALSE(store.is_mostly_free());
  for (std::int32_t item = 0; item < kFar; ++item) {
    if (item % 10 != 0) store.remove(item);
  }
  EXPECT_TRUE(store.is_mostly_free());
  int dropped = 0;
  store.pack([&](const PooledList& list) {
    ++dropped;
    EXPECT_NE(list.head % 10, 0U);
  });
  EXPECT_EQ(dropped, kFar - kFar / 10);
  EXPECT_FALSE(store.is_mostly_free());
  for (std::int32_t item = 0; item < kFar; item += 10) {
    EXPECT_EQ(store.cell_of(item), (Cell{CellStore::kBlockSide * item, 0, 0}));
    EXPECT_EQ(store.note_of_block_of(item).as_of, 1U);
    EXPECT_EQ(store.note_of_block_of(item).list.head, static_cast<std::uint32_t>(item));
  }
}

TEST(CellStore, KeepsANumberForWhatIsInNoCell) {
  CellStore store;
  EXPECT_FALSE(store.knows(7));
  store.keep_for(7, 0);
  store.keep_for(3, 1'000'000);
  EXPECT_TRUE(store.knows(7));
  EXPECT_FALSE(store.knows(5));
  EXPECT_FALSE(store.contains(7));
  EXPECT_EQ(store.kept_for(7), 0);
  EXPECT_EQ(store.kept_for(3), 1'000'000);
  store.insert(7, {0, 0, 0});
  EXPECT_TRUE(store.contains(7));
  store.keep_for(3, CellStore::kNone);
  EXPECT_FALSE(store.knows(3));
}

TEST(CellStore, CountsWorkByLevel) {
  CellStore store;
  store.insert(0, {0, 0, 5});
  store.insert(1, {1, 0, 5});
  store.insert(2, {0, 0, 6});
  std::vector<std::int32_t> room(2 + kWrittenBeyond);
  store.collect_around(0, room.data());
  store.collect_around(1, room.data());
  EXPECT_EQ(store.take_work(6).searches, 0);
  const CellWork work = store.take_work(5);
  EXPECT_EQ(work.searches, 2);
  EXPECT_EQ(work.looks, 2);
  EXPECT_EQ(store.take_work(5).searches, 0);
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The grid of boxes against a search through all of them.
#include "broad_phase/box_grid.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;

Aabb square(double x, double y, double half) { return {x - half, y - half, x + half, y + half}; }

struct Item {
  Aabb tight;
  double margin = 0;
  std::int32_t line = 0;  ///< where it stands in the grid
  Aabb box() const { return grown(tight, margin); }
};

/// Anywhere within nine decades, most of them in a heap; of any size.
Item random_item(Random& random) {
  const bool lone = random.one_in(8);
  const double x = lone ? random.either_sign(random.decades(-3, 9)) : random.uniform(-20, 20);
  const double y = lone ? random.either_sign(random.decades(-3, 9)) : random.uniform(-20, 20);
  return {square(x, y, random.decades(-4, 2)), random.one_in(4) ? 0 : random.decades(-4, 2)};
}

std::vector<std::int32_t> found_in(const BoxGrid& grid, const Aabb& box) {
  const auto span = grid.find(box);
  std::vector<std::int32_t> found(span.begin(), span.end());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::int32_t> found_slowly(const std::map<std::int32_t, Item>& items, const Aabb& box) {
  std::vector<std::int32_t> found;
  for (const auto& [number, item] : items) {
    if (overlaps(item.box(), box)) found.push_back(number);
  }
  return found;
}

TEST(BoxGrid, FindsEveryOverlapAndNothingElseUnderRandomWork) {
  Random random(test::seed_of_run());
  BoxGrid grid;
  std::map<std::int32_t, Item> items;
  EXPECT_TRUE(found_in(grid, {-1, -1, 1, 1}).empty());
  for (int i = 0; i < 20'000; ++i) {
    const auto number = static_cast<std::int32_t>(random.below(300));
    if (items.contains(number)) {
      grid.remove(items[number].line);
      items.erase(number);
    }
    if (!random.one_in(3)) {
      Item item = random_item(random);
      item.line = grid.insert(number, item.tight, item.margin);
      items[number] = item;
    }
    const Aabb box = random.one_in(20) ? square(0, 0, 1e12) : random_item(random).tight;
    ASSERT_EQ(found_in(grid, box), found_slowly(items, box));
  }
}

TEST(BoxGrid, FindsBoxesThatOnlyTouch) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 20'000; ++i) {
    BoxGrid grid;
    const double half = random.decades(-6, 6);
    const double x = random.either_sign(random.decades(-6, 6)) * half;
    const Aabb tight = square(x, 0, half);
    grid.insert(0, tight, half);
    const Aabb box = grown(tight, half);
    const double other = random.decades(-6, 6) * half;
    const Aabb beside{box.high_x, -other, box.high_x + 2 * other, other};
    ASSERT_EQ(found_in(grid, beside).size(), 1U);
    const Aabb left{box.low_x - 2 * other, -other, box.low_x, other};
    ASSERT_EQ(found_in(grid, left).size(), 1U);
  }
}

TEST(BoxGrid, WorksAtTheEndsOfTheRange) {
  BoxGrid grid;
  grid.insert(0, square(1e150, -1e150, 1e-150), 0);
  grid.insert(1, square(0, 0, 1e-150), 0);
  grid.insert(2, square(-1e150, 1e150, 1e150), 0);
  EXPECT_EQ(found_in(grid, square(1e150, -1e150, 1)), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(found_in(grid, square(1e-150, 0, 1e-150)), (std::vector<std::int32_t>{1, 2}));
}

}  // namespace
}  // namespace stoss::engine

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

Aabb square(double x, double y, double half) { return grown({x, y, x, y}, half); }

/// Anywhere within nine decades, most of them in a heap; of any size.
Aabb random_square(Random& random) {
  const bool lone = random.one_in(8);
  const double x = lone ? random.either_sign(random.decades(-3, 9)) : random.uniform(-20, 20);
  const double y = lone ? random.either_sign(random.decades(-3, 9)) : random.uniform(-20, 20);
  return square(x, y, random.decades(-4, 2));
}

std::vector<std::int32_t> found_in(const BoxGrid& grid, const Aabb& box) {
  std::vector<std::int32_t> found;
  grid.query(box, [&](std::int32_t item) { found.push_back(item); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::int32_t> found_slowly(const std::map<std::int32_t, Aabb>& boxes, const Aabb& box) {
  std::vector<std::int32_t> found;
  for (const auto& [item, other] : boxes) {
    if (overlaps(other, box)) found.push_back(item);
  }
  return found;
}

TEST(BoxGrid, FindsEveryOverlapAndNothingElseUnderRandomWork) {
  Random random(test::seed_of_run());
  BoxGrid grid;
  std::map<std::int32_t, Aabb> boxes;
  EXPECT_TRUE(found_in(grid, {-1, -1, 1, 1}).empty());
  for (int i = 0; i < 20'000; ++i) {
    const auto item = static_cast<std::int32_t>(random.below(300));
    ASSERT_EQ(grid.contains(item), boxes.contains(item));
    if (boxes.contains(item)) {
      grid.remove(item);
      boxes.erase(item);
    }
    if (!random.one_in(3)) {
      boxes[item] = random_square(random);
      grid.insert(item, boxes[item]);
    }
    const Aabb box = random.one_in(20) ? Aabb{-1e12, -1e12, 1e12, 1e12} : random_square(random);
    ASSERT_EQ(found_in(grid, box), found_slowly(boxes, box));
  }
}

TEST(BoxGrid, FindsBoxesThatOnlyTouch) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 20'000; ++i) {
    BoxGrid grid;
    const double half = random.decades(-6, 6);
    const double x = random.either_sign(random.decades(-6, 6)) * half;
    const Aabb box = square(x, 0, half);
    grid.insert(0, box);
    const double other = random.decades(-6, 6) * half;
    const Aabb beside{box.high_x, -other, box.high_x + 2 * other, other};
    ASSERT_EQ(found_in(grid, beside).size(), 1U);
    const Aabb left{box.low_x - 2 * other, -other, box.low_x, other};
    ASSERT_EQ(found_in(grid, left).size(), 1U);
  }
}

TEST(BoxGrid, WorksAtTheEndsOfTheRange) {
  BoxGrid grid;
  grid.insert(0, square(1e150, -1e150, 1e-150));
  grid.insert(1, square(0, 0, 1e-150));
  grid.insert(2, square(-1e150, 1e150, 1e150));
  EXPECT_EQ(found_in(grid, square(1e150, -1e150, 1)), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(found_in(grid, square(1e-150, 0, 1e-150)), (std::vector<std::int32_t>{1, 2}));
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The tree of boxes against a search through all of them.
#include "broad_phase/aabb_tree.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;

Aabb random_box(Random& random) {
  const double x = random.either_sign(random.decades(-3, 4));
  const double y = random.either_sign(random.decades(-3, 4));
  const double width = random.one_in(8) ? 0 : random.decades(-4, 4);
  const double height = random.one_in(8) ? 0 : random.decades(-4, 4);
  return {x, y, x + width, y + height};
}

bool is_same(const Aabb& a, const Aabb& b) {
  return a.low_x == b.low_x && a.low_y == b.low_y && a.high_x == b.high_x && a.high_y == b.high_y;
}

std::vector<std::int32_t> found_in(const AabbTree& tree, const Aabb& box) {
  std::vector<std::int32_t> found;
  tree.query(box, [&](std::int32_t item) { found.push_back(item); });
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

TEST(AabbTree, FindsEveryOverlapAndNothingElseUnderRandomWork) {
  Random random(test::seed_of_run());
  AabbTree tree;
  std::map<std::int32_t, Aabb> boxes;
  std::map<std::int32_t, std::int32_t> leaf_of;
  EXPECT_TRUE(found_in(tree, {-1, -1, 1, 1}).empty());
  for (int i = 0; i < 20'000; ++i) {
    const auto item = static_cast<std::int32_t>(random.below(200));
    if (boxes.contains(item)) {
      tree.remove(leaf_of[item]);
      boxes.erase(item);
    }
    if (!random.one_in(3)) {
      const Aabb box = random_box(random);
      leaf_of[item] = tree.insert(item, box);
      boxes[item] = box;
    }
    for (const auto& [other, box] : boxes) {
      ASSERT_TRUE(is_same(tree.box_of(leaf_of[other]), box));
    }
    const Aabb box = random_box(random);
    ASSERT_EQ(found_in(tree, box), found_slowly(boxes, box));
  }
}

TEST(AabbTree, TouchingBoxesOverlap) {
  AabbTree tree;
  tree.insert(0, {0, 0, 1, 1});
  EXPECT_EQ(found_in(tree, {1, 1, 2, 2}).size(), 1U);
  EXPECT_TRUE(found_in(tree, {1.0000001, 1, 2, 2}).empty());
}

// Sorted insertion is what unbalances a tree; a query's stack holds 64 levels.
TEST(AabbTree, StaysShallowUnderSortedInsertionAndRemoval) {
  AabbTree tree;
  constexpr std::int32_t kCount = 60'000;
  std::vector<std::int32_t> leaf_of;
  for (std::int32_t i = 0; i < kCount; ++i) {
    leaf_of.push_back(tree.insert(i, {1.0 * i, 0, i + 0.5, 1}));
  }
  for (std::int32_t i = 0; i < kCount; i += 997) {
    EXPECT_EQ(found_in(tree, {i + 0.1, 0, i + 0.2, 1}), (std::vector<std::int32_t>{i}));
  }
  EXPECT_EQ(found_in(tree, {-1, 0, 1e9, 1}).size(), static_cast<std::size_t>(kCount));
  for (std::int32_t i = 0; i < kCount; ++i) {
    if (i % 100 != 0) tree.remove(leaf_of[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(found_in(tree, {-1, 0, 1e9, 1}).size(), static_cast<std::size_t>(kCount / 100));
}

TEST(Aabb, GrowsByTheMarginAndItsOwnRounding) {
  const Aabb box = grown({1, -2, 3, 4}, 0.5);
  EXPECT_LE(box.low_x, 0.5);
  EXPECT_LE(box.low_y, -2.5);
  EXPECT_GE(box.high_x, 3.5);
  EXPECT_GE(box.high_y, 4.5);
  const Aabb far = grown({0x1p60, 0, 0x1p60, 0}, 0);
  EXPECT_LT(far.low_x, 0x1p60);
  EXPECT_GT(far.high_x, 0x1p60);
}

}  // namespace
}  // namespace stoss::engine

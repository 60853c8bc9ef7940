// SPDX-License-Identifier: Apache-2.0
// Cells are as large as they must be, and as suits the work.
#include "broad_phase/cell_side.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stoss::engine {
namespace {

using test::Random;

// Equation (1), with room for the rounding of places.
TEST(CellSide, LeavesRoomForTwoDisksBetweenCagesApart) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 10'000; ++i) {
    const double radius = random.decades(-9, 9);
    const double side = least_side(radius) * random.decades(0, 3);
    const double beyond = beyond_cell(radius, side);
    EXPECT_GE(side * (1 - 2 * beyond), 2 * radius + kCellRounding * side);
    EXPECT_GT(beyond, 0);
  }
}

// In walks of which everything is known: steps of one length in all directions, and so many others
// to the square metre.
CellWork work_of_walk(Random& random, double radius, double side, double step, double others) {
  constexpr int kSteps = 20'000;
  const double half = side / 2 + beyond_cell(radius, side) * side;
  CellWork work;
  work.searches = kSteps;
  work.looks = kSteps * 9 * side * side * others;
  double x = 0, y = 0, cell_x = 0, cell_y = 0;
  const auto cross = [&](double at, double& cell) {
    for (; std::abs(at - cell) > half; ++work.crossings) cell += std::copysign(side, at - cell);
  };
  for (int i = 0; i < kSteps; ++i) {
    const double angle = random.uniform(0, 6.283185307179586);
    cross(x += step * std::cos(angle), cell_x);
    cross(y += step * std::sin(angle), cell_y);
  }
  return work;
}

double cost_of(const CellWork& work) {
  return kCrossingLooks * work.crossings + work.looks * (1 + work.crossings / work.searches / 3);
}

TEST(CellSide, TheBestCostsHardlyMoreThanAnyOther) {
  Random random(test::seed_of_run());
  constexpr double kRadius = 0.5;
  for (const double step : {0.05, 0.2, 0.5, 1.0, 3.0, 10.0}) {
    // Of a gas whose mean free path is the step.
    const double others = std::min(0.9, 0.35 / step);
    double side = least_side(kRadius);
    for (int i = 0; i < 4; ++i) {
      side = best_side(kRadius, side, work_of_walk(random, kRadius, side, step, others));
    }
    const double cost = cost_of(work_of_walk(random, kRadius, side, step, others));
    for (double other = least_side(kRadius); other < 64; other *= 1.2) {
      const double its = cost_of(work_of_walk(random, kRadius, other, step, others));
      EXPECT_LT(cost, 1.15 * its) << "step " << step << ": " << side << " beside " << other;
    }
  }
}

TEST(CellSide, StaysAtTheLeastWhereNobodyCrosses) {
  EXPECT_NEAR(best_side(0.5, least_side(0.5), {0, 1e6, 9e6}), least_side(0.5), 1e-15);
  // And comes down to it by halves.
  EXPECT_EQ(best_side(0.5, 8, {0, 1e6, 9e6}), 4);
}

TEST(CellSide, BecomesFourTimesAsLongAtMost) {
  const double least = least_side(0.5);
  const double best = best_side(0.5, least, {1e6, 0, 0});
  EXPECT_GT(best, 3.5 * least);
  EXPECT_LE(best, 4 * least);
}

}  // namespace
}  // namespace stoss::engine

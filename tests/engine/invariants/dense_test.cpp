// SPDX-License-Identifier: Apache-2.0
// Dense and long, with a census all the way: nothing overlaps by more than rounding and nothing is
// missed. A short run of what tests/engine/world/long_test.cpp does for 5 million collisions.
//
// Reference: at area fraction 0.69 the textbook formula lets disks pass through each other (overlap
// 0.99 of a diameter in float; 0.96 in double with a clock at 10^9 s).

#include "engine/invariants/gas.hpp"
#include "support/campaign.hpp"

#include <stoss/engine/verify.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace stoss::engine {
namespace {

void expect_apart(const char* name,
                  Arithmetic arithmetic,
                  const Instant& start,
                  double deepest_max) {
  const std::uint64_t collisions = test::campaign(100'000, 5'000'000);
  for (const double radius : {0.5, 0.4375}) {
    World world = test::make_gas(
        {.area_fraction = 0.69, .radius = radius, .arithmetic = arithmetic, .start = start});
    double deepest = 0;
    std::uint64_t checks = 0;
    for (; world.counters().collisions < collisions; ++checks) {
      test::run_collisions(world, 1000);
      const Census census = world.census();
      deepest = std::max(deepest, census.deepest);
      ASSERT_EQ(census.missed, 0U);
      ASSERT_LE(census.deepest, overlap_tolerance(arithmetic));
    }
    std::printf("%s, radius %.4f m: deepest overlap %.2g of the reach in %llu checks\n",
                name,
                radius,
                deepest,
                static_cast<unsigned long long>(checks));
    EXPECT_LT(deepest, deepest_max);
  }
}

TEST(Dense, InDoubleNothingOverlaps) { expect_apart("double", Arithmetic::Double, {}, 1e-14); }

TEST(Dense, InDoubleAtABillionSecondsNothingOverlaps) {
  expect_apart("double at 1e9 s", Arithmetic::Double, test::seconds(1e9), 1e-14);
}

TEST(Dense, InFloatNothingOverlapsByMoreThanItsTimesAreRounded) {
  expect_apart("float", Arithmetic::Float, {}, 1e-5);
}

TEST(Dense, InLongDoubleNothingOverlaps) {
  expect_apart("long double", Arithmetic::LongDouble, {}, 1e-17);
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// Time reversal: a gas whose velocities are turned round finds its way back, as far as chaos lets
// it. Velocities are rounded to one double as they are turned, so no arithmetic does better than
// the digits of that.
//
// Reference: 100 disks at area fraction 0.2, the same way back after c collisions a disk: in plain
// double off by 2e-14 m for c = 2, 4e-11 for 6, 5e-8 for 10, 1e-5 for 14; in float by 2e-5 for 2
// and 8e-4 for 4.

#include "engine/invariants/gas.hpp"
#include "engine/invariants/statistics.hpp"
#include "support/campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace stoss::engine {
namespace {

/// Root mean square distance (m) from where they started, after so many collisions a disk and back.
double way_back(Arithmetic arithmetic, int collisions_per_disk, std::uint64_t seed) {
  const test::GasSpec spec{.seed = seed, .arithmetic = arithmetic};
  World world = test::make_gas(spec);
  const World beginning = world;
  const auto disks = static_cast<std::uint64_t>(spec.columns * spec.columns);
  // A collision of two disks is one of each.
  test::run_collisions(world, static_cast<std::uint64_t>(collisions_per_disk) * disks / 2);
  std::vector<VectorFor> velocities;
  world.for_each_disk([&](const BodyState& body) {
    velocities.push_back({body.id, -body.velocity});
  });
  EXPECT_TRUE(world.set_velocity(velocities).ok());
  const Instant end = instant_from_ticks(2 * ticks(world.now()));
  EXPECT_TRUE(world.advance_to(end).ok());
  double sum = 0;
  beginning.for_each_disk([&](const BodyState& body) {
    sum += (test::state(world, body.id).position - body.position).squaredNorm();
  });
  return std::sqrt(sum / static_cast<double>(disks));
}

struct Bound {
  int collisions_per_disk;
  double off_max;  ///< m, a hundred times the reference
};

void expect_back(const char* name, Arithmetic arithmetic, const std::vector<Bound>& bounds) {
  const std::uint64_t seeds = test::campaign(4, 40);
  for (const Bound& bound : bounds) {
    double worst = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      worst = std::max(worst, way_back(arithmetic, bound.collisions_per_disk, seed));
    }
    std::printf("%s, %d collisions a disk and back: at most %.2g m off\n",
                name,
                bound.collisions_per_disk,
                worst);
    EXPECT_LT(worst, bound.off_max) << bound.collisions_per_disk;
  }
}

TEST(TimeReversal, InDoubleAGasFindsItsWayBack) {
  expect_back("double", Arithmetic::Double, {{2, 2e-12}, {6, 4e-9}, {10, 1e-6}, {12, 2e-4}});
}

TEST(TimeReversal, InFloatAGasFindsItsWayBack) {
  expect_back("float", Arithmetic::Float, {{2, 2e-3}, {4, 1e-2}});
}

TEST(TimeReversal, InWiderArithmeticsTheTurnIsWhatCosts) {
  expect_back("long double", Arithmetic::LongDouble, {{2, 2e-12}, {10, 1e-6}});
  expect_back("double-double", Arithmetic::DoubleDouble, {{2, 2e-12}, {10, 1e-6}});
}

}  // namespace
}  // namespace stoss::engine

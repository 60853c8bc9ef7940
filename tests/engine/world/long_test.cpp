// SPDX-License-Identifier: Apache-2.0
// Long campaigns, behind the label `long`.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace stoss::engine {
namespace {

using test::disk;
using test::must_spawn;
using test::run_for;
using test::seconds;
using test::state;

// NUMERICS: an absolute double clock is 6.5e-2 m off after 1e9 s, and loses a wall hit.
TEST(Long, ADiskInABoxForABillionSecondsIsExactByUnfolding) {
  World world;
  must_spawn(world, {disk(1, {3, 2}, {1.25, 0.6875}, 0.5)}, test::box(2, {0, 0}, {10, 7}));
  ASSERT_TRUE(world.advance_to(seconds(1e9)).ok());
  EXPECT_EQ(world.counters().collisions, 253'472'222U);
  // 2.5 + 1.25e9 = 69444444 * 18 + 10.5 -> 18 - 10.5; 1.5 + 6.875e8 = 57291666 * 12 + 9.5 -> 12
  // - 9.5
  EXPECT_NEAR(state(world, 1).position.x(), 0.5 + 7.5, 2e-8);
  EXPECT_NEAR(state(world, 1).position.y(), 0.5 + 2.5, 2e-8);
}

/// A crystal of n x n disks at an area fraction, molten by random velocities.
World dense_gas(int n, double fraction, Arithmetic arithmetic, const Instant& start) {
  test::Random random(test::seed_of_run());
  World world(WorldOptions{.start = start, .arithmetic = arithmetic});
  const double pitch = std::sqrt(M_PI * 0.25 * 0.875 * 0.875 / fraction);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < n * n; ++i) {
    disks.push_back(disk(static_cast<Id>(i + 1),
                         pitch * Vector2(i % n + 0.5, i / n + 0.5),
                         {random.uniform(-1.7, 1.7), random.uniform(-1.7, 1.7)},
                         0.4375));
  }
  const double side = pitch * n;
  must_spawn(world, disks, test::box(10'000, {0, 0}, {side, side}));
  return world;
}

// Dense and long, with a census all the way: the deepest overlap found, and the energy.
void expect_healthy(Arithmetic arithmetic, const Instant& start, double overlap, double drift) {
  World world = dense_gas(10, 0.69, arithmetic, start);
  const double energy = world.conserved().kinetic_energy;
  const auto collisions_max = test::environment_number("STOSS_COLLISIONS", 5'000'000);
  double deepest = 0;
  while (world.counters().collisions < collisions_max) {
    const AdvanceReport report =
        world.advance_to(*offset_by(world.now(), 1000), nullptr, 2000).value();
    ASSERT_NE(report.stop, Stop::Stalled);
    deepest = std::max(deepest, test::deepest_overlap(world));
  }
  const double change = world.conserved().kinetic_energy / energy - 1;
  std::printf("%llu collisions: deepest overlap %.3g of the reach, energy drift %.3g\n",
              static_cast<unsigned long long>(world.counters().collisions),
              deepest,
              change);
  EXPECT_LT(deepest, overlap);
  EXPECT_LT(std::abs(change), drift);
}

TEST(Long, ADenseGasStaysApartInDouble) { expect_healthy(Arithmetic::Double, {}, 1e-13, 1e-14); }
TEST(Long, ADenseGasStaysApartInDoubleAtABillionSeconds) {
  expect_healthy(Arithmetic::Double, seconds(1e9), 1e-13, 1e-14);
}
TEST(Long, ADenseGasStaysApartInFloat) { expect_healthy(Arithmetic::Float, {}, 1e-5, 1e-5); }

}  // namespace
}  // namespace stoss::engine

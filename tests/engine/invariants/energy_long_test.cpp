// SPDX-License-Identifier: Apache-2.0
// A thousand million collisions: the energy is where an unbiased random walk may leave it, a
// million millionth of what a double shows, and every census on the way is clean.
// Environment: STOSS_COLLISIONS.

#include "engine/invariants/energy.hpp"
#include "engine/invariants/gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace stoss::engine {
namespace {

TEST(Long, TheEnergyOfAThousandMillionCollisionsDoesNotMove) {
  const std::uint64_t collisions = test::environment_number("STOSS_COLLISIONS", 1'000'000'000);
  const std::uint64_t stretch = collisions / 100;
  World world = test::make_gas({.radius = 0.4375});
  const test::Real before = test::exact_energy(world);
  for (std::uint64_t done = stretch; done <= collisions; done += stretch) {
    test::run_collisions(world, stretch);
    const double drift = test::relative_change(before, test::exact_energy(world));
    constexpr double kUnit2 = 0x1p-106;  // u^2
    // A bias of 10^-5 u^2 a collision would be out of it at the end.
    const double bound = kUnit2 * 4 * test::kEnergyStep * std::sqrt(static_cast<double>(done));
    const Census census = world.census();
    std::printf("%llu collisions: drift %.3g, bound %.3g, deepest overlap %.2g\n",
                static_cast<unsigned long long>(done),
                drift,
                bound,
                census.deepest);
    std::fflush(stdout);
    ASSERT_LT(std::abs(drift), bound);
    ASSERT_EQ(census.missed, 0U);
    ASSERT_EQ(census.overlaps, 0U);
  }
}

}  // namespace
}  // namespace stoss::engine

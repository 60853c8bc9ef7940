// SPDX-License-Identifier: Apache-2.0
// The energy's drift is an unbiased random walk: its spread over many runs grows as the root of the
// number of collisions, and its mean is within four standard errors of zero. Its steps are
// roundings of a rounding: what a double shows of the energy does not move.
//
// Source: engine/NUMERICS.md, "Impulses". Radii other than 0.5 m are looked at, too: rounding of
// p.p just above and below a power of two differs, and a bias may show there. Of a bias of 0.002
// u^2 a collision, as dropped squares of low words leave it (contact_law/unbiased.hpp), the mean
// would be 30 standard errors off in a normal run, and 100 in a long one.

#include "engine/invariants/energy.hpp"
#include "engine/invariants/gas.hpp"
#include "engine/invariants/statistics.hpp"
#include "support/campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace stoss::engine {
namespace {

struct Walk {
  test::Sample early;  ///< relative drift after a tenth of the collisions
  test::Sample late;
};

Walk walk(Arithmetic arithmetic, double radius, std::uint64_t collisions) {
  Walk result;
  const std::uint64_t seeds = 24;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    World world = test::make_gas({.radius = radius, .seed = seed, .arithmetic = arithmetic});
    const test::Real before = test::exact_energy(world);
    test::run_collisions(world, collisions / 10);
    result.early.add(test::relative_change(before, test::exact_energy(world)));
    test::run_collisions(world, collisions - collisions / 10);
    result.late.add(test::relative_change(before, test::exact_energy(world)));
  }
  return result;
}

void expect_walk(Arithmetic arithmetic, double unit) {
  const auto collisions = static_cast<double>(test::campaign(20'000, 300'000));
  for (const double radius : {0.5, 0.4375, 0.46875}) {
    const Walk drift = walk(arithmetic, radius, static_cast<std::uint64_t>(collisions));
    const double step = drift.late.deviation() / std::sqrt(collisions);
    const double growth = drift.late.deviation() / drift.early.deviation();
    const double off = drift.late.mean() / drift.late.error();
    std::printf(
        "radius %.5f: drift after %.0f collisions %.2g +- %.2g (a run), mean %+.2f "
        "standard errors, growth for 10 times the collisions %.2f; a collision: step %.4f "
        "u^2, mean %+.1e +- %.1e\n",
        radius,
        collisions,
        drift.late.mean(),
        drift.late.deviation(),
        off,
        growth,
        step / (unit * unit),
        drift.late.mean() / collisions / (unit * unit),
        drift.late.error() / collisions / (unit * unit));
    EXPECT_LT(std::abs(off), 4);
    // sqrt(10) within four of its own standard errors, 0.2 of it for 24 runs; 10 if it were a bias.
    EXPECT_GT(growth, 1.5);
    EXPECT_LT(growth, 6);
    EXPECT_LT(step, test::kEnergyStep * unit * unit);
  }
}

TEST(EnergyWalk, InDoubleIsFarBelowARounding) { expect_walk(Arithmetic::Double, 0x1p-53); }

TEST(EnergyWalk, InFloatIsFarBelowARounding) { expect_walk(Arithmetic::Float, 0x1p-24); }

}  // namespace
}  // namespace stoss::engine

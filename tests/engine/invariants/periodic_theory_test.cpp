// SPDX-License-Identifier: Apache-2.0
// What kinetic theory says of hard disks in a periodic world, within error bars: there is no wall
// to disturb the bulk, and what N disks differ from infinitely many by is known to first order in
// 1/N.
//
//   collisions a disk and second    4 / sqrt(pi) (Z - 1) / d sqrt(k T / m)  g  f1 (1) virial, sum
//   of d J / (2 N k T)                (Z - 1)                   g  f2     a second    (2) g  = 1 -
//   S y^2 h'' / (2 N h), h = y (Z - 1), S = 1 / (d(y Z)/dy)                              (3) f1 =
//   sqrt(N) Gamma(N - 1) / Gamma(N - 1/2),   f2 = N / (N - 1)                                (4)
//
// k T: the energy a disk; total momentum zero; J: impulses; d: diameter; y: area fraction. (3) is
// the pair distribution at contact of a closed system against that of an open one, (4) the mean and
// the mean square of a relative velocity on the energy shell of 2 (N - 1) dimensions.
//
// Sources: Lebowitz, Percus, Phys. Rev. 122 (1961) 1675 (3); Lado, J. Chem. Phys. 75 (1981) 5461
// (momentum); virial.hpp.

#include "engine/invariants/gas.hpp"
#include "engine/invariants/statistics.hpp"
#include "engine/invariants/virial.hpp"
#include "support/campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace stoss::engine {
namespace {

using std::numbers::pi;

/// columns^2 disks at rest as a whole, with temperature about 1.
World periodic_gas(const test::GasSpec& gas) {
  const double side = test::side_of(gas);
  World world(WorldOptions{.start = {}, .period = {side, side}});
  test::Random random(test::seed_of_run() + gas.seed);
  const double pitch = side / gas.columns;
  std::vector<DiskSpec> disks;
  Vector2 mean = Vector2::Zero();
  for (int i = 0; i < gas.columns * gas.columns; ++i) {
    const Vector2 velocity(test::nearly_normal(random), test::nearly_normal(random));
    disks.push_back(
        test::disk(kNoId, pitch * Vector2(i % gas.columns, i / gas.columns), velocity, gas.radius));
    mean += velocity;
  }
  mean /= static_cast<double>(disks.size());
  for (DiskSpec& d : disks) d.velocity -= mean;
  test::must_spawn(world, disks);
  return world;
}

class Impulses final : public CollisionSink {
 public:
  void on_collision(const Collision& c) override { sum_ += c.impulse; }
  double take() { return std::exchange(sum_, 0); }

 private:
  double sum_ = 0;  // kg m/s
};

struct Bulk {
  test::Sample rate;    ///< collisions a disk and second
  test::Sample virial;  ///< (2), a second
  double temperature = 0;
};

Bulk measure(const test::GasSpec& gas, std::uint64_t collisions_per_disk) {
  World world = periodic_gas(gas);
  const auto disks = static_cast<double>(world.disk_count());
  Bulk bulk;
  bulk.temperature = world.conserved().kinetic_energy / disks;
  Impulses impulses;
  test::run_collisions(world, static_cast<std::uint64_t>(40 * disks), &impulses);
  impulses.take();
  constexpr int kBatches = 24;
  for (int batch = 0; batch < kBatches; ++batch) {
    const Instant begun = world.now();
    const std::uint64_t before = world.counters().collisions;
    const double many = static_cast<double>(collisions_per_disk) * disks / 2;
    test::run_collisions(world, static_cast<std::uint64_t>(many), &impulses);
    const double seconds = seconds_between(begun, world.now());
    const auto collisions = static_cast<double>(world.counters().collisions - before);
    bulk.rate.add(2 * collisions / (disks * seconds));
    bulk.virial.add(2 * gas.radius * impulses.take() / (2 * disks * bulk.temperature * seconds));
  }
  EXPECT_EQ(world.census().overlaps, 0U);
  EXPECT_EQ(world.census().missed, 0U);
  return bulk;
}

void expect_theory(int columns, double area_fraction, std::uint64_t collisions_per_disk) {
  const test::GasSpec gas{.columns = columns, .area_fraction = area_fraction, .radius = 0.5};
  const Bulk bulk = measure(gas, collisions_per_disk);
  const double n = columns * columns;
  const auto state = test::virial_series(area_fraction);
  const double pairs = 1 - state.bending / (2 * n * state.stiffness);
  const double mean_speed = std::sqrt(n) * std::exp(std::lgamma(n - 1) - std::lgamma(n - 0.5));
  std::printf("%g disks, area fraction %g: (3) %.5f, (4) %.5f and %.5f\n",
              n,
              area_fraction,
              pairs,
              mean_speed,
              n / (n - 1));
  // What is left of (3) in second order, and of the virial series.
  const double systematic = 2 / (n * n) + (area_fraction > 0.25 ? 5e-4 : 2e-5);
  const double thermal_speed = std::sqrt(bulk.temperature);
  test::expect_agreement("collision rate",
                         bulk.rate,
                         4 / std::sqrt(pi) * state.excess * thermal_speed * pairs * mean_speed,
                         systematic);
  test::expect_agreement("virial", bulk.virial, state.excess * pairs * n / (n - 1), systematic);
}

TEST(PeriodicTheory, CollisionRateAndEquationOfStateAreThoseOfTheBulk) {
  for (const double area_fraction : {0.05, 0.1, 0.2, 0.3}) {
    expect_theory(16, area_fraction, test::campaign(24, 4'000));
  }
}

TEST(PeriodicTheory, FewDisksDifferFromTheBulkAsTheyMust) {
  for (const double area_fraction : {0.1, 0.2}) {
    expect_theory(4, area_fraction, test::campaign(500, 100'000));
    expect_theory(8, area_fraction, test::campaign(125, 50'000));
  }
}

}  // namespace
}  // namespace stoss::engine

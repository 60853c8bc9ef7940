// SPDX-License-Identifier: Apache-2.0
#pragma once

// Gases of equal disks in a square box, at temperature 1.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/wide/world.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace stoss::test {

struct GasSpec {
  int columns = 10;            ///< disks: columns^2
  double area_fraction = 0.2;  ///< of the box that disks cover
  double radius = 0.5;         ///< m
  std::uint64_t seed = 1;
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  Instant start{};
};

/// The side of its box, m.
inline double side_of(const GasSpec& gas) {
  return gas.columns * gas.radius * std::sqrt(std::numbers::pi / gas.area_fraction);
}

/// A normal deviate by the sum of twelve uniform ones: good to 1 %, and the same everywhere.
inline double nearly_normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform(0, 1);
  return sum;
}

/// Disks 1, 2, ... of mass 1 kg on a lattice, each component of velocity of variance 1, and the
/// walls 1,000,001 to 1,000,004 at 0 and side_of().
inline World make_gas(const GasSpec& gas) {
  World world = wide::make_world({gas.start, gas.arithmetic, engine::BroadPhaseKind::Neighbours});
  Random random(seed_of_run() + gas.seed);
  const double side = side_of(gas);
  const double pitch = side / gas.columns;
  std::vector<DiskSpec> disks;
  for (int i = 0; i < gas.columns * gas.columns; ++i) {
    disks.push_back(disk(static_cast<Id>(i + 1),
                         pitch * Vector2(i % gas.columns + 0.5, i / gas.columns + 0.5),
                         {nearly_normal(random), nearly_normal(random)},
                         gas.radius));
  }
  must_spawn(world, disks, box(1'000'001, {0, 0}, {side, side}));
  return world;
}

/// Runs until so many collisions more have happened, walls included.
inline void run_collisions(World& world,
                           std::uint64_t count,
                           engine::CollisionSink* sink = nullptr) {
  const std::uint64_t end = world.counters().collisions + count;
  while (world.counters().collisions < end) {
    const auto report = world.advance_to(
        *engine::offset_by(world.now(), 1e6), sink, end - world.counters().collisions);
    ASSERT_TRUE(report.ok());
    ASSERT_NE(report.value().stop, engine::Stop::Stalled);
  }
}

}  // namespace stoss::test

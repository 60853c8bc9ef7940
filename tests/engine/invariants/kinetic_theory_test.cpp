// SPDX-License-Identifier: Apache-2.0
// What kinetic theory says of hard disks between walls, within error bars: moments of velocities,
// equipartition, mean free paths, the collision rate and the equation of state.
//
// Sources: Chernov, J. Stat. Phys. 88 (1997) 1 (mean free path pi A / P of the table that the
// centre sees); virial.hpp (the equation of state); the moments are those of a point drawn from a
// sphere of 2 N dimensions.

#include "engine/invariants/gas.hpp"
#include "engine/invariants/statistics.hpp"
#include "engine/invariants/virial.hpp"
#include "support/campaign.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace stoss::engine {
namespace {

using std::numbers::pi;

// -- Velocities

/// A few disks that share their energy: <v^4> / <v^2>^2 in batches.
test::Sample fourth_moments(int columns, std::uint64_t samples) {
  World world = test::make_gas({.columns = columns, .area_fraction = 0.2});
  const auto disks = static_cast<double>(columns * columns);
  const double mean_square = 2 * world.conserved().kinetic_energy / disks;
  constexpr int kBatches = 32;
  test::Sample result;
  for (int batch = 0; batch < kBatches; ++batch) {
    double sum = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      EXPECT_TRUE(world.advance_to(*offset_by(world.now(), 2.0)).ok());
      world.for_each_disk([&](const BodyState& body) {
        sum += std::pow(body.velocity.squaredNorm() / mean_square, 2);
      });
    }
    result.add(sum / (disks * static_cast<double>(samples)));
  }
  return result;
}

// v^2 of one of N disks is Beta(1, N - 1) of what they share, not yet Maxwell's: 2 N / (N + 1).
TEST(KineticTheory, TheFourthMomentIsThatOfAMicrocanonicalGas) {
  test::expect_agreement(
      "<v^4>/<v^2>^2, 4 disks", fourth_moments(2, test::campaign(300, 30'000)), 1.6);
  test::expect_agreement(
      "<v^4>/<v^2>^2, 9 disks", fourth_moments(3, test::campaign(300, 30'000)), 1.8);
  test::expect_agreement(
      "<v^4>/<v^2>^2, 100 disks", fourth_moments(10, test::campaign(50, 3'000)), 200.0 / 101);
}

// Whatever their masses and radii, disks have the same share of the energy.
TEST(KineticTheory, EnergyIsSharedAlikeAmongUnlikeDisks) {
  World world;
  const std::array<double, 4> masses{0.1, 1, 5, 30};
  std::vector<DiskSpec> disks;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const auto n = static_cast<double>(i);
    disks.push_back(test::disk(
        i + 1, {2 + 2 * n, 3 + 0.5 * n}, {1.3 - 0.7 * n, 0.4 + 0.3 * n}, 0.2 + 0.2 * n, masses[i]));
  }
  test::must_spawn(world, disks, test::box(10, {0, 0}, {10, 8}));
  const double share = world.conserved().kinetic_energy / static_cast<double>(masses.size());
  constexpr int kBatches = 32;
  const std::uint64_t samples = test::campaign(1'000, 60'000);
  std::array<test::Sample, 4> energies;
  for (int batch = 0; batch < kBatches; ++batch) {
    std::array<double, 4> sums{};
    for (std::uint64_t i = 0; i < samples; ++i) {
      ASSERT_TRUE(world.advance_to(*offset_by(world.now(), 4.0)).ok());
      for (std::size_t k = 0; k < masses.size(); ++k) {
        sums[k] += 0.5 * masses[k] * test::state(world, k + 1).velocity.squaredNorm();
      }
    }
    for (std::size_t k = 0; k < masses.size(); ++k) {
      energies[k].add(sums[k] / (share * static_cast<double>(samples)));
    }
  }
  for (std::size_t k = 0; k < masses.size(); ++k) {
    test::expect_agreement("share of the energy", energies[k], 1);
  }
}

// -- Mean free paths of one disk

/// Mean flight (m) between hits, in batches.
test::Sample mean_flights(World& world, Id id, std::uint64_t hits) {
  const double speed = test::state(world, id).velocity.norm();
  test::run_collisions(world, 1000);
  constexpr int kBatches = 32;
  test::Sample result;
  for (int batch = 0; batch < kBatches; ++batch) {
    const Instant begun = world.motion(id).value().since;
    test::run_collisions(world, hits);
    const double seconds = seconds_between(begun, world.motion(id).value().since);
    result.add(speed * seconds / static_cast<double>(hits));
  }
  return result;
}

// A disk of 0.1 m around a fixed one of 0.7 m in a square of 4 m. Orbits that bounce between two
// walls die out slowly, so that the error bars miss up to a part in a thousand.
TEST(KineticTheory, TheMeanFreePathAroundAnObstacleIsPiAreaOverPerimeter) {
  World world;
  test::must_spawn(world,
                   {test::disk(1, {0.5, 0.6}, {std::cos(1.0), std::sin(1.0)}, 0.1),
                    test::static_disk(2, {2, 2}, 0.7)},
                   test::box(3, {0, 0}, {4, 4}));
  const double area = 3.8 * 3.8 - pi * 0.8 * 0.8;
  const double perimeter = 4 * 3.8 + 2 * pi * 0.8;
  test::expect_agreement("mean free path with an obstacle",
                         mean_flights(world, 1, test::campaign(20'000, 600'000)),
                         pi * area / perimeter,
                         1e-3);
}

// Without it nothing mixes directions: the flight along each axis is a billiard of its own.
TEST(KineticTheory, TheMeanFreePathInAnEmptySquareIsThatOfItsDirection) {
  World world;
  test::must_spawn(world,
                   {test::disk(1, {0.5, 0.6}, {std::cos(1.0), std::sin(1.0)}, 0.1)},
                   test::box(3, {0, 0}, {4, 4}));
  const double expected = 3.8 / (std::cos(1.0) + std::sin(1.0));
  EXPECT_NEAR(mean_flights(world, 1, 20'000).mean() / expected, 1, 1e-4);
}

// -- The collision rate and the equation of state

/// Counts what happens away from the walls, and pushes on the middles of the walls: both know
/// nothing of walls and corners but the density that they leave inside.
class Interior final : public CollisionSink {
 public:
  Interior(double side, double margin) : low_(margin), high_(side - margin) {}

  void on_collision(const Collision& c) override {
    if (c.kind == ContactKind::DiskDisk) {
      if (contains(c.point)) ++collisions_;
    } else {
      const bool is_upright = std::abs(c.normal.x()) > std::abs(c.normal.y());
      const double along = is_upright ? c.point.y() : c.point.x();
      if (along > low_ && along < high_) push_ += c.impulse;
    }
  }
  bool contains(const Vector2& point) const {
    return point.minCoeff() > low_ && point.maxCoeff() < high_;
  }
  double length() const { return high_ - low_; }
  std::uint64_t take_collisions() { return std::exchange(collisions_, 0); }
  double take_push() { return std::exchange(push_, 0); }

 private:
  double low_;
  double high_;
  std::uint64_t collisions_ = 0;
  double push_ = 0;  // kg m/s
};

struct Bulk {
  test::Sample area_fraction;  ///< inside
  test::Sample rate;           ///< collisions a disk and second there
  test::Sample pressure;       ///< N/m
  double temperature = 0;      ///< <m v^2> / 2, J
};

Bulk measure(const test::GasSpec& spec, int samples_per_batch) {
  World world = test::make_gas(spec);
  const double diameter = 2 * spec.radius;
  const double margin = 4 * diameter;
  Interior interior(test::side_of(spec), margin);
  const auto disks = static_cast<double>(world.disk_count());
  Bulk bulk;
  bulk.temperature = world.conserved().kinetic_energy / disks;
  test::run_collisions(world, static_cast<std::uint64_t>(40 * disks), &interior);
  interior.take_collisions();
  interior.take_push();
  constexpr int kBatches = 20;
  constexpr double kStep = 0.25;  // s
  const double area = interior.length() * interior.length();
  for (int batch = 0; batch < kBatches; ++batch) {
    double inside = 0;
    for (int i = 0; i < samples_per_batch; ++i) {
      EXPECT_TRUE(world.advance_to(*offset_by(world.now(), kStep), &interior).ok());
      world.for_each_disk(
          [&](const BodyState& body) { inside += interior.contains(body.position); });
    }
    const double seconds = kStep * samples_per_batch;
    const double present = inside / samples_per_batch;
    bulk.area_fraction.add(present * pi * spec.radius * spec.radius / area);
    bulk.rate.add(2 * static_cast<double>(interior.take_collisions()) / (present * seconds));
    bulk.pressure.add(interior.take_push() / (4 * interior.length() * seconds));
  }
  return bulk;
}

// Enskog: a disk's collisions a second are 4 / sqrt(pi) (Z - 1) / d sqrt(k T / m), and what the
// walls feel is Z n k T. Both at the density inside, which the walls raise by a few per cent.
void expect_theory(double area_fraction, int samples) {
  const test::GasSpec spec{.columns = 24, .area_fraction = area_fraction, .radius = 0.4375};
  const Bulk bulk = measure(spec, samples);
  const double inside = bulk.area_fraction.mean();
  const double z = 1 + test::virial_series(inside).excess;
  const double diameter = 2 * spec.radius;
  const double density = inside / (pi * spec.radius * spec.radius);
  std::printf("area fraction %.3g, inside %.5f +- %.2g, Z %.5f\n",
              area_fraction,
              inside,
              bulk.area_fraction.error(),
              z);
  // The density inside is known to some 1e-3, and one part of N disks shares the energy of all.
  constexpr double kSystematic = 6e-3;
  test::expect_agreement("collision rate",
                         bulk.rate,
                         4 / std::sqrt(pi) * (z - 1) / diameter * std::sqrt(bulk.temperature),
                         kSystematic);
  test::expect_agreement(
      "pressure on the walls", bulk.pressure, z * density * bulk.temperature, kSystematic);
}

TEST(KineticTheory, CollisionRateAndPressureAreThoseOfTheEquationOfState) {
  const int samples = static_cast<int>(test::campaign(100, 4'000));
  for (const double area_fraction : {0.05, 0.1, 0.2, 0.3}) expect_theory(area_fraction, samples);
}

}  // namespace
}  // namespace stoss::engine

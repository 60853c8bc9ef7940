// SPDX-License-Identifier: Apache-2.0
// Worlds with a thermostat: the published answers of the generator, the distributions of what it
// draws, temperatures and heights of a gas within error bars, one story whatever the ticks.
#include "motion_law/thermostat.hpp"

#include "engine/invariants/statistics.hpp"
#include "support/campaign.hpp"
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stoss::engine {
namespace {

using test::run_for;

WorldOptions with_thermostat(const Thermostat& thermostat,
                             BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects.thermostat = thermostat;
  options.broad_phase = kind;
  return options;
}

/// Disks of two sizes and masses at rest in a box of 10 m.
World cold_gas(const WorldOptions& options) {
  World world(options);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 36; ++i) {
    disks.push_back(test::disk(static_cast<Id>(i + 1),
                               {1.6 * (i % 6) + 1, 1.6 * (i / 6) + 1},
                               {0, 0},
                               0.2 + 0.2 * (i % 2),
                               i % 2 == 0 ? 0.5 : 3));
  }
  test::must_spawn(world, disks, test::box(100, {0, 0}, {10, 10}));
  return world;
}

// kat_vectors of Random123, the authors' own library.
TEST(Philox, GivesThePublishedAnswers) {
  constexpr std::uint64_t kOnes = ~std::uint64_t{0};
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
            (PhiloxBlock{
                0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  EXPECT_EQ(philox({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (PhiloxBlock{
                0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
  EXPECT_EQ(philox({0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
                   {0x452821e638d01377, 0xbe5466cf34e90c6c}),
            (PhiloxBlock{
                0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}));
}

/// The largest distance of an empirical distribution from `cumulative`, times the root of the
/// count: above 1.95 once in a thousand runs, above 2.5 once in 130,000 (Kolmogorov).
template <class Cumulative>
double kolmogorov(std::vector<double> values, const Cumulative& cumulative) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double worst = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double f = cumulative(values[i]);
    const auto rank = static_cast<double>(i);
    worst = std::max({worst, f - rank / n, (rank + 1) / n - f});
  }
  return worst * std::sqrt(n);
}

TEST(Kicks, AreDrawnFromTheExponentialAndTheNormalDistribution) {
  constexpr double kRate = 3, kTemperature = 2.5, kMass = 0.4, kRadius = 0.7;
  const std::uint64_t seed = test::seed_of_run();
  std::vector<double> waits, x, y, spins;
  test::Sample squares, fourths, products;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const KickKey key{seed, 1 + i % 10, i / 10};
    waits.push_back(wait_before(key, kRate));
    const Vector2 z = velocity_after(key, kTemperature, kMass) / std::sqrt(kTemperature / kMass);
    x.push_back(z.x());
    y.push_back(z.y());
    spins.push_back(spin_after(key, kTemperature, kMass, kRadius));
    squares.add(z.squaredNorm());
    fourths.add(std::pow(z.x(), 4));
    products.add(z.x() * z.y());
  }
  const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  const double spin_unit = std::sqrt(2 * kTemperature / kMass) / kRadius;
  EXPECT_LT(kolmogorov(waits, [&](double t) { return -std::expm1(-kRate * t); }), 2.5);
  EXPECT_LT(kolmogorov(x, normal), 2.5);
  EXPECT_LT(kolmogorov(y, normal), 2.5);
  EXPECT_LT(kolmogorov(spins, [&](double s) { return normal(s / spin_unit); }), 2.5);
  test::expect_agreement("<z^2>", squares, 2);
  test::expect_agreement("<z_x^4>", fourths, 3);
  test::expect_agreement("<z_x z_y>", products, 0);
}

// The formulas of thermostat.hpp by decimal arithmetic with 60 digits, rounded where they round.
TEST(Kicks, AreTheSameBitsWithEveryCompiler) {
  const KickKey key{12, 34, 56};
  EXPECT_EQ(wait_before(key, 3), 0x1.0e18797ccc6d2p-2);
  EXPECT_EQ(velocity_after(key, 2.5, 0.4), Vector2(-0x1.7735dcec1d260p+0, -0x1.79cd7c196afbcp+0));
  EXPECT_EQ(spin_after(key, 2.5, 0.4, 0.7), 0x1.2b0de605c74d1p-2);
}

TEST(ThermostatWorld, KicksAtThePointsOfAPoissonProcess) {
  World world(with_thermostat({1, 2, 7}));
  test::must_spawn(world, {test::disk(1, {0, 0}, {0, 0}, 0.5)});
  double last = 0;
  std::vector<double> waits;
  for (std::uint64_t i = 0; i < 3'000; ++i) {
    EXPECT_EQ(world.counters().kicks, i);
    while (world.counters().kicks == i) {
      ASSERT_TRUE(world.advance_to(test::seconds(1e6), nullptr, 1).ok());
    }
    const double now = seconds_between({}, world.now());
    waits.push_back(now - last);
    last = now;
    EXPECT_EQ(world.motion(1).value().since, world.now());
  }
  EXPECT_LT(kolmogorov(waits, [](double t) { return -std::expm1(-2 * t); }), 2.5);
}

// Two kinds of disk that start at rest and collide: each component has the mean energy T / 2, and
// so has the spin. Perfectly rough contacts keep energy, so that nothing but the bath counts.
TEST(ThermostatWorld, BringsAGasToItsTemperature) {
  constexpr double kTemperature = 1.7;
  WorldOptions options = with_thermostat({kTemperature, 5, test::seed_of_run()});
  options.effects.rough = Rough{1, 1e6};
  World world = cold_gas(options);
  run_for(world, 4);
  test::Sample light, heavy, spins;
  for (std::uint64_t batch = 0; batch < 32; ++batch) {
    double sums[3] = {};
    const std::uint64_t samples = test::campaign(20, 1'000);
    for (std::uint64_t i = 0; i < samples; ++i) {
      run_for(world, 1);
      world.for_each_disk([&](const BodyState& s) {
        const bool is_light = s.id % 2 == 1;
        sums[is_light ? 0 : 1] += (is_light ? 0.5 : 3) * s.velocity.squaredNorm();
        if (is_light) sums[2] += 0.5 * 0.5 * s.radius * s.radius * s.spin * s.spin;
      });
    }
    const auto count = 18 * static_cast<double>(samples);
    light.add(sums[0] / count);
    heavy.add(sums[1] / count);
    spins.add(sums[2] / count);
  }
  EXPECT_GT(world.counters().collisions, 1'000U);
  test::expect_agreement("temperature of light disks", light, 2 * kTemperature);
  test::expect_agreement("temperature of heavy disks", heavy, 2 * kTemperature);
  test::expect_agreement("temperature of spins", spins, kTemperature);
}

TEST(ThermostatWorld, TellsOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  const auto gas = [](BroadPhaseKind kind) { return cold_gas(with_thermostat({2, 3, 5}, kind)); };
  const World end = test::expect_one_story(gas, 5, 500, 5);
  EXPECT_GT(end.counters().kicks, 36U * 3 * 5);
  EXPECT_GT(end.counters().collisions, 200U);
  EXPECT_EQ(end.census().overlaps, 0U);
  EXPECT_EQ(end.census().missed, 0U);
}

TEST(ThermostatWorld, TellsOneStoryWithEveryEffectThatItGoesWith) {
  for (const bool falls : {true, false}) {
    const auto gas = [&](BroadPhaseKind kind) {
      WorldOptions options = with_thermostat({2, 1, 6}, kind);
      options.effects.restitution = Restitution{0.7, 0.6, 1e-4, 0};
      if (falls) {
        options.effects.gravity = Gravity{{0.2, -3}};
        options.effects.restitution->rest_speed = 1e-3;
      } else {
        options.effects.floor_friction = FloorFriction{0.7};
        options.effects.rough = Rough{0.3, 0.5};
      }
      return cold_gas(options);
    };
    const World end = test::expect_one_story(gas, 8, 300, 4);
    EXPECT_GT(end.counters().kicks, 36U * 5);
    EXPECT_EQ(end.census().overlaps, 0U);
    EXPECT_EQ(end.census().missed, 0U);
  }
}

TEST(ThermostatWorld, StartsAnywhereInTimeAlike) {
  WorldOptions late = with_thermostat({2, 3, 5});
  late.start = {std::int64_t{1} << 40, 0};
  World early = cold_gas(with_thermostat({2, 3, 5}));
  World aged = cold_gas(late);
  const auto a = run_for(early, 3);
  const auto b = run_for(aged, 3);
  ASSERT_GT(a.size(), 50U);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].instant.fraction, b[i].instant.fraction);
    ASSERT_EQ(a[i].velocity_a, b[i].velocity_a);
  }
}

TEST(ThermostatWorld, DrawsByTheSeedAndTheIdAlone) {
  const auto velocity_at_end = [](std::uint64_t seed, bool has_company) {
    World world(with_thermostat({1, 1, seed}));
    if (has_company) test::must_spawn(world, {test::disk(9, {1e6, 0}, {0, 0}, 0.5)});
    test::must_spawn(world, {test::disk(1, {0, 0}, {0, 0}, 0.5)});
    run_for(world, 20);
    return test::state(world, 1).velocity;
  };
  EXPECT_EQ(velocity_at_end(3, false), velocity_at_end(3, true));
  EXPECT_NE(velocity_at_end(3, false), velocity_at_end(4, false));
}

TEST(ThermostatWorld, AtRateZeroIsTheWorldWithoutIt) {
  const auto moving = [](const WorldOptions& options) {
    World world = cold_gas(options);
    std::vector<VectorFor> velocities;
    test::Random random(3);
    for (Id id = 1; id <= 36; ++id) {
      velocities.push_back({id, {random.uniform(-1, 1), random.uniform(-1, 1)}});
    }
    EXPECT_TRUE(world.set_velocity(velocities).ok());
    return world;
  };
  World plain = moving({});
  World idle = moving(with_thermostat({1, 0, 5}));
  const auto a = run_for(plain, 20);
  const auto b = run_for(idle, 20);
  ASSERT_GT(a.size(), 200U);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].instant, b[i].instant);
  EXPECT_EQ(idle.counters().kicks, 0U);
}

TEST(ThermostatWorld, AtTemperatureZeroStopsWhatMoves) {
  World world(with_thermostat({0, 1, 5}));
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {1, 2}, 0.5), test::kinematic_disk(2, {9, 9}, {1, 0}, 1)},
                   std::vector<WallSpec>{test::wall(3, {-50, -50}, {50, -50}, {0, 0.01})});
  run_for(world, 50);
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
  EXPECT_EQ(test::state(world, 2).velocity, Vector2(1, 0)) << "only dynamic disks are kicked";
  EXPECT_EQ(world.wall(3).value().velocity, Vector2(0, 0.01));
}

TEST(ThermostatWorld, LetsGoOfWhatRests) {
  WorldOptions options = with_thermostat({1e-3, 0.2, 11});
  options.effects.gravity = Gravity{{0, -9.81}};
  options.effects.restitution = Restitution{0.5, 0.5, 0, 1e-3};
  World world(options);
  test::must_spawn(world,
                   {test::disk(1, {0, 0.5}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(2, {-900, 0}, {900, 0})});
  int at_rest = 0;
  int flying = 0;
  for (int i = 0; i < 2'000; ++i) {
    run_for(world, 0.05);
    ++(test::state(world, 1).velocity.y() == 0 ? at_rest : flying);
    ASSERT_GE(test::state(world, 1).position.y(), 0.5 - 1e-12);
  }
  EXPECT_GT(world.counters().kicks, 5U);
  EXPECT_GT(at_rest, 100);
  EXPECT_GT(flying, 0);
}

// Points that do not meet, above a floor: the mean height is that of the barometric law, T / (m g).
TEST(ThermostatWorld, HoldsAnAtmosphereByTheBarometricLaw) {
  constexpr double kTemperature = 2, kPull = 4, kRadius = 1e-4;
  WorldOptions options = with_thermostat({kTemperature, 1, test::seed_of_run()});
  options.effects.gravity = Gravity{{0, -kPull}};
  World world(options);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 24; ++i) {
    disks.push_back(test::disk(kNoId, {0.4 * i + 0.3, 0.5}, {0, 1}, kRadius));
  }
  test::must_spawn(world, disks, test::box(100, {0, 0}, {10, 100}));
  run_for(world, 20);
  test::Sample heights, squares;
  for (std::uint64_t batch = 0; batch < 32; ++batch) {
    const std::uint64_t samples = test::campaign(40, 2'000);
    double sum = 0, sum_of_squares = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      run_for(world, 1);
      world.for_each_disk([&](const BodyState& s) {
        const double height = s.position.y() - kRadius;
        sum += height;
        sum_of_squares += height * height;
      });
    }
    heights.add(sum / (24 * static_cast<double>(samples)));
    squares.add(sum_of_squares / (24 * static_cast<double>(samples)));
  }
  test::expect_agreement("mean height", heights, kTemperature / kPull);
  test::expect_agreement("mean square", squares, 2 * std::pow(kTemperature / kPull, 2));
}

TEST(ThermostatWorld, CommandsDoNotDisturbTheProcess) {
  World told = cold_gas(with_thermostat({1, 1, 5}));
  World left = cold_gas(with_thermostat({1, 1, 5}));
  run_for(told, 1);
  const VectorFor still{7, {0, 0}};
  ASSERT_TRUE(told.set_velocity(std::span(&still, 1)).ok());
  run_for(told, 9);
  run_for(left, 10);
  EXPECT_EQ(told.counters().kicks, left.counters().kicks);
  EXPECT_NE(told.state_hash(), left.state_hash());
}

TEST(ThermostatWorld, RefusesDamagedBytesAndImpossibleNumbers) {
  Effects effects;
  effects.thermostat = Thermostat{-1, 1, 0};
  EXPECT_EQ(check_effects(effects)->field, "thermostat.temperature");
  effects.thermostat = Thermostat{std::nan(""), 1, 0};
  EXPECT_EQ(check_effects(effects)->field, "thermostat.temperature");
  effects.thermostat = Thermostat{1, 1e10, 0};
  EXPECT_EQ(check_effects(effects)->field, "thermostat.rate");
  effects.thermostat = Thermostat{1, -1, 0};
  EXPECT_EQ(check_effects(effects)->field, "thermostat.rate");

  World world = cold_gas(with_thermostat({1, 1, 5}));
  run_for(world, 2);
  auto bytes = world.serialise();
  ASSERT_TRUE(World::deserialise(bytes).ok());
  // Last come four walls of 16 words each, and before them a disk, which ends with the instant of
  // its next kick and the count.
  const std::size_t next_kick = bytes.size() - (4 * 16 + 3) * 8;
  bytes[next_kick + 7] = std::byte{0x80};  // long ago
  EXPECT_FALSE(World::deserialise(bytes).ok());
}

}  // namespace
}  // namespace stoss::engine

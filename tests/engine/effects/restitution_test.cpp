// SPDX-License-Identifier: Apache-2.0
// Worlds whose contacts lose energy: the exact loss, collapse and the rule against it, one story
// whatever the ticks, the broad phase, or a pause in bytes.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stoss::engine {
namespace {

using test::run_for;

/// Equal disks in a box at an area fraction, with thermal velocities.
World granular_gas(int side, double area_fraction, const WorldOptions& options) {
  World world(options);
  test::Random random(test::environment_number("STOSS_SEED", 7));
  const double spacing = std::sqrt(3.14159265 * 0.25 / area_fraction);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < side * side; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(
        test::disk(kNoId, {spacing * (i % side + 0.5), spacing * (i / side + 0.5)}, velocity, 0.5));
  }
  test::must_spawn(world, disks, test::box(10'000, {0, 0}, {spacing * side, spacing * side}));
  return world;
}

WorldOptions with(const Restitution& restitution) {
  WorldOptions options;
  options.effects.restitution = restitution;
  return options;
}

TEST(RestitutionWorld, ADiskAtRestIsHitByTheBook) {
  World world(with({0.5, 0.25, 0}));
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {1, 0}, 0.5), test::disk(2, {3, 0}, {0, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(3, {6, -9}, {6, 9})});
  const auto log = run_for(world, 10);
  ASSERT_GE(log.size(), 2U);
  EXPECT_EQ(log[0].velocity_a, Vector2(0.25, 0));
  EXPECT_EQ(log[0].velocity_b, Vector2(0.75, 0));
  EXPECT_EQ(log[0].impulse, 0.75);
  EXPECT_EQ(log[1].velocity_a, Vector2(-0.1875, 0)) << "the wall has a coefficient of its own";
}

TEST(RestitutionWorld, LosesWhatItsContactsLose) {
  World world = granular_gas(12, 0.3, with({0.8, 1, 0}));
  const double before = world.conserved().kinetic_energy;
  double lost = 0;
  for (const Collision& c : run_for(world, 20)) {
    if (c.kind != ContactKind::DiskDisk) continue;
    lost += (1 - 0.8 * 0.8) * 0.5 * c.approach_speed * c.approach_speed / 2;
  }
  EXPECT_GT(lost, 0.5 * before);
  EXPECT_NEAR(world.conserved().kinetic_energy, before - lost, 1e-12 * before);
}

// Haff: T = T0 / (1 + t / tau)^2, 1 / tau = (1 - e^2) Gamma0 / 4, with the rate Gamma0 of
// collisions a disk measured in the same gas without loss. Elastic walls; NUMERICS C6 allows 2
// percent.
TEST(RestitutionWorld, CoolsAsHaffSays) {
  constexpr int kSide = 32;
  constexpr double kRestitution = 0.95;
  World elastic = granular_gas(kSide, 0.1, {});
  run_for(elastic, 20);  // forgets the lattice
  World measured = elastic;
  std::uint64_t pairs = 0;
  constexpr double kSpan = 40;
  for (const Collision& c : run_for(measured, kSpan)) pairs += c.kind == ContactKind::DiskDisk;
  const double rate = 2.0 * static_cast<double>(pairs) / (kSide * kSide * kSpan);

  World cooling(with({kRestitution, 1, 0}));
  std::vector<DiskSpec> disks;
  elastic.for_each_disk([&](const BodyState& s) {
    disks.push_back(test::disk(s.id, s.position, s.velocity, s.radius));
  });
  std::vector<WallSpec> walls;
  elastic.for_each_wall(
      [&](const WallState& w) { walls.push_back(test::wall(w.id, w.start, w.end)); });
  test::must_spawn(cooling, disks, walls);
  const double before = cooling.conserved().kinetic_energy;
  const double tau = 4 / ((1 - kRestitution * kRestitution) * rate);
  for (const double t : {0.5 * tau, tau}) {
    run_for(cooling, 0.5 * tau);
    const double haff = 1 / ((1 + t / tau) * (1 + t / tau));
    EXPECT_NEAR(cooling.conserved().kinetic_energy / before / haff, 1, 0.04) << "t = " << t;
  }
}

TEST(RestitutionWorld, CollapsesWithoutTheRuleAndRunsOnWithIt) {
  World bare = granular_gas(10, 0.5, with({0.1, 1, 0}));
  EXPECT_EQ(bare.advance_to(test::seconds(20), nullptr, 3'000'000).value().stop, Stop::Stalled);
  World guarded = granular_gas(10, 0.5, with({0.1, 1, 1e-4}));
  test::Log log;
  const AdvanceReport report = guarded.advance_to(test::seconds(20), &log, 3'000'000).value();
  EXPECT_EQ(report.stop, Stop::Reached);
  std::uint64_t marked = 0;
  for (const Collision& c : log.collisions) marked += c.regularised ? 1 : 0;
  EXPECT_GT(marked, 0U);
  EXPECT_EQ(guarded.counters().regularised, marked) << "every use is counted and marked";
  EXPECT_LT(guarded.conserved().kinetic_energy, 1);
  EXPECT_EQ(guarded.census().overlaps, 0U);
}

TEST(RestitutionWorld, TellsOneStoryWhateverTheTicksAndTheBroadPhase) {
  const auto gas = [](BroadPhaseKind kind) {
    WorldOptions options = with({0.7, 0.9, 1e-3});
    options.broad_phase = kind;
    return granular_gas(8, 0.3, options);
  };
  test::expect_one_story(gas, 8, 400, 3);
}

TEST(RestitutionWorld, SurvivesItsOwnBytes) {
  World world = granular_gas(6, 0.3, with({0.7, 0.9, 1e-3}));
  run_for(world, 3);
  auto restored = World::deserialise(world.serialise());
  ASSERT_TRUE(restored.ok()) << restored.reject().reason;
  World again = std::move(restored).value();
  EXPECT_EQ(again.effects(), world.effects());
  run_for(world, 3);
  run_for(again, 3);
  EXPECT_EQ(again.serialise(), world.serialise());
}

TEST(RestitutionWorld, OneTellsTheStoryOfThePlainWorld) {
  World plain = granular_gas(8, 0.3, {});
  World unit = granular_gas(8, 0.3, with({1, 1, 0}));
  const auto a = run_for(plain, 10);
  const auto b = run_for(unit, 10);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].instant, b[i].instant);
    ASSERT_EQ(a[i].velocity_a, b[i].velocity_a);
  }
}

TEST(RestitutionWorld, RefusesNumbersOutOfRange) {
  const auto field = [](const Restitution& restitution) {
    Effects effects;
    effects.restitution = restitution;
    const auto reject = check_effects(effects);
    return reject ? reject->field : std::string();
  };
  EXPECT_EQ(field({1.5, 1, 0}), "restitution.coefficient");
  EXPECT_EQ(field({std::nan(""), 1, 0}), "restitution.coefficient");
  EXPECT_EQ(field({0.5, -0.1, 0}), "restitution.wall_coefficient");
  EXPECT_EQ(field({0.5, 0.5, -1}), "restitution.contact_duration");
  EXPECT_EQ(field({0.5, 0.5, HUGE_VAL}), "restitution.contact_duration");
  EXPECT_EQ(field({0, 0, 0}), "");
  EXPECT_THROW(World(with({2, 1, 0})), std::invalid_argument);
}

}  // namespace
}  // namespace stoss::engine

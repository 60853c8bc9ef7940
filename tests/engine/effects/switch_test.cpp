// SPDX-License-Identifier: Apache-2.0
// Effects that are switched while a world lives: what changes, what does not, and one story
// whatever the ticks.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/features.hpp>

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace stoss::engine {
namespace {

using test::run_for;

/// Disks of three sizes thrown about in a box, one static, one kinematic.
World gas(const Effects& effects, BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects = effects;
  options.broad_phase = kind;
  World world(options);
  test::Random random(11);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 49; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    DiskSpec disk = test::disk(
        kNoId, {1.6 * (i % 7) + 1, 1.6 * (i / 7) + 1}, velocity, 0.3 + 0.1 * (i % 3), 1 + i % 2);
    disk.spin = random.uniform(-1, 1);
    disks.push_back(disk);
  }
  disks.push_back(test::static_disk(900, {6.25, 12.9}, 0.4));
  disks.push_back(test::kinematic_disk(901, {1, 12.9}, {0.01, 0}, 0.4));
  test::must_spawn(world, disks, test::box(1'000, {0, 0}, {14, 14}));
  return world;
}

Effects falling() {
  Effects effects;
  effects.gravity = Gravity{{0.1, -3}};
  effects.restitution = Restitution{0.8, 0.7, 0, 1e-3};
  return effects;
}

Effects rough() {
  Effects effects;
  effects.rough = Rough{0.4, 0.3};
  effects.restitution = Restitution{0.9, 0.9, 0, 0};
  return effects;
}

Effects slowed() {
  Effects effects = rough();
  effects.floor_friction = FloorFriction{0.2};
  return effects;
}

Effects heated() {
  Effects effects = falling();
  effects.thermostat = Thermostat{1, 2, 9};
  return effects;
}

std::vector<Effects> kinds() { return {{}, rough(), falling(), slowed(), heated()}; }

void must_switch(World& world, const Effects& effects) {
  const auto outcome = world.set_effects(effects);
  EXPECT_TRUE(outcome.ok()) << outcome.reject().field << ' ' << outcome.reject().reason;
  EXPECT_EQ(world.effects(), effects);
}

TEST(Switch, KeepsEveryBodyWhereItIsAndAsItMoves) {
  for (const Effects& from : kinds()) {
    for (const Effects& to : kinds()) {
      World world = gas(from);
      run_for(world, 2);
      std::vector<BodyState> before;
      world.for_each_disk([&](const BodyState& s) { before.push_back(s); });
      const Counters counted = world.counters();
      must_switch(world, to);
      std::size_t i = 0;
      world.for_each_disk([&](const BodyState& s) {
        const BodyState& old = before[i++];
        EXPECT_EQ(s.id, old.id);
        EXPECT_EQ(s.position, old.position);
        EXPECT_EQ(s.velocity, old.velocity);
        EXPECT_NEAR(s.spin, old.spin, 1e-16);
        EXPECT_NEAR(s.angle, old.angle, 1e-14);
      });
      EXPECT_EQ(i, before.size());
      EXPECT_EQ(world.counters().collisions, counted.collisions);
      EXPECT_EQ(world.counters().regularised, counted.regularised);
      run_for(world, 3);
      EXPECT_EQ(world.census().overlaps, 0U);
      EXPECT_EQ(world.census().missed, 0U);
    }
  }
}

TEST(Switch, OfAContactLawTouchesNoMotion) {
  World world = gas({});
  run_for(world, 2.345);
  std::vector<MotionRecord> before;
  for (const Id id : world.ids()) before.push_back(world.motion(id).value());
  const auto bytes = world.serialise();
  const std::uint64_t hash = world.state_hash();
  must_switch(world, rough());
  EXPECT_NE(world.state_hash(), hash) << "the effects are part of the state";
  for (const MotionRecord& motion : before) {
    const MotionRecord now = world.motion(motion.id).value();
    EXPECT_EQ(now.since, motion.since);
    EXPECT_EQ(now.x.high, motion.x.high);
    EXPECT_EQ(now.x.low, motion.x.low);
    EXPECT_EQ(now.vy.high, motion.vy.high);
    EXPECT_EQ(now.vy.low, motion.vy.low);
  }
  must_switch(world, {});
  EXPECT_EQ(world.serialise(), bytes) << "on and off again: not a bit";
  EXPECT_EQ(world.state_hash(), hash);
}

// The disks that stand still have the same law with and without friction: they are left alone.
TEST(Switch, OfAMotionLawIsAnEventOfTheBodiesConcernedAlone) {
  World world;
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {1, 0.3}, 0.5),
                    test::disk(2, {0, 50}, {0, 0}, 0.5),
                    test::kinematic_disk(3, {0, 90}, {1, 0}, 0.5)},
                   std::vector<WallSpec>{test::wall(4, {-9, -20}, {9, -20}, {0, 0.1})});
  run_for(world, 1.5);
  Effects effects;
  effects.floor_friction = FloorFriction{0.25};
  must_switch(world, effects);
  EXPECT_EQ(world.motion(1).value().since, world.now());
  for (const Id id : {Id{2}, Id{3}, Id{4}}) EXPECT_EQ(world.motion(id).value().since, Instant{});
  run_for(world, 10);
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(0, 0));
}

TEST(Switch, GivesTheMotionsThatTheLawsSay) {
  World world;
  test::must_spawn(world, {test::disk(1, {0, 0}, {3, 4}, 0.5)});
  run_for(world, 1);
  Effects effects;
  effects.gravity = Gravity{{0, -2}};
  must_switch(world, effects);
  run_for(world, 1);
  EXPECT_EQ(test::state(world, 1).position, Vector2(6, 7));
  EXPECT_EQ(test::state(world, 1).velocity, Vector2(3, 2));
  effects.gravity = Gravity{{1, 0}};
  must_switch(world, effects);
  run_for(world, 1);
  EXPECT_EQ(test::state(world, 1).position, Vector2(9.5, 9));
  must_switch(world, {});
  run_for(world, 1);
  EXPECT_EQ(test::state(world, 1).position, Vector2(13.5, 11));
}

TEST(Switch, LetsGoOfWhatRestsWhenThePullChanges) {
  World world = gas(falling());
  test::must_spawn(
      world, {test::disk(800, {-3, 0.5}, {0, 0}, 0.5)}, test::box(801, {-5, 0}, {-1, 9}));
  run_for(world, 1);
  const std::uint64_t events = world.counters().collisions;
  Effects up = falling();
  up.gravity = Gravity{{0, 3}};
  must_switch(world, up);
  run_for(world, 1);
  EXPECT_NEAR(test::state(world, 800).position.y(), 0.5 + 1.5, 1e-12);
  EXPECT_GT(world.counters().collisions, events);
  Effects softer = up;
  softer.restitution->coefficient = 0.2;
  const MotionRecord flying = world.motion(800).value();
  must_switch(world, softer);
  EXPECT_EQ(world.motion(800).value().since, flying.since);
}

/// Runs with a story of switches at fixed instants; ticks in between.
World run_story(BroadPhaseKind kind, int ticks, bool with_pauses) {
  World world = gas({}, kind);
  const std::vector<Effects> story = {heated(), falling(), {}, slowed(), rough(), heated(), {}};
  double now = 0;
  for (const Effects& effects : story) {
    for (int i = 1; i <= ticks; ++i) {
      EXPECT_TRUE(world.advance_to(test::seconds(now + 1.25 * i / ticks)).ok());
    }
    now += 1.25;
    must_switch(world, effects);
    if (with_pauses) world = World::deserialise(world.serialise(), kind).value();
  }
  EXPECT_TRUE(world.advance_to(test::seconds(now + 2)).ok());
  return world;
}

TEST(Switch, TellsOneStoryWhateverTheTicksTheBroadPhaseAndPausesInBytes) {
  const World leap = run_story(BroadPhaseKind::Neighbours, 1, false);
  EXPECT_EQ(leap.serialise(), run_story(BroadPhaseKind::Neighbours, 64, false).serialise());
  EXPECT_EQ(leap.serialise(), run_story(BroadPhaseKind::AllPairs, 3, true).serialise());
  EXPECT_GT(leap.counters().collisions, 300U);
}

TEST(Switch, IsTheSameInEveryArithmetic) {
  for (const Arithmetic arithmetic : {Arithmetic::Float, Arithmetic::LongDouble}) {
    WorldOptions options;
    options.arithmetic = arithmetic;
    World world(options);
    test::must_spawn(world, {test::disk(1, {0, 5}, {1, 0}, 0.5)}, test::box(2, {-9, 0}, {9, 9}));
    run_for(world, 1);
    must_switch(world, heated());
    run_for(world, 3);
    must_switch(world, {});
    run_for(world, 3);
    EXPECT_EQ(world.arithmetic(), arithmetic);
    EXPECT_EQ(world.census().overlaps, 0U);
  }
}

TEST(Switch, IsSeenByThoseWhoFollowChanges) {
  World world = gas({});
  run_for(world, 1);
  world.drain_changes();
  must_switch(world, rough());
  EXPECT_TRUE(world.drain_changes().empty());
  must_switch(world, falling());
  const auto changes = world.drain_changes();
  ASSERT_EQ(changes.size(), 49U) << "the dynamic disks";
  for (const Change& change : changes) EXPECT_EQ(change.kind, ChangeKind::Moved);
}

TEST(Switch, OfTheThermostatsRateKeepsWhatIsDrawn) {
  Effects slow, fast;
  slow.thermostat = Thermostat{1, 0.5, 4};
  fast.thermostat = Thermostat{1, 5, 4};
  const auto next_kick = [](World world) {
    const std::uint64_t kicks = world.counters().kicks;
    while (world.counters().kicks == kicks) {
      EXPECT_TRUE(world.advance_to(test::seconds(1e3), nullptr, 1).ok());
    }
    return seconds_between({}, world.now());
  };
  WorldOptions options;
  options.effects = slow;
  World world(options);
  test::must_spawn(world, {test::disk(1, {0, 0}, {0, 0}, 0.5)});
  run_for(world, 0.125);
  const double before = next_kick(world);
  World other = world;
  must_switch(other, fast);
  EXPECT_NEAR(next_kick(other), 0.125 + (before - 0.125) / 10, 1e-15);
  must_switch(other, slow);
  EXPECT_NEAR(next_kick(other), before, 1e-14);
  slow.thermostat->temperature = 7;
  must_switch(world, slow);
  EXPECT_EQ(next_kick(world), before);
}

TEST(Switch, ThatIsRefusedChangesNothing) {
  World world = gas(falling());
  run_for(world, 1);
  const auto before = test::fingerprint(world);
  Effects wrong = falling();
  wrong.rough = Rough{0, 1};
  EXPECT_EQ(world.set_effects(wrong).reject().code, Code::Unimplemented);
  wrong = falling();
  wrong.restitution->coefficient = 2;
  EXPECT_EQ(world.set_effects(wrong).reject().field, "restitution.coefficient");
  EXPECT_EQ(test::fingerprint(world), before);
}

// -- The tables

TEST(Features, HaveEveryEffectWithItsNumbers) {
  for (const EffectInfo& effect : known_effects()) {
    Effects effects;
    EXPECT_FALSE(effect.is_on(effects));
    effect.set(effects, true);
    EXPECT_TRUE(effect.is_on(effects)) << effect.name;
    EXPECT_NE(effects, Effects{});
    EXPECT_FALSE(settings_of(effects).empty()) << effect.name;
    effect.set(effects, false);
    EXPECT_EQ(effects, Effects{});
  }
  EXPECT_EQ(find_refusal("gravity", "rough"), find_refusal("rough", "gravity"));
  EXPECT_EQ(find_refusal("rough", "restitution"), nullptr);
}

TEST(Features, CombinationsAreRefusedAsTheTableSays) {
  for (const EffectInfo& a : known_effects()) {
    for (const EffectInfo& b : known_effects()) {
      if (a.name == b.name) continue;
      Effects effects;
      a.set(effects, true);
      b.set(effects, true);
      const auto reject = check_effects(effects);
      const Refusal* const refusal = find_refusal(a.name, b.name);
      ASSERT_EQ(reject.has_value(), refusal != nullptr) << a.name << " and " << b.name;
      if (!reject) continue;
      EXPECT_EQ(reject->code, Code::Unimplemented);
      EXPECT_EQ(reject->field, refusal->effect);
      EXPECT_EQ(reject->reason, refusal->reason);
    }
  }
}

TEST(Features, SettingsAreReadAndWrittenByName) {
  const auto effects =
      changed_effects({},
                      {},
                      std::array<EffectSetting, 3>{{{"gravity.acceleration.x", 1},
                                                    {"gravity.acceleration.y", -9},
                                                    {"restitution.coefficient", 0.5}}});
  ASSERT_TRUE(effects.ok());
  EXPECT_EQ(effects.value().gravity->acceleration, Vector2(1, -9));
  EXPECT_EQ(effects.value().restitution->wall_coefficient, 0.5) << "by default the same";
  const auto again = changed_effects({}, {}, settings_of(effects.value()));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again.value(), effects.value());
  const std::array<std::string, 1> off = {"gravity"};
  EXPECT_FALSE(changed_effects(effects.value(), off, {}).value().gravity);
  EXPECT_EQ(changed_effects({}, off, {}).reject().reason, "is not on");
}

TEST(Features, SettingsThatMakeNoSenseAreRefusedByName) {
  const auto field = [](const EffectSetting& setting) {
    const auto outcome = changed_effects({}, {}, std::span(&setting, 1));
    return outcome.ok() ? "" : outcome.reject().field;
  };
  EXPECT_EQ(field({"gravity.acceleration.x", 1}), "gravity.acceleration.y");
  EXPECT_EQ(field({"gravity", 1}), "gravity");
  EXPECT_EQ(field({"magnetism.strength", 1}), "magnetism.strength");
  EXPECT_EQ(field({"restitution.coefficient", 1.5}), "restitution.coefficient");
  EXPECT_EQ(field({"thermostat.seed", 0.5}), "thermostat.seed");
  EXPECT_EQ(field({"floor_friction.deceleration", 2}), "");
}

}  // namespace
}  // namespace stoss::engine

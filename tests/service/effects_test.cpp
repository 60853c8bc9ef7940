// SPDX-License-Identifier: Apache-2.0
// Effects that a command switches: when, for whom, and how the publisher learns of it.
#include "fixture.hpp"

#include <questions.hpp>

namespace stoss::service::testing {
namespace {

using engine::Code;
using engine::Instant;

class EffectCommands : public SimulationTest {
 protected:
  static translate::CommandSpec set(std::vector<engine::EffectSetting> settings,
                                    std::vector<std::string> off = {}) {
    translate::CommandSpec spec = make(idl::Op::kSetEffects);
    spec.settings = std::move(settings);
    spec.effects_off = std::move(off);
    return spec;
  }

  static translate::CommandSpec fall_down() {
    return set({{"gravity.acceleration.x", 0}, {"gravity.acceleration.y", -2}});
  }
};

TEST_F(EffectCommands, SwitchAtTheInstantGivenWhateverTheTicks) {
  std::vector<std::uint64_t> hashes;
  for (const double rate : {7.0, 60.0, 1000.0}) {
    begin({.tick_rate = rate});
    auto down = fall_down();
    down.at = seconds(0.333);
    auto up = set({{"gravity.acceleration.y", 1}});
    up.at = seconds(0.75);
    auto free = set({}, {"gravity"});
    free.at = seconds(1.5);
    send(1, 1, down);
    send(1, 2, up);
    send(1, 3, free);
    run(3.0);
    const Told all = told();
    EXPECT_EQ(all.moment_of(1, 1).at, seconds(0.333));
    EXPECT_EQ(all.code_of(1, 3), Code::Ok);
    const double vy = -2 * (0.75 - 0.333) + 0.75;
    EXPECT_NEAR(simulation->world().state(1).value().velocity.y(), vy, 1e-14);
    EXPECT_EQ(simulation->world().motion(1).value().since, seconds(1.5));
    hashes.push_back(simulation->world().state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_F(EffectCommands, AreToldToThePublisher) {
  begin({.paused = true});
  Told all = told();
  ASSERT_EQ(all.epochs.size(), 1U);
  EXPECT_TRUE(all.epochs[0].effects.empty());
  send(1, 1, set({{"restitution.coefficient", 0.5}}));
  settle();
  all = told();
  ASSERT_EQ(all.ticks.size(), 1U);
  ASSERT_TRUE(all.ticks[0].effects.has_value());
  EXPECT_EQ(all.ticks[0].effects.value(), std::vector<std::string>{"restitution"});
  EXPECT_TRUE(all.ticks[0].changes.empty()) << "a contact law moves nobody";
  send(1, 2, fall_down());
  settle();
  all = told();
  ASSERT_EQ(all.ticks.size(), 1U);
  ASSERT_EQ(all.ticks[0].changes.size(), 1U);
  EXPECT_EQ(all.ticks[0].changes[0].motion.ay.high, -2) << "replicas go on exactly";
  EXPECT_EQ(all.ticks[0].effects.value(), (std::vector<std::string>{"gravity", "restitution"}));
}

TEST_F(EffectCommands, ResetGoesBackToTheScenesOwn) {
  translate::SceneBodies scene = one_disk();
  scene.effects.restitution = engine::Restitution{0.7, 0.6, 0, 0};
  begin({.paused = true}, scene);
  const std::uint64_t hash = simulation->world().state_hash();
  send(1, 1, fall_down());
  send(1, 2, set({}, {"restitution"}));
  settle();
  EXPECT_FALSE(simulation->world().effects().restitution);
  send(1, 3, make(idl::Op::kReset));
  settle();
  EXPECT_EQ(simulation->world().effects(), scene.effects);
  EXPECT_EQ(simulation->world().state_hash(), hash);
  EXPECT_EQ(told().epochs.back().effects, std::vector<std::string>{"restitution"});
}

TEST_F(EffectCommands, AThermostatTakesTheScenesSeedUnlessItIsTold) {
  translate::SceneBodies scene = one_disk();
  scene.seed = 12;
  begin({.paused = true}, scene);
  send(1, 1, set({{"thermostat.temperature", 1}, {"thermostat.rate", 5}}));
  settle();
  EXPECT_EQ(simulation->world().effects().thermostat->seed, 12U);
  send(1, 2, set({{"thermostat.rate", 6}, {"thermostat.seed", 99}}));
  settle();
  EXPECT_EQ(simulation->world().effects().thermostat->seed, 99U);
}

TEST_F(EffectCommands, ThatMakeNoSenseChangeNothing) {
  begin({.paused = true});
  send(1, 1, fall_down());
  settle();
  const std::uint64_t hash = simulation->world().state_hash();
  static_cast<void>(told());
  send(1, 2, set({{"rough.tangential_restitution", 0}, {"rough.friction", 1}}));
  send(1, 3, set({{"restitution.coefficient", 2}}));
  send(1, 4, set({{"magnetism.strength", 2}}));
  send(1, 5, set({}, {"drag"}));
  send(1, 6, set({}, {}));
  send(1, 7, set({{"floor_friction.deceleration", 1}}, {"gravity", "restitution"}));
  settle();
  const Told all = told();
  EXPECT_EQ(all.code_of(1, 2), Code::Unimplemented);
  EXPECT_EQ(all.reply_to(1, 2).reject->field, "rough");
  EXPECT_EQ(all.reply_to(1, 3).reject->field, "restitution.coefficient");
  EXPECT_EQ(all.reply_to(1, 4).reject->field, "magnetism.strength");
  for (const std::uint64_t number : {3U, 4U, 5U, 6U, 7U}) {
    EXPECT_EQ(all.code_of(1, number), Code::InvalidArgument) << number;
  }
  EXPECT_EQ(simulation->world().state_hash(), hash);
  EXPECT_TRUE(all.ticks.empty()) << "nothing has changed, so nothing is told";
}

TEST_F(EffectCommands, AVerifiedWorldKeepsNoBooksOfWhatDoesNotLast) {
  begin({.tick_rate = 100, .verify = 1});
  send(1, 1, fall_down());
  run(0.5);
  send(1, 2, set({}, {"gravity"}));
  run(1.6);
  const WorldStatus status = told().statuses.back();
  EXPECT_LE(status.verified.energy_error, 1e-14);
  EXPECT_LE(status.verified.momentum_error, 1e-14);
}

TEST(Features, NameWhatIsOnAndWhatDoesNotGoTogether) {
  engine::Effects effects;
  effects.gravity = engine::Gravity{{0, -9.81}};
  const auto words = features(effects);
  const auto has = [&](const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  EXPECT_TRUE(has("command:SET_EFFECTS"));
  EXPECT_TRUE(has("effect:thermostat"));
  EXPECT_TRUE(has("refused:rough+gravity"));
  EXPECT_TRUE(has("setting:gravity.acceleration.y=-9.81"));
  EXPECT_LE(words.size(), std::size_t{stoss_v1_MAX_FEATURES});
  for (const std::string& word : words)
    EXPECT_LE(word.size(), std::size_t{stoss_v1_MAX_NAME_LENGTH});
}

}  // namespace
}  // namespace stoss::service::testing

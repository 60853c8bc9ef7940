// SPDX-License-Identifier: Apache-2.0
// simulate: from the command line to SimulateOptions.

#include "cli/common.hpp"
#include "cli/simulate.hpp"

#include <stoss/engine/verify.hpp>
#include <stoss/translate/basics.hpp>
#include <stoss/translate/scene.hpp>

#include <cmath>

namespace stoss::client::cli {
namespace {

struct SimulateTexts {
  std::string scene;
  std::string until;
  std::string tick_rate;
  std::string collisions;
  std::string zones;
  std::string states;
  std::string save_scene;
  std::string scalar = "double";
  std::string broad_phase = "neighbours";
  std::string method = "exact";
  std::string step;
  std::string max_collisions;
  std::string verify;
  bool stats = false;
  bool hash = false;
};

engine::Arithmetic arithmetic_named(const std::string& name) {
  std::string known;
  for (const engine::Arithmetic arithmetic : translate::arithmetics()) {
    if (name == translate::name_of(arithmetic)) return arithmetic;
    known += (known.empty() ? "" : ", ") + std::string(translate::name_of(arithmetic));
  }
  throw UsageError("--scalar: \"" + name + "\" is not one of " + known);
}

engine::BroadPhaseKind broad_phase_named(const std::string& name) {
  const auto kind = translate::broad_phase_of(name);
  if (!kind) throw UsageError("--broad-phase: must be neighbours or all-pairs");
  return *kind;
}

double positive(const std::string& option, const std::string& text) {
  const double value = number_of(option, text);
  if (!(value > 0) || std::isinf(value)) {
    throw UsageError(option + ": must be above 0 and finite");
  }
  return value;
}

engine::Instant duration(const std::string& option, const std::string& text) {
  const engine::Instant value = instant_of(option, text);
  if (value < engine::Instant{}) throw UsageError(option + ": must not be negative");
  return value;
}

/// Nothing: off. "true" is what CLI11 makes of the option without a number.
std::uint64_t verify_period(const std::string& text) {
  if (text.empty()) return 0;
  if (text == "true") return engine::kVerifyPeriod;
  const std::uint64_t period = count_of("--verify", text);
  if (period == 0) throw UsageError("--verify: must be above 0");
  return period;
}

void read_method(const SimulateTexts& texts, SimulateOptions& options) {
  if (texts.method != "exact" && texts.method != "fixed-step") {
    throw UsageError("--method: must be exact or fixed-step");
  }
  const bool stepped = texts.method == "fixed-step";
  if (stepped && options.save_scene) {
    throw UsageError("--save-scene: of the exact method alone");
  }
  if (stepped && texts.step.empty()) throw UsageError("--method fixed-step needs --step");
  if (!stepped && !texts.step.empty()) throw UsageError("--step is for --method fixed-step");
  if (stepped && options.zones) throw UsageError("--zones is for --method exact");
  if (stepped && options.verify != 0) throw UsageError("--verify is for --method exact");
  if (stepped) options.step = positive("--step", texts.step);
}

SimulateOptions options_of(const SimulateTexts& texts, bool json) {
  SimulateOptions options;
  options.scene = texts.scene;
  if (!texts.until.empty()) options.until = duration("--until", texts.until);
  if (!texts.tick_rate.empty()) options.tick_rate = positive("--tick-rate", texts.tick_rate);
  if (!texts.collisions.empty()) options.collisions = texts.collisions;
  if (!texts.zones.empty()) options.zones = texts.zones;
  if (!texts.states.empty()) options.states = texts.states;
  if (!texts.save_scene.empty()) options.save_scene = texts.save_scene;
  options.arithmetic = arithmetic_named(texts.scalar);
  options.broad_phase = broad_phase_named(texts.broad_phase);
  if (!texts.max_collisions.empty()) {
    options.max_collisions = count_of("--max-collisions", texts.max_collisions);
  }
  options.verify = verify_period(texts.verify);
  options.stats = texts.stats;
  options.hash = texts.hash;
  options.json = json;
  read_method(texts, options);
  return options;
}

}  // namespace

void add_simulate_verb(CLI::App& app, Invocation& invocation) {
  auto texts = std::make_shared<SimulateTexts>();
  CLI::App* verb =
      add_verb(app,
               "simulate",
               "Run a scene offline with the same engine, as fast as it goes",
               "stoss simulate clients/scenes/pi-2.json --until 20 --collisions - --stats");
  verb->add_option("SCENE", texts->scene, "A .json, .textproto or .binpb file")->required();
  verb->add_option("--until", texts->until, "Simulated seconds from the scene's start");
  verb->add_option("--tick-rate",
                   texts->tick_rate,
                   "Advance in ticks of 1/HZ; changes no byte of output (default: one leap)");
  verb->add_option("--collisions",
                   texts->collisions,
                   "Write the collisions as JSON Lines to this file; -: standard output");
  verb->add_option(
      "--zones", texts->zones, "Write entries into zones and exits as JSON Lines to this file");
  verb->add_option(
      "--states", texts->states, "Write the final states of all disks as JSON Lines to this file");
  verb->add_option(
      "--save-scene",
      texts->save_scene,
      "Write the end as a scene to begin with; where disks grew, without their growth");
  verb->add_option("--scalar",
                   texts->scalar,
                   "Arithmetic: float, double, long-double, double-double or float128")
      ->capture_default_str();
  verb->add_option(
          "--broad-phase", texts->broad_phase, "neighbours or all-pairs; changes no byte of output")
      ->capture_default_str();
  verb->add_option(
          "--method", texts->method, "exact, or fixed-step: the textbook baseline to compare with")
      ->capture_default_str();
  verb->add_option("--step", texts->step, "Time step of fixed-step [s]");
  verb->add_option("--max-collisions", texts->max_collisions, "Stop right after so many");
  verb->add_option("--verify",
                   texts->verify,
                   "Check the whole world for overlaps, missed contacts and drift every so many "
                   "events (100000 unless given); changes no byte of output")
      ->type_name("[EVENTS]")
      ->expected(0, 1);
  verb->add_flag("--stats", texts->stats, "A JSON object of statistics on standard error");
  verb->add_flag(
      "--hash",
      texts->hash,
      "Print a digest (FNV-1a, 64 bits) of the collision log's bytes and the state hash");
  verb->callback([&invocation, texts] {
    invocation.action = [&global = invocation.global, texts] {
      simulate(options_of(*texts, global.json));
    };
  });
}

}  // namespace stoss::client::cli

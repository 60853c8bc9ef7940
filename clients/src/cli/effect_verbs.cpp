// SPDX-License-Identifier: Apache-2.0
// features, effects, effects set, effects off

#include "cli/common.hpp"
#include "cli/features_text.hpp"
#include "cli/json_object.hpp"
#include "cli/live_settings.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/engine/features.hpp>

#include <utility>

namespace stoss::client::cli {
namespace {

// -- features

std::string word_list(const std::vector<std::string>& words, bool json) {
  std::string text = json ? "[" : "";
  for (const std::string& word : words) {
    if (!json) {
      text += word + '\n';
      continue;
    }
    if (text.size() > 1) text += ',';
    idl::append_string(text, word);
  }
  return json ? text + "]\n" : text;
}

void features(const GlobalOptions& global, bool live) {
  if (!live) {
    print(global.json ? features_json() : features_text());
    return;
  }
  const auto session = connect(global);
  print(word_list(value_or_throw(session->ask(Query::features())).features, global.json));
}

void add_features(CLI::App& app, Invocation& invocation) {
  auto live = std::make_shared<bool>(false);
  CLI::App* verb = add_verb(
      app, "features", "List effects, which go together, and limits", "stoss features --json");
  verb->add_flag("--live", *live, "Ask a daemon for its own, in the words of the protocol");
  verb->callback([&invocation, live] {
    invocation.action = [&invocation, live] { features(invocation.global, *live); };
  });
}

// -- effects

void show(const GlobalOptions& global) {
  const auto session = connect(global);
  const std::vector<engine::EffectSetting> settings = live_settings(*session);
  if (global.json) {
    JsonObject object;
    for (const engine::EffectSetting& setting : settings) {
      object.number(setting.name, setting.value);
    }
    print(object.text() + '\n');
    return;
  }
  if (settings.empty()) print("no effects are on\n");
  for (const engine::EffectSetting& setting : settings) {
    print(setting.name + '=' + format_number(setting.value) + '\n');
  }
}

struct SwitchOptions {
  std::vector<std::string> words;
  std::string at;
};

/// NAME=NUMBER, or NAME=X,Y for a vector.
void append_setting(const std::string& word, std::vector<engine::EffectSetting>& settings) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError(word + ": must be EFFECT.NAME=NUMBER or EFFECT.NAME=X,Y");
  }
  const std::string name = word.substr(0, equals);
  const std::string value = word.substr(equals + 1);
  if (value.find(',') == std::string::npos) {
    settings.push_back({name, number_of(name, value)});
    return;
  }
  const engine::Vector2 v = vector_of(name, value);
  settings.push_back({name + ".x", v.x()});
  settings.push_back({name + ".y", v.y()});
}

void send(const GlobalOptions& global, Command command, const SwitchOptions& options) {
  if (!options.at.empty()) command.at(instant_of("--at", options.at));
  const auto session = connect(global);
  print(reply_text(value_or_throw(session->command(command)), global.json));
}

void set(const GlobalOptions& global, const SwitchOptions& options) {
  std::vector<engine::EffectSetting> settings;
  for (const std::string& word : options.words) append_setting(word, settings);
  send(global, Command::set_effects({}, std::move(settings)), options);
}

void off(const GlobalOptions& global, const SwitchOptions& options) {
  send(global, Command::set_effects(options.words, {}), options);
}

using Act = void (*)(const GlobalOptions&, const SwitchOptions&);

void add_switch(CLI::App& effects,
                Invocation& invocation,
                const std::string& name,
                const std::string& description,
                const std::string& example,
                const std::string& symbol,
                const std::string& meaning,
                Act act) {
  auto options = std::make_shared<SwitchOptions>();
  CLI::App* verb = add_verb(effects, name, description, example);
  verb->add_option(symbol, options->words, meaning)->required();
  verb->add_option("--at", options->at, "Instant of the world's clock at which to apply it [s]");
  verb->callback([&invocation, options, act] {
    invocation.action = [&invocation, options, act] { act(invocation.global, *options); };
  });
}

void add_effects(CLI::App& app, Invocation& invocation) {
  CLI::App* verb = add_verb(app,
                            "effects",
                            "Show the effects that are on, or switch them while the world lives",
                            "stoss effects set gravity.acceleration=0,-9.81 --at 12.5");
  verb->require_subcommand(0, 1);
  verb->callback([verb, &invocation] {
    if (!verb->get_subcommands().empty()) return;  // it has said what to do
    invocation.action = [&invocation] { show(invocation.global); };
  });
  add_switch(*verb,
             invocation,
             "set",
             "Set numbers of effects; the first switches its effect on",
             "stoss effects set restitution.coefficient=0.9 gravity.acceleration=0,-9.81",
             "SETTING",
             "EFFECT.NAME=NUMBER or EFFECT.NAME=X,Y; `stoss features` lists them",
             set);
  add_switch(*verb,
             invocation,
             "off",
             "Switch effects off",
             "stoss effects off gravity restitution",
             "EFFECT",
             "Its name",
             off);
}

}  // namespace

void add_effect_verbs(CLI::App& app, Invocation& invocation) {
  add_features(app, invocation);
  add_effects(app, invocation);
}

}  // namespace stoss::client::cli

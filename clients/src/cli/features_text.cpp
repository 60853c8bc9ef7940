// SPDX-License-Identifier: Apache-2.0
#include "cli/features_text.hpp"

#include "cli/json_object.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/engine/features.hpp>
#include <stoss/engine/world.hpp>
#include <stoss/translate/basics.hpp>
#include <stoss/translate/scene.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace stoss::client::cli {
namespace {

struct Limit {
  const char* name;
  double value;
  const char* unit;
  const char* meaning;
};

std::vector<Limit> limits() {
  return {
      {"length", engine::kLengthMaxM, "m", "largest coordinate and radius (1e30 in float)"},
      {"speed", engine::kSpeedMaxMps, "m/s", "largest component of a velocity (1e30 in float)"},
      {"time", static_cast<double>(engine::kSecondsMax), "s", "instants lie within this of 0"},
      {"overlap", engine::kOverlapTolerance, "1", "of the contact distance: deeper is refused"},
  };
}

bool is_bounded(const engine::EffectParameter& parameter) {
  return parameter.high < std::numeric_limits<double>::max();
}

std::string range(const engine::EffectParameter& parameter) {
  if (!is_bounded(parameter)) return ">= " + format_number(parameter.low);
  return '[' + format_number(parameter.low) + ", " + format_number(parameter.high) + ']';
}

std::string full_name(const engine::EffectParameter& parameter) {
  return std::string(parameter.effect) + '.' + std::string(parameter.name);
}

std::string numbers_text() {
  Table table({"number", "unit", "range", "required", "meaning"});
  for (const engine::EffectParameter& parameter : engine::effect_parameters()) {
    table.add({full_name(parameter) + (parameter.components == 2 ? "=X,Y" : ""),
               std::string(parameter.unit),
               range(parameter),
               parameter.is_required ? "yes" : "no",
               std::string(parameter.meaning)});
  }
  return table.text();
}

std::string combinations_text() {
  std::vector<std::string> heads = {""};
  for (const engine::EffectInfo& effect : engine::known_effects()) heads.emplace_back(effect.name);
  Table table(heads);
  for (const engine::EffectInfo& row : engine::known_effects()) {
    std::vector<std::string> cells = {std::string(row.name)};
    for (const engine::EffectInfo& column : engine::known_effects()) {
      const bool is_refused = engine::find_refusal(row.name, column.name) != nullptr;
      cells.emplace_back(row.name == column.name ? "" : is_refused ? "refused" : "yes");
    }
    table.add(std::move(cells));
  }
  std::string text = table.text();
  for (const engine::Refusal& refusal : engine::refused_combinations()) {
    text += std::string(refusal.effect) + " with " + std::string(refusal.other) + ": " +
            std::string(refusal.reason) + '\n';
  }
  return text;
}

/// The elements, each an object already, as a JSON array.
std::string array(const std::vector<std::string>& elements) {
  std::string text = "[";
  for (const std::string& element : elements) {
    if (text.size() > 1) text += ',';
    text += element;
  }
  return text + ']';
}

std::string parameter_json(const engine::EffectParameter& parameter) {
  JsonObject object;
  object.string("name", parameter.name)
      .string("unit", parameter.unit)
      .number("low", parameter.low)
      .number("high", is_bounded(parameter) ? parameter.high : HUGE_VAL)
      .count("components", static_cast<std::uint64_t>(parameter.components))
      .boolean("required", parameter.is_required)
      .string("meaning", parameter.meaning);
  return object.text();
}

std::string effect_json(const engine::EffectInfo& effect) {
  std::vector<std::string> numbers;
  for (const engine::EffectParameter& parameter : engine::effect_parameters()) {
    if (parameter.effect == effect.name) numbers.push_back(parameter_json(parameter));
  }
  JsonObject object;
  object.string("name", effect.name).string("meaning", effect.meaning);
  return object.object("numbers", array(numbers)).text();
}

std::string combinations_json() {
  std::vector<std::string> pairs;
  const auto effects = engine::known_effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    for (std::size_t j = i + 1; j < effects.size(); ++j) {
      const engine::Refusal* const refusal = engine::find_refusal(effects[i].name, effects[j].name);
      JsonObject object;
      object.string("effect", effects[i].name)
          .string("with", effects[j].name)
          .boolean("works", refusal == nullptr);
      if (refusal != nullptr) object.string("reason", refusal->reason);
      pairs.push_back(object.text());
    }
  }
  return array(pairs);
}

}  // namespace

std::string features_text() {
  std::string text = "Effects\n";
  Table effects({"effect", "meaning"});
  for (const engine::EffectInfo& effect : engine::known_effects()) {
    effects.add({std::string(effect.name), std::string(effect.meaning)});
  }
  text += effects.text() + "\nTheir numbers\n" + numbers_text();
  text += "\nTogether\n" + combinations_text() + "\nLimits\n";
  Table bounds({"limit", "value", "unit", "meaning"});
  for (const Limit& limit : limits()) {
    bounds.add({limit.name, format_number(limit.value), limit.unit, limit.meaning});
  }
  text += bounds.text() + "\nArithmetics\n";
  for (const engine::Arithmetic arithmetic : translate::arithmetics()) {
    text += std::string(translate::name_of(arithmetic)) + '\n';
  }
  return text;
}

std::string features_json() {
  std::vector<std::string> effects, bounds, arithmetics;
  for (const engine::EffectInfo& effect : engine::known_effects()) {
    effects.push_back(effect_json(effect));
  }
  for (const Limit& limit : limits()) {
    JsonObject object;
    object.string("name", limit.name).number("value", limit.value).string("unit", limit.unit);
    bounds.push_back(object.string("meaning", limit.meaning).text());
  }
  for (const engine::Arithmetic arithmetic : translate::arithmetics()) {
    std::string word;
    idl::append_string(word, translate::name_of(arithmetic));
    arithmetics.push_back(std::move(word));
  }
  JsonObject object;
  object.object("effects", array(effects))
      .object("combinations", combinations_json())
      .object("limits", array(bounds))
      .object("arithmetics", array(arithmetics));
  return object.text() + '\n';
}

}  // namespace stoss::client::cli

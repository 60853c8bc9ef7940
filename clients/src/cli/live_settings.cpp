// SPDX-License-Identifier: Apache-2.0
#include "cli/live_settings.hpp"

#include "cli/common.hpp"

#include <stoss/client/decimal.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace stoss::client::cli {
namespace {

constexpr std::string_view kRemedy = "; or load with --bodies-only";

[[noreturn]] void refuse(std::string field, std::string reason) {
  throw RefusedError({.code = engine::Code::FailedPrecondition,
                      .field = std::move(field),
                      .reason = std::move(reason) + std::string(kRemedy)});
}

std::optional<double> find(const std::vector<engine::EffectSetting>& settings,
                           const std::string& name) {
  const auto found = std::find_if(
      settings.begin(), settings.end(), [&name](const auto& one) { return one.name == name; });
  if (found == settings.end()) return std::nullopt;
  return found->value;
}

void compare_axis(const char* field, double wanted, double present) {
  if (wanted == 0 || wanted == present) return;
  const std::string world = present == 0 ? "open" : format_number(present) + " m";
  refuse(field,
         "is " + format_number(wanted) + " m in the scene and " + world +
             " in the world, and fixed there; start stossd with the scene");
}

}  // namespace

std::vector<engine::EffectSetting> live_settings(Session& session) {
  constexpr std::string_view kMark = "setting:";
  const Answer answer = value_or_throw(session.ask(Query::features()));
  std::vector<engine::EffectSetting> settings;
  for (const std::string& word : answer.features) {
    const std::size_t equals = word.find('=');
    if (word.rfind(kMark, 0) != 0 || equals == std::string::npos) continue;
    const std::string name = word.substr(kMark.size(), equals - kMark.size());
    settings.push_back({name, number_of(name, word.substr(equals + 1))});
  }
  return settings;
}

void refuse_differences(const translate::SceneBodies& scene, Session& session) {
  const engine::Vector2& period = session.first_status().period;
  compare_axis("period.x", scene.period.x(), period.x());
  compare_axis("period.y", scene.period.y(), period.y());
  const std::vector<engine::EffectSetting> wanted = engine::settings_of(scene.effects);
  if (wanted.empty()) return;
  const std::vector<engine::EffectSetting> present = live_settings(session);
  for (const engine::EffectSetting& setting : wanted) {
    if (setting.name == "thermostat.seed") continue;
    const std::optional<double> value = find(present, setting.name);
    if (value == setting.value) continue;
    refuse("effects." + setting.name,
           "is " + format_number(setting.value) + " in the scene and " +
               (value ? format_number(*value) : "off") +
               " in the world; `stoss effects set` switches it");
  }
}

}  // namespace stoss::client::cli

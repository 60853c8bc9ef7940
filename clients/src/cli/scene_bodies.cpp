// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_bodies.hpp"

#include "cli/exit_code.hpp"

#include <stoss/idl/scene_file.hpp>
#include <stoss/translate/basics.hpp>

#include <utility>
#include <variant>

namespace stoss::client::cli {

Scene scene_in(const std::string& path) {
  auto loaded = idl::load_scene(path);
  if (const auto* error = std::get_if<idl::SceneError>(&loaded)) {
    throw RefusedError(
        {.code = translate::code_of(idl::wire_value(error->code)).value_or(engine::Code::Internal),
         .field = {},
         .reason = error->message()});
  }
  return std::get<Scene>(std::move(loaded));
}

translate::SceneBodies scene_bodies(const std::string& path) {
  return value_or_refuse(translate::bodies_of(scene_in(path)));
}

void refuse_effects(const translate::SceneBodies& bodies, const std::string& who) {
  if (!bodies.zones.empty()) {
    throw RefusedError(
        {.code = engine::Code::Unimplemented, .field = "zones", .reason = who + " knows no zones"});
  }
  const bool is_open = bodies.period == engine::Vector2::Zero();
  if (bodies.effects == engine::Effects{} && is_open) return;
  throw RefusedError(
      {.code = engine::Code::Unimplemented,
       .field = is_open ? "effects" : "period",
       .reason = who + " knows uniform motion and elastic contacts in open space only"});
}

}  // namespace stoss::client::cli

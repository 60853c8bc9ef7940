// SPDX-License-Identifier: Apache-2.0
#include "questions.hpp"

#include <stoss/engine/features.hpp>
#include <stoss/idl/json_lines.hpp>
#include <stoss/translate/scene.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace stoss::service {
namespace {

using engine::Code;
using engine::Outcome;
using engine::Reject;
using idl::Ask;

Reject invalid(std::string field, std::string reason) {
  return {.code = Code::InvalidArgument, .field = std::move(field), .reason = std::move(reason)};
}

bool finite(const engine::Vector2& v) { return std::isfinite(v.x()) && std::isfinite(v.y()); }

// Adds a body's row; false when there is none of that id.
bool append(const engine::World& world, engine::Id id, Rows& rows) {
  if (const auto state = world.state(id)) {
    rows.states.append(state.value());
    return true;
  }
  const auto wall = world.wall(id);
  if (!wall) return false;
  rows.states.append(wall.value());
  rows.walls.append(wall.value());
  return true;
}

Outcome<Rows> states(const engine::World& world, const translate::QuerySpec& query) {
  if (query.ids.empty()) return invalid("ids", "names no body");
  Rows rows;
  for (std::size_t i = 0; i < query.ids.size(); ++i) {
    if (append(world, query.ids[i], rows)) continue;
    return Reject{.code = Code::NotFound,
                  .field = "ids",
                  .index = i,
                  .body = query.ids[i],
                  .reason = "no such body"};
  }
  return rows;
}

Outcome<Rows> list(const engine::World& world) {
  Rows rows;
  rows.states.reserve(world.disk_count());
  world.for_each_disk([&](const engine::BodyState& state) { rows.states.append(state); });
  world.for_each_wall([&](const engine::WallState& wall) { rows.walls.append(wall); });
  return rows;
}

Outcome<Rows> region(const engine::World& world, const translate::QuerySpec& query) {
  if (!finite(query.low)) return invalid("min_x, min_y", "is not finite");
  if (!finite(query.high)) return invalid("max_x, max_y", "is not finite");
  if (query.low.x() > query.high.x() || query.low.y() > query.high.y()) {
    return invalid("max_x, max_y", "is below min_x, min_y");
  }
  Rows rows;
  std::size_t left = query.count == 0 ? std::numeric_limits<std::size_t>::max() : query.count;
  for (const engine::Id id : world.region(query.low, query.high)) {
    if (left-- == 0) break;
    if (const auto state = world.state(id)) {
      rows.states.append(state.value());
    } else if (const auto wall = world.wall(id)) {
      rows.walls.append(wall.value());
    }
  }
  return rows;
}

Outcome<Rows> nearest(const engine::World& world, const translate::QuerySpec& query) {
  if (!finite(query.point)) return invalid("x, y", "is not finite");
  if (query.count > kNearestMax) {
    return invalid("count", "is above " + std::to_string(kNearestMax));
  }
  const std::size_t count = query.count == 0 ? kNearestMax : query.count;
  Rows rows;
  for (const engine::Near& near : world.nearest(query.point, count)) {
    if (const auto state = world.state(near.id)) {
      rows.states.append(state.value(), near.distance);
    } else if (const auto wall = world.wall(near.id)) {
      rows.states.append(wall.value(), near.distance);
      rows.walls.append(wall.value());
    }
  }
  return rows;
}

Outcome<Rows> ray(const engine::World& world, const translate::QuerySpec& query) {
  if (!finite(query.point)) return invalid("x, y", "is not finite");
  if (!finite(query.direction) || query.direction == engine::Vector2::Zero()) {
    return invalid("direction_x, direction_y", "is not finite, or has no length");
  }
  if (!(query.distance > 0)) return invalid("distance", "must be above 0");
  if (query.count > 1) {
    return Reject{.code = Code::Unimplemented,
                  .field = "count",
                  .reason = "this version finds the first hit of a ray only"};
  }
  Rows rows;
  if (const auto hit = world.ray(query.point, query.direction, query.distance)) {
    rows.hits.append(*hit);
  }
  return rows;
}

}  // namespace

Outcome<Rows> answer(const engine::World& world, const translate::QuerySpec& query) {
  switch (static_cast<Ask>(query.op)) {
    case Ask::kStates:
      return states(world, query);
    case Ask::kList:
      return list(world);
    case Ask::kRegion:
      return region(world, query);
    case Ask::kNearest:
      return nearest(world, query);
    case Ask::kRay:
      return ray(world, query);
    case Ask::kForecast:
      return query.ids.empty() ? list(world) : states(world, query);
    case Ask::kWorld:
    case Ask::kCollisions:
    case Ask::kZoneEvents:
    case Ask::kFeatures:
    case Ask::kStatus:
    case Ask::kPredict:
      break;
  }
  return Reject{.code = Code::Unimplemented,
                .field = "op",
                .reason = "operation " + std::to_string(query.op) + " is not in this version"};
}

std::vector<std::string> features(const engine::Effects& on) {
  std::vector<std::string> words = {
      "SPAWNING",
      "SPAWNING_ENTITIES",
      "DELETING",
      "ENTITY_STATE_GETTING",
      "ENTITY_STATE_SETTING",
      "SIMULATION_RESET",
      "SIMULATION_STATE_GETTING",
      "SIMULATION_STATE_SETTING",
      "SIMULATION_STATE_PAUSE",
      "STEP_SIMULATION_SINGLE",
      "STEP_SIMULATION_MULTIPLE",
  };
  for (const idl::Op op : {idl::Op::kSpawn,
                           idl::Op::kRemove,
                           idl::Op::kSetVelocity,
                           idl::Op::kApplyImpulse,
                           idl::Op::kSetEffects,
                           idl::Op::kPause,
                           idl::Op::kResume,
                           idl::Op::kStep,
                           idl::Op::kRunFor,
                           idl::Op::kRunTo,
                           idl::Op::kSetSpeed,
                           idl::Op::kReset,
                           idl::Op::kWatch,
                           idl::Op::kUnwatch}) {
    words.push_back("command:" + std::string(idl::name_of(op)));
  }
  for (const Ask ask : {Ask::kStates,
                        Ask::kList,
                        Ask::kRegion,
                        Ask::kNearest,
                        Ask::kRay,
                        Ask::kWorld,
                        Ask::kCollisions,
                        Ask::kZoneEvents,
                        Ask::kFeatures,
                        Ask::kStatus,
                        Ask::kForecast}) {
    words.push_back("query:" + std::string(idl::name_of(ask)));
  }
  for (const engine::Arithmetic arithmetic : translate::arithmetics()) {
    words.push_back("scalar:" + std::string(translate::name_of(arithmetic)));
  }
  for (const std::string_view effect : translate::engine_effects()) {
    words.push_back("effect:" + std::string(effect));
  }
  words.emplace_back("world:periodic");
  for (const engine::Refusal& refusal : engine::refused_combinations()) {
    words.push_back("refused:" + std::string(refusal.effect) + "+" + std::string(refusal.other));
  }
  for (const engine::EffectSetting& setting : engine::settings_of(on)) {
    std::string word = "setting:" + setting.name + "=";
    idl::append_number(word, setting.value);
    words.push_back(std::move(word));
  }
  return words;
}

}  // namespace stoss::service

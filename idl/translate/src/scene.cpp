// SPDX-License-Identifier: Apache-2.0
#include <stoss/engine/features.hpp>
#include <stoss/idl/scene_file.hpp>
#include <stoss/translate/basics.hpp>
#include <stoss/translate/scene.hpp>
#include <stoss/wide/world.hpp>

#include <algorithm>
#include <utility>

namespace stoss::translate {
namespace {

using engine::Code;
using engine::Reject;

engine::Vector2 vector_of(const Vector2& v) { return {v.x(), v.y()}; }

std::optional<engine::BodyKind> kind_of(Disk::Kind kind) {
  switch (kind) {
    case Disk::DYNAMIC:
      return engine::BodyKind::Dynamic;
    case Disk::KINEMATIC:
      return engine::BodyKind::Kinematic;
    case Disk::STATIC:
      return engine::BodyKind::Static;
    case Disk_Kind_Disk_Kind_INT_MIN_SENTINEL_DO_NOT_USE_:
    case Disk_Kind_Disk_Kind_INT_MAX_SENTINEL_DO_NOT_USE_:
      return std::nullopt;
  }
  return std::nullopt;
}

Reject unimplemented(std::string field, std::string reason) {
  return {.code = Code::Unimplemented, .field = std::move(field), .reason = std::move(reason)};
}

engine::DiskSpec spec_of(const Disk& disk, engine::BodyKind kind) {
  return {.id = disk.id(),
          .kind = kind,
          .position = vector_of(disk.position()),
          .velocity = vector_of(disk.velocity()),
          .radius = disk.radius(),
          .mass = disk.has_mass() ? disk.mass() : 1,
          .angle = disk.angle(),
          .spin = disk.spin()};
}

engine::WallSpec spec_of(const Wall& wall) {
  return {.id = wall.id(),
          .start = vector_of(wall.start()),
          .end = vector_of(wall.end()),
          .velocity = vector_of(wall.velocity())};
}

engine::ZoneSpec spec_of(const Zone& zone) {
  return {.id = zone.id(), .center = vector_of(zone.center()), .radius = zone.radius()};
}

engine::Effects effects_of(const Effects& asked, std::uint64_t seed) {
  engine::Effects effects;
  if (asked.has_gravity()) {
    effects.gravity = engine::Gravity{vector_of(asked.gravity().acceleration())};
  }
  if (asked.has_floor_friction()) {
    effects.floor_friction = engine::FloorFriction{asked.floor_friction().deceleration()};
  }
  if (asked.has_restitution()) {
    const Restitution& restitution = asked.restitution();
    effects.restitution = engine::Restitution{
        .coefficient = restitution.coefficient(),
        .wall_coefficient = restitution.has_wall_coefficient() ? restitution.wall_coefficient()
                                                               : restitution.coefficient(),
        .contact_duration = restitution.contact_duration(),
        .rest_speed = restitution.rest_speed()};
  }
  if (asked.has_drag()) effects.drag = engine::Drag{asked.drag().rate()};
  if (asked.has_growth()) effects.growth = engine::Growth{asked.growth().rate()};
  if (asked.has_rough()) {
    effects.rough = engine::Rough{.tangential_restitution = asked.rough().tangential_restitution(),
                                  .friction = asked.rough().friction()};
  }
  if (asked.has_thermostat()) {
    effects.thermostat = engine::Thermostat{.temperature = asked.thermostat().temperature(),
                                            .rate = asked.thermostat().rate(),
                                            .seed = seed};
  }
  return effects;
}

}  // namespace

std::span<const std::string_view> engine_effects() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names;
    for (const engine::EffectInfo& effect : engine::known_effects()) names.push_back(effect.name);
    return names;
  }();
  return kNames;
}

std::optional<Reject> unsupported(const Scene& scene) {
  const auto known = engine_effects();
  for (const std::string& name : idl::effect_names(scene)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return unimplemented("effects." + name, "this version has no exact " + name);
    }
  }
  return std::nullopt;
}

engine::Outcome<SceneBodies> bodies_of(const Scene& scene) {
  if (auto reject = unsupported(scene)) return *std::move(reject);
  SceneBodies bodies;
  bodies.start = {scene.start().seconds(), scene.start().fraction()};
  bodies.effects = effects_of(scene.effects(), scene.seed());
  bodies.seed = scene.seed();
  if (auto reject = engine::check_effects(bodies.effects)) {
    reject->field = "effects." + reject->field;
    return *std::move(reject);
  }
  bodies.period = vector_of(scene.period());
  if (auto reject = engine::check_period(bodies.period)) return *std::move(reject);
  bodies.disks.reserve(static_cast<std::size_t>(scene.disks_size()));
  bodies.disk_names.reserve(bodies.disks.capacity());
  for (const Disk& disk : scene.disks()) {
    const auto kind = kind_of(disk.kind());
    if (!kind) {
      return Reject{.code = Code::InvalidArgument,
                    .field = "disks[" + std::to_string(bodies.disks.size()) + "].kind",
                    .index = bodies.disks.size(),
                    .body = disk.id(),
                    .reason = "is unknown"};
    }
    bodies.disks.push_back(spec_of(disk, *kind));
    bodies.disk_names.push_back(disk.name());
  }
  for (const Wall& wall : scene.walls()) {
    bodies.walls.push_back(spec_of(wall));
    bodies.wall_names.push_back(wall.name());
  }
  for (const Zone& zone : scene.zones()) {
    bodies.zones.push_back(spec_of(zone));
    bodies.zone_names.push_back(zone.name());
  }
  return bodies;
}

const std::string& SceneBodies::name_of(std::size_t i) const {
  if (i < disk_names.size()) return disk_names[i];
  i -= disk_names.size();
  return i < wall_names.size() ? wall_names[i] : zone_names[i - wall_names.size()];
}

std::vector<engine::Arithmetic> arithmetics() {
  std::vector<engine::Arithmetic> available;
  for (const auto arithmetic : {engine::Arithmetic::Float,
                                engine::Arithmetic::Double,
                                engine::Arithmetic::LongDouble,
                                engine::Arithmetic::DoubleDouble,
                                engine::Arithmetic::Float128}) {
    if (wide::is_available(arithmetic)) available.push_back(arithmetic);
  }
  return available;
}

engine::Outcome<SceneWorld> make_world(const SceneBodies& bodies, const WorldChoice& choice) {
  if (!engine::in_range(bodies.start)) {
    return Reject{
        .code = Code::InvalidArgument, .field = "start", .reason = "is beyond the end of time"};
  }
  if (!wide::is_available(choice.arithmetic)) {
    return unimplemented("arithmetic",
                         std::string(name_of(choice.arithmetic)) + " is not in this build");
  }
  engine::World world = wide::make_world({.start = bodies.start,
                                          .arithmetic = choice.arithmetic,
                                          .broad_phase = choice.broad_phase,
                                          .effects = bodies.effects,
                                          .period = bodies.period});
  auto made = world.spawn({bodies.disks, bodies.walls, bodies.zones});
  if (!made) return made.reject();
  return SceneWorld{std::move(world), std::move(made).value()};
}

void adopt_ids(SceneBodies& bodies, std::span<const engine::Id> ids) {
  for (std::size_t i = 0; i < bodies.disks.size(); ++i) bodies.disks[i].id = ids[i];
  for (std::size_t i = 0; i < bodies.walls.size(); ++i) {
    bodies.walls[i].id = ids[bodies.disks.size() + i];
  }
  for (std::size_t i = 0; i < bodies.zones.size(); ++i) {
    bodies.zones[i].id = ids[bodies.disks.size() + bodies.walls.size() + i];
  }
}

engine::Outcome<engine::World> make_world(const Scene& scene, const WorldChoice& choice) {
  const auto bodies = bodies_of(scene);
  if (!bodies) return bodies.reject();
  auto made = make_world(bodies.value(), choice);
  if (!made) return made.reject();
  return std::move(made).value().world;
}

}  // namespace stoss::translate

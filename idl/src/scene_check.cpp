// SPDX-License-Identifier: Apache-2.0
// What can be told of a scene without a world: that nothing required is missing, that every number
// is finite and in its range, that no id is given twice.
#include "scene_check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace stoss::idl {
namespace {

// Ends the check at the first fault; never leaves this file.
struct Failure {
  std::string field;
  std::string reason;
};

[[noreturn]] void fail(std::string field, std::string reason) {
  throw Failure{std::move(field), std::move(reason)};
}

// What a field's name begins with; made into text only when something is wrong, for scenes have a
// million bodies.
struct Prefix {
  const char* list = "";
  int index = -1;  // of the body; -1: `list` is all of it

  [[nodiscard]] std::string text() const {
    return index < 0 ? list : list + ('[' + std::to_string(index) + "].");
  }
};

std::string operator+(const Prefix& prefix, const char* name) { return prefix.text() + name; }

std::string shown(double value) {
  constexpr std::size_t kRoom = 32;
  char room[kRoom];
  return {room, std::to_chars(room, room + kRoom, value).ptr};
}

void finite(const Prefix& prefix, const char* name, double value) {
  if (!std::isfinite(value)) fail(prefix + name, "must be finite, but is " + shown(value));
}

void finite(const Prefix& prefix, const char* name, const Vector2& value) {
  if (!std::isfinite(value.x()) || !std::isfinite(value.y())) {
    fail(prefix + name,
         "must be finite, but is (" + shown(value.x()) + ", " + shown(value.y()) + ")");
  }
}

void missing(const Prefix& prefix, const char* name, const char* hint) {
  fail(prefix + name, std::string("is missing; ") + hint);
}

void positive(const Prefix& prefix, const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    fail(prefix + name, "must be finite and greater than 0, but is " + shown(value));
  }
}

void at_least_zero(const Prefix& prefix, const char* name, double value) {
  if (!(value >= 0) || !std::isfinite(value)) {
    fail(prefix + name, "must be finite and at least 0, but is " + shown(value));
  }
}

void between(const Prefix& prefix, const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    fail(prefix + name,
         "must be between " + shown(low) + " and " + shown(high) + ", but is " + shown(value));
  }
}

// Names cross DDS as bounded C strings.
void check_name(const Prefix& prefix, const std::string& name) {
  if (name.size() > stoss_v1_MAX_NAME_LENGTH) {
    fail(prefix + "name",
         "must be at most " + std::to_string(stoss_v1_MAX_NAME_LENGTH) + " bytes long, but has " +
             std::to_string(name.size()));
  }
  if (name.find('\0') != std::string::npos) fail(prefix + "name", "must not hold a zero byte");
}

void check_disk(const Disk& disk, const Prefix& prefix) {
  check_name(prefix, disk.name());
  if (!Disk::Kind_IsValid(disk.kind())) {
    fail(prefix + "kind",
         "must be DYNAMIC, KINEMATIC or STATIC, but is number " +
             std::to_string(static_cast<int>(disk.kind())));
  }
  if (!disk.has_position())
    missing(prefix, "position", "a disk needs its centre, as {x, y} in metres");
  finite(prefix, "position", disk.position());
  finite(prefix, "velocity", disk.velocity());
  if (!disk.has_radius()) missing(prefix, "radius", "a disk needs a radius > 0 in metres");
  positive(prefix, "radius", disk.radius());
  if (disk.has_mass()) positive(prefix, "mass", disk.mass());
  finite(prefix, "angle", disk.angle());
  finite(prefix, "spin", disk.spin());
  const bool moves = disk.velocity().x() != 0 || disk.velocity().y() != 0;
  if (disk.kind() == Disk::STATIC && moves) {
    fail(prefix + "velocity",
         "must be zero for a STATIC disk; one that moves unswervingly is KINEMATIC");
  }
}

void check_wall(const Wall& wall, const Prefix& prefix) {
  check_name(prefix, wall.name());
  if (!wall.has_start()) missing(prefix, "start", "a wall needs both ends, as {x, y} in metres");
  if (!wall.has_end()) missing(prefix, "end", "a wall needs both ends, as {x, y} in metres");
  finite(prefix, "start", wall.start());
  finite(prefix, "end", wall.end());
  finite(prefix, "velocity", wall.velocity());
  if (wall.start().x() == wall.end().x() && wall.start().y() == wall.end().y()) {
    fail(prefix + "end", "must not be the wall's start; a point is a STATIC disk");
  }
}

void check_zone(const Zone& zone, const Prefix& prefix) {
  check_name(prefix, zone.name());
  if (!zone.has_center()) missing(prefix, "center", "a zone needs its centre, as {x, y} in metres");
  finite(prefix, "center", zone.center());
  if (!zone.has_radius()) missing(prefix, "radius", "a zone needs a radius > 0 in metres");
  positive(prefix, "radius", zone.radius());
}

void check_restitution(const Restitution& effect) {
  const Prefix prefix{"effects.restitution."};
  if (!effect.has_coefficient()) missing(prefix, "coefficient", "it is between 0 and 1");
  between(prefix, "coefficient", effect.coefficient(), 0, 1);
  if (effect.has_wall_coefficient()) {
    between(prefix, "wall_coefficient", effect.wall_coefficient(), 0, 1);
  }
  at_least_zero(prefix, "contact_duration", effect.contact_duration());
  at_least_zero(prefix, "rest_speed", effect.rest_speed());
}

void check_thermostat(const Thermostat& effect) {
  const Prefix prefix{"effects.thermostat."};
  if (!effect.has_temperature()) missing(prefix, "temperature", "it is at least 0 joules");
  at_least_zero(prefix, "temperature", effect.temperature());
  if (!effect.has_rate()) missing(prefix, "rate", "it is at least 0 per second");
  at_least_zero(prefix, "rate", effect.rate());
}

void check_rough(const Rough& effect) {
  const Prefix prefix{"effects.rough."};
  if (!effect.has_tangential_restitution()) {
    missing(prefix, "tangential_restitution", "it is between -1 (smooth) and 1");
  }
  between(prefix, "tangential_restitution", effect.tangential_restitution(), -1, 1);
  if (!effect.has_friction()) missing(prefix, "friction", "it is at least 0");
  at_least_zero(prefix, "friction", effect.friction());
}

void check_effects(const Effects& effects) {
  if (effects.has_gravity()) {
    const Gravity& gravity = effects.gravity();
    const Prefix prefix{"effects.gravity."};
    if (!gravity.has_acceleration()) missing(prefix, "acceleration", "it is {x, y} in m/s^2");
    finite(prefix, "acceleration", gravity.acceleration());
  }
  if (effects.has_drag()) {
    if (!effects.drag().has_rate())
      missing({"effects.drag."}, "rate", "it is at least 0 per second");
    at_least_zero({"effects.drag."}, "rate", effects.drag().rate());
  }
  if (effects.has_floor_friction()) {
    const FloorFriction& friction = effects.floor_friction();
    const Prefix prefix{"effects.floor_friction."};
    if (!friction.has_deceleration()) missing(prefix, "deceleration", "it is at least 0 m/s^2");
    at_least_zero(prefix, "deceleration", friction.deceleration());
  }
  if (effects.has_restitution()) check_restitution(effects.restitution());
  if (effects.has_rough()) check_rough(effects.rough());
  if (effects.has_growth()) {
    if (!effects.growth().has_rate()) missing({"effects.growth."}, "rate", "it is at least 0 m/s");
    at_least_zero({"effects.growth."}, "rate", effects.growth().rate());
  }
  if (effects.has_thermostat()) check_thermostat(effects.thermostat());
}

// Every id of a scene and who has it.
class Ids {
 public:
  void add(std::uint64_t id, const Prefix& prefix) {
    if (id != 0) holders_.push_back({id, prefix});
  }

  // Fails for the first body with an id that one before it has. Most scenes count their bodies
  // upwards, and are done at a glance.
  void check() const {
    const auto is_not_above = [](const Holder& x, const Holder& y) { return y.id <= x.id; };
    if (std::adjacent_find(holders_.begin(), holders_.end(), is_not_above) == holders_.end()) {
      return;
    }
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for (const Holder& holder : holders_) order.emplace_back(holder.id, order.size());
    std::sort(order.begin(), order.end());
    std::size_t twin = holders_.size();
    std::size_t first = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (order[i].first != order[i - 1].first || order[i].second >= twin) continue;
      twin = order[i].second;
      first = order[i - 1].second;
    }
    if (twin == holders_.size()) return;
    std::string other = holders_[first].prefix.text();
    other.pop_back();
    fail(holders_[twin].prefix + "id",
         "is " + std::to_string(holders_[twin].id) + ", which " + other + " has already");
  }

 private:
  struct Holder {
    std::uint64_t id;
    Prefix prefix;
  };
  std::vector<Holder> holders_;
};

template <class List, class Check>
void check_list(const List& list, const char* name, Ids& ids, Check check) {
  for (int i = 0; i < list.size(); ++i) {
    const Prefix prefix{name, i};
    check(list[i], prefix);
    ids.add(list[i].id(), prefix);
  }
}

void check_bodies(const Scene& scene) {
  Ids ids;
  try {
    check_list(scene.disks(), "disks", ids, check_disk);
    check_list(scene.walls(), "walls", ids, check_wall);
    check_list(scene.zones(), "zones", ids, check_zone);
  } catch (const Failure&) {
    ids.check();  // what is wrong with an earlier body is told first
    throw;
  }
  ids.check();
}

void check_all(const Scene& scene) {
  check_name({}, scene.name());
  check_bodies(scene);
  check_effects(scene.effects());
  at_least_zero({"period."}, "x", scene.period().x());
  at_least_zero({"period."}, "y", scene.period().y());
}

template <class List>
void name_from(const List& list, std::size_t index, SceneError& error) {
  if (index >= static_cast<std::size_t>(list.size())) return;
  const auto& body = list[static_cast<int>(index)];
  error.id = body.id();
  error.body = body.name();
}

}  // namespace

void name_body(const Scene& scene, SceneError& error) {
  const std::size_t open = error.field.find('[');
  if (open == std::string::npos) return;
  std::size_t index = 0;
  const char* const begin = error.field.data() + open + 1;
  if (std::from_chars(begin, error.field.data() + error.field.size(), index).ec != std::errc())
    return;
  const std::string list = error.field.substr(0, open);
  if (list == "disks") name_from(scene.disks(), index, error);
  if (list == "walls") name_from(scene.walls(), index, error);
  if (list == "zones") name_from(scene.zones(), index, error);
}

std::optional<SceneError> check_scene(const Scene& scene) {
  try {
    check_all(scene);
  } catch (const Failure& failure) {
    SceneError error;
    error.field = failure.field;
    error.reason = failure.reason;
    name_body(scene, error);
    return error;
  }
  return std::nullopt;
}

std::vector<std::string> effect_names(const Scene& scene) {
  std::vector<std::string> names;
  const Effects& effects = scene.effects();
  if (effects.has_gravity()) names.emplace_back("gravity");
  if (effects.has_drag()) names.emplace_back("drag");
  if (effects.has_floor_friction()) names.emplace_back("floor_friction");
  if (effects.has_restitution()) names.emplace_back("restitution");
  if (effects.has_rough()) names.emplace_back("rough");
  if (effects.has_growth()) names.emplace_back("growth");
  if (effects.has_thermostat()) names.emplace_back("thermostat");
  return names;
}

}  // namespace stoss::idl

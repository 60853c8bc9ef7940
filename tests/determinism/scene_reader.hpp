// SPDX-License-Identifier: Apache-2.0
#pragma once

// Scene files for programs that know the engine alone: the fields of the JSON mapping that make
// bodies. Programs read scenes through the contracts room; this reader exists so that the engine
// can be built and compared without it.

#include <stoss/engine/world.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stoss::determinism {

struct Bodies {
  engine::Instant start;
  std::vector<engine::DiskSpec> disks;
  std::vector<engine::WallSpec> walls;
};

namespace detail {

using nlohmann::json;

/// 64-bit integers are strings in canonical JSON; small ones may be numbers.
template <class T>
T integer(const json& object, const char* key) {
  if (!object.contains(key)) return 0;
  const json& value = object.at(key);
  if (!value.is_string()) return value.get<T>();
  const auto& digits = value.get_ref<const std::string&>();
  if constexpr (std::is_signed_v<T>) {
    return std::stoll(digits);
  } else {
    return std::stoull(digits);
  }
}

inline engine::Vector2 vector(const json& object, const char* key) {
  if (!object.contains(key)) return {0, 0};
  const json& v = object.at(key);
  return {v.value("x", 0.0), v.value("y", 0.0)};
}

inline engine::BodyKind kind(const json& disk) {
  const std::string name = disk.value("kind", std::string("DYNAMIC"));
  if (name == "DYNAMIC") return engine::BodyKind::Dynamic;
  if (name == "KINEMATIC") return engine::BodyKind::Kinematic;
  if (name == "STATIC") return engine::BodyKind::Static;
  throw std::runtime_error("unknown kind " + name);
}

}  // namespace detail

/// Throws when the file cannot be read, or asks for what is more than disks and walls.
inline Bodies read_scene(const std::string& path) {
  using detail::json;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  const json scene = json::parse(file);
  for (const char* more : {"zones", "effects", "period"}) {
    if (scene.contains(more)) throw std::runtime_error(path + " asks for " + more);
  }
  Bodies bodies;
  const json start = scene.value("start", json::object());
  bodies.start = {detail::integer<std::int64_t>(start, "seconds"),
                  detail::integer<std::uint64_t>(start, "fraction")};
  for (const json& d : scene.value("disks", json::array())) {
    engine::DiskSpec disk;
    disk.id = detail::integer<std::uint64_t>(d, "id");
    disk.kind = detail::kind(d);
    disk.position = detail::vector(d, "position");
    disk.velocity = detail::vector(d, "velocity");
    disk.radius = d.at("radius").get<double>();
    disk.mass = d.value("mass", 1.0);
    disk.angle = d.value("angle", 0.0);
    disk.spin = d.value("spin", 0.0);
    bodies.disks.push_back(disk);
  }
  for (const json& w : scene.value("walls", json::array())) {
    engine::WallSpec wall;
    wall.id = detail::integer<std::uint64_t>(w, "id");
    wall.start = detail::vector(w, "start");
    wall.end = detail::vector(w, "end");
    wall.velocity = detail::vector(w, "velocity");
    bodies.walls.push_back(wall);
  }
  return bodies;
}

}  // namespace stoss::determinism

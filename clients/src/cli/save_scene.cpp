// SPDX-License-Identifier: Apache-2.0
#include "cli/save_scene.hpp"

#include "cli/exit_code.hpp"
#include "cli/scene_bodies.hpp"

#include <stoss/idl/scene_file.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::client::cli {
namespace {

void assign(Vector2& to, const engine::Vector2& from) {
  to.set_x(from.x());
  to.set_y(from.y());
}

/// What no radius of a packing may keep: a place is off by less than one unit in the last place of
/// the largest number of the scene, and of two bodies each gives way by four.
class Shrinkage {
 public:
  explicit Shrinkage(const engine::World& world) : share_(2 * world.census().deepest) {
    double size = 0;
    const auto see = [&size](const engine::Vector2& v) {
      size = std::max({size, std::abs(v.x()), std::abs(v.y())});
    };
    world.for_each_disk([&](const engine::BodyState& disk) {
      see(disk.position);
      size = std::max(size, disk.radius);
    });
    world.for_each_wall([&](const engine::WallState& wall) {
      see(wall.start);
      see(wall.end);
    });
    unit_ = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  }

  [[nodiscard]] double radius_of(const engine::BodyState& disk) const {
    const double radius = disk.radius * (1 - share_) - 4 * unit_;
    if (radius > 0) return radius;
    throw RefusedError({.code = engine::Code::FailedPrecondition,
                        .field = "radius",
                        .body = disk.id,
                        .reason = "is too small to be rounded down in a scene of this size"});
  }

 private:
  double share_;  ///< of a radius: what bodies overlap by rounding in the world itself
  double unit_;   ///< m
};

void take_over(Disk& disk, const engine::BodyState& state) {
  disk.set_id(state.id);
  assign(*disk.mutable_position(), state.position);
  assign(*disk.mutable_velocity(), state.velocity);
  disk.set_angle(state.angle);
  disk.set_spin(state.spin);
}

}  // namespace

void save_scene(const std::string& from,
                const std::string& to,
                const engine::World& world,
                std::span<const engine::Id> ids) {
  Scene scene = scene_in(from);
  const bool has_grown = scene.effects().has_growth();
  scene.mutable_effects()->clear_growth();
  scene.mutable_start()->set_seconds(world.now().seconds);
  scene.mutable_start()->set_fraction(world.now().fraction);
  std::optional<Shrinkage> shrinkage;
  if (has_grown) shrinkage.emplace(world);
  for (int i = 0; i < scene.disks_size(); ++i) {
    const engine::BodyState state = value_or_refuse(world.state(ids[static_cast<std::size_t>(i)]));
    take_over(*scene.mutable_disks(i), state);
    if (shrinkage) scene.mutable_disks(i)->set_radius(shrinkage->radius_of(state));
  }
  for (int i = 0; i < scene.walls_size(); ++i) {
    const auto place = static_cast<std::size_t>(scene.disks_size() + i);
    const engine::WallState state = value_or_refuse(world.wall(ids[place]));
    Wall& wall = *scene.mutable_walls(i);
    wall.set_id(state.id);
    assign(*wall.mutable_start(), state.start);
    assign(*wall.mutable_end(), state.end);
  }
  for (int i = 0; i < scene.zones_size(); ++i) {
    const auto place = static_cast<std::size_t>(scene.disks_size() + scene.walls_size() + i);
    scene.mutable_zones(i)->set_id(ids[place]);
  }
  if (const auto error = idl::save_scene(scene, to)) {
    throw RefusedError(
        {.code = engine::Code::FailedPrecondition, .field = {}, .reason = error->message()});
  }
}

}  // namespace stoss::client::cli

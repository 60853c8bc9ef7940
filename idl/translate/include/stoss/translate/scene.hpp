// SPDX-License-Identifier: Apache-2.0
// From a scene to the world that it describes.
#pragma once

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/engine/world.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stoss {
class Scene;  // of scene.proto
}

namespace stoss::translate {

/// The names of the effects that the engine has, as a scene spells them.
[[nodiscard]] std::span<const std::string_view> engine_effects();

/// A scene's bodies and effects in the engine's words; names run beside them and may be empty.
struct SceneBodies {
  engine::Instant start;
  engine::Effects effects;
  std::uint64_t seed = 0;  ///< for effects that are switched on later
  engine::Vector2 period = engine::Vector2::Zero();
  std::vector<engine::DiskSpec> disks;
  std::vector<std::string> disk_names;
  std::vector<engine::WallSpec> walls;
  std::vector<std::string> wall_names;
  std::vector<engine::ZoneSpec> zones;
  std::vector<std::string> zone_names;

  /// Of the i-th of all ids that make_world() returns.
  [[nodiscard]] const std::string& name_of(std::size_t i) const;
};

/// Whatever of the scene the engine has no exact treatment for: Unimplemented, with the field named
/// as "effects.drag".
[[nodiscard]] std::optional<engine::Reject> unsupported(const Scene& scene);

/// The bodies of a scene that has passed idl::check_scene. Errors: those of unsupported();
/// InvalidArgument for a kind that is unknown, and those of engine::check_effects() and
/// engine::check_period().
[[nodiscard]] engine::Outcome<SceneBodies> bodies_of(const Scene& scene);

/// How a scene's world computes; neither changes with the scene.
struct WorldChoice {
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours;
};

/// A new world with the bodies in it, and the ids that they got: disks first, then walls, then
/// zones.
struct SceneWorld {
  engine::World world;
  std::vector<engine::Id> ids;
};

/// The arithmetics that worlds can be made in: all but float128 in every build.
[[nodiscard]] std::vector<engine::Arithmetic> arithmetics();

/// Errors: those of World::spawn; InvalidArgument for a start beyond the end of time; Unimplemented
/// for an arithmetic that this build has not.
[[nodiscard]] engine::Outcome<SceneWorld> make_world(const SceneBodies& bodies,
                                                     const WorldChoice& choice);

/// Gives the bodies the ids that their world gave them.
void adopt_ids(SceneBodies& bodies, std::span<const engine::Id> ids);

/// Both steps in one.
[[nodiscard]] engine::Outcome<engine::World> make_world(const Scene& scene,
                                                        const WorldChoice& choice);

}  // namespace stoss::translate

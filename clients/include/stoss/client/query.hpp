// SPDX-License-Identifier: Apache-2.0
// Read-only questions to a world, and their answers.
#pragma once

#include <stoss/client/status.hpp>
#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/idl/types.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stoss::client {

/// One question. Made by the functions below; about the present, or about the instant given to
/// at().
struct Query {
  idl::Ask op = idl::Ask::kStatus;
  std::optional<engine::Instant> instant;
  std::vector<engine::Id> ids;
  engine::Vector2 low = engine::Vector2::Zero();
  engine::Vector2 high = engine::Vector2::Zero();
  engine::Vector2 point = engine::Vector2::Zero();
  engine::Vector2 direction = engine::Vector2::Zero();
  double distance = 0;
  std::uint64_t number = 0;
  std::uint64_t count = 0;

  /// The states of these bodies; at most kCommandBodiesMax of them.
  static Query states(std::vector<engine::Id> ids);
  /// The states of all bodies.
  static Query list();
  /// The bodies that touch a box.
  static Query region(const engine::Vector2& low, const engine::Vector2& high);
  /// The `count` bodies nearest to a point, nearest first.
  static Query nearest(const engine::Vector2& point, std::uint64_t count);
  /// The first `count` bodies along a ray.
  static Query ray(const engine::Vector2& origin,
                   const engine::Vector2& direction,
                   double length = std::numeric_limits<double>::infinity(),
                   std::uint64_t count = 1);
  /// The whole exact world: every stored motion and what else makes a body.
  static Query world();
  /// Collisions from a number on; `count` 0: as many as there are.
  static Query collisions(std::uint64_t first, std::uint64_t count = 0);
  /// Zone events, likewise.
  static Query zone_events(std::uint64_t first, std::uint64_t count = 0);
  static Query features();
  static Query status();

  /// Asks about this instant of the world's clock instead of the present.
  Query& at(const engine::Instant& when);
};

/// A body in an answer. A wall's state is that of its start point.
struct FoundBody {
  engine::BodyState state;
  bool wall = false;
  double distance = 0;  ///< to its surface, m; Query::nearest only
};

/// An answer, put together from all its chunks. Only what the question was about is filled.
struct Answer {
  engine::Instant at;  ///< what was asked about
  std::uint64_t tick = 0;
  std::uint64_t epoch = 0;
  std::uint64_t motion_number = 0;     ///< the last motion batch whose content is in this answer
  std::uint64_t collision_number = 0;  ///< the last collision that has happened
  std::uint64_t zone_number = 0;       ///< the last zone event that has happened
  std::uint64_t state_hash = 0;        ///< Query::world
  std::vector<FoundBody> bodies;
  std::vector<engine::WallState> walls;        ///< Query::list, Query::region
  std::vector<engine::RayHit> hits;            ///< Query::ray
  std::vector<engine::MotionRecord> motions;   ///< Query::world, in the order of ids
  std::vector<engine::BodyRecord> statics;     ///< Query::world, in the order of ids
  std::vector<engine::Collision> collisions;   ///< Query::collisions, in their order
  std::vector<engine::ZoneEvent> zone_events;  ///< Query::zone_events, in their order
  std::vector<std::string> features;           ///< Query::features
  std::optional<Status> status;                ///< Query::status
};

}  // namespace stoss::client

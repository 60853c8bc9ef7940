// SPDX-License-Identifier: Apache-2.0
// What the threads hand to one another: plain values, moved and never shared.
#pragma once

#include "admission.hpp"

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/engine/verify.hpp>
#include <stoss/idl/types.hpp>
#include <stoss/translate/columns.hpp>
#include <stoss/translate/command.hpp>
#include <stoss/translate/query.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stoss::service {

/// A point of a world's history.
struct Moment {
  std::uint64_t epoch = 0;
  std::uint64_t tick = 0;  ///< the last tick at or before `at`
  engine::Instant at;

  friend bool operator==(const Moment&, const Moment&) = default;
};

/// A command on its way to the world.
struct CommandItem {
  translate::CommandSpec spec;
  Ticket ticket;
};

/// A question on its way to the world.
struct QueryItem {
  translate::QuerySpec spec;
  Ticket ticket;
};

/// What a body is after a change; `body` is set but for ChangeKind::Removed.
struct BodyChange {
  engine::ChangeKind kind = engine::ChangeKind::Moved;
  engine::MotionRecord motion;
  engine::BodyRecord body;
};

/// Does it tell of the body more than its motion? Growth that was switched off leaves radii that no
/// motion tells.
[[nodiscard]] inline bool tells_body(const BodyChange& change, bool effects_switched) {
  if (change.kind == engine::ChangeKind::Spawned) return true;
  const bool grows = change.motion.radius.high != 0;
  return effects_switched && change.kind == engine::ChangeKind::Moved && !change.body.is_wall &&
         !grows;
}

using NamedBody = std::pair<engine::Id, std::string>;

/// What happened since the record before.
struct TickRecord {
  Moment moment;
  std::vector<BodyChange> changes;
  std::vector<engine::Collision> collisions;
  std::vector<engine::ZoneEvent> zone_events;
  std::optional<std::vector<engine::ZoneState>> zones;  ///< all there are, if one came or went
  std::vector<NamedBody> names;
  std::optional<std::vector<std::string>> effects;  ///< those that are on, if that has changed
  std::uint64_t state_hash = 0;                     ///< 0 when nobody asked for it

  [[nodiscard]] bool changes_the_world() const {
    return !changes.empty() || effects || zones || !zone_events.empty();
  }
};

/// A world as it begins: at the start, and after a reset.
struct EpochRecord {
  Moment moment;
  std::vector<BodyChange> bodies;
  std::vector<engine::ZoneState> zones;
  std::vector<NamedBody> names;
  std::vector<std::string> effects;  ///< those that are on
  std::uint64_t state_hash = 0;
};

/// The one reply of a command. Kept for duplicates.
struct ReplyRecord {
  RequestId request;
  std::optional<engine::Reject> reject;  ///< nothing: done
  bool duplicate = false;
  std::optional<Moment> moment;  ///< nothing: the present of whoever sends it
  std::vector<engine::Id> ids;   ///< made
};

struct ReplyItem {
  ReplyRecord reply;
  Ticket ticket;
};

/// The rows of an answer, in full; the sender cuts them into chunks.
struct Rows {
  translate::StateColumns states;
  translate::WallColumns walls;
  translate::HitColumns hits;
};

/// An answer that is ready to be sent.
struct AnswerItem {
  RequestId request;
  std::optional<Moment> moment;  ///< nothing: the present of whoever sends it
  std::variant<engine::Reject, Rows, std::vector<std::string>> content;
  Ticket ticket;
};

/// A question that the publisher answers from its picture of the world.
struct PictureQuery {
  translate::QuerySpec spec;
  Ticket ticket;
};

/// A slot of the body topic was given to a body, or taken from it (kNoId).
struct WatchRecord {
  std::uint32_t slot = 0;
  engine::Id id = engine::kNoId;
};

/// What the world's thread knows of its own health.
struct WorldStatus {
  idl::WorldState state = idl::WorldState::kRunning;
  std::string reason;
  Moment moment;
  double tick_rate = 0;
  double speed_asked = 0;
  double speed_reached = 0;
  std::uint64_t bodies = 0;
  std::uint64_t walls = 0;
  std::uint64_t zones = 0;
  std::uint64_t watched = 0;
  std::uint64_t collisions = 0;
  std::uint64_t events = 0;
  double events_per_second = 0;
  std::uint64_t commands = 0;
  std::uint64_t rejected = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t queries = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t ticks_late = 0;
  std::uint64_t ticks_slipped = 0;
  std::uint64_t regularised = 0;
  std::uint64_t order_dependent = 0;
  std::uint64_t collisions_lost = 0;
  std::uint64_t zone_events_lost = 0;
  std::uint64_t records_put_off = 0;
  std::uint64_t verify_period = 0;  ///< 0: the world is not verified
  engine::Verification verified{};
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::Vector2 period = engine::Vector2::Zero();
  engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours;
};

using OutboxItem = std::
    variant<TickRecord, EpochRecord, ReplyItem, AnswerItem, PictureQuery, WatchRecord, WorldStatus>;

}  // namespace stoss::service

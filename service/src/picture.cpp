// SPDX-License-Identifier: Apache-2.0
#include "picture.hpp"

#include <stoss/engine/motion.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace stoss::service {
void Picture::begin(const EpochRecord& record) {
  bodies_.clear();
  ids_.clear();
  flights_.clear();
  walls_ = 0;
  index_.clear();
  names_.clear();
  has_grown_ = false;
  bodies_.reserve(record.bodies.size());
  ids_.reserve(record.bodies.size());
  flights_.reserve(record.bodies.size());
  index_.reserve(record.bodies.size());
  for (const BodyChange& body : record.bodies) put(body);
  zones_ = record.zones;
  name(record.names);
  effects_ = record.effects;
  moment_ = record.moment;
  state_hash_ = record.state_hash;
  ++version_;
  ++scene_version_;
}

void Picture::apply(const TickRecord& record) {
  std::span<const BodyChange> changes(record.changes);
  while (!changes.empty()) {
    const std::size_t moved = move(changes, record.effects.has_value());
    changes = changes.subspan(moved);
    if (moved != 0 || changes.empty()) continue;
    if (changes.front().kind == engine::ChangeKind::Removed) {
      remove(changes.front().motion.id);
    } else {
      put(changes.front());
    }
    changes = changes.subspan(1);
  }
  if (record.zones) set_zones(*record.zones);
  name(record.names);
  moment_ = record.moment;
  ++version_;
  if (record.effects) {
    effects_ = *record.effects;
    ++scene_version_;
  }
  if (record.changes_the_world()) state_hash_ = record.state_hash;
}

// Bodies lie anywhere in memory. Where those of the next changes are is looked up beforehand, so
// that memory answers for several of them at a time.
std::size_t Picture::move(std::span<const BodyChange> changes, bool effects_switched) {
  constexpr std::size_t kTogether = 16;
  std::array<std::size_t, kTogether> places;
  std::size_t count = 0;
  for (; count < std::min(kTogether, changes.size()); ++count) {
    if (changes[count].kind != engine::ChangeKind::Moved) break;
    const auto entry = index_.find(changes[count].motion.id);
    if (entry == index_.end()) break;
    places[count] = entry->second;
    const auto* const flight = reinterpret_cast<const char*>(&flights_[entry->second]);
    __builtin_prefetch(flight, 1);
    __builtin_prefetch(flight + sizeof(Flight) - 1, 1);
  }
  for (std::size_t k = 0; k < count; ++k) {
    set(places[k], changes[k], tells_body(changes[k], effects_switched));
  }
  return count;
}

void Picture::put(const BodyChange& change) {
  const auto [entry, is_new] = index_.try_emplace(change.motion.id, bodies_.size());
  if (is_new) {
    bodies_.emplace_back();
    ids_.push_back(change.motion.id);
    flights_.emplace_back();
    if (change.body.is_wall) ++walls_;
    ++scene_version_;
  }
  set(entry->second, change, true);
}

void Picture::set(std::size_t i, const BodyChange& change, bool tells_body) {
  const Flight flight = flight_of(change.motion, change.body, arithmetic_, period_);
  const bool tells_motion = !is_flight(flight) || !is_flight(flights_[i]);
  flights_[i] = flight;
  if (tells_body || tells_motion) bodies_[i] = {change.motion, change.body};
  if (change.body.is_wall) ++scene_version_;
  has_grown_ = has_grown_ || change.motion.radius.high != 0;
}

void Picture::set_zones(const std::vector<engine::ZoneState>& zones) {
  const std::vector<engine::ZoneState> before = std::exchange(zones_, zones);
  for (const engine::ZoneState& zone : before) {
    if (!has_zone(zone.id)) names_.erase(zone.id);
  }
  ++scene_version_;
}

bool Picture::has_zone(engine::Id id) const {
  return std::any_of(
      zones_.begin(), zones_.end(), [id](const engine::ZoneState& zone) { return zone.id == id; });
}

void Picture::remove(engine::Id id) {
  const auto entry = index_.find(id);
  if (entry == index_.end()) return;
  const std::size_t hole = entry->second;
  index_.erase(entry);
  if (bodies_[hole].record.is_wall) --walls_;
  if (hole + 1 != bodies_.size()) {
    bodies_[hole] = bodies_.back();
    ids_[hole] = ids_.back();
    flights_[hole] = flights_.back();
    index_[ids_[hole]] = hole;
  }
  bodies_.pop_back();
  ids_.pop_back();
  flights_.pop_back();
  names_.erase(id);
  ++scene_version_;
}

void Picture::name(const std::vector<NamedBody>& names) {
  for (const auto& [id, text] : names) {
    if (index_.contains(id) || has_zone(id)) names_[id] = text;
  }
}

std::vector<std::size_t> Picture::order() const {
  std::vector<std::size_t> order(ids_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
    return ids_[a] < ids_[b];
  });
  return order;
}

Picture::Body Picture::body(std::size_t i) const {
  Body body = bodies_[i];
  if (is_flight(flights_[i])) body.motion = record_of(ids_[i], flights_[i]);
  return body;
}

std::optional<Picture::Body> Picture::find(engine::Id id) const {
  const auto entry = index_.find(id);
  if (entry == index_.end()) return std::nullopt;
  return body(entry->second);
}

engine::BodyState Picture::state_of(const Body& body) const {
  const engine::MotionRecord& motion = body.motion;
  return {.id = motion.id,
          .kind = body.record.kind,
          .instant = moment_.at,
          .position = engine::evaluate(motion, arithmetic_, moment_.at, period_),
          .velocity = engine::evaluate_velocity(motion, arithmetic_, moment_.at),
          .angle = engine::turned(motion.angle, motion.spin, motion.since, moment_.at),
          .spin = motion.spin,
          .radius = engine::evaluate_radius(motion, body.record, arithmetic_, moment_.at)};
}

engine::WallState Picture::wall_of(const Body& body) const {
  return engine::evaluate_wall(body.motion, body.record, arithmetic_, moment_.at, period_);
}

}  // namespace stoss::service

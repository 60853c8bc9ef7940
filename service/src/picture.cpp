// SPDX-License-Identifier: Apache-2.0
#include "picture.hpp"

#include <stoss/engine/motion.hpp>

#include <algorithm>
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
  for (const BodyChange& change : record.changes) {
    if (change.kind == engine::ChangeKind::Removed) {
      remove(change.motion.id);
    } else {
      put(change);
    }
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

void Picture::put(const BodyChange& change) {
  const Flight flight = flight_of(change.motion, change.body, arithmetic_, period_);
  const auto [entry, is_new] = index_.try_emplace(change.motion.id, bodies_.size());
  if (is_new) {
    bodies_.push_back({change.motion, change.body});
    ids_.push_back(change.motion.id);
    flights_.push_back(flight);
    if (change.body.is_wall) ++walls_;
  } else {
    bodies_[entry->second] = {change.motion, change.body};
    flights_[entry->second] = flight;
  }
  if (is_new || change.body.is_wall) ++scene_version_;
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

std::vector<const Picture::Body*> Picture::ordered() const {
  std::vector<const Body*> order;
  order.reserve(bodies_.size());
  for (const Body& body : bodies_) order.push_back(&body);
  std::sort(order.begin(), order.end(), [](const Body* a, const Body* b) {
    return a->motion.id < b->motion.id;
  });
  return order;
}

const Picture::Body* Picture::find(engine::Id id) const {
  const auto entry = index_.find(id);
  return entry == index_.end() ? nullptr : &bodies_[entry->second];
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

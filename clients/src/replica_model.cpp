// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/replica_model.hpp>

#include <algorithm>
#include <utility>

namespace stoss::client {
namespace {

bool before(const MotionPart& a, const MotionPart& b) {
  return a.epoch != b.epoch ? a.epoch < b.epoch : a.number < b.number;
}

}  // namespace

void ReplicaModel::apply(MotionPart part) {
  if (!complete_) {
    wait(std::move(part));
    return;
  }
  if (part.epoch < stamp_.epoch || (part.epoch == stamp_.epoch && part.number < next_)) {
    ++counters_.ignored;
    return;
  }
  if (part.epoch == stamp_.epoch && part.number == next_) {
    stage(std::move(part));
    return;
  }
  ++(part.epoch > stamp_.epoch ? counters_.epochs : counters_.gaps);
  invalidate();
  wait(std::move(part));
}

// Parts come almost sorted, so the place is at or near the end.
void ReplicaModel::wait(MotionPart part) {
  if (!waiting_.empty() && part.epoch > waiting_.back().epoch) {
    counters_.ignored += waiting_.size();
    waiting_.clear();
  }
  if (!waiting_.empty() && part.epoch < waiting_.back().epoch) {
    ++counters_.ignored;
    return;
  }
  auto place = waiting_.end();
  while (place != waiting_.begin() && before(part, *std::prev(place))) --place;
  if (place != waiting_.begin() && !before(*std::prev(place), part)) {
    ++counters_.ignored;  // it is there already
    return;
  }
  waiting_.insert(place, std::move(part));
  if (waiting_.size() <= kPartsWaitingMax) return;
  waiting_.pop_front();
  ++counters_.overflows;
}

void ReplicaModel::invalidate() {
  complete_ = false;
  staged_.clear();
  waiting_.clear();
}

void ReplicaModel::clear() {
  bodies_.clear();
  free_.clear();
  order_.clear();
  slot_of_.clear();
  inserted_.clear();
  staged_.clear();
  removed_ = false;
}

void ReplicaModel::load(const Answer& world) {
  // An answer from before the last reset is no use: parts of a newer epoch are waiting.
  if (!waiting_.empty() && waiting_.back().epoch > world.epoch) return;
  if (world.motions.size() != world.statics.size()) {
    ++counters_.contradictions;
    return;
  }
  clear();
  bodies_.reserve(world.motions.size());
  slot_of_.reserve(world.motions.size());
  for (std::size_t i = 0; i < world.motions.size(); ++i) {
    if (world.motions[i].id != world.statics[i].id) {
      ++counters_.contradictions;
      complete_ = false;
      return;
    }
    insert(world.motions[i], world.statics[i]);
  }
  restore_order();
  stamp_ = {world.epoch, world.motion_number, world.tick, world.at, world.state_hash};
  next_ = world.motion_number + 1;
  complete_ = true;
  ++counters_.loads;
  tell();
  apply_waiting();
}

void ReplicaModel::apply_waiting() {
  std::deque<MotionPart> parts = std::exchange(waiting_, {});
  while (!parts.empty()) {
    MotionPart part = std::move(parts.front());
    parts.pop_front();
    apply(std::move(part));
  }
}

void ReplicaModel::stage(MotionPart part) {
  if (part.part != staged_.size()) {
    ++counters_.contradictions;
    invalidate();
    return;
  }
  ++next_;
  const bool whole = part.last_of_tick();
  staged_.push_back(std::move(part));
  if (whole) apply_tick();
}

void ReplicaModel::apply_tick() {
  const std::vector<MotionPart> parts = std::exchange(staged_, {});
  for (const MotionPart& part : parts) {
    if (!apply_part(part)) {
      ++counters_.contradictions;
      invalidate();
      clear();  // half of a tick is not to be seen
      return;
    }
    ++counters_.parts;
    counters_.changes += part.changes.size();
  }
  restore_order();
  const MotionPart& last = parts.back();
  arithmetic_ = last.arithmetic;
  period_ = last.period;
  stamp_ = {last.epoch, last.number, last.tick, last.at, last.state_hash};
  tell();
}

// What a part spawns is listed in its statics in the same order, and what has grown for good.
bool ReplicaModel::apply_part(const MotionPart& part) {
  std::size_t next_static = 0;
  for (const MotionChange& change : part.changes) {
    const engine::Id id = change.motion.id;
    switch (change.kind) {
      case engine::ChangeKind::Spawned: {
        if (next_static >= part.statics.size() || part.statics[next_static].id != id) return false;
        if (slot_of_.contains(id)) return false;
        insert(change.motion, part.statics[next_static++]);
        break;
      }
      case engine::ChangeKind::Moved: {
        const auto found = slot_of_.find(id);
        if (found == slot_of_.end()) return false;
        ReplicaBody& body = bodies_[found->second];
        body.motion = change.motion;
        if (next_static < part.statics.size() && part.statics[next_static].id == id) {
          body.body = part.statics[next_static++];
        }
        break;
      }
      case engine::ChangeKind::Removed:
        if (!remove(id)) return false;
        break;
    }
  }
  return true;
}

void ReplicaModel::insert(const engine::MotionRecord& motion, const engine::BodyRecord& body) {
  std::uint32_t slot = 0;
  if (free_.empty()) {
    slot = static_cast<std::uint32_t>(bodies_.size());
    bodies_.push_back({motion, body});
  } else {
    slot = free_.back();
    free_.pop_back();
    bodies_[slot] = {motion, body};
  }
  slot_of_.emplace(motion.id, slot);
  inserted_.push_back({motion.id, slot});
}

bool ReplicaModel::remove(engine::Id id) {
  const auto found = slot_of_.find(id);
  if (found == slot_of_.end()) return false;
  free_.push_back(found->second);
  slot_of_.erase(found);
  removed_ = true;
  return true;
}

// Once per tick, so that a tick with many spawns and removals costs one pass.
void ReplicaModel::restore_order() {
  const auto by_id = [](const Place& a, const Place& b) { return a.id < b.id; };
  if (removed_) {
    std::erase_if(order_, [this](const Place& place) { return !slot_of_.contains(place.id); });
    removed_ = false;
  }
  if (inserted_.empty()) return;
  std::sort(inserted_.begin(), inserted_.end(), by_id);
  const auto old_size = static_cast<std::ptrdiff_t>(order_.size());
  order_.insert(order_.end(), inserted_.begin(), inserted_.end());
  std::inplace_merge(order_.begin(), order_.begin() + old_size, order_.end(), by_id);
  inserted_.clear();
}

const ReplicaBody* ReplicaModel::find(engine::Id id) const {
  const auto found = slot_of_.find(id);
  return found == slot_of_.end() ? nullptr : &bodies_[found->second];
}

engine::BodyState ReplicaModel::disk_at(const ReplicaBody& body,
                                        const engine::Instant& instant) const {
  const engine::MotionRecord& motion = body.motion;
  engine::BodyState state;
  state.id = motion.id;
  state.kind = body.body.kind;
  state.instant = instant;
  state.position = engine::evaluate(motion, arithmetic_, instant, period_);
  state.velocity = engine::evaluate_velocity(motion, arithmetic_, instant);
  state.angle = engine::turned(motion.angle, motion.spin, motion.since, instant);
  state.spin = motion.spin;
  state.radius = engine::evaluate_radius(motion, body.body, arithmetic_, instant);
  return state;
}

engine::WallState ReplicaModel::wall_at(const ReplicaBody& body,
                                        const engine::Instant& instant) const {
  return engine::evaluate_wall(body.motion, body.body, arithmetic_, instant, period_);
}

}  // namespace stoss::client

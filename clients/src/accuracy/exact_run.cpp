// SPDX-License-Identifier: Apache-2.0
#include "accuracy/exact_run.hpp"

#include <stoss/wide/world.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace stoss::client::accuracy {
namespace {

using engine::DoubleWord;

engine::World world_or_throw(engine::Outcome<engine::World> world) {
  if (!world) throw std::runtime_error(world.reject().reason);
  return std::move(world).value();
}

DoubleWord<double> to_word(const engine::SplitNumber& number) { return {number.high, number.low}; }

}  // namespace

engine::Outcome<engine::World> exact_world(const translate::SceneBodies& bodies,
                                           engine::Arithmetic arithmetic) {
  engine::World world = wide::make_world({bodies.start, arithmetic, {}});
  const auto spawned = world.spawn({bodies.disks, bodies.walls, bodies.zones});
  if (!spawned) return spawned.reject();
  return world;
}

ExactRun::ExactRun(const translate::SceneBodies& bodies, engine::Arithmetic arithmetic)
    : world_(world_or_throw(exact_world(bodies, arithmetic))) {
  world_.for_each_disk([this](const engine::BodyState& state) {
    if (state.kind != engine::BodyKind::Dynamic) return;
    dynamic_.push_back(state.id);
    masses_.push_back(world_.body(state.id).value().mass);
  });
}

bool ExactRun::advance(const engine::Instant& until,
                       engine::CollisionSink* sink,
                       std::uint64_t work) {
  const auto report = world_.advance_to(until, sink, work);
  if (!report) throw std::runtime_error(report.reject().reason);
  if (report.value().stop == engine::Stop::Stalled) {
    throw std::runtime_error("collisions crowd into one instant without end");
  }
  return report.value().stop == engine::Stop::Reached;
}

// A record holds no instant finer than 2^-64 s. Stopping the disks of a copy makes records of the
// present instant, which is such an instant, and so gives positions to the last bit of a record.
Snapshot ExactRun::snapshot(const engine::Instant&) const {
  Snapshot snapshot;
  snapshot.positions.reserve(dynamic_.size());
  std::vector<engine::VectorFor> stops;
  stops.reserve(dynamic_.size());
  for (std::size_t i = 0; i < dynamic_.size(); ++i) {
    const engine::MotionRecord motion = world_.motion(dynamic_[i]).value();
    const DoubleWord<double> vx = to_word(motion.vx);
    const DoubleWord<double> vy = to_word(motion.vy);
    snapshot.energy = snapshot.energy + (vx * vx + vy * vy) * (masses_[i] / 2);
    stops.push_back({dynamic_[i], engine::Vector2::Zero()});
  }
  engine::World copy = world_;
  if (!copy.set_velocity(stops)) throw std::runtime_error("the world cannot be looked at");
  for (const engine::Id id : dynamic_) {
    const engine::MotionRecord motion = copy.motion(id).value();
    snapshot.positions.push_back({to_word(motion.x), to_word(motion.y)});
  }
  return snapshot;
}

Faults ExactRun::faults() {
  const engine::Census census = world_.census();
  faults_.missed = std::max(faults_.missed.value_or(0), census.missed);
  faults_.deepest = std::max(faults_.deepest, census.deepest);
  return faults_;
}

}  // namespace stoss::client::accuracy

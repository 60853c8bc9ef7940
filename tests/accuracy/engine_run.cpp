// SPDX-License-Identifier: Apache-2.0
#include "accuracy/engine_run.hpp"

#include <stoss/engine/instant.hpp>

#include <utility>

namespace stoss::tests {

engine::Instant EngineRun::end_of_next_step() const {
  return engine::offset_by(start_, static_cast<double>(steps_ + 1) * step_)
      .value_or(engine::Instant::never());
}

bool EngineRun::advance(const engine::Instant& until,
                        engine::CollisionSink* sink,
                        std::uint64_t work) {
  sink_ = sink;
  for (; work > 0; --work) {
    const engine::Instant next = end_of_next_step();
    if (next > until) return true;
    take_step(step_);
    ++steps_;
    now_ = next;
    // With no time to look ahead it sees the present overlaps.
    if (audited_) audit_.look_ahead(disks_, walls_, 0);
  }
  return end_of_next_step() > until;
}

client::accuracy::Snapshot EngineRun::snapshot(const engine::Instant& instant) const {
  client::accuracy::Snapshot snapshot;
  const double rest = engine::seconds_between(now_, instant);
  double energy = 0;
  for (const engine::DiskSpec& disk : disks_) {
    if (disk.kind != engine::BodyKind::Dynamic) continue;
    const engine::Vector2 place = disk.position + disk.velocity * rest;
    snapshot.positions.push_back({{place.x(), 0}, {place.y(), 0}});
    energy += disk.mass * disk.velocity.squaredNorm() / 2;
  }
  snapshot.energy = {energy, 0};
  return snapshot;
}

client::accuracy::Faults EngineRun::faults() { return {{}, audit_.deepest()}; }

void EngineRun::collided(engine::Id a, engine::Id b, engine::ContactKind kind) {
  if (sink_ == nullptr) return;
  if (kind == engine::ContactKind::DiskDisk && a > b) std::swap(a, b);
  const engine::Collision collision{
      .sequence = ++collisions_, .instant = end_of_next_step(), .kind = kind, .a = a, .b = b};
  sink_->on_collision(collision);
}

}  // namespace stoss::tests

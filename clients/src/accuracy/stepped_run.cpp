// SPDX-License-Identifier: Apache-2.0
#include "accuracy/stepped_run.hpp"

#include <stoss/engine/instant.hpp>

namespace stoss::client::accuracy {

SteppedRun::SteppedRun(const translate::SceneBodies& bodies,
                       const baseline::StepRule& rule,
                       bool audited)
    : world_(bodies.disks, bodies.walls, bodies.start, rule, audited) {}

bool SteppedRun::advance(const engine::Instant& until,
                         engine::CollisionSink* sink,
                         std::uint64_t work) {
  return world_.step_up_to(until, sink, work);
}

Snapshot SteppedRun::snapshot(const engine::Instant& instant) const {
  Snapshot snapshot;
  const double rest = engine::seconds_between(world_.now(), instant);
  world_.for_each_disk([&](const engine::BodyState& state) {
    if (state.kind != engine::BodyKind::Dynamic) return;
    const engine::Vector2 place = state.position + state.velocity * rest;
    snapshot.positions.push_back({{place.x(), 0}, {place.y(), 0}});
  });
  snapshot.energy = {world_.conserved().kinetic_energy, 0};
  return snapshot;
}

Faults SteppedRun::faults() { return {world_.audit().missed(), world_.audit().deepest()}; }

}  // namespace stoss::client::accuracy

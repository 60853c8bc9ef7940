// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/status.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/basics.hpp>

namespace stoss::client {
namespace {

void copy_counts(Status& to, const idl::wire::Status& from) {
  to.bodies = from.bodies;
  to.walls = from.walls;
  to.zones = from.zones;
  to.watched = from.watched;
  to.collisions = from.collisions;
  to.events = from.events;
  to.events_per_second = from.events_per_second;
  to.commands = from.commands;
  to.rejected = from.rejected;
  to.duplicates = from.duplicates;
  to.queries = from.queries;
  to.motion_number = from.motion_number;
  to.collision_number = from.collision_number;
  to.zone_number = from.zone_number;
  to.frame_count = from.frame_count;
  to.dropped = from.dropped;
  to.queue_full = from.queue_full;
  to.ticks_late = from.ticks_late;
  to.ticks_slipped = from.ticks_slipped;
  to.regularised = from.regularised;
  to.order_dependent = from.order_dependent;
  to.verify_period = from.verify_period;
  to.verify_checks = from.verify_checks;
  to.verify_overlaps = from.verify_overlaps;
  to.verify_missed = from.verify_missed;
  to.verify_worst_overlap = from.verify_worst_overlap;
  to.verify_energy_error = from.verify_energy_error;
  to.verify_momentum_error = from.verify_momentum_error;
}

}  // namespace

Status status_of(const idl::wire::Status& status) {
  Status result;
  result.world = idl::text(status.world);
  // A state that is newer than this program is at least not one that it can run commands in.
  result.state = status.state <= stoss_v1_STATE_FAILED ? static_cast<idl::WorldState>(status.state)
                                                       : idl::WorldState::kFailed;
  result.reason = idl::text(status.reason);
  result.epoch = status.epoch;
  result.at = translate::to_engine(status.at);
  result.real_seconds = status.real_seconds;
  result.real_nanoseconds = status.real_nanoseconds;
  result.uptime = status.uptime;
  result.tick = status.tick;
  result.tick_rate = status.tick_rate;
  result.speed_asked = status.speed_asked;
  result.speed_reached = status.speed_reached;
  result.state_hash = status.state_hash;
  copy_counts(result, status);
  result.arithmetic = status.arithmetic;
  result.period = {status.period_x, status.period_y};
  result.broad_phase = idl::text(status.broad_phase);
  result.version = idl::text(status.version);
  result.build = idl::text(status.build);
  result.pid = status.pid;
  for (const idl::wire::Counter& counter : idl::view(status.counters)) {
    result.counters.push_back({std::string(idl::text(counter.name)), counter.value});
  }
  return result;
}

}  // namespace stoss::client

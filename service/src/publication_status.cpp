// SPDX-License-Identifier: Apache-2.0
// The status as it is published: what the world's thread told, and what the publisher counted.
#include "publication.hpp"

#include <stoss/idl/sequence.hpp>

#include <unistd.h>

#include <chrono>

#ifndef STOSS_VERSION
#error "STOSS_VERSION comes from the build"
#endif

namespace stoss::service {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "gcc " __VERSION__;
#endif

}  // namespace

void Publication::fill_status(const WorldStatus& status) {
  collisions_lost_ = status.collisions_lost;
  zone_events_lost_ = status.zone_events_lost;
  records_put_off_ = status.records_put_off;
  idl::assign(status_.world, options_.world);
  status_.state = idl::wire_value(status.state);
  idl::assign(status_.reason, status.reason);
  status_.epoch = status.moment.epoch;
  status_.at = translate::to_wire(status.moment.at);
  const auto real = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(real);
  status_.real_seconds = seconds.count();
  status_.real_nanoseconds = static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(real - seconds).count());
  status_.uptime = std::chrono::duration<double>(clock_.now() - started_).count();
  status_.tick = status.moment.tick;
  status_.tick_rate = status.tick_rate;
  status_.speed_asked = status.speed_asked;
  status_.speed_reached = status.speed_reached;
  status_.bodies = status.bodies;
  status_.walls = status.walls;
  status_.zones = status.zones;
  status_.watched = status.watched;
  status_.collisions = status.collisions;
  status_.events = status.events;
  status_.events_per_second = status.events_per_second;
  status_.commands = status.commands;
  status_.rejected = status.rejected;
  status_.duplicates = status.duplicates;
  status_.queries = status.queries;
  status_.state_hash = status.state_hash;
  status_.motion_number = motions_.number();
  status_.collision_number = collisions_.number();
  status_.zone_number = zones_.number();
  status_.frame_count = frames_.count();
  status_.queue_full = shared_.queue_full.load(std::memory_order_relaxed);
  status_.ticks_late = status.ticks_late;
  status_.ticks_slipped = status.ticks_slipped;
  status_.regularised = status.regularised;
  status_.order_dependent = status.order_dependent;
  status_.verify_period = status.verify_period;
  status_.verify_checks = status.verified.checks;
  status_.verify_overlaps = status.verified.overlaps;
  status_.verify_missed = status.verified.missed;
  status_.verify_worst_overlap = status.verified.deepest;
  status_.verify_energy_error = status.verified.energy_error;
  status_.verify_momentum_error = status.verified.momentum_error;
  status_.arithmetic = idl::wire_value(translate::to_wire(status.arithmetic));
  status_.period_x = status.period.x();
  status_.period_y = status.period.y();
  idl::assign(status_.broad_phase, translate::name_of(status.broad_phase));
  idl::assign(status_.version, STOSS_VERSION);
  idl::assign(status_.build, kCompiler);
  status_.pid = static_cast<std::uint32_t>(getpid());
  add_counters();
}

void Publication::add_counters() {
  const std::uint64_t write_failures =
      motions_.failures() + collisions_.failures() + zones_.failures() + frames_.failures() +
      watched_.failures() + scene_.failures() + status_writer_.failures();
  status_.dropped = write_failures + replies_failed_ + collisions_lost_ + zone_events_lost_ +
                    outbox_.refusals_dropped() + transfers_.abandoned();
  counters_.clear();
  const auto add = [this](const char* name, std::uint64_t value) {
    wire::Counter& counter = counters_.emplace_back();
    idl::assign(counter.name, name);
    counter.value = value;
  };
  add("write_failures", write_failures);
  add("replies_failed", replies_failed_);
  add("refusals_dropped", outbox_.refusals_dropped());
  add("answers_abandoned", transfers_.abandoned());
  add("collisions_lost", collisions_lost_);
  add("zone_events_lost", zone_events_lost_);
  add("records_put_off", records_put_off_);
  add("frames_late", frame_times_.late());
  add("malformed", shared_.malformed.load(std::memory_order_relaxed));
  add("mailboxes", mailboxes_.size());
  add("mailboxes_evicted", mailboxes_.evicted());
  add("answers_underway", transfers_.underway());
  add("scene_version", scene_.version());
  idl::lend(status_.counters, counters_);
}

}  // namespace stoss::service

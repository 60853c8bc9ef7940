// SPDX-License-Identifier: Apache-2.0
// A world's health, as it reports it about once a second and on request.
#pragma once

#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/idl/types.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace stoss::client {

/// The fields are those of Status in idl/stoss.idl, which says what each means.
struct Status {
  struct Counter {
    std::string name;
    std::uint64_t value = 0;
  };

  std::string world;
  idl::WorldState state = idl::WorldState::kStopped;
  std::string reason;
  std::uint64_t epoch = 0;
  engine::Instant at;
  std::int64_t real_seconds = 0;
  std::uint32_t real_nanoseconds = 0;
  double uptime = 0;
  std::uint64_t tick = 0;
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
  std::uint64_t motion_number = 0;
  std::uint64_t collision_number = 0;
  std::uint64_t zone_number = 0;
  std::uint64_t frame_count = 0;
  std::uint64_t dropped = 0;
  std::uint64_t queue_full = 0;
  std::uint64_t ticks_late = 0;
  std::uint64_t ticks_slipped = 0;
  std::uint64_t regularised = 0;
  std::uint64_t order_dependent = 0;
  std::uint64_t verify_period = 0;
  std::uint64_t verify_checks = 0;
  std::uint64_t verify_overlaps = 0;
  std::uint64_t verify_missed = 0;
  double verify_worst_overlap = 0;
  double verify_energy_error = 0;
  double verify_momentum_error = 0;
  std::uint8_t arithmetic = 0;
  engine::Vector2 period = engine::Vector2::Zero();  ///< m; 0: open
  std::string broad_phase;
  std::string version;
  std::string build;
  std::uint32_t pid = 0;
  std::vector<Counter> counters;
};

[[nodiscard]] Status status_of(const idl::wire::Status& status);

}  // namespace stoss::client

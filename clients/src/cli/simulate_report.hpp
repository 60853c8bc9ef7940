// SPDX-License-Identifier: Apache-2.0
#pragma once

// What an offline run says about itself at its end.

#include "cli/simulate.hpp"
#include "cli/simulate_log.hpp"

#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace stoss::client::cli {

struct SimulateReport {
  engine::Conserved at_start{};
  engine::Conserved at_end{};
  engine::Instant end{};
  std::size_t disks = 0;
  std::size_t walls = 0;
  std::uint64_t zone_events = 0;
  std::uint64_t events = 0;  ///< collisions and all others
  double wall_seconds = 0;
  std::optional<std::uint64_t> state_hash{};
};

/// Statistics on standard error when asked for; digests, or one line of summary when nothing else
/// goes there, on standard output.
void print_report(const SimulateOptions& options,
                  const SimulateReport& report,
                  const CollisionLog& log);

}  // namespace stoss::client::cli

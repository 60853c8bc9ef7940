// SPDX-License-Identifier: Apache-2.0
#pragma once

// The horizon of each arithmetic in a scene, within a budget.

#include "accuracy/measure.hpp"

namespace stoss::client::accuracy {

/// What a look at the beginning of a run tells.
struct Probe {
  double cpu_s_per_collision = 0;
  double reached_s = 0;
  double last_collision_s = 0;
  std::uint64_t collisions = 0;
  bool ended = false;  ///< there are no more collisions, ever
};

/// Runs a method for about `cpu_s` seconds of CPU time. Throws std::runtime_error as Run::advance.
[[nodiscard]] Probe probe(const Method& method, const engine::Instant& start, double cpu_s);

/// REQUIRES: method.arithmetic. Takes about `cpu_s` seconds of CPU time at most.
[[nodiscard]] HorizonFigures horizon_of(const Method& method,
                                        const translate::SceneBodies& bodies,
                                        std::size_t disks,
                                        double cpu_s);

}  // namespace stoss::client::accuracy

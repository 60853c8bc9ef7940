// SPDX-License-Identifier: Apache-2.0
#pragma once

// `stoss simulate`: a scene run offline, by the exact engine or by the stepped baseline.

#include <stoss/engine/types.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace stoss::client::cli {

struct SimulateOptions {
  std::string scene;
  std::optional<engine::Instant> until;   ///< as a duration from the scene's start
  std::optional<double> tick_rate;        ///< Hz
  std::optional<std::string> collisions;  ///< where the log goes
  std::optional<std::string> zones;       ///< where the log of zone events goes
  std::optional<std::string> states;      ///< where the final states go
  std::optional<std::string> save_scene;  ///< where the end goes, as a scene
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours;
  std::optional<double> step;  ///< s; set: the stepped baseline
  std::uint64_t max_collisions = ~std::uint64_t{0};
  std::uint64_t verify = 0;  ///< events between two checks of the whole world; 0: none
  bool stats = false;
  bool hash = false;
  bool json = false;
};

/// Runs a scene. Throws RefusedError (a scene or body that is refused; Internal: the verification
/// found a fault), UsageError, or
/// std::system_error (output that cannot be written).
void simulate(const SimulateOptions& options);

}  // namespace stoss::client::cli

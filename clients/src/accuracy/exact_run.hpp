// SPDX-License-Identifier: Apache-2.0
#pragma once

// An exact world as a Run.

#include "accuracy/run.hpp"

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/world.hpp>
#include <stoss/translate/scene.hpp>

#include <vector>

namespace stoss::client::accuracy {

/// A world of any arithmetic with the scene's bodies in it. Errors: those of World::spawn.
[[nodiscard]] engine::Outcome<engine::World> exact_world(const translate::SceneBodies& bodies,
                                                         engine::Arithmetic arithmetic);

class ExactRun final : public Run {
 public:
  /// Throws std::runtime_error when this arithmetic cannot hold the scene.
  ExactRun(const translate::SceneBodies& bodies, engine::Arithmetic arithmetic);

  bool advance(const engine::Instant& until,
               engine::CollisionSink* sink,
               std::uint64_t work) override;
  [[nodiscard]] engine::Instant now() const override { return world_.now(); }
  [[nodiscard]] Snapshot snapshot(const engine::Instant& instant) const override;
  [[nodiscard]] Faults faults() override;

 private:
  engine::World world_;
  std::vector<engine::Id> dynamic_;  ///< in order
  std::vector<double> masses_;       ///< of the above, kg
  Faults faults_;
};

}  // namespace stoss::client::accuracy

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Another physics engine as a Run: it steps, and tells after each step where its disks are.

#include "accuracy/run.hpp"
#include "baseline/step_audit.hpp"

#include <stoss/translate/scene.hpp>

#include <cstdint>
#include <vector>

namespace stoss::tests {

class EngineRun : public client::accuracy::Run {
 public:
  EngineRun(const translate::SceneBodies& bodies, double step, bool audited)
      : disks_(bodies.disks),
        walls_(bodies.walls),
        start_(bodies.start),
        now_(bodies.start),
        step_(step),
        audited_(audited) {}

  bool advance(const engine::Instant& until,
               engine::CollisionSink* sink,
               std::uint64_t work) override;
  [[nodiscard]] engine::Instant now() const override { return now_; }
  [[nodiscard]] client::accuracy::Snapshot snapshot(const engine::Instant& instant) const override;
  /// What an engine that looks ahead has missed cannot be told from its steps.
  [[nodiscard]] client::accuracy::Faults faults() override;

 protected:
  /// Steps the engine and brings disks_ up to date.
  virtual void take_step(double dt) = 0;
  /// A collision of the step under way.
  void collided(engine::Id a, engine::Id b, engine::ContactKind kind);

  std::vector<engine::DiskSpec> disks_;  ///< in the order of ids, as all scenes of the study are
  std::vector<engine::WallSpec> walls_;

 private:
  [[nodiscard]] engine::Instant end_of_next_step() const;

  client::baseline::StepAudit audit_;
  engine::Instant start_;
  engine::Instant now_;
  double step_;
  bool audited_;
  std::uint64_t steps_ = 0;
  std::uint64_t collisions_ = 0;
  engine::CollisionSink* sink_ = nullptr;
};

}  // namespace stoss::tests

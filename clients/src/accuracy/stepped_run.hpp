// SPDX-License-Identifier: Apache-2.0
#pragma once

// A stepped baseline as a Run.

#include "accuracy/run.hpp"
#include "baseline/fixed_step.hpp"

#include <stoss/translate/scene.hpp>

namespace stoss::client::accuracy {

class SteppedRun final : public Run {
 public:
  /// `audited`: faults() tells something; takes time.
  SteppedRun(const translate::SceneBodies& bodies, const baseline::StepRule& rule, bool audited);

  bool advance(const engine::Instant& until,
               engine::CollisionSink* sink,
               std::uint64_t work) override;
  [[nodiscard]] engine::Instant now() const override { return world_.now(); }
  [[nodiscard]] Snapshot snapshot(const engine::Instant& instant) const override;
  [[nodiscard]] Faults faults() override;

 private:
  baseline::FixedStep world_;
};

}  // namespace stoss::client::accuracy

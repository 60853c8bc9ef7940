// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a step is about to get wrong: contacts that begin within it and that nothing at its end
// tells of, and how deep bodies will be inside each other when the step ends.
//
//   |p + v t| = R, first at  t = c / (-b + sqrt(b^2 - v^2 c)),  b = p.v, c = p^2 - R^2       (1)
//
// p, v: position (m) and velocity (m/s) of one body relative to the other; R: contact distance (m).
// A contact that begins within the step counts as seen when at the end of the step, and before any
// velocity is changed, the two overlap and approach: that is what a stepped engine looks for.
//
// Source: as engine/include/stoss/engine contact times, in plain doubles.
// Accuracy: contacts that begin in the last millionth of a step are left to the next one.

#include "baseline/uniform_grid.hpp"

#include <stoss/engine/types.hpp>

#include <cstdint>
#include <span>

namespace stoss::client::baseline {

class StepAudit {
 public:
  /// Judges the step of `dt` seconds that is about to be taken in straight lines.
  void look_ahead(std::span<const engine::DiskSpec> disks,
                  std::span<const engine::WallSpec> walls,
                  double dt);

  /// Contacts that began and were over, or beyond recognition, when their step ended.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }
  /// Deepest overlap at the end of any step, as a part of the contact distance.
  [[nodiscard]] double deepest() const { return deepest_; }

 private:
  void judge(const engine::DiskSpec& a, const engine::DiskSpec& b, double dt);
  void judge(const engine::DiskSpec& disk, const engine::WallSpec& wall, double dt);
  void note(bool began, double end_distance, double contact_distance, bool approaching);

  UniformGrid grid_;
  std::uint64_t missed_ = 0;
  double deepest_ = 0;
};

}  // namespace stoss::client::baseline

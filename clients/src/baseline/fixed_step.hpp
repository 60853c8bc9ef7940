// SPDX-License-Identifier: Apache-2.0
#pragma once

// The textbook way to simulate disks, kept as the baseline that the exact engine is compared with.
//
//   x <- x + v dt, for every body;                                                      (1)
//   for every pair that overlaps and approaches:  J = 2 (u.n) / (1/m_a + 1/m_b),
//   v_a <- v_a + J n / m_a,  v_b <- v_b - J n / m_b                                     (2)
//
// u: velocity of a relative to b (m/s); n: unit vector from a to b; m: masses (kg), infinite for
// kinematic and static disks and for walls. Pairs are found with a uniform grid.
//
// Source: as in Ericson, Real-Time Collision Detection (2005), 2.4 and 7.1 (uniform grid); the
//   impulse of a frictionless elastic contact as in any mechanics text.
// Deviation: none is meant. It misses contacts that begin and end within a step, finds the others
//   late and deep, and resolves them where it finds them: these are the errors to be compared.
// Accuracy: first order in dt while no contact is missed; tests/clients/fixed_step_test.cpp.

#include "baseline/uniform_grid.hpp"

#include <stoss/engine/types.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace stoss::client::baseline {

/// A world of disks and walls that goes in steps. Single-threaded, deterministic.
class FixedStep {
 public:
  /// REQUIRES: step > 0 and finite (s); bodies as the exact engine accepts them, with ids.
  FixedStep(std::span<const engine::DiskSpec> disks,
            std::span<const engine::WallSpec> walls,
            const engine::Instant& start,
            double step);

  /// Steps on to `until`; the last step is as short as it must be. Stops after the step in which
  /// the number of collisions reaches `max_collisions`. `sink` may be null.
  void advance_to(const engine::Instant& until,
                  engine::CollisionSink* sink,
                  std::uint64_t max_collisions);

  [[nodiscard]] engine::Instant now() const { return now_; }
  [[nodiscard]] std::uint64_t collisions() const { return collisions_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] engine::Conserved conserved() const;
  /// Every disk in the order of ids.
  void for_each_disk(const std::function<void(const engine::BodyState&)>& visit) const;

 private:
  void move(double dt);
  void meet_disks();
  void meet_walls();
  void meet(std::size_t a, std::size_t b);
  void meet_wall(std::size_t disk, const engine::WallSpec& wall);
  void report(engine::Collision& collision);

  std::vector<engine::DiskSpec> disks_;  ///< in the order of ids
  std::vector<engine::WallSpec> walls_;  ///< in the order of ids
  UniformGrid grid_;
  engine::Instant start_;
  engine::Instant now_;
  double step_;
  std::uint64_t steps_ = 0;
  std::uint64_t collisions_ = 0;
  engine::CollisionSink* sink_ = nullptr;
};

}  // namespace stoss::client::baseline

// SPDX-License-Identifier: Apache-2.0
#pragma once

// The textbook ways to simulate disks, kept as the baselines that the exact engine is compared
// with.
//
//   x <- x + v dt, for every body;                                                      (1)
//   for every pair that overlaps and approaches:  J = 2 (u.n) / (1/m_a + 1/m_b),
//   v_a <- v_a + J n / m_a,  v_b <- v_b - J n / m_b                                     (2)
//
// u: velocity of a relative to b (m/s); n: unit vector from a to b; m: masses (kg), infinite for
// kinematic and static disks and for walls. Pairs are found with a uniform grid.
//
// Two refinements that engines use:
//   substeps: pairs are looked for once a step, (1) and (2) are done n times with dt/n;
//   back-up: before (2), both bodies go back along their lines to where they touched, at most by
//     the step; after it they go on for the same time,
//
//   tau = -c / (B + sqrt(B^2 - v^2 c)),  B = -p.v,  c = p^2 - R^2                       (3)
//
// p, v: relative position (m) and velocity (m/s); R: contact distance (m); tau: time to go back
// (s).
//
// Source: as in Ericson, Real-Time Collision Detection (2005), 2.4 and 7.1 (uniform grid); the
//   impulse of a frictionless elastic contact as in any mechanics text.
// Deviation: none is meant. It misses contacts that begin and end within a step, finds the others
//   late and deep, and resolves them where it finds them: these are the errors to be compared.
// Accuracy: first order in dt while no contact is missed; with back-up to rounding, until a body
//   has two contacts within a step; tests/clients/fixed_step_test.cpp.

#include "baseline/step_audit.hpp"
#include "baseline/uniform_grid.hpp"

#include <stoss/engine/types.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace stoss::client::baseline {

/// How a stepped world goes from one step to the next.
struct StepRule {
  double step = 0;             ///< s, > 0
  std::uint32_t substeps = 1;  ///< parts of a step that share one search for pairs, >= 1
  bool back_up = false;        ///< contacts are resolved where they began
};

/// A world of disks and walls that goes in steps. Single-threaded, deterministic.
class FixedStep {
 public:
  /// REQUIRES: step > 0 and finite (s); bodies as the exact engine accepts them, with ids.
  FixedStep(std::span<const engine::DiskSpec> disks,
            std::span<const engine::WallSpec> walls,
            const engine::Instant& start,
            double step);
  /// As above; `audited` judges every step before it is taken, which takes time.
  FixedStep(std::span<const engine::DiskSpec> disks,
            std::span<const engine::WallSpec> walls,
            const engine::Instant& start,
            const StepRule& rule,
            bool audited);

  /// Steps on to `until`; the last step is as short as it must be. Stops after the step in which
  /// the number of collisions reaches `max_collisions`. `sink` may be null.
  void advance_to(const engine::Instant& until,
                  engine::CollisionSink* sink,
                  std::uint64_t max_collisions);

  /// Takes whole steps while they end at or before `until`, at most `max_steps`. Returns whether
  /// none is left to take. REQUIRES: advance_to() is not used on this world.
  bool step_up_to(const engine::Instant& until,
                  engine::CollisionSink* sink,
                  std::uint64_t max_steps);

  [[nodiscard]] engine::Instant now() const { return now_; }
  [[nodiscard]] std::uint64_t collisions() const { return collisions_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] const StepAudit& audit() const { return audit_; }
  [[nodiscard]] engine::Conserved conserved() const;
  /// Every disk in the order of ids.
  void for_each_disk(const std::function<void(const engine::BodyState&)>& visit) const;

 private:
  [[nodiscard]] engine::Instant end_of_next_step(const engine::Instant& otherwise) const;
  void take_step(const engine::Instant& end, double dt);
  void find_candidates(double dt);
  void move(double dt);
  void meet_disks();
  void meet_walls();
  void meet(std::size_t a, std::size_t b);
  void meet_wall(std::size_t disk, engine::WallSpec& wall);
  void resolve(engine::DiskSpec& a, engine::DiskSpec& b, double back);
  void bounce(engine::DiskSpec& disk, const engine::WallSpec& wall, double back);
  void report(engine::Collision& collision, double back);

  std::vector<engine::DiskSpec> disks_;  ///< in the order of ids
  std::vector<engine::WallSpec> walls_;  ///< in the order of ids
  UniformGrid grid_;
  std::vector<std::pair<std::size_t, std::size_t>> candidates_;  ///< of a step with substeps
  StepAudit audit_;
  engine::Instant start_;
  engine::Instant now_;
  StepRule rule_;
  bool audited_ = false;
  bool within_step_ = false;  ///< advance_to() stopped before the end of a step
  double part_ = 0;           ///< s, the length of the substep under way
  std::uint64_t steps_ = 0;
  std::uint64_t collisions_ = 0;
  engine::CollisionSink* sink_ = nullptr;
};

}  // namespace stoss::client::baseline

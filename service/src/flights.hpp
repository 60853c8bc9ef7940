// SPDX-License-Identifier: Apache-2.0
// Motions as frames read them. A frame evaluates every disk, so what that reads and computes is
// most of what publishing costs: here it is a line and a half a disk, and several disks at a time.
#pragma once

#include <stoss/engine/motion.hpp>
#include <stoss/engine/types.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace stoss::service {

/// All that a frame tells of a disk that flies straight, neither turns nor changes its size, and is
/// in an open world of doubles.
struct Flight {
  engine::Motion<double> motion;
  engine::Id id = engine::kNoId;  ///< kNoId: it is no such disk
};

/// Nothing when the body is no such disk.
[[nodiscard]] Flight flight_of(const engine::MotionRecord& motion,
                               const engine::BodyRecord& body,
                               engine::Arithmetic arithmetic,
                               const engine::Vector2& period);

/// So many are evaluated together.
inline constexpr std::size_t kFlightsAtOnce = 32;

/// Columns of a frame.
struct FlightStates {
  std::array<engine::Id, kFlightsAtOnce> id;
  std::array<double, kFlightsAtOnce> x, y;    ///< m
  std::array<double, kFlightsAtOnce> vx, vy;  ///< m/s
};

/// The states at an instant, as engine::evaluate() and evaluate_velocity() have them, to the same
/// bits. False, with `states` in no state to be used, when one of them is no such disk, or its
/// motion begins at this very instant.
[[nodiscard]] bool states_at(std::span<const Flight, kFlightsAtOnce> flights,
                             const engine::Instant& at,
                             FlightStates& states);

}  // namespace stoss::service

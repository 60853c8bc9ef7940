// SPDX-License-Identifier: Apache-2.0
// Motions as frames read them. A frame evaluates every disk, so what that reads and computes is
// most of what publishing costs beyond DDS: here it is 80 bytes a disk, and several disks at a
// time.
#pragma once

#include <stoss/engine/motion.hpp>
#include <stoss/engine/types.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace stoss::service {

/// The motion of a disk that flies straight, neither turns nor changes its size, and is in an open
/// world of doubles; or none, which began at the end of time.
struct Flight {
  engine::Motion<double> motion{{}, {}, engine::Instant::never()};
};

[[nodiscard]] inline bool is_flight(const Flight& flight) {
  return flight.motion.since != engine::Instant::never();
}

/// The record that it was made from. REQUIRES: is_flight(flight).
[[nodiscard]] inline engine::MotionRecord record_of(engine::Id id, const Flight& flight) {
  return engine::to_record(id, flight.motion);
}

/// None when the body is no such disk.
[[nodiscard]] Flight flight_of(const engine::MotionRecord& motion,
                               const engine::BodyRecord& body,
                               engine::Arithmetic arithmetic,
                               const engine::Vector2& period);

/// So many are evaluated together.
inline constexpr std::size_t kFlightsAtOnce = 32;

/// Where their states go: a part of the columns of a frame.
struct FlightStates {
  using Column = std::span<double, kFlightsAtOnce>;
  Column x, y;    ///< m
  Column vx, vy;  ///< m/s
};

/// The states at an instant, as engine::evaluate() and evaluate_velocity() have them, to the same
/// bits. False, with `states` in no state to be used, when one of the flights is none. Flights that
/// will be asked for soon are brought into the cache meanwhile.
[[nodiscard]] bool states_at(std::span<const Flight, kFlightsAtOnce> flights,
                             const engine::Instant& at,
                             const FlightStates& states,
                             std::span<const Flight> soon = {});

}  // namespace stoss::service

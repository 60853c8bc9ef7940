// SPDX-License-Identifier: Apache-2.0
#pragma once

// One way to advance a scene, under way: an exact world in some arithmetic, a stepped baseline, or
// another engine that a study sets beside them.

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/types.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace stoss::client::accuracy {

/// The dynamic disks at an instant, to 106 bits, in the order of ids.
struct Snapshot {
  std::vector<engine::DoubleWord2<double>> positions;  ///< m
  engine::DoubleWord<double> energy;                   ///< kinetic, J
};

/// What a run got wrong by its own account. Zero is the only good figure.
struct Faults {
  /// Contacts that went by without a collision; nothing where that cannot be known.
  std::optional<std::uint64_t> missed = 0;
  double deepest = 0;  ///< overlap, as a part of the contact distance
};

class Run {
 public:
  virtual ~Run() = default;
  /// Goes on towards `until`, by about `work` events or steps. Returns whether it has arrived.
  /// `sink` may be null. Throws std::runtime_error when it cannot go on.
  virtual bool advance(const engine::Instant& until,
                       engine::CollisionSink* sink,
                       std::uint64_t work) = 0;
  [[nodiscard]] virtual engine::Instant now() const = 0;
  /// The state at `instant`, which lies at most a step after what advance() has reached; between
  /// two steps disks are carried on along their lines.
  [[nodiscard]] virtual Snapshot snapshot(const engine::Instant& instant) const = 0;
  /// What was found so far, the present instant included.
  [[nodiscard]] virtual Faults faults() = 0;
};

/// Advances by this much work between two looks at the clock.
inline constexpr std::uint64_t kEventsAtOnce = 2048;
inline constexpr std::uint64_t kStepsAtOnce = 16;

}  // namespace stoss::client::accuracy

// SPDX-License-Identifier: Apache-2.0
// One published sample of changed motions.
#pragma once

#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/idl/types.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace stoss::client {

/// A body's change; for a removed one only the id and the instant of the motion say anything.
struct MotionChange {
  engine::ChangeKind kind = engine::ChangeKind::Moved;
  engine::MotionRecord motion;
};

/// A part of the changes of one tick. Parts are numbered through without gaps within an epoch.
struct MotionPart {
  std::uint64_t epoch = 0;
  std::uint64_t number = 0;
  std::uint32_t part = 0;  ///< of the tick's parts, from 0
  std::uint32_t parts = 1;
  std::uint64_t tick = 0;
  engine::Instant at;
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::Vector2 period = engine::Vector2::Zero();  ///< m; 0: open
  std::uint64_t state_hash = 0;  ///< of the world after the tick; in the last part, or 0
  std::vector<MotionChange> changes;
  std::vector<engine::BodyRecord> statics;  ///< of the bodies that this part brings in

  [[nodiscard]] bool last_of_tick() const { return part + 1 >= parts; }
};

/// Nothing when the sample's arrays contradict each other, or its arithmetic or periods are none
/// that are known here.
[[nodiscard]] std::optional<MotionPart> motion_part_of(const idl::wire::MotionBatch& batch);

}  // namespace stoss::client

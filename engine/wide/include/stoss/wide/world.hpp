// SPDX-License-Identifier: Apache-2.0
#pragma once

// Worlds in every arithmetic, the wide ones included.

#include <stoss/engine/world.hpp>

#include <cstddef>
#include <span>

namespace stoss::wide {

/// Whether this build has the arithmetic: Float128 needs GCC's libquadmath.
bool is_available(engine::Arithmetic arithmetic);

/// A world without bodies in any arithmetic. REQUIRES: is_available(options.arithmetic).
engine::World make_world(const engine::WorldOptions& options);

/// As engine::World::deserialise, for any arithmetic.
engine::Outcome<engine::World> deserialise(
    std::span<const std::byte> bytes,
    engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours);

}  // namespace stoss::wide

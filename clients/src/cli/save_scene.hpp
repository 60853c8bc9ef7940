// SPDX-License-Identifier: Apache-2.0
#pragma once

// The end of a run as a scene to begin with.

#include <stoss/engine/types.hpp>
#include <stoss/engine/world.hpp>

#include <span>
#include <string>

namespace stoss::client::cli {

/// Writes the scene at `from` to `to` as the world has it now. `ids`: of its disks, then of its
/// walls. Growth is left out: a packing is made once. The radii that it made are rounded down by a
/// few units in the last place of the scene's size, so that no rounding of a place makes two bodies
/// overlap. Throws RefusedError (a file that cannot be written; a disk that rounding would leave no
/// radius).
void save_scene(const std::string& from,
                const std::string& to,
                const engine::World& world,
                std::span<const engine::Id> ids);

}  // namespace stoss::client::cli

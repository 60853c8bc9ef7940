// SPDX-License-Identifier: Apache-2.0
#pragma once

// How far ahead a world's forecast can be trusted.
//
// Collisions amplify every difference: in a gas each one eats most of a decimal digit. Two runs
// that start one unit in the last place apart therefore agree on who meets whom up to some instant,
// and on nothing after it. That instant is the horizon of the arithmetic in this scene.
//
// Source: NUMERICS: Krylov's instability of hard-disk motion; van Zon, van Beijeren, Dellago, Phys.
// Rev. Lett. 80 (1998) 2035 for the rate. Deviation: measured from the twin run, not from an
// exponent.

#include <stoss/engine/world.hpp>

#include <cstdint>

namespace stoss::engine {

struct Horizon {
  Instant instant;               ///< of the first collision that the two runs disagree on
  std::uint64_t collisions = 0;  ///< on which they agree
  double collisions_per_disk =
      0;                     ///< agreed pair collisions, both partners counted, per dynamic disk
  bool reached_end = false;  ///< they agree up to the end of what was asked
};

/// Runs a copy of `world` beside one whose motions are off by one unit in the last place, up to
/// `until` or `max_collisions`. The world itself stays as it is. `seed` picks the signs.
Outcome<Horizon> measure_horizon(const World& world,
                                 const Instant& until,
                                 std::uint64_t max_collisions,
                                 std::uint64_t seed = 1);

}  // namespace stoss::engine

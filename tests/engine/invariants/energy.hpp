// SPDX-License-Identifier: Apache-2.0
#pragma once

// A world's energy without rounding, to see a drift that no double shows.

#include "support/oracle.hpp"
#include "support/worlds.hpp"

namespace stoss::test {

/// Twice the kinetic energy of the dynamic disks, from the words of their stored velocities, in 400
/// bits; J.
inline Real exact_energy(const World& world) {
  Real sum = 0;
  for (const Id id : world.ids()) {
    const auto body = world.body(id).value();
    if (body.is_wall || body.kind != engine::BodyKind::Dynamic) continue;
    const auto motion = world.motion(id).value();
    const Real vx = Real(motion.vx.high) + Real(motion.vx.low);
    const Real vy = Real(motion.vy.high) + Real(motion.vy.low);
    sum += Real(body.mass) * (vx * vx + vy * vy);
  }
  return sum;
}

/// now / before - 1, rounded once.
inline double relative_change(const Real& before, const Real& now) {
  return Real((now - before) / before).convert_to<double>();
}

/// What a collision does to the energy of 100 disks that share it, at most, relative to that energy
/// and in units of u^2 (u = 2^-53 in double, 2^-24 in float): the step of a random walk without
/// bias. Measured by energy_walk_test: 0.035 to 0.043. The long run is judged by it.
inline constexpr double kEnergyStep = 0.06;

}  // namespace stoss::test

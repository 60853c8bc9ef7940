// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a world in S takes in. Within these limits no difference, square root or share of masses
// leaves the range of S; the kernels scale what they square.

#include <stoss/engine/world.hpp>

#include <cmath>
#include <type_traits>

namespace stoss::engine::detail {

/// The largest lengths and speeds that a world in S takes in. Chosen for float: differences of
/// positions, and what the kernels make of them, stay far below its largest number, 3e38.
template <class S>
inline constexpr double kLengthMax = kLengthMaxM;
template <>
inline constexpr double kLengthMax<float> = 1e30;
template <class S>
inline constexpr double kSpeedMax = kSpeedMaxMps;
template <>
inline constexpr double kSpeedMax<float> = 1e30;

/// Sums of two masses, and quotients of them, must stay in range.
template <class S>
bool is_usable_mass(double mass) {
  if (!(mass > 0) || !std::isfinite(mass)) return false;
  const double limit = std::is_same_v<S, float> ? 1e30 : 1e150;
  return mass <= limit && mass >= 1 / limit;
}

}  // namespace stoss::engine::detail

// SPDX-License-Identifier: Apache-2.0
// Kicks that hold a temperature T (J): what the n-th kick of a body draws.
//   (1) waiting times  t = -log(U) / rate,  U uniform in (0, 1]
//   (2) components of velocity  sqrt(T / m) z,  spin  sqrt(T / I) z,  I = m r^2 / 2,  z normal
//   (3) z1, z2 = (u, v) sqrt(-2 log(s) / s),  s = u^2 + v^2,  for the first (u, v) uniform in the
//       square (-1, 1)^2 with 0 < s < 1
// Source: Andersen, J. Chem. Phys. 72 (1980) 2384; (3): Marsaglia, Bray, SIAM Rev. 6 (1964) 260.
// Deviation: the random numbers are functions of (seed, body, n, purpose, attempt): philox.hpp.
// Accuracy: uniform numbers of 53 bits, all arithmetic in double, whatever the world's; logarithms
//   rounded correctly (elementary.hpp): the same bits with every compiler. Moments and waiting
//   times within error bars: tests/engine/effects/thermostat_test.cpp.
// Preconditions: rate > 0, T >= 0, m > 0, r > 0.
#pragma once

#include "elementary.hpp"
#include "philox.hpp"

#include <stoss/engine/types.hpp>

#include <cmath>
#include <cstdint>

namespace stoss::engine {

/// Which kick: of a body, in a world with that seed.
struct KickKey {
  std::uint64_t seed = 0;
  Id body = kNoId;
  std::uint64_t number = 0;  ///< kicks of the body before
};

namespace detail {

/// What a kick draws random numbers for. The values are part of the results: they never change.
enum class Purpose : std::uint64_t { Wait = 0, Velocity = 1, Spin = 2 };

inline PhiloxBlock draw(const KickKey& key, Purpose purpose, std::uint64_t attempt) {
  return philox({key.number, static_cast<std::uint64_t>(purpose), attempt, 0},
                {key.seed, key.body});
}

/// k 2^-53, uniform in [0, 1).
inline double unit_interval(std::uint64_t word) {
  constexpr unsigned kDropped = 11;
  return static_cast<double>(word >> kDropped) * 0x1p-53;
}

/// Uniform in (-1, 1), and symmetric.
inline double both_signs(std::uint64_t word) { return 2 * unit_interval(word) - (1 - 0x1p-53); }

/// (3)
inline Vector2 two_normals(const KickKey& key, Purpose purpose) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    const PhiloxBlock words = draw(key, purpose, attempt);
    const double u = both_signs(words[0]);
    const double v = both_signs(words[1]);
    const double s = u * u + v * v;
    if (!(s > 0 && s < 1)) continue;
    const double log_s = to_scalar(log1p_words(two_sum(s, -1.0)));
    const double scale = std::sqrt(-2 * log_s / s);
    return {u * scale, v * scale};
  }
}

}  // namespace detail

/// (1), s.
inline double wait_before(const KickKey& key, double rate) {
  const double u = detail::unit_interval(detail::draw(key, detail::Purpose::Wait, 0)[0]);
  return -rounded_log1p(-u) / rate;
}

/// (2), m/s.
inline Vector2 velocity_after(const KickKey& key, double temperature, double mass) {
  return std::sqrt(temperature / mass) * detail::two_normals(key, detail::Purpose::Velocity);
}

/// (2), rad/s.
inline double spin_after(const KickKey& key, double temperature, double mass, double radius) {
  const double speed = std::sqrt(2 * (temperature / mass));
  return speed / radius * detail::two_normals(key, detail::Purpose::Spin).x();
}

}  // namespace stoss::engine

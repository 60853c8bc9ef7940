// SPDX-License-Identifier: Apache-2.0
// Random numbers without a state: a keyed bijection of a counter.
//   (1) one round on (c0, c1, c2, c3) with keys (k0, k1):
//       (hi1 ^ c1 ^ k0, lo1, hi0 ^ c3 ^ k1, lo0),  hi0 lo0 = M0 c0,  hi1 lo1 = M1 c2
//   (2) ten rounds; between two of them k0 += W0, k1 += W1, modulo 2^64
// Source: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC '11:
//   Philox4x64-10, with its multipliers and Weyl constants.
// Deviation: none.
// Accuracy: integers; the published known answers: tests/engine/effects/thermostat_test.cpp.
// Preconditions: none.
#pragma once

#include <stoss/engine/instant.hpp>

#include <array>
#include <cstdint>

namespace stoss::engine {

using PhiloxBlock = std::array<std::uint64_t, 4>;
using PhiloxKey = std::array<std::uint64_t, 2>;

[[nodiscard]] constexpr PhiloxBlock philox(PhiloxBlock counter, PhiloxKey key) noexcept {
  constexpr PhiloxKey kMultipliers = {0xd2e7470ee14c6c93U, 0xca5a826395121157U};
  constexpr PhiloxKey kWeyl = {0x9e3779b97f4a7c15U, 0xbb67ae8584caa73bU};
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds; ++round) {
    const Uint128 p = static_cast<Uint128>(kMultipliers[0]) * counter[0];
    const Uint128 q = static_cast<Uint128>(kMultipliers[1]) * counter[2];
    counter = {static_cast<std::uint64_t>(q >> 64) ^ counter[1] ^ key[0],
               static_cast<std::uint64_t>(q),
               static_cast<std::uint64_t>(p >> 64) ^ counter[3] ^ key[1],
               static_cast<std::uint64_t>(p)};
    key = {key[0] + kWeyl[0], key[1] + kWeyl[1]};
  }
  return counter;
}

}  // namespace stoss::engine

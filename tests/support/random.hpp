// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random numbers for tests: the same from every standard library, from a seed that is printed and
// can be set. Environment: STOSS_SEED.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace stoss::test {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53);
  }

  /// 10^x with x in [low, high).
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  double either_sign(double x) { return (bits() & 1U) != 0 ? x : -x; }

  /// In [0, count). REQUIRES: count > 0.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }

  bool one_in(std::uint64_t count) { return below(count) == 0; }

 private:
  std::uint64_t state_;
};

inline std::uint64_t environment_number(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 0);
}

/// The seed of this process, printed once.
inline std::uint64_t seed_of_run() {
  static const std::uint64_t seed = [] {
    const std::uint64_t value = environment_number("STOSS_SEED", 20261122);
    std::printf("STOSS_SEED=%llu\n", static_cast<unsigned long long>(value));
    return value;
  }();
  return seed;
}

}  // namespace stoss::test

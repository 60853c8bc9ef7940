// SPDX-License-Identifier: Apache-2.0
#pragma once

// The instants of ticks, each computed from the tick's number alone.
//
//   t_n = t_0 + floor(2^64 n d / r) 2^-64 s                                              (1)
//
// t_0: the instant of tick 0; r / d: ticks per second as an exact ratio. Nothing is summed up, so
// the millionth tick is as exact as the first, and the ticks at whole seconds of a rate of whole
// hertz fall on them exactly.
//
// Source: long division of a 192-bit number by a 64-bit one, limb by limb.
// Accuracy: (1) is exact integer arithmetic; tests/engine/tick_clock_test.cpp compares it with
//   another division of the same numbers.

#include <stoss/engine/instant.hpp>

#include <cstdint>
#include <optional>

namespace stoss::engine {

/// Ticks of numerator / denominator hertz from an instant on. A small value; copy it freely.
class TickClock {
 public:
  /// REQUIRES: both numbers of the ratio > 0.
  constexpr TickClock(const Instant& start, std::uint64_t numerator_hz, std::uint64_t denominator)
      : start_(start), numerator_(numerator_hz), denominator_(denominator) {}

  /// A clock of exactly the rate that the double holds (59.94 is a ratio of powers of two, not
  /// 5994/100). Nothing unless `hz` is a ratio of two 64-bit numbers: positive and finite, and, for
  /// whole numbers and for everything from 2^-10 up, below 2^64.
  static constexpr std::optional<TickClock> from_rate(const Instant& start, double hz) {
    constexpr double kTwo64 = 18446744073709551616.0;
    constexpr double kTwo63 = 9223372036854775808.0;
    if (!(hz > 0 && hz < kTwo64)) return std::nullopt;
    std::uint64_t denominator = 1;
    // Doubling is exact. A double at or above 2^63 is a whole number, so the loop ends before.
    while (hz < kTwo63 && static_cast<double>(static_cast<std::uint64_t>(hz)) != hz) {
      if (denominator > (~std::uint64_t{0} >> 1)) return std::nullopt;
      hz *= 2;
      denominator *= 2;
    }
    return TickClock(start, static_cast<std::uint64_t>(hz), denominator);
  }

  constexpr Instant start() const { return start_; }
  constexpr std::uint64_t numerator() const { return numerator_; }
  constexpr std::uint64_t denominator() const { return denominator_; }

  /// The instant of tick `n`, as (1) has it; Instant::never() beyond the end of time.
  constexpr Instant instant_of(std::uint64_t n) const {
    const Uint128 product = static_cast<Uint128>(n) * denominator_;
    const Uint128 whole = product / numerator_;
    if (whole >= static_cast<Uint128>(kSecondsMax) * 2) return Instant::never();
    const Uint128 rest = product % numerator_;  // < 2^64
    const auto fraction = static_cast<std::uint64_t>((rest << 64) / numerator_);
    const Int128 elapsed = static_cast<Int128>((whole << 64) | fraction);
    const Instant result = instant_from_ticks(ticks(start_) + elapsed);
    return in_range(result) ? result : Instant::never();
  }

  /// The lowest number of a tick at or after `t`; nothing when there is none below 2^64.
  constexpr std::optional<std::uint64_t> first_at_or_after(const Instant& t) const {
    if (t <= start_) return 0;
    std::uint64_t low = 0;  // its tick is before t
    std::uint64_t high = 1;
    while (instant_of(high) < t) {
      low = high;
      if (high > (~std::uint64_t{0} >> 1)) {
        high = ~std::uint64_t{0};
        if (instant_of(high) < t) return std::nullopt;
        break;
      }
      high *= 2;
    }
    while (high - low > 1) {
      const std::uint64_t middle = low + (high - low) / 2;
      (instant_of(middle) < t ? low : high) = middle;
    }
    return high;
  }

 private:
  Instant start_;
  std::uint64_t numerator_;
  std::uint64_t denominator_;
};

}  // namespace stoss::engine

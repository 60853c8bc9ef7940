// SPDX-License-Identifier: Apache-2.0
#pragma once

// Points of simulated time as signed fixed-point numbers of seconds.
//
// An absolute time held as a double loses resolution as the world ages (1e-7 s after 1e9 s).
// A fixed-point number has one resolution for ever, so a world that starts at 2^40 s gives the same
// bytes as one that starts at 0. Durations stay floating point; they are measured from the later of
// two motions' instants and only then added.
//
// Source: 64.64 is the 128-bit date format of NTP (RFC 5905, section 6).
// Accuracy: differences are exact integers, rounded once to hi and once to lo; sums are rounded
// once to the grid of 2^-64 s (Instant) or 2^-128 s (WideInstant). Measured by
// tests/engine/instant_test.cpp.

#include <stoss/engine/double_word.hpp>

#include <compare>
#include <cstdint>
#include <limits>
#include <optional>

namespace stoss::engine {

__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

struct Instant;
constexpr Int128 ticks(const Instant& t);

/// A point of simulated time: `seconds` + `fraction` * 2^-64 s, with 0 <= fraction / 2^64 < 1.
/// Ordered, exact, 16 bytes.
struct Instant {
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;

  friend constexpr bool operator==(const Instant&, const Instant&) = default;
  // As one number: which of two instants is later is a toss-up that no jump should hang on.
  friend constexpr auto operator<=>(const Instant& a, const Instant& b) {
    return ticks(a) <=> ticks(b);
  }
  friend constexpr bool operator<(const Instant& a, const Instant& b) {
    return ticks(a) < ticks(b);
  }

  /// Later than every event: what a body without an event is scheduled at.
  static constexpr Instant never() {
    return {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::uint64_t>::max()};
  }
};

/// Simulated times that a world accepts lie within +-2^61 s (7e10 years), so that no sum overflows.
inline constexpr std::int64_t kSecondsMax = std::int64_t{1} << 61;

constexpr bool in_range(const Instant& t) {
  return t.seconds > -kSecondsMax && t.seconds < kSecondsMax;
}

/// The instant as a whole number of 2^-64 s.
constexpr Int128 ticks(const Instant& t) {
  return static_cast<Int128>((static_cast<Uint128>(static_cast<std::uint64_t>(t.seconds)) << 64) |
                             t.fraction);
}

constexpr Instant instant_from_ticks(Int128 n) {
  const auto u = static_cast<Uint128>(n);
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(u >> 64)),
          static_cast<std::uint64_t>(u)};
}

/// An instant on the finer grid of 2^-128 s, for arithmetics wider than double.
struct WideInstant {
  Instant coarse;          ///< rounded down to 2^-64 s
  std::uint64_t fine = 0;  ///< in units of 2^-128 s

  friend constexpr auto operator<=>(const WideInstant&, const WideInstant&) = default;
  static constexpr WideInstant never() { return {Instant::never(), 0}; }
};

/// The grid that an arithmetic S schedules on.
template <class S>
struct TimeOf {
  using Type = std::conditional_t<kCompensated<S>, Instant, WideInstant>;
};
template <class S>
using Time = typename TimeOf<S>::Type;

constexpr Instant to_instant(const Instant& t) { return t; }
/// The nearest 64.64 instant (ties away from zero fraction).
constexpr Instant to_instant(const WideInstant& t) {
  return instant_from_ticks(ticks(t.coarse) + static_cast<Int128>(t.fine >> 63));
}

template <class T>
constexpr T from_instant(const Instant& t) {
  if constexpr (std::is_same_v<T, Instant>) {
    return t;
  } else {
    return {t, 0};
  }
}

namespace detail {

/// 2^n, exactly, for an S whose exponent range holds it.
template <class S>
[[nodiscard]] constexpr S power_of_two(int n) noexcept {
  S power(1);
  S base = n < 0 ? S(0.5) : S(2);
  for (int rest = n < 0 ? -n : n; rest > 0; rest /= 2) {
    if (rest % 2 != 0) power = S(power * base);
    if (rest > 1) base = S(base * base);
  }
  return power;
}

template <class S>
inline const S kTwo32 = power_of_two<S>(32);
template <class S>
inline const S kTwoMinus32 = power_of_two<S>(-32);

/// A whole number of 2^-64 s, in seconds: rounded to hi, the rest rounded to lo.
template <class S>
DoubleWord<S> to_seconds(Int128 n) {
  static const S scale = power_of_two<S>(-64);
  const S hi = static_cast<S>(n);
  const S lo = static_cast<S>(n - static_cast<Int128>(hi));
  return {hi * scale, lo * scale};
}

/// Seconds on the grid of 2^-64 s: the whole part of their number, towards zero, and the rest of
/// it, exactly.
template <class S>
struct OnGrid {
  Int128 whole;
  S rest;
};

/// REQUIRES: |seconds| < 2^63.
template <class S>
OnGrid<S> on_grid(const S& seconds) {
  static const S scale = power_of_two<S>(64);
  const S n = seconds * scale;
  const auto whole = static_cast<Int128>(n);
  return {whole, n - static_cast<S>(whole)};
}

// The same for double without conversions of 128 bits where 32 of them and 64 will do.

template <>
[[gnu::always_inline]] inline DoubleWord<double> to_seconds<double>(Int128 n) {
  constexpr std::int64_t kExact = std::int64_t{1} << 21;  // s; up to there n / 2^32 has 53 bits
  const auto whole = static_cast<std::int64_t>(n >> 64);
  if (whole < kExact && whole >= -kExact) [[likely]] {
    return quick_two_sum(static_cast<double>(static_cast<std::int64_t>(n >> 32)) * 0x1p-32,
                         static_cast<double>(static_cast<std::uint32_t>(n)) * 0x1p-64);
  }
  const auto hi = static_cast<double>(n);
  return {hi * 0x1p-64, static_cast<double>(n - static_cast<Int128>(hi)) * 0x1p-64};
}

template <>
[[gnu::always_inline]] inline OnGrid<double> on_grid<double>(const double& seconds) {
  constexpr double kLargest = 0x1p30;  // s; below, seconds * 2^32 fits in 64 bits
  if (!(std::abs(seconds) < kLargest)) [[unlikely]] {
    const auto whole = static_cast<Int128>(seconds * 0x1p64);
    return {whole, seconds * 0x1p64 - static_cast<double>(whole)};
  }
  const double coarse = seconds * 0x1p32;
  const auto high = static_cast<std::int64_t>(coarse);
  const double fine = (coarse - static_cast<double>(high)) * 0x1p32;  // exact, with their sign
  const auto low = static_cast<std::int64_t>(fine);
  return {(static_cast<Int128>(high) << 32) + low, fine - static_cast<double>(low)};
}

}  // namespace detail

/// later - earlier in seconds: exact as an integer, rounded to hi, the rest rounded to lo.
template <class S>
[[gnu::always_inline]] inline DoubleWord<S> difference(const Instant& later,
                                                       const Instant& earlier) {
  return detail::to_seconds<S>(ticks(later) - ticks(earlier));
}

/// later - earlier in seconds, for an S of at least 64 digits: summed limb by limb from the least.
template <class S>
DoubleWord<S> difference(const WideInstant& later, const WideInstant& earlier) {
  Int128 coarse = ticks(later.coarse) - ticks(earlier.coarse);
  const bool borrow = later.fine < earlier.fine;
  std::uint64_t fine = later.fine - earlier.fine;
  if (borrow) coarse -= 1;
  const bool negative = coarse < 0;
  if (negative) {  // two's complement of the 192-bit number
    fine = ~fine + 1;
    coarse = ~coarse + (fine == 0 ? 1 : 0);
  }
  const auto high = static_cast<Uint128>(coarse);
  const std::uint32_t limbs[6] = {static_cast<std::uint32_t>(fine),
                                  static_cast<std::uint32_t>(fine >> 32),
                                  static_cast<std::uint32_t>(high),
                                  static_cast<std::uint32_t>(high >> 32),
                                  static_cast<std::uint32_t>(high >> 64),
                                  static_cast<std::uint32_t>(high >> 96)};
  S sum(0);
  for (const std::uint32_t limb : limbs) {
    sum = (sum + S(static_cast<double>(limb))) * detail::kTwoMinus32<S>;
  }
  sum = sum * detail::kTwo32<S> * detail::kTwo32<S>;
  return {negative ? -sum : sum, S(0)};
}

/// `from` + hi + lo seconds, rounded once to the grid; nothing when that is beyond the end of time.
/// REQUIRES: hi >= 0, |lo| <= ulp(hi).
template <class S>
[[gnu::always_inline]] inline std::optional<Instant> later_by(const Instant& from,
                                                              const S& hi,
                                                              const S& lo) {
  static const S limit = detail::power_of_two<S>(61);
  if (!(hi < limit)) return std::nullopt;
  detail::OnGrid<S> time = detail::on_grid(hi);
  if (lo != S(0)) [[unlikely]] {
    const detail::OnGrid<S> low = detail::on_grid(lo);
    time.whole += low.whole;
    time.rest += low.rest;  // both are exact and within (-1, 1)
    for (; time.rest >= S(0.5); time.rest -= S(1)) time.whole += 1;
    for (; time.rest < S(-0.5); time.rest += S(1)) time.whole -= 1;
  }
  time.whole += time.rest >= S(0.5) ? 1 : 0;
  const Instant result = instant_from_ticks(ticks(from) + time.whole);
  if (!in_range(result)) return std::nullopt;
  return result;
}

/// As above on the fine grid, for every binary S: limbs of 32 bits are split off exactly.
template <class S>
std::optional<WideInstant> later_by(const WideInstant& from, const S& hi, const S&) {
  if (!(hi < detail::power_of_two<S>(61))) return std::nullopt;
  S rest = hi * detail::kTwoMinus32<S> * detail::kTwoMinus32<S>;  // in units of 2^64 s
  std::uint32_t limbs[6] = {};
  for (int i = 5; i >= 0; --i) {
    rest = rest * detail::kTwo32<S>;
    auto limb = static_cast<std::uint64_t>(static_cast<double>(rest));
    // The conversion to double may round up to the next whole number, 2^32 among them.
    if (S(static_cast<double>(limb)) > rest) --limb;
    limbs[i] = static_cast<std::uint32_t>(limb);
    rest = rest - S(static_cast<double>(limb));
  }
  const std::uint64_t fine_added = (static_cast<std::uint64_t>(limbs[1]) << 32) | limbs[0];
  Int128 added = 0;
  for (int i = 5; i >= 2; --i) added = (added << 32) | static_cast<Int128>(limbs[i]);
  WideInstant result;
  result.fine = from.fine + fine_added;
  const Int128 carry = result.fine < fine_added ? 1 : 0;
  result.coarse = instant_from_ticks(ticks(from.coarse) + added + carry);
  if (!in_range(result.coarse)) return std::nullopt;
  return result;
}

/// A duration that a person or a protocol gave in seconds, added to an instant. Nothing when the
/// duration is not finite or the sum is beyond the end of time.
std::optional<Instant> offset_by(const Instant& from, double seconds);

/// `later` - `earlier` in seconds, rounded once.
double seconds_between(const Instant& earlier, const Instant& later);

}  // namespace stoss::engine

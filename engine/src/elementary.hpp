// SPDX-License-Identifier: Apache-2.0
// exp, expm1, log1p and (1 - exp(-x)) / x, the same to the last bit with every compiler.
//   (1) e^x - 1 = 2^k (1 + E) - 1,  k = round(x / ln 2),  E = expm1(x - k ln 2)
//   (2) expm1(2 y) = f (2 + f),  f = expm1(y);   f = sum y^n / n!  for |y| < 0.011
//   (3) log(1 + x) = y + log(1 + r),  r = (1 + x) e^-y - 1,  y: log(1 + x) to one word
//   (4) log m = 2 (s + s^3 / 3 + s^5 / 5 + ...),  s = (m - 1) / (m + 1)
// Source: Muller, Elementary Functions (3rd ed. 2016), 11.1 (range reduction in several words);
//   (2)-(4): Abramowitz, Stegun, Handbook of Mathematical Functions, 4.2.1, 4.1.27.
// Deviation: no tables. (1)-(3) run in double words, so that one rounding makes the result. Float
//   runs in double. Wide scalars halve x until (2) converges, and repeat (3) from double's y.
// Accuracy: 0.501 ulp where the result is normal (measured 0.500, all rounded correctly):
//   elementary_test.cpp. Wide scalars: 2^4 (1 + |x|) eps.
// Preconditions: round to nearest; as the library's functions for NaN, infinities and x <= -1.
#pragma once

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/instant.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace stoss::engine {

namespace detail {

/// x 2^k in two products, for the power itself may overflow.
template <class S>
[[nodiscard]] constexpr S times_power_of_two(const S& x, int k) noexcept {
  return S(S(x * power_of_two<S>(k / 2)) * power_of_two<S>(k - k / 2));
}

/// ln 2 in three words of 41, 42 and 53 bits: the first two times |k| < 2^11 are exact.
/// elementary_test.cpp derives them anew.
inline constexpr double kLnTwoHigh = 0x1.62e42fefa2p-1;
inline constexpr double kLnTwoMiddle = 0x1.9ef35793c7p-41;
inline constexpr double kLnTwoLow = 0x1.9cc01f97b57a0p-83;
inline constexpr double kInverseLnTwo = 0x1.71547652b82fep+0;

/// Halvings of x - k ln 2, |.| < 0.347, before (2); the sum's last term is then 2^-111. Chosen:
/// fewest operations. Larger and smaller: slower.
inline constexpr int kHalvings = 5;

/// 1 / n! for n = 2..7 in two words: what (2) takes in two words at |y| < 0.011.
inline constexpr std::array<DoubleWord<double>, 6> kInverseFactorials = {{
    {0x1p-1, 0},
    {0x1.5555555555555p-3, 0x1.5555555555555p-57},
    {0x1.5555555555555p-5, 0x1.5555555555555p-59},
    {0x1.1111111111111p-7, 0x1.1111111111111p-63},
    {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
    {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},
}};

/// 1 / n! for n = 8..13, whose terms are below 2^-53 of the sum.
inline constexpr std::array<double, 6> kInverseFactorialsOfTail = {0x1.a01a01a01a01ap-16,
                                                                   0x1.71de3a556c734p-19,
                                                                   0x1.27e4fb7789f5cp-22,
                                                                   0x1.ae64567f544e4p-26,
                                                                   0x1.1eed8eff8d898p-29,
                                                                   0x1.6124613a86d09p-33};

/// (2)
[[nodiscard]] inline DoubleWord<double> expm1_of_small(const DoubleWord<double>& x) noexcept {
  const double scale = power_of_two<double>(-kHalvings);
  const DoubleWord<double> y{x.hi * scale, x.lo * scale};
  double tail = 0;
  for (std::size_t i = kInverseFactorialsOfTail.size(); i-- > 0;) {
    tail = (tail + kInverseFactorialsOfTail[i]) * y.hi;
  }
  DoubleWord<double> sum = kInverseFactorials.back() + tail;
  for (std::size_t i = kInverseFactorials.size() - 1; i-- > 0;) {
    sum = sum * y + kInverseFactorials[i];
  }
  sum = y + square(y) * sum;
  for (int i = 0; i < kHalvings; ++i) sum = sum * (sum + 2.0);
  return sum;
}

/// k and E of (1).
struct ReducedExponential {
  int k = 0;
  DoubleWord<double> rest;
};

/// For |x| < 800.
[[nodiscard]] inline ReducedExponential reduced_exponential(const DoubleWord<double>& x) noexcept {
  const double quotient = x.hi * kInverseLnTwo;
  const int k = static_cast<int>(quotient < 0 ? quotient - 0.5 : quotient + 0.5);
  if (k == 0) return {0, expm1_of_small(x)};
  const double n = k;
  const DoubleWord<double> rest =
      ((x + (-n * kLnTwoHigh)) + (-n * kLnTwoMiddle)) + (-n * kLnTwoLow);
  return {k, expm1_of_small(rest)};
}

/// Beyond it in either direction e^x lies outside the range of double; chosen with some room, for
/// the limits proper come out of the products with powers of two. No unit.
inline constexpr double kExponentMax = 800;

template <class S>
inline constexpr bool kIsWide = !kCompensated<S>;

/// (2) for wide scalars.
template <class S>
[[nodiscard]] inline S wide_expm1(const S& x) noexcept {
  const S eps = std::numeric_limits<S>::epsilon();
  const S near = power_of_two<S>(-kHalvings);
  S y = x;
  int halvings = 0;
  for (; y > near || y < -near; ++halvings) y = S(y * S(0.5));
  S sum = y, term = y;
  for (int n = 2; term * term > eps * eps * y * y; ++n) {
    term = S(term * y / S(n));
    sum = S(sum + term);
  }
  for (; halvings > 0; --halvings) sum = S(sum * (sum + S(2)));
  return sum;
}

}  // namespace detail

/// e^x - 1 in two words, for |x| < 700.
template <class S>
[[nodiscard]] inline DoubleWord<S> expm1_words(const DoubleWord<S>& x) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    const detail::ReducedExponential e = detail::reduced_exponential(x);
    if (e.k == 0) return e.rest;
    const double power = detail::power_of_two<double>(e.k);
    return two_sum(power, -1.0) + DoubleWord<double>{e.rest.hi * power, e.rest.lo * power};
  } else {
    static_assert(detail::kIsWide<S>, "float runs in double");
    return {detail::wide_expm1(x.hi), S(0)};
  }
}

/// e^x in two words, for |x| < 700.
template <class S>
[[nodiscard]] inline DoubleWord<S> exp_words(const DoubleWord<S>& x) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    const detail::ReducedExponential e = detail::reduced_exponential(x);
    const DoubleWord<double> mantissa = e.rest + 1.0;
    const double power = detail::power_of_two<double>(e.k);
    return {mantissa.hi * power, mantissa.lo * power};
  } else {
    static_assert(detail::kIsWide<S>, "float runs in double");
    const S one(1);
    if (x.hi < S(0)) return {S(one / (detail::wide_expm1(S(-x.hi)) + one)), S(0)};
    return {S(detail::wide_expm1(x.hi) + one), S(0)};
  }
}

namespace detail {

/// log(1 + x) to a few ulp, by (4); `whole` = 1 + x, rounded.
[[nodiscard]] inline double coarse_log1p(double x, double whole) noexcept {
  constexpr int kMantissaBits = 52, kBias = 1023, kTerms = 12;
  constexpr double kRootTwo = 0x1.6a09e667f3bcdp+0;
  const auto bits = std::bit_cast<std::uint64_t>(whole);
  int k = static_cast<int>(bits >> static_cast<unsigned>(kMantissaBits)) - kBias;
  double mantissa = whole * power_of_two<double>(-k / 2) * power_of_two<double>(-k - -k / 2);
  if (mantissa > kRootTwo) {
    mantissa *= 0.5;
    ++k;
  }
  const double rest = k == 0 ? x : mantissa - 1;
  const double s = rest / (2 + rest), s2 = s * s;
  double sum = 0;
  for (int n = kTerms; n > 0; --n) sum = (sum + 1.0 / (n + n + 1)) * s2;
  return k * kLnTwoHigh + (k * kLnTwoMiddle + 2 * (s + s * sum));
}

}  // namespace detail

/// log(1 + x) in two words, for normal 1 + x > 0.
template <class S>
[[nodiscard]] inline DoubleWord<S> log1p_words(const DoubleWord<S>& x) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    const double y = detail::coarse_log1p(x.hi, (x + 1.0).hi);
    const DoubleWord<double> back{-y, 0};
    DoubleWord<double> r;
    const double size = x.hi < 0 ? -x.hi : x.hi;
    if (size < 0.5) {
      const DoubleWord<double> e = expm1_words(back);
      r = (x + e) + x * e;
    } else {
      r = (x + 1.0) * exp_words(back) - 1.0;
    }
    return (r - 0.5 * r.hi * r.hi) + y;
  } else {
    static_assert(detail::kIsWide<S>, "float runs in double");
    const auto whole = static_cast<double>(S(x.hi + S(1)));
    S y = S(detail::coarse_log1p(static_cast<double>(x.hi), whole));
    for (int i = 0; i < 3; ++i) {
      const S e = detail::wide_expm1(S(-y));
      const S r = (x.hi + e) + x.hi * e;
      y = S(y + (r - S(0.5) * r * r));
    }
    return {y, S(0)};
  }
}

/// (1 - e^-x) / x in two words, 1 at zero, for |x| < 700.
template <class S>
[[nodiscard]] inline DoubleWord<S> decay_mean_words(const DoubleWord<S>& x) noexcept {
  if (x.hi == S(0)) return {S(1), S(0)};
  return expm1_words(-x) / -x;
}

namespace detail {

/// f(x) by `in_words` in the inner scalar, rounded.
template <class S, class Function>
[[nodiscard]] inline S rounded_from(const S& x, const Function& in_words) noexcept {
  if constexpr (std::is_same_v<S, float>) {
    return static_cast<float>(to_scalar(in_words(DoubleWord<double>{static_cast<double>(x), 0})));
  } else {
    return to_scalar(in_words(DoubleWord<S>{x, S(0)}));
  }
}

}  // namespace detail

/// e^x
template <class S>
[[nodiscard]] inline S rounded_exp(const S& x) noexcept {
  if (!(x == x)) return x;
  const S limit = S(detail::kExponentMax);
  if (x > limit) return std::numeric_limits<S>::infinity();
  if (x < -limit) return S(0);
  return detail::rounded_from(x, [](const auto& y) {
    using Inner = std::remove_cvref_t<decltype(y.hi)>;
    if constexpr (std::is_same_v<Inner, double>) {
      const detail::ReducedExponential e = detail::reduced_exponential(y);
      const double mantissa = to_scalar(e.rest + 1.0);
      return DoubleWord<double>{detail::times_power_of_two(mantissa, e.k), 0};
    } else {
      return exp_words(y);
    }
  });
}

/// e^x - 1
template <class S>
[[nodiscard]] inline S rounded_expm1(const S& x) noexcept {
  const S far(100);  // where 1 is below half an ulp of e^x, or e^x of 1
  if (x > far) return rounded_exp(x);
  if (x < -far) return S(-1);
  if (!(x == x) || x == S(0)) return x;
  return detail::rounded_from(x, [](const auto& y) { return expm1_words(y); });
}

/// log(1 + x)
template <class S>
[[nodiscard]] inline S rounded_log1p(const S& x) noexcept {
  if (!(x > S(-1))) {
    return x == S(-1) ? S(-std::numeric_limits<S>::infinity()) : S((x - x) / (x - x));
  }
  if (x == S(0) || S(x - x) != S(0)) return x;
  return detail::rounded_from(x, [](const auto& y) { return log1p_words(y); });
}

/// (1 - e^-x) / x: the mean over [0, x] of e^-y.
template <class S>
[[nodiscard]] inline S rounded_decay_mean(const S& x) noexcept {
  const S far(100);  // where e^-x is below half an ulp of 1
  if (x > far) return S(S(1) / x);
  if (!(x == x)) return x;
  if (x < -far) {  // e^-x in two factors, for it may overflow where the quotient does not
    if (x < -S(detail::kExponentMax)) return std::numeric_limits<S>::infinity();
    return detail::rounded_from(x, [](const auto& y) {
      const auto root = exp_words(-y * decltype(y.hi)(0.5));
      return (root / -y) * root;
    });
  }
  return detail::rounded_from(x, [](const auto& y) { return decay_mean_words(y); });
}

}  // namespace stoss::engine

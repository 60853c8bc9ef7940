// SPDX-License-Identifier: Apache-2.0
// How far a body has come at an instant, under linear drag.
//   (1) x(t) = p + v s + a f,  u(t) = v l + a s    p [m], v [m/s]: at t = 0; a [m/s^2]: what pulls
//       l = e^(-m t),  s = (1 - l) / m,  f = (t - s) / m          m: rate of the drag [1/s]; t [s]
//   (2) (t - s) / m = t^2 (1/2! - y/3! + y^2/4! - ...),  y = m t
// Source: elementary: u' = -m u + a.
// Deviation: l and s from elementary.hpp; f by (2) where it cancels; l is taken for zero beyond
//   kSpent. Float runs in double.
// Accuracy: s to 2^-103 of itself, l to 2^-105 of 1, f to 2^-93 of itself:
// contact_time/drag_curve_test.cpp. Preconditions: m > 0.
#pragma once

#include "contact_time/accelerated.hpp"
#include "elementary.hpp"
#include "stoss/engine/double_word.hpp"

#include <cstddef>
#include <type_traits>

namespace stoss::engine::detail {

/// e^-y may be taken for zero from here on. Derived: below 2^-1000. No unit.
inline constexpr double kSpent = 700;

/// Below it (y - 1 + e^-y) / y^2 cancels too much to be formed as it stands. Chosen; no unit.
/// Larger: the series needs more terms; smaller: it loses more than 2^-90.
inline constexpr double kSlightDrag = 0x1p-10;

/// (2) without its t^2, in two words, for |y| < kSlightDrag.
template <class S>
[[nodiscard]] inline DoubleWord<S> fall_mean_of_slight(const DoubleWord<S>& y) noexcept {
  S tail(0);
  for (std::size_t i = kInverseFactorialsOfTail.size(); i-- > 0;) {
    tail = S(kInverseFactorialsOfTail[i]) - tail * y.hi;
  }
  DoubleWord<S> sum{tail, S(0)};
  for (std::size_t i = kInverseFactorials.size(); i-- > 0;) {
    const DoubleWord<S> term{S(kInverseFactorials[i].hi), S(kInverseFactorials[i].lo)};
    sum = term - sum * y;
  }
  return sum;
}

/// The durations of (1), and what is left of the speed.
template <class S>
struct DragClock {
  DoubleWord<S> run;   ///< s
  DoubleWord<S> fall;  ///< f
  DoubleWord<S> left;  ///< l
};

/// At `t`; further back than kSpent / m as it was half that far.
template <class S>
[[nodiscard]] inline DragClock<S> drag_clock(const DoubleWord<S>& t, const S& rate) noexcept {
  const DoubleWord<S> y = t * rate;
  if (!(y.hi < S(kSpent))) {
    const DoubleWord<S> end = S(1) / DoubleWord<S>{rate, S(0)};
    return {end, (t - end) * end, {}};
  }
  if (y.hi < S(-kSpent)) return drag_clock(DoubleWord<S>{S(-kSpent / 2) / rate, S(0)}, rate);
  const DoubleWord<S> spent = expm1_words(-y);
  const DoubleWord<S> run = y.hi == S(0) ? t : spent / -rate;
  const DoubleWord<S> fall =
      magnitude(y.hi) < S(kSlightDrag) ? square(t) * fall_mean_of_slight(y) : (t - run) / rate;
  return {run, fall, spent + S(1)};
}

/// In the words of the scalar that motions are stored in.
template <class S>
[[nodiscard]] inline DoubleWord<S> stored_words(const DoubleWord<Inner<S>>& x) noexcept {
  if constexpr (std::is_same_v<S, Inner<S>>) {
    return x;
  } else {
    const S hi = static_cast<S>(x.hi);
    return two_sum(hi, static_cast<S>((x.hi - static_cast<Inner<S>>(hi)) + x.lo));
  }
}

}  // namespace stoss::engine::detail

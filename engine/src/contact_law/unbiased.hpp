// SPDX-License-Identifier: Apache-2.0
// The double-word operations of a contact law, with errors that have no sign.
//   (1) p . p and y m in three words           p: a contact vector [m]; m: a sum of masses [kg]
//   (2) x / y = q + (x - q y) / y.hi           q = RN(x / y); RN(x.hi / y.hi) will not do
// Source: Joldes, Muller, Popescu, ACM TOMS 44 (2017) 15res, and the next terms of its expansions.
// Deviation: square() drops lo lo, and operator/ drops a part whose mean is -(y.lo / y.hi)^2 of the
//   quotient. Both are squares: they err to one side, by 0.1 to 0.35 u^2, and every contact adds
//   its own (u = 2^-53 in double). With the q of (2) the dropped part is y.lo (x - q y), of either
//   sign alike, as are roundings to nearest of what differs from contact to contact. A wall's
//   normal does not differ, nor do two masses: hence the third words, for a rounded square or sum
//   would err to the same side each time. They must reach a sum with all its words, before it is
//   rounded: added to a rounded word they are lost, for it is that coarse.
// Accuracy: (1) to 16 u^3, (2) to 6 u^2; the mean over 10^6 quotients is known to 0.0004 u^2 and
//   within four standard errors of zero: tests/engine/contact_law/unbiased_test.cpp.
// Preconditions: normalised words, y != 0, products that neither overflow nor underflow.
#pragma once

#include "stoss/engine/double_word.hpp"

namespace stoss::engine::detail {

/// The value hi + lo + third, each at most half an ulp of the one before.
template <class S>
struct TripleWord {
  S hi{};
  S lo{};
  S third{};

  [[nodiscard]] constexpr DoubleWord<S> two_words() const noexcept { return {hi, lo}; }
};

/// (1)
template <class S>
[[nodiscard, gnu::always_inline]] inline TripleWord<S> square_norm_in_three_words(
    const DoubleWord2<S>& p) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> x2 = two_prod(p.x.hi, p.x.hi), y2 = two_prod(p.y.hi, p.y.hi);
    const DoubleWord<S> x_mixed = two_prod(p.x.hi, p.x.lo), y_mixed = two_prod(p.y.hi, p.y.lo);
    const DoubleWord<S> high = two_sum(x2.hi, y2.hi);
    const DoubleWord<S> errors = two_sum(x2.lo, y2.lo);
    const DoubleWord<S> mixed = two_sum(x_mixed.hi, y_mixed.hi);
    const DoubleWord<S> middle = two_sum(errors.hi, mixed.hi + mixed.hi);
    const DoubleWord<S> second = two_sum(high.lo, middle.hi);
    const S mixed_low = mixed.lo + (x_mixed.lo + y_mixed.lo);
    const S lows = p.x.lo * p.x.lo + p.y.lo * p.y.lo;
    const S third = ((errors.lo + middle.lo) + second.lo) + ((mixed_low + mixed_low) + lows);
    const DoubleWord<S> sum = quick_two_sum(high.hi, second.hi);
    const DoubleWord<S> rest = two_sum(sum.lo, third);
    return {sum.hi, rest.hi, rest.lo};
  } else {
    return {square_norm(p).hi, S(0), S(0)};
  }
}

/// (1)
template <class S>
[[nodiscard, gnu::always_inline]] inline TripleWord<S> product_in_three_words(
    const TripleWord<S>& x, const DoubleWord<S>& m) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> high = two_prod(x.hi, m.hi);
    const DoubleWord<S> mixed = two_prod(x.lo, m.hi);
    const DoubleWord<S> other = m.lo == S(0) ? DoubleWord<S>{S(0), S(0)} : two_prod(x.hi, m.lo);
    const DoubleWord<S> both = two_sum(mixed.hi, other.hi);
    const DoubleWord<S> second = two_sum(high.lo, both.hi);
    const S third =
        (second.lo + both.lo) + (((mixed.lo + other.lo) + x.third * m.hi) + x.lo * m.lo);
    const DoubleWord<S> sum = quick_two_sum(high.hi, second.hi);
    const DoubleWord<S> rest = two_sum(sum.lo, third);
    return {sum.hi, rest.hi, rest.lo};
  } else {
    return {S(x.hi * m.hi), S(0), S(0)};
  }
}

/// (2)
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> unbiased_quotient(
    const DoubleWord<S>& x, const TripleWord<S>& y) noexcept {
  if constexpr (kCompensated<S>) {
    const S inverse = S(1) / y.hi;
    const S guess = x.hi * inverse;
    const DoubleWord<S> high_product = two_prod(guess, y.hi);
    const DoubleWord<S> low_product = two_prod(guess, y.lo);
    const DoubleWord<S> high = two_sum(x.hi - high_product.hi, -high_product.lo);
    const DoubleWord<S> low = two_sum(x.lo, -low_product.hi);
    const S quotient = guess + (high.hi + low.hi) * inverse;
    const S step = quotient - guess;
    const DoubleWord<S> rest = two_sum(high.hi - step * y.hi, low.hi);
    const S tail =
        (rest.lo + (high.lo + low.lo)) - (low_product.lo + (step * y.lo + quotient * y.third));
    return quick_two_sum(quotient, (rest.hi + tail) * inverse);
  } else {
    return {S(x.hi / y.hi), S(0)};
  }
}

}  // namespace stoss::engine::detail

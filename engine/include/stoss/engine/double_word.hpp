// SPDX-License-Identifier: Apache-2.0
// Double-word arithmetic: a number kept as the unevaluated sum of two floating-point words.
//   (1) two_sum:  hi = RN(a + b),  hi + lo = a + b  exactly
//   (2) two_prod: hi = RN(a * b),  hi + lo = a * b  exactly
//   (3) x = hi + lo, |lo| <= ulp(hi) / 2;  u = 2^-53 (double), 2^-24 (float)
// RN rounds to nearest, ties to even. Quantities carry whatever unit the caller gives them.
// Source: Dekker, Numer. Math. 18 (1971) 224 (splitting, (2)); Knuth, TAOCP 2, 4.2.2 (1); Joldes,
//   Muller, Popescu, ACM TOMS 44 (2017) 15res, algorithms 4, 6, 8, 11, 17 (sum, product, quotient).
// Deviation: one instruction sequence for every target. A fused multiply-add stands in (2) alone,
//   where the splitting gives the same two words, so builds with and without FMA agree in each bit.
//   Types wider than double carry no low word: every operation is the plain one and lo stays zero.
//   The x and y of a vector of doubles go through it side by side, in two lanes of one register.
// Speed: sums and products are always inlined. Left as calls, as GCC leaves them, they pass every
//   word through memory.
// Accuracy: relative error of + - * / sqrt at most 3, 3, 7, 15, 8 u^2; tests/engine/
//   double_word_test.cpp measures each against 400 bits.
// Preconditions: round to nearest, no -ffast-math, no excess precision, operands normalised as (3).
#pragma once

#include <cfloat>
#include <cmath>
#include <limits>
#include <type_traits>

#if defined(__FAST_MATH__)
#error "double-word arithmetic is void under -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "double-word arithmetic needs every operation rounded once");

namespace stoss::engine {

/// True for the scalars whose rounding errors are carried along (float and double). For all other,
/// wider types the same source compiles to the plain formulas.
template <class S>
inline constexpr bool kCompensated = false;
template <>
inline constexpr bool kCompensated<float> = true;
template <>
inline constexpr bool kCompensated<double> = true;

/// Two doubles side by side, for the x and the y of a vector: the formulas below take them for one
/// scalar. Each lane is rounded as a double by itself is. For double alone: where GCC 12 vectorises
/// what it narrows to float, it loses the low words.
using TwoLanes = double __attribute__((vector_size(16)));
template <>
inline constexpr bool kCompensated<TwoLanes> = true;

/// The value hi + lo; |lo| <= ulp(hi) / 2.
template <class S>
struct DoubleWord {
  S hi{};
  S lo{};
};

/// A vector of double words.
template <class S>
struct DoubleWord2 {
  DoubleWord<S> x, y;
};

/// a + b and its rounding error, exactly. 6 operations (Knuth).
template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> two_sum(const S& a, const S& b) noexcept {
  if constexpr (kCompensated<S>) {
    const S sum = a + b;
    const S from_b = sum - a;
    return {sum, (a - (sum - from_b)) + (b - from_b)};
  } else {
    return {S(a + b), S(0)};
  }
}

/// The same for |a| >= |b| or a = 0, in 3 operations (Dekker).
template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> quick_two_sum(const S& a,
                                                                        const S& b) noexcept {
  if constexpr (kCompensated<S>) {
    const S sum = a + b;
    return {sum, b - (sum - a)};
  } else {
    return {S(a + b), S(0)};
  }
}

namespace detail {

/// Dekker's product. Exact where neither the splitting overflows nor the error underflows.
[[nodiscard]] constexpr DoubleWord<double> two_prod_by_splitting(double a, double b) noexcept {
  constexpr double kSplitter = 0x1p27 + 1;  // cuts 53 bits into 26 + 26 and a sign (Veltkamp)
  const double product = a * b;
  const double a_scaled = kSplitter * a;
  const double a_hi = a_scaled - (a_scaled - a);
  const double a_lo = a - a_hi;
  const double b_scaled = kSplitter * b;
  const double b_hi = b_scaled - (b_scaled - b);
  const double b_lo = b - b_hi;
  return {product, (((a_hi * b_hi - product) + a_hi * b_lo) + a_lo * b_hi) + a_lo * b_lo};
}

#if defined(__FMA__) || defined(FP_FAST_FMA) || defined(__ARM_FEATURE_FMA)
[[nodiscard, gnu::always_inline]] inline DoubleWord<double> two_prod_double(double a,
                                                                            double b) noexcept {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}
#else
[[nodiscard]] inline DoubleWord<double> two_prod_double(double a, double b) noexcept {
  // Chosen: far from the ends of the range (2^-969 and 2^996), at no cost in any real scene.
  constexpr double kSmall = 0x1p-900;
  constexpr double kLarge = 0x1p900;
  const double product = a * b;
  const double size = std::fabs(product);
  if (size > kSmall && size < kLarge && std::fabs(a) < kLarge && std::fabs(b) < kLarge) [[likely]] {
    return two_prod_by_splitting(a, b);
  }
  if (product == 0 && (a == 0 || b == 0)) return {product, 0.0};
  return {product, std::fma(a, b, -product)};
}
#endif

[[nodiscard, gnu::always_inline]] inline DoubleWord<TwoLanes> two_prod_lanes(
    const TwoLanes& a, const TwoLanes& b) noexcept {
  const DoubleWord<double> first = two_prod_double(a[0], b[0]);
  const DoubleWord<double> second = two_prod_double(a[1], b[1]);
  return {TwoLanes{first.hi, second.hi}, TwoLanes{first.lo, second.lo}};
}

/// x and y of a vector as one double word of two lanes, and back.
[[nodiscard, gnu::always_inline]] inline DoubleWord<TwoLanes> side_by_side(
    const DoubleWord<double>& x, const DoubleWord<double>& y) noexcept {
  return {TwoLanes{x.hi, y.hi}, TwoLanes{x.lo, y.lo}};
}
[[nodiscard, gnu::always_inline]] inline DoubleWord<TwoLanes> side_by_side(
    const DoubleWord2<double>& a) noexcept {
  return side_by_side(a.x, a.y);
}
[[nodiscard, gnu::always_inline]] inline DoubleWord2<double> from_lanes(
    const DoubleWord<TwoLanes>& a) noexcept {
  return {{a.hi[0], a.lo[0]}, {a.hi[1], a.lo[1]}};
}

}  // namespace detail

/// a * b and its rounding error; exact unless the error underflows, and then rounded once.
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> two_prod(const S& a, const S& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    return detail::two_prod_double(a, b);
  } else if constexpr (std::is_same_v<S, TwoLanes>) {
    return detail::two_prod_lanes(a, b);
  } else if constexpr (std::is_same_v<S, float>) {
    const double exact = static_cast<double>(a) * static_cast<double>(b);  // 48 bits fit into 53
    // Not static_cast<float>(exact), which is the same number: where GCC 12 vectorises, it takes
    // that number widened again for `exact` itself, and the error comes out as zero.
    const float product = a * b;
    return {product, static_cast<float>(exact - static_cast<double>(product))};
  } else {
    return {S(a * b), S(0)};
  }
}

/// The nearest scalar.
template <class S>
[[nodiscard]] constexpr S to_scalar(const DoubleWord<S>& x) noexcept {
  return x.hi + x.lo;
}

/// -1, 0 or 1. NaN gives 0.
template <class S>
[[nodiscard]] constexpr int sign(const DoubleWord<S>& x) noexcept {
  const S zero(0);
  if (x.hi > zero) return 1;
  if (x.hi < zero) return -1;
  return x.lo > zero ? 1 : (x.lo < zero ? -1 : 0);
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator-(
    const DoubleWord<S>& x) noexcept {
  if constexpr (kCompensated<S>) {
    return {-x.hi, -x.lo};
  } else {
    return {S(-x.hi), S(0)};
  }
}

/// Algorithm 6 (AccurateDWPlusDW), error <= 3 u^2 even under cancellation.
template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator+(
    const DoubleWord<S>& x, const DoubleWord<S>& y) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> high = two_sum(x.hi, y.hi);
    const DoubleWord<S> low = two_sum(x.lo, y.lo);
    const DoubleWord<S> sum = quick_two_sum(high.hi, high.lo + low.hi);
    return quick_two_sum(sum.hi, low.lo + sum.lo);
  } else {
    return {S(x.hi + y.hi), S(0)};
  }
}

/// Algorithm 4 (DWPlusFP), error <= 2 u^2.
template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator+(
    const DoubleWord<S>& x, const std::type_identity_t<S>& y) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> high = two_sum(x.hi, y);
    return quick_two_sum(high.hi, x.lo + high.lo);
  } else {
    return {S(x.hi + y), S(0)};
  }
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator+(
    const std::type_identity_t<S>& x, const DoubleWord<S>& y) noexcept {
  return y + x;
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator-(
    const DoubleWord<S>& x, const DoubleWord<S>& y) noexcept {
  return x + (-y);
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator-(
    const DoubleWord<S>& x, const std::type_identity_t<S>& y) noexcept {
  return x + S(-y);
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord<S> operator-(
    const std::type_identity_t<S>& x, const DoubleWord<S>& y) noexcept {
  return (-y) + x;
}

/// Algorithm 11 (DWTimesDW1) without its fused steps, error <= 7 u^2.
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> operator*(const DoubleWord<S>& x,
                                                                 const DoubleWord<S>& y) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> high = two_prod(x.hi, y.hi);
    return quick_two_sum(high.hi, high.lo + (x.hi * y.lo + x.lo * y.hi));
  } else {
    return {S(x.hi * y.hi), S(0)};
  }
}

/// Algorithm 8 (DWTimesFP2), error <= 3 u^2.
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> operator*(
    const DoubleWord<S>& x, const std::type_identity_t<S>& y) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> high = two_prod(x.hi, y);
    return quick_two_sum(high.hi, high.lo + x.lo * y);
  } else {
    return {S(x.hi * y), S(0)};
  }
}

template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> operator*(const std::type_identity_t<S>& x,
                                                                 const DoubleWord<S>& y) noexcept {
  return y * x;
}

/// Algorithm 17 (DWDivDW2), error <= 15 u^2.
template <class S>
[[nodiscard]] inline DoubleWord<S> operator/(const DoubleWord<S>& x,
                                             const DoubleWord<S>& y) noexcept {
  if constexpr (kCompensated<S>) {
    const S quotient = x.hi / y.hi;
    const DoubleWord<S> product = y * quotient;
    const S rest = (x.hi - product.hi) + (x.lo - product.lo);
    return quick_two_sum(quotient, rest / y.hi);
  } else {
    return {S(x.hi / y.hi), S(0)};
  }
}

template <class S>
[[nodiscard]] inline DoubleWord<S> operator/(const DoubleWord<S>& x,
                                             const std::type_identity_t<S>& y) noexcept {
  return x / DoubleWord<S>{y, S(0)};
}

template <class S>
[[nodiscard]] inline DoubleWord<S> operator/(const std::type_identity_t<S>& x,
                                             const DoubleWord<S>& y) noexcept {
  return DoubleWord<S>{x, S(0)} / y;
}

/// x * x, error <= 5 u^2.
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> square(const DoubleWord<S>& x) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> high = two_prod(x.hi, x.hi);
    const S mixed = x.hi * x.lo;
    return quick_two_sum(high.hi, high.lo + (mixed + mixed));
  } else {
    return {S(x.hi * x.hi), S(0)};
  }
}

/// Square root by one Newton step on the rounded root; NaN below zero.
template <class S>
[[nodiscard]] inline DoubleWord<S> sqrt(const DoubleWord<S>& x) noexcept {
  using std::sqrt;
  const S root = sqrt(x.hi);
  if constexpr (kCompensated<S>) {
    if (x.hi == S(0)) return {root, S(0)};
    const DoubleWord<S> power = two_prod(root, root);
    const S rest = ((x.hi - power.hi) - power.lo) + x.lo;
    return quick_two_sum(root, rest / (root + root));
  } else {
    return {root, S(0)};
  }
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr DoubleWord2<S> operator-(
    const DoubleWord2<S>& a) noexcept {
  return {-a.x, -a.y};
}

template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord2<S> operator+(
    const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    return detail::from_lanes(detail::side_by_side(a) + detail::side_by_side(b));
  } else {
    return {a.x + b.x, a.y + b.y};
  }
}

template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord2<S> operator-(
    const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    return detail::from_lanes(detail::side_by_side(a) - detail::side_by_side(b));
  } else {
    return {a.x - b.x, a.y - b.y};
  }
}

/// The vector times a scalar.
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord2<S> operator*(
    const DoubleWord2<S>& a, const std::type_identity_t<S>& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    return detail::from_lanes(detail::side_by_side(a) * TwoLanes{b, b});
  } else {
    return {a.x * b, a.y * b};
  }
}

/// The vector times a double word.
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord2<S> operator*(const DoubleWord2<S>& a,
                                                                  const DoubleWord<S>& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    return detail::from_lanes(detail::side_by_side(a) * detail::side_by_side(b, b));
  } else {
    return {a.x * b, a.y * b};
  }
}

/// a.x b.x + a.y b.y
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> dot(const DoubleWord2<S>& a,
                                                           const DoubleWord2<S>& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    const DoubleWord2<S> products =
        detail::from_lanes(detail::side_by_side(a) * detail::side_by_side(b));
    return products.x + products.y;
  } else {
    return a.x * b.x + a.y * b.y;
  }
}

/// a.x b.y - a.y b.x
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> cross(const DoubleWord2<S>& a,
                                                             const DoubleWord2<S>& b) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    const DoubleWord2<S> products =
        detail::from_lanes(detail::side_by_side(a) * detail::side_by_side(b.y, b.x));
    return products.x - products.y;
  } else {
    return a.x * b.y - a.y * b.x;
  }
}

/// |a|^2
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord<S> square_norm(
    const DoubleWord2<S>& a) noexcept {
  if constexpr (std::is_same_v<S, double>) {
    const DoubleWord2<S> products = detail::from_lanes(square(detail::side_by_side(a)));
    return products.x + products.y;
  } else {
    return square(a.x) + square(a.y);
  }
}

namespace detail {

/// a b + c e rounded to one word; error <= u |result| + 8 u^2 (|a b| + |c e|), a third of the work
/// of the double-word operators.
template <class S>
[[nodiscard, gnu::always_inline]] inline S rounded_sum_of_products(
    const DoubleWord<S>& a,
    const DoubleWord<S>& b,
    const DoubleWord<S>& c,
    const DoubleWord<S>& e) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord<S> first = two_prod(a.hi, b.hi);
    const DoubleWord<S> second = two_prod(c.hi, e.hi);
    const DoubleWord<S> high = two_sum(first.hi, second.hi);
    const S mixed = (a.hi * b.lo + a.lo * b.hi) + (c.hi * e.lo + c.lo * e.hi);
    return high.hi + (high.lo + ((first.lo + second.lo) + mixed));
  } else {
    return S(a.hi * b.hi + c.hi * e.hi);
  }
}

/// A sum that is exact but for its third word: for the rare differences that cancel to less than
/// double words resolve. Error <= u |sum| + 40 u^3 sum |terms| (Ogita, Rump, Oishi, SIAM J. Sci.
/// Comput. 26 (2005) 1955, SumK with K = 3).
template <class S>
class LongSum {
 public:
  constexpr void add(const S& term) noexcept {
    const DoubleWord<S> high = two_sum(high_, term);
    const DoubleWord<S> middle = two_sum(middle_, high.lo);
    high_ = high.hi;
    middle_ = middle.hi;
    low_ = S(low_ + middle.lo);
  }

  constexpr void add(const DoubleWord<S>& term) noexcept {
    add(term.hi);
    add(term.lo);
  }

  /// Adds x y.
  void add_product(const DoubleWord<S>& x, const DoubleWord<S>& y) noexcept {
    add(two_prod(x.hi, y.hi));
    if (x.lo == S(0) && y.lo == S(0)) return;
    add(two_prod(x.hi, y.lo));
    add(two_prod(x.lo, y.hi));
    add(two_prod(x.lo, y.lo));
  }

  [[nodiscard]] constexpr DoubleWord<S> two_words() const noexcept {
    const DoubleWord<S> high = two_sum(high_, middle_);
    return quick_two_sum(high.hi, S(high.lo + low_));
  }

 private:
  S high_{};
  S middle_{};
  S low_{};
};

/// Below this share of its terms a difference of double words is formed anew with a third word:
/// 2^8 eps, where the 2^-103 that double words lose are 2^-6 ulp of what is left. No unit; derived.
/// Larger: slower; smaller: gaps of 1e-17 d lose bits (the families near touching).
inline constexpr int kThirdWordShare = 256;

}  // namespace detail

/// dot(a, b) rounded to one word, see detail::rounded_sum_of_products.
template <class S>
[[nodiscard]] inline S rounded_dot(const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  return detail::rounded_sum_of_products(a.x, b.x, a.y, b.y);
}

/// cross(a, b) rounded to one word, see detail::rounded_sum_of_products.
template <class S>
[[nodiscard]] inline S rounded_cross(const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  return detail::rounded_sum_of_products(a.x, b.y, -a.y, b.x);
}

}  // namespace stoss::engine

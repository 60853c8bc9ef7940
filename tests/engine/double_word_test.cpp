// SPDX-License-Identifier: Apache-2.0
// The double-word operations against 400 bits: exactness of the sums and products, and the relative
// error bounds that double_word.hpp states, in units of u^2.
#include "stoss/engine/double_word.hpp"

#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

namespace stoss::engine {
namespace {

using test::Random;
using test::Real;

template <class S>
S random_scalar(Random& random, int exponents) {
  const double significand = random.either_sign(random.uniform(1, 2));
  const int exponent = static_cast<int>(random.uniform(-exponents, exponents));
  return static_cast<S>(std::ldexp(significand, exponent));
}

/// A normalised double word, its low word anywhere down to 2^-20 ulp.
template <class S>
DoubleWord<S> random_double_word(Random& random, int exponents) {
  const S hi = random_scalar<S>(random, exponents);
  const double half_ulp = static_cast<double>(std::fabs(hi)) *
                          static_cast<double>(std::numeric_limits<S>::epsilon()) / 4;
  const double lo = random.either_sign(half_ulp * random.uniform(0, 1) * random.decades(-6, 0));
  return quick_two_sum(hi, static_cast<S>(lo));
}

template <class S>
class DoubleWordOf : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(DoubleWordOf, Scalars);

TYPED_TEST(DoubleWordOf, SumsAndProductsAreExact) {
  using S = TypeParam;
  Random random(test::seed_of_run());
  const int exponents = std::numeric_limits<S>::max_exponent / 4;
  int wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const S a = random_scalar<S>(random, exponents), b = random_scalar<S>(random, exponents);
    const DoubleWord<S> sum = two_sum(a, b), product = two_prod(a, b);
    if (test::exact(sum) != Real(a) + Real(b) || sum.hi != a + b) ++wrong;
    if (test::exact(product) != Real(a) * Real(b) || product.hi != a * b) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
}

/// The worst relative error of an operation in units of u^2.
template <class S, class Operation, class Truth>
double worst_error(const Operation& operation, const Truth& truth, bool positive) {
  Random random(test::seed_of_run());
  const Real u = Real(std::numeric_limits<S>::epsilon()) / 2;
  Real worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const int exponents = i % 2 == 0 ? 2 : 20;
    DoubleWord<S> x = random_double_word<S>(random, exponents);
    DoubleWord<S> y = random_double_word<S>(random, exponents);
    if (i % 8 == 4) y = {-x.hi, random_double_word<S>(random, 2).lo * x.hi / 8};  // cancels
    y = quick_two_sum(y.hi, y.lo);
    if (positive && x.hi < 0) x = -x;
    const Real wanted = truth(test::exact(x), test::exact(y));
    if (wanted == 0) continue;
    worst = std::max(worst, Real(abs((test::exact(operation(x, y)) - wanted) / wanted)));
  }
  return Real(worst / (u * u)).template convert_to<double>();
}

TYPED_TEST(DoubleWordOf, OperationsKeepTheirErrorBounds) {
  using S = TypeParam;
  using Word = DoubleWord<S>;
  const auto check = [](const char* name, double worst, double bound) {
    std::printf("%zu-byte %-10s %.2f u^2 (bound %g)\n", sizeof(S), name, worst, bound);
    EXPECT_LE(worst, bound) << name;
  };
  check("sum",
        worst_error<S>([](const Word& x, const Word& y) { return x + y; },
                       [](const Real& x, const Real& y) { return Real(x + y); },
                       false),
        3.1);
  check("difference",
        worst_error<S>([](const Word& x, const Word& y) { return x - y; },
                       [](const Real& x, const Real& y) { return Real(x - y); },
                       false),
        3.1);
  check("product",
        worst_error<S>([](const Word& x, const Word& y) { return x * y; },
                       [](const Real& x, const Real& y) { return Real(x * y); },
                       false),
        7);
  check("times one",
        worst_error<S>([](const Word& x, const Word& y) { return x * y.hi; },
                       [](const Real& x, const Real& y) {
                         return Real(x * Real(static_cast<S>(y.template convert_to<S>())));
                       },
                       false),
        3);
  check("quotient",
        worst_error<S>([](const Word& x, const Word& y) { return x / y; },
                       [](const Real& x, const Real& y) { return Real(x / y); },
                       false),
        15);
  check("square",
        worst_error<S>([](const Word& x, const Word&) { return square(x); },
                       [](const Real& x, const Real&) { return Real(x * x); },
                       false),
        5);
  check("root",
        worst_error<S>([](const Word& x, const Word&) { return sqrt(x); },
                       [](const Real& x, const Real&) { return Real(sqrt(x)); },
                       true),
        8);
}

TYPED_TEST(DoubleWordOf, LongSumSurvivesCancellationOfTwoWords) {
  using S = TypeParam;
  detail::LongSum<S> sum;
  const S tiny = std::ldexp(S(1), -3 * std::numeric_limits<S>::digits / 2);
  const DoubleWord<S> x{S(1), tiny};
  sum.add_product(x, x);
  sum.add(S(-1));
  sum.add(S(-2) * tiny);
  EXPECT_EQ(to_scalar(sum.two_words()), tiny * tiny);
}

TYPED_TEST(DoubleWordOf, SignsAndScalars) {
  using S = TypeParam;
  EXPECT_EQ(sign(DoubleWord<S>{S(1), S(0)}), 1);
  EXPECT_EQ(sign(DoubleWord<S>{S(-1), S(0)}), -1);
  EXPECT_EQ(sign(DoubleWord<S>{S(0), S(0)}), 0);
  EXPECT_EQ(to_scalar(DoubleWord<S>{S(1), S(0)} - S(1)), S(0));
  EXPECT_EQ(to_scalar(sqrt(DoubleWord<S>{S(0), S(0)})), S(0));
  EXPECT_EQ(to_scalar(S(1) / DoubleWord<S>{S(4), S(0)}), S(0.25));
}

TEST(DoubleWord, WideScalarsCarryNoLowWord) {
  const DoubleWord<long double> third = 1.0L / DoubleWord<long double>{3.0L, 0.0L};
  EXPECT_EQ(third.lo, 0.0L);
  EXPECT_EQ(two_prod(third.hi, third.hi).lo, 0.0L);
  EXPECT_EQ(sqrt(third).lo, 0.0L);
}

// The product of a build without fused multiply-add must be that of a build with it, bit for bit:
// subnormal errors, overflow, zeros of either sign, infinities.
TEST(DoubleWord, ProductHasTheBitsOfAFusedMultiplyAddEverywhere) {
  Random random(test::seed_of_run());
  const auto special = [&random](double x) {
    switch (random.bits() % 12) {
      case 0:
        return 0.0;
      case 1:
        return -0.0;
      case 2:
        return std::numeric_limits<double>::infinity();
      case 3:
        return std::numeric_limits<double>::denorm_min() * static_cast<double>(random.bits() % 100);
      case 4:
        return 1.0;
      default:
        return x;
    }
  };
  int different = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double a = special(random_scalar<double>(random, 1073));
    const double b = special(random_scalar<double>(random, i % 2 == 0 ? 1073 : 300));
    const double product = a * b;
    const DoubleWord<double> found = two_prod(a, b);
    const double low = std::fma(a, b, -product);
    const bool same = std::bit_cast<std::uint64_t>(found.lo) == std::bit_cast<std::uint64_t>(low) ||
                      (std::isnan(found.lo) && std::isnan(low));
    if (!same) ++different;
  }
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace stoss::engine

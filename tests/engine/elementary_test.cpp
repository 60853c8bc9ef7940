// SPDX-License-Identifier: Apache-2.0
// The engine's own exp, expm1, log1p and (1 - exp(-x)) / x against 400 bits, over the whole range
// and where they are hard: near zero, near -1, near the ends of the range.
#include "elementary.hpp"

#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>

namespace stoss::engine {
namespace {

using test::Random;
using test::Real;

/// The largest error in ulp of f over the arguments that `draw` yields, and how many in a million
/// are not rounded correctly.
template <class S>
double worst_of(const std::string& name,
                const std::function<S(Random&)>& draw,
                const std::function<S(S)>& f,
                const std::function<Real(const Real&)>& truth) {
  Random random(test::seed_of_run());
  const std::uint64_t cases =
      test::environment_number("STOSS_CASES", test::campaign(20000, 1000000));
  double worst = 0;
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const S x = draw(random);
    const Real exact = truth(Real(x));
    if (abs(exact) < Real(std::numeric_limits<S>::min())) continue;
    if (abs(exact) > Real(std::numeric_limits<S>::max())) continue;
    const double ulp = test::error_in_ulp<S>(Real(f(x)), exact);
    worst = std::max(worst, ulp);
    if (ulp > 0.5) ++wrong;
  }
  std::printf("%-40s max %.6f ulp, not correctly rounded %llu of %llu\n",
              name.c_str(),
              worst,
              static_cast<unsigned long long>(wrong),
              static_cast<unsigned long long>(cases));
  return worst;
}

Real exact_decay_mean(const Real& x) { return x == 0 ? Real(1) : Real(-expm1(Real(-x)) / x); }

/// Arguments of all sizes down to 10^-15, up to `limit`, of both signs.
template <class S>
std::function<S(Random&)> of_all_sizes(double limit) {
  return
      [=](Random& r) { return static_cast<S>(r.either_sign(r.decades(-15, std::log10(limit)))); };
}

template <class S>
void expect_rounded(const std::string& scalar) {
  constexpr double kUlpMax = 0.501;
  const double limit = std::is_same_v<S, float> ? 88 : 709;
  const auto all = of_all_sizes<S>(limit);
  const std::function<S(Random&)> even = [=](Random& r) {
    return static_cast<S>(r.uniform(-limit, limit));
  };
  const std::function<S(Random&)> unit = [](Random& r) { return static_cast<S>(r.uniform(-2, 2)); };
  for (const auto& draw : {all, even, unit}) {
    EXPECT_LE(
        worst_of<S>(
            scalar + " exp", draw, rounded_exp<S>, [](const Real& x) { return Real(exp(x)); }),
        kUlpMax);
    EXPECT_LE(worst_of<S>(scalar + " expm1",
                          draw,
                          rounded_expm1<S>,
                          [](const Real& x) { return Real(expm1(x)); }),
              kUlpMax);
    EXPECT_LE(
        worst_of<S>(scalar + " (1 - exp(-x)) / x", draw, rounded_decay_mean<S>, exact_decay_mean),
        kUlpMax);
  }
  const std::function<S(Random&)> near_pole = [](Random& r) {
    return static_cast<S>(-1 + r.decades(-15, 0));
  };
  const std::function<S(Random&)> small = [](Random& r) {
    return static_cast<S>(r.either_sign(r.decades(-30, 0)) * 0.999);
  };
  const std::function<S(Random&)> large = [](Random& r) {
    return static_cast<S>(r.decades(-1, std::is_same_v<S, float> ? 38 : 300));
  };
  for (const auto& draw : {near_pole, small, large}) {
    EXPECT_LE(worst_of<S>(
                  scalar + " log1p",
                  [&](Random& r) {
                    const S x = draw(r);
                    return x > S(-1) ? x : S(0.5);
                  },
                  rounded_log1p<S>,
                  [](const Real& x) { return Real(log1p(x)); }),
              kUlpMax);
  }
}

TEST(Elementary, DoubleIsRoundedOnce) { expect_rounded<double>("double"); }
TEST(Elementary, FloatIsRoundedOnce) { expect_rounded<float>("float"); }

// Wide scalars: 2^4 (1 + |x|) eps.
TEST(Elementary, LongDoubleIsGoodToAFewUnits) {
  Random random(test::seed_of_run());
  const Real eps(std::numeric_limits<long double>::epsilon());
  for (int i = 0; i < 2000; ++i) {
    const auto x = static_cast<long double>(random.either_sign(random.decades(-12, 2)));
    const auto y = static_cast<long double>(random.decades(-12, 2) - 0.9);
    const Real exact_x(x), bound = 16 * (1 + abs(exact_x)) * eps;
    EXPECT_LE(Real(abs(Real(rounded_exp(x)) / exp(exact_x) - 1)), bound) << x;
    EXPECT_LE(Real(abs(Real(rounded_expm1(x)) / expm1(exact_x) - 1)), bound) << x;
    EXPECT_LE(Real(abs(Real(rounded_log1p(y)) / log1p(Real(y)) - 1)), 16 * eps) << y;
  }
}

template <class S>
class ElementaryAtItsEnds : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(ElementaryAtItsEnds, Scalars);

TYPED_TEST(ElementaryAtItsEnds, ValuesAreThoseOfTheLibrary) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity(), nan = std::numeric_limits<S>::quiet_NaN();
  EXPECT_EQ(rounded_exp(S(0)), S(1));
  EXPECT_EQ(rounded_exp(inf), inf);
  EXPECT_EQ(rounded_exp(S(-inf)), S(0));
  EXPECT_EQ(rounded_expm1(S(0)), S(0));
  EXPECT_EQ(rounded_expm1(S(-inf)), S(-1));
  EXPECT_EQ(rounded_log1p(S(0)), S(0));
  EXPECT_EQ(rounded_log1p(S(-1)), S(-inf));
  EXPECT_EQ(rounded_log1p(inf), inf);
  EXPECT_TRUE(std::isnan(rounded_log1p(S(-2))));
  EXPECT_EQ(rounded_decay_mean(S(0)), S(1));
  EXPECT_EQ(rounded_decay_mean(inf), S(0));
  for (const S value : {rounded_exp(nan), rounded_expm1(nan), rounded_log1p(nan)}) {
    EXPECT_TRUE(std::isnan(value));
  }
  EXPECT_TRUE(std::isnan(rounded_decay_mean(nan)));
}

// The words of ln 2 and 1 / n!, derived anew: the first two words of ln 2 have bits to spare for k.
TEST(Elementary, ConstantsAreThoseOfTheirDefinitions) {
  const Real ln2 = log(Real(2));
  const Real words =
      Real(detail::kLnTwoHigh) + Real(detail::kLnTwoMiddle) + Real(detail::kLnTwoLow);
  EXPECT_LE(Real(abs(words - ln2)), ldexp(Real(1), -135));
  for (const double word : {detail::kLnTwoHigh, detail::kLnTwoMiddle}) {
    EXPECT_EQ(word * 2047.0, Real(Real(word) * 2047).convert_to<double>());
    EXPECT_EQ(Real(word * 2047.0), Real(Real(word) * 2047));
  }
  Real factorial = 1;
  for (std::size_t n = 2; n < 14; ++n) {
    factorial *= static_cast<double>(n);
    if (n < 8) {
      const DoubleWord<double>& pair = detail::kInverseFactorials[n - 2];
      EXPECT_LE(Real(abs(test::exact(pair) * factorial - 1)), ldexp(Real(1), -106));
    } else {
      EXPECT_EQ(detail::kInverseFactorialsOfTail[n - 8], Real(1 / factorial).convert_to<double>());
    }
  }
}

}  // namespace
}  // namespace stoss::engine

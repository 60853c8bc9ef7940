// SPDX-License-Identifier: Apache-2.0
// The operations of unbiased.hpp against 400 bits: how far off, and whether to one side. Errors are
// relative, in units of u^2 or u^3 (u = 2^-53 in double, 2^-24 in float).
#include "contact_law/unbiased.hpp"

#include "support/bias.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

namespace stoss::engine {
namespace {

using detail::TripleWord;
using test::Random;
using test::Real;
using test::Steps;

template <class S>
Real exact(const TripleWord<S>& x) {
  return Real(x.hi) + Real(x.lo) + Real(x.third);
}

/// approximate / truth - 1 in units of u^power.
template <class S>
double relative_error(const Real& approximate, const Real& truth, int power) {
  const Real u = Real(std::numeric_limits<S>::epsilon()) / 2;
  return Real((approximate / truth - 1) / pow(u, power)).template convert_to<double>();
}

/// Both words full, of any leading digits.
template <class S>
DoubleWord<S> two_words(Random& random) {
  const S hi = static_cast<S>(random.either_sign(std::exp2(random.uniform(-3, 3))));
  return quick_two_sum(
      hi, static_cast<S>(random.uniform(-0.5, 0.5)) * std::numeric_limits<S>::epsilon() * hi);
}

template <class S>
TripleWord<S> three_words(Random& random) {
  const DoubleWord<S> two = two_words<S>(random);
  const S fine = std::numeric_limits<S>::epsilon() * two.lo;
  return {two.hi, two.lo, static_cast<S>(random.uniform(-0.5, 0.5)) * fine};
}

template <class S>
void expect_three_words() {
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(60000);
  double norm = 0, product = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const DoubleWord2<S> p{two_words<S>(random), two_words<S>(random)};
    const Real x = test::exact(p.x), y = test::exact(p.y);
    const Real found = exact(detail::square_norm_in_three_words(p));
    norm = std::max(norm, std::fabs(relative_error<S>(found, x * x + y * y, 3)));
    const TripleWord<S> a = three_words<S>(random);
    DoubleWord<S> m = two_words<S>(random);
    if (random.one_in(2)) m.lo = S(0);
    const Real times = exact(detail::product_in_three_words(a, m));
    product = std::max(product, std::fabs(relative_error<S>(times, exact(a) * test::exact(m), 3)));
  }
  std::printf(
      "%zu-byte, three words: p.p to %.3g u^3, products to %.3g u^3\n", sizeof(S), norm, product);
  EXPECT_LE(norm, 16);
  EXPECT_LE(product, 16);
}

TEST(Unbiased, ThreeWordsAreThreeWordsInDouble) { expect_three_words<double>(); }
TEST(Unbiased, ThreeWordsAreThreeWordsInFloat) { expect_three_words<float>(); }

template <class S>
void expect_quotients_without_sign() {
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(300000);
  Steps errors;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const DoubleWord<S> x = two_words<S>(random);
    const TripleWord<S> y = three_words<S>(random);
    const Real found = test::exact(detail::unbiased_quotient(x, y));
    errors.add(relative_error<S>(found, test::exact(x) / exact(y), 2));
  }
  EXPECT_LE(errors.worst(), 6);
  test::expect_no_bias("quotient, u^2", errors);
}

TEST(Unbiased, QuotientsErrToNeitherSideInDouble) { expect_quotients_without_sign<double>(); }
TEST(Unbiased, QuotientsErrToNeitherSideInFloat) { expect_quotients_without_sign<float>(); }

// One denominator for ever, as a wall's normal is one: none may err to a side of its own.
TEST(Unbiased, NoDenominatorHasABiasOfItsOwn) {
  Random random(test::seed_of_run());
  test::GroupsOfSteps groups;
  for (int i = 0; i < 400; ++i) {
    const TripleWord<double> y = three_words<double>(random);
    Steps errors;
    for (int k = 0; k < 1000; ++k) {
      const DoubleWord<double> x = two_words<double>(random);
      const Real found = test::exact(detail::unbiased_quotient(x, y));
      errors.add(relative_error<double>(found, test::exact(x) / exact(y), 2));
    }
    groups.add(errors);
  }
  groups.expect_no_bias("quotients by one denominator");
}

TEST(Unbiased, WideScalarsDivideAsEver) {
  const TripleWord<long double> seven{7.0L, 0.0L, 0.0L};
  EXPECT_EQ(detail::unbiased_quotient(DoubleWord<long double>{3.0L, 0.0L}, seven).hi, 3.0L / 7.0L);
  const DoubleWord2<long double> p{{3.0L, 0.0L}, {4.0L, 0.0L}};
  EXPECT_EQ(detail::square_norm_in_three_words(p).hi, 25.0L);
  EXPECT_EQ(detail::product_in_three_words(seven, DoubleWord<long double>{2.0L, 0.0L}).hi, 14.0L);
}

}  // namespace
}  // namespace stoss::engine

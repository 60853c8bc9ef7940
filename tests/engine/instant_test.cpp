// SPDX-License-Identifier: Apache-2.0
// Instants against exact arithmetic: sums are rounded once to the grid, differences once to words.
#include "support/oracle.hpp"
#include "support/random.hpp"

#include <stoss/engine/instant.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace stoss::engine {
namespace {

using test::Random;
using test::Real;

Real exact(const Instant& t) { return Real(t.seconds) + ldexp(Real(t.fraction), -64); }
Real exact(const WideInstant& t) { return exact(t.coarse) + ldexp(Real(t.fine), -128); }

Instant random_instant(Random& random) {
  const auto shift = random.below(62) + 2;
  return {static_cast<std::int64_t>(random.bits()) >> shift, random.bits() >> random.below(64)};
}

constexpr std::uint64_t kHalf = std::uint64_t{1} << 63;

TEST(Instant, IsOrderedBySecondsThenFraction) {
  EXPECT_LT((Instant{-1, ~std::uint64_t{0}}), (Instant{0, 0}));
  EXPECT_LT((Instant{3, 1}), (Instant{3, 2}));
  EXPECT_LT((Instant{3, ~std::uint64_t{0}}), (Instant{4, 0}));
  EXPECT_LT((Instant{kSecondsMax, 0}), Instant::never());
  EXPECT_FALSE(in_range(Instant::never()));
  EXPECT_FALSE(in_range({kSecondsMax, 0}));
  EXPECT_TRUE(in_range({kSecondsMax - 1, ~std::uint64_t{0}}));
  EXPECT_FALSE(in_range({-kSecondsMax, 0}));
}

TEST(Instant, IsAWholeNumberOfTicksAndBack) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 10000; ++i) {
    const Instant t = random_instant(random);
    EXPECT_EQ(instant_from_ticks(ticks(t)), t);
  }
  EXPECT_EQ(instant_from_ticks(-1), (Instant{-1, ~std::uint64_t{0}}));
}

template <class S>
void expect_exact_differences(double relative_error) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 20000; ++i) {
    const Instant a = random_instant(random);
    const Instant b = random.one_in(2)
                          ? random_instant(random)
                          : instant_from_ticks(ticks(a) + static_cast<std::int64_t>(random.bits()));
    const DoubleWord<S> d = difference<S>(b, a);
    const Real truth = exact(b) - exact(a);
    const Real error = abs(test::exact(d) - truth);
    EXPECT_LE(error, abs(truth) * Real(relative_error));
    EXPECT_EQ(d.hi, truth.convert_to<S>());  // rounded once
  }
  EXPECT_EQ(difference<S>(Instant{7, 9}, Instant{7, 9}).hi, S(0));
}

TEST(Instant, DifferencesAreRoundedOnceToTheHighWordAndTheRestToTheLow) {
  expect_exact_differences<double>(0x1p-106);
  expect_exact_differences<float>(0x1p-48);
}

TEST(Instant, WideDifferencesAreGoodToTheLastPlace) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 20000; ++i) {
    const WideInstant a{random_instant(random), random.bits()};
    const WideInstant b{random_instant(random), random.bits() >> random.below(64)};
    const DoubleWord<long double> d = difference<long double>(b, a);
    const Real truth = exact(b) - exact(a);
    EXPECT_LE(abs(Real(d.hi) - truth), abs(truth) * Real(0x1p-62));
    EXPECT_EQ(d.lo, 0.0L);
    EXPECT_EQ(difference<long double>(a, b).hi, -d.hi);
  }
}

TEST(Instant, SumsAreTheNearestOfTheGrid) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 50000; ++i) {
    const Instant from = random_instant(random);
    const double hi = std::ldexp(random.uniform(1, 2), static_cast<int>(random.below(140)) - 90);
    const double lo = random.either_sign(random.uniform(0, 0.5)) * hi * 0x1p-52;
    const auto sum = later_by<double>(from, hi, lo);
    const Real truth = exact(from) + Real(hi) + Real(lo);
    ASSERT_TRUE(sum.has_value());
    // Rests are summed in one word: a tie may fall to either side.
    EXPECT_LE(abs(exact(*sum) - truth), ldexp(Real(1), -65) * Real(1 + 0x1p-50));
  }
}

TEST(Instant, SumsHaveKnownRoundings) {
  const Instant t{5, 100};
  EXPECT_EQ(later_by<double>(t, 0.0, 0.0), t);
  EXPECT_EQ(later_by<double>(t, 0x1p-64, 0.0), (Instant{5, 101}));
  EXPECT_EQ(later_by<double>(t, 0x1p-66, 0.0), t);
  EXPECT_EQ(later_by<double>(t, 0x1.8p-65, 0.0), (Instant{5, 101}));
  EXPECT_EQ(later_by<double>(t, 1.0, -0x1p-64), (Instant{6, 99}));
  EXPECT_EQ(later_by<double>(t, 0.5, 0.0), (Instant{5, 100 + kHalf}));
  EXPECT_EQ(later_by<float>(t, 0.5F, 0x1p-30F),
            (Instant{5, 100 + kHalf + (std::uint64_t{1} << 34)}));
}

TEST(Instant, SumsBeyondTheEndOfTimeAreNone) {
  EXPECT_FALSE(later_by<double>(Instant{0, 0}, 0x1p61, 0.0).has_value());
  EXPECT_FALSE(later_by<double>(Instant{0, 0}, HUGE_VAL, 0.0).has_value());
  EXPECT_FALSE(later_by<double>(Instant{0, 0}, std::nan(""), 0.0).has_value());
  EXPECT_FALSE(later_by<double>(Instant{kSecondsMax - 1, 0}, 1.0, 0.0).has_value());
  EXPECT_TRUE(later_by<double>(Instant{kSecondsMax - 2, 0}, 1.0, 0.0).has_value());
  EXPECT_FALSE(later_by<long double>(WideInstant{}, 0x1p61L, 0.0L).has_value());
  EXPECT_FALSE(later_by<long double>(WideInstant{{kSecondsMax - 1, 0}, 0}, 1.0L, 0.0L).has_value());
}

TEST(Instant, WideSumsAreExactToTheirGrid) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 50000; ++i) {
    const WideInstant from{random_instant(random), random.bits()};
    long double t = std::ldexp(1.0L + 0x1p-63L * static_cast<long double>(random.bits() >> 1),
                               static_cast<int>(random.below(180)) - 130);
    // Just below a power of two every limb is all ones, and a double would round it up.
    if (random.one_in(3))
      t = std::nextafter(std::ldexp(1.0L, static_cast<int>(random.below(60)) - 30), 0.0L);
    const auto sum = later_by<long double>(from, t, 0.0L);
    ASSERT_TRUE(sum.has_value());
    const Real error = exact(from) + Real(t) - exact(*sum);
    EXPECT_GE(error, 0);
    EXPECT_LT(error, ldexp(Real(1), -128));
  }
}

TEST(Instant, SumsAndDifferencesAreInverse) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 20000; ++i) {
    const Instant a = random_instant(random);
    // Up to 2^40 s apart, 106 bits hold a difference.
    const Instant b =
        instant_from_ticks(ticks(a) + (static_cast<Int128>(random.bits() >> 24) << 64) +
                           static_cast<Int128>(random.bits()));
    const DoubleWord<double> d = difference<double>(b, a);
    EXPECT_EQ(later_by<double>(a, d.hi, d.lo), b);
  }
}

TEST(Instant, OffsetsMayBeNegative) {
  EXPECT_EQ(offset_by({5, 0}, 1.5), (Instant{6, kHalf}));
  EXPECT_EQ(offset_by({5, 0}, -1.5), (Instant{3, kHalf}));
  EXPECT_EQ(offset_by({0, 0}, -0.0), (Instant{0, 0}));
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 0x1p61, -0x1p61, 1e300}) {
    EXPECT_FALSE(offset_by({0, 0}, bad).has_value()) << bad;
  }
}

TEST(Instant, SecondsBetweenAreRoundedOnce) {
  EXPECT_EQ(seconds_between({3, kHalf}, {5, 0}), 1.5);
  EXPECT_EQ(seconds_between({5, 0}, {3, kHalf}), -1.5);
  EXPECT_EQ(seconds_between({std::int64_t{1} << 60, 0}, {std::int64_t{1} << 60, 1}), 0x1p-64);
}

TEST(WideInstant, IsRoundedToTheNearestInstant) {
  EXPECT_EQ(to_instant(WideInstant{{5, 7}, kHalf - 1}), (Instant{5, 7}));
  EXPECT_EQ(to_instant(WideInstant{{5, 7}, kHalf}), (Instant{5, 8}));
  EXPECT_EQ(to_instant(WideInstant{{5, ~std::uint64_t{0}}, kHalf}), (Instant{6, 0}));
  EXPECT_EQ(from_instant<WideInstant>({5, 7}), (WideInstant{{5, 7}, 0}));
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The instants of ticks against a bit-by-bit division that shares no code with them.

#include <stoss/engine/tick_clock.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace stoss::engine {
namespace {

/// floor(2^64 n d / r) for quotients below 2^126, one bit at a time.
Uint128 scaled_quotient(std::uint64_t n, std::uint64_t d, std::uint64_t r) {
  const Uint128 product = static_cast<Uint128>(n) * d;
  Uint128 rest = 0;
  Uint128 quotient = 0;
  for (int bit = 127; bit >= -64; --bit) {
    rest = (rest << 1) | (bit >= 0 ? (product >> bit) & 1U : Uint128{0});
    quotient <<= 1;
    if (rest >= r) {
      rest -= r;
      quotient |= 1U;
    }
  }
  return quotient;
}

TEST(TickClock, WholeSecondsOfWholeHertzAreHitExactly) {
  const TickClock clock(Instant{5, 0}, 60, 1);
  EXPECT_EQ(clock.instant_of(0), (Instant{5, 0}));
  EXPECT_EQ(clock.instant_of(60), (Instant{6, 0}));
  EXPECT_EQ(clock.instant_of(30), (Instant{5, std::uint64_t{1} << 63}));
  EXPECT_EQ(clock.instant_of(std::uint64_t{60} * 1'000'000'007), (Instant{1'000'000'012, 0}));
}

TEST(TickClock, TheFractionIsRoundedDown) {
  // 2^64 / 3 = 6148914691236517205.33...
  const TickClock clock(Instant{0, 0}, 3, 1);
  EXPECT_EQ(clock.instant_of(1), (Instant{0, 6148914691236517205U}));
  EXPECT_EQ(clock.instant_of(2), (Instant{0, 12297829382473034410U}));
  EXPECT_EQ(clock.instant_of(3), (Instant{1, 0}));
}

TEST(TickClock, AgreesWithABitByBitDivisionForRandomRatios) {
  std::mt19937_64 random(20240607);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t r = (random() >> (random() % 64)) | 1U;
    const std::uint64_t d = (random() >> (random() % 64)) | 1U;
    const std::uint64_t n = random() >> (random() % 64);
    if (static_cast<Uint128>(n) * d / r >= static_cast<Uint128>(kSecondsMax)) continue;
    const Instant expected = instant_from_ticks(static_cast<Int128>(scaled_quotient(n, d, r)));
    ASSERT_EQ(TickClock(Instant{0, 0}, r, d).instant_of(n), expected) << n << ' ' << d << ' ' << r;
  }
}

TEST(TickClock, AShiftedStartShiftsEveryTick) {
  const Instant start{std::int64_t{1} << 40, 12345};
  const TickClock at_zero(Instant{0, 0}, 1000, 7);
  const TickClock shifted(start, 1000, 7);
  for (std::uint64_t n = 0; n < 5000; n += 13) {
    EXPECT_EQ(ticks(shifted.instant_of(n)), ticks(start) + ticks(at_zero.instant_of(n)));
  }
}

TEST(TickClock, BeyondTheEndOfTimeIsNever) {
  const TickClock clock(Instant{0, 0}, 1, ~std::uint64_t{0});
  EXPECT_EQ(clock.instant_of(1), Instant::never());
  EXPECT_EQ(clock.instant_of(~std::uint64_t{0}), Instant::never());
}

TEST(TickClock, ARateIsTakenAsTheExactRatioOfItsDouble) {
  const auto tenth = TickClock::from_rate({}, 0.1);
  ASSERT_TRUE(tenth);
  EXPECT_EQ(static_cast<double>(tenth->numerator()) / static_cast<double>(tenth->denominator()),
            0.1);
  const auto sixty = TickClock::from_rate({}, 60);
  ASSERT_TRUE(sixty);
  EXPECT_EQ(sixty->numerator(), 60U);
  EXPECT_EQ(sixty->denominator(), 1U);
  EXPECT_TRUE(TickClock::from_rate({}, 1.8e19));
  EXPECT_TRUE(TickClock::from_rate({}, 0.001));
}

TEST(TickClock, WhatIsNoRateGivesNoClock) {
  for (const double hz : {0.0,
                          -1.0,
                          1e300,
                          1e-300,
                          std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(TickClock::from_rate({}, hz)) << hz;
  }
}

TEST(TickClock, FindsTheFirstTickAtOrAfterAnInstant) {
  const auto clock = TickClock::from_rate(Instant{10, 0}, 60);
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->first_at_or_after(Instant{0, 0}), 0U);
  EXPECT_EQ(clock->first_at_or_after(Instant{10, 0}), 0U);
  EXPECT_EQ(clock->first_at_or_after(Instant{10, 1}), 1U);
  EXPECT_EQ(clock->first_at_or_after(Instant{11, 0}), 60U);
  EXPECT_EQ(clock->first_at_or_after(Instant{11, 1}), 61U);
  for (std::uint64_t n = 1; n < 100'000'000; n = n * 3 + 1) {
    EXPECT_EQ(clock->first_at_or_after(clock->instant_of(n)), n);
  }
}

}  // namespace
}  // namespace stoss::engine

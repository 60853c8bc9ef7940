// SPDX-License-Identifier: Apache-2.0
// Instants and numbers as people write them.

#include <stoss/client/decimal.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace stoss::client {
namespace {

using engine::Instant;

TEST(Decimal, DecimalsBecomeTheNearestInstant) {
  EXPECT_EQ(parse_instant("0"), (Instant{0, 0}));
  EXPECT_EQ(parse_instant("1.5"), (Instant{1, std::uint64_t{1} << 63}));
  EXPECT_EQ(parse_instant("-0.25"), (Instant{-1, std::uint64_t{3} << 62}));
  EXPECT_EQ(parse_instant(" +12 "), (Instant{12, 0}));
  EXPECT_EQ(parse_instant(".5"), (Instant{0, std::uint64_t{1} << 63}));
  EXPECT_EQ(parse_instant("5."), (Instant{5, 0}));
  EXPECT_EQ(parse_instant("25e-2"), (Instant{0, std::uint64_t{1} << 62}));
  EXPECT_EQ(parse_instant("1e3"), (Instant{1000, 0}));
  // 2^64 / 10 = 1844674407370955161.6
  EXPECT_EQ(parse_instant("0.1"), (Instant{0, 1844674407370955162U}));
  EXPECT_EQ(parse_instant("0.100000000000000000000000000000"), (Instant{0, 1844674407370955162U}));
}

TEST(Decimal, DigitsBelowTheResolutionAreRoundedOnce) {
  // 2^-65 = 0.0000000000000000000271050543121376108501863200217485427856445312500
  const std::string half = "0.00000000000000000002710505431213761085018632002174854278564453125";
  EXPECT_EQ(parse_instant(half), (Instant{0, 1}));
  EXPECT_EQ(parse_instant("0.00000000000000000002710505431213761085018632002174854278564453124"),
            (Instant{0, 0}));
  EXPECT_EQ(parse_instant("0.99999999999999999999999"), (Instant{1, 0}));
  EXPECT_EQ(parse_instant("-" + half), (Instant{-1, ~std::uint64_t{0}}));
}

TEST(Decimal, PairsOfSecondsAndFractionAreTakenAsTheyAre) {
  EXPECT_EQ(parse_instant("3:1"), (Instant{3, 1}));
  EXPECT_EQ(parse_instant("-1:18446744073709551615"), (Instant{-1, ~std::uint64_t{0}}));
  EXPECT_FALSE(parse_instant("3:-1"));
  EXPECT_FALSE(parse_instant("3:18446744073709551616"));
}

TEST(Decimal, WhatIsNoInstantIsRefused) {
  for (const char* text : {"",
                           ".",
                           "-",
                           "1.2.3",
                           "inf",
                           "nan",
                           "1e",
                           "1e2000",
                           "0x10",
                           "1 2",
                           "--1",
                           "2305843009213693952",
                           "1e18e",
                           ":",
                           "1:",
                           ":1"}) {
    EXPECT_FALSE(parse_instant(text)) << text;
  }
}

TEST(Decimal, TheShortestDecimalReadsBackToTheSameInstant) {
  EXPECT_EQ(format_instant({0, 0}), "0");
  EXPECT_EQ(format_instant({-1, std::uint64_t{3} << 62}), "-0.25");
  EXPECT_EQ(format_instant({0, 1844674407370955162U}), "0.1");
  EXPECT_EQ(format_instant({7, ~std::uint64_t{0}}), "7.99999999999999999994");
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const Instant instant{
        static_cast<std::int64_t>(random() >> (random() % 60 + 4)) * (i % 2 == 0 ? 1 : -1),
        random() >> (random() % 64) << (random() % 64)};
    if (!engine::in_range(instant)) continue;
    const std::string text = format_instant(instant);
    ASSERT_EQ(parse_instant(text), instant) << text;
    ASSERT_LE(text.size(), 42U);
  }
}

TEST(Decimal, NumbersAreReadWhole) {
  EXPECT_EQ(parse_number("-1.5"), -1.5);
  EXPECT_EQ(parse_number(" +2e3"), 2000.0);
  EXPECT_EQ(parse_number("inf"), std::numeric_limits<double>::infinity());
  for (const char* text : {"", "1x", "+-1", "1,2", "--1"}) EXPECT_FALSE(parse_number(text)) << text;
  EXPECT_EQ(parse_count("18446744073709551615"), ~std::uint64_t{0});
  for (const char* text : {"-1", "1.5", "18446744073709551616", ""}) {
    EXPECT_FALSE(parse_count(text)) << text;
  }
}

TEST(Decimal, VectorsAreTwoNumbersAndAComma) {
  const auto vector = parse_vector("-1,2.5");
  ASSERT_TRUE(vector);
  EXPECT_EQ(vector->x(), -1);
  EXPECT_EQ(vector->y(), 2.5);
  for (const char* text : {"1", "1,", ",1", "1,2,3", "1;2"})
    EXPECT_FALSE(parse_vector(text)) << text;
}

TEST(Decimal, NumbersArePrintedInTheirShortestForm) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(1e300), "1e+300");
  EXPECT_EQ(format_number(-0.0), "-0");
}

}  // namespace
}  // namespace stoss::client

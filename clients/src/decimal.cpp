// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/decimal.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace stoss::client {
namespace {

using engine::Instant;
using engine::Int128;
using engine::Uint128;

/// Longer texts are not numbers that anybody wrote; the bound keeps the conversion quick.
constexpr std::size_t kTextLengthMax = 2000;
constexpr int kExponentMax = 1000;

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

template <class T>
std::optional<T> whole(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// sign * 0.d1 d2 d3 ... * 10^point
struct Decimal {
  bool negative = false;
  std::vector<std::uint8_t> digits;
  int point = 0;
};

std::optional<int> parse_exponent(std::string_view text) {
  const std::optional<int> exponent = whole<int>(text);
  if (!exponent || *exponent > kExponentMax || *exponent < -kExponentMax) return std::nullopt;
  return exponent;
}

std::optional<Decimal> parse_decimal(std::string_view text) {
  Decimal result;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    result.negative = text.front() == '-';
    text.remove_prefix(1);
  }
  bool past_point = false;
  std::size_t i = 0;
  for (; i < text.size() && (is_digit(text[i]) || (text[i] == '.' && !past_point)); ++i) {
    if (text[i] == '.') {
      past_point = true;
      continue;
    }
    result.digits.push_back(static_cast<std::uint8_t>(text[i] - '0'));
    if (!past_point) ++result.point;
  }
  if (result.digits.empty()) return std::nullopt;
  if (i == text.size()) return result;
  if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
  const std::optional<int> exponent = parse_exponent(text.substr(i + 1));
  if (!exponent) return std::nullopt;
  result.point += *exponent;
  return result;
}

/// The whole part; nothing when it is beyond the end of time.
std::optional<std::int64_t> whole_part(const Decimal& decimal) {
  std::int64_t seconds = 0;
  for (int i = 0; i < decimal.point; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int digit = at < decimal.digits.size() ? decimal.digits[at] : 0;
    if (seconds >= engine::kSecondsMax / 10) return std::nullopt;
    seconds = seconds * 10 + digit;
  }
  return seconds;
}

/// The digits after the decimal point.
std::vector<std::uint8_t> fraction_digits(const Decimal& decimal) {
  std::vector<std::uint8_t> digits;
  if (decimal.point < 0) digits.assign(static_cast<std::size_t>(-decimal.point), 0);
  const auto whole_digits = static_cast<std::size_t>(std::max(decimal.point, 0));
  for (std::size_t i = whole_digits; i < decimal.digits.size(); ++i) {
    digits.push_back(decimal.digits[i]);
  }
  return digits;
}

/// Doubles 0.d1 d2 d3 ... in place; true when that carries into the whole part.
bool double_fraction(std::vector<std::uint8_t>& digits) {
  int carry = 0;
  for (std::size_t i = digits.size(); i-- > 0;) {
    const int twice = digits[i] * 2 + carry;
    carry = twice >= 10 ? 1 : 0;
    digits[i] = static_cast<std::uint8_t>(twice - 10 * carry);
  }
  return carry != 0;
}

}  // namespace

std::optional<Instant> parse_instant(std::string_view text) {
  text = trimmed(text);
  if (text.size() > kTextLengthMax) return std::nullopt;
  if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    const auto seconds = whole<std::int64_t>(text.substr(0, colon));
    const auto fraction = whole<std::uint64_t>(text.substr(colon + 1));
    if (!seconds || !fraction) return std::nullopt;
    const Instant instant{*seconds, *fraction};
    return engine::in_range(instant) ? std::optional(instant) : std::nullopt;
  }
  const std::optional<Decimal> decimal = parse_decimal(text);
  if (!decimal) return std::nullopt;
  const std::optional<std::int64_t> seconds = whole_part(*decimal);
  if (!seconds) return std::nullopt;
  std::vector<std::uint8_t> rest = fraction_digits(*decimal);
  auto magnitude = static_cast<Uint128>(*seconds);
  constexpr int kFractionBits = 64;
  for (int bit = 0; bit < kFractionBits; ++bit) {
    magnitude = (magnitude << 1) | (double_fraction(rest) ? 1U : 0U);
  }
  if (double_fraction(rest)) magnitude += 1;  // the rest was a half or more
  const auto ticks = static_cast<Int128>(magnitude);
  const Instant instant = engine::instant_from_ticks(decimal->negative ? -ticks : ticks);
  return engine::in_range(instant) ? std::optional(instant) : std::nullopt;
}

std::string format_instant(const Instant& instant) {
  const Int128 ticks = engine::ticks(instant);
  const Instant magnitude = engine::instant_from_ticks(ticks < 0 ? -ticks : ticks);
  std::string digits;
  // Digit by digit: fraction = 0.digits + rest / 2^64 / 10^k. The text reads back once it is within
  // half a unit of 2^-64, that is, once 2 rest < 10^k, or 2 (2^64 - rest) < 10^k for the next
  // above.
  std::uint64_t rest = magnitude.fraction;
  Uint128 power = 1;
  bool up = false;
  while (2 * static_cast<Uint128>(rest) >= power) {
    const Uint128 to_next = (static_cast<Uint128>(1) << 64) - rest;
    if (2 * to_next < power) {
      up = true;
      break;
    }
    const Uint128 ten = static_cast<Uint128>(rest) * 10;
    digits += static_cast<char>('0' + static_cast<int>(ten >> 64));
    rest = static_cast<std::uint64_t>(ten);
    power *= 10;
  }
  std::int64_t seconds = magnitude.seconds;
  if (up) {
    std::size_t i = digits.size();
    while (i > 0 && digits[i - 1] == '9') digits[--i] = '0';
    if (i > 0) {
      ++digits[i - 1];
    } else {
      ++seconds;
    }
  }
  while (!digits.empty() && digits.back() == '0') digits.pop_back();
  std::string text = (ticks < 0 ? "-" : "") + std::to_string(seconds);
  if (!digits.empty()) text += '.' + digits;
  return text;
}

std::optional<double> parse_number(std::string_view text) { return whole<double>(text); }

std::optional<std::uint64_t> parse_count(std::string_view text) {
  return whole<std::uint64_t>(text);
}

std::optional<engine::Vector2> parse_vector(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::optional<double> x = parse_number(text.substr(0, comma));
  const std::optional<double> y = parse_number(text.substr(comma + 1));
  if (!x || !y) return std::nullopt;
  return engine::Vector2{*x, *y};
}

std::string format_number(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  static_cast<void>(error);  // the buffer holds the longest double (24 characters)
  return {buffer.data(), end};
}

}  // namespace stoss::client

// SPDX-License-Identifier: Apache-2.0
// The lexical half of reading JSON: RFC 8259 without leniency, and its numbers.
#pragma once

#include "utf8.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace stoss::idl {

/// Unwinds a reader of JSON; read_json catches it.
struct JsonFailure {
  std::size_t offset;
  std::string reason;
};

/// A name as a message quotes it, cut where it would flood the line.
inline std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "\"" + std::string(text.substr(0, kLongest));
  if (text.size() > kLongest) out += "...";
  return out + "\"";
}

/// Walks over a text, token by token.
class JsonScanner {
 public:
  explicit JsonScanner(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t offset() const noexcept { return next_; }

  [[noreturn]] void fail(std::string reason) const { fail_at(next_, std::move(reason)); }
  [[noreturn]] static void fail_at(std::size_t offset, std::string reason) {
    throw JsonFailure{offset, std::move(reason)};
  }

  /// The next character that is no white space; 0 at the end.
  char peek() {
    while (next_ < text_.size() && is_space(text_[next_])) ++next_;
    return next_ < text_.size() ? text_[next_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++next_;
    return true;
  }
  void expect(char c, const char* where) {
    if (!accept(c)) fail(std::string("expected '") + c + "' " + where + ", but found " + found());
  }
  void expect_end() {
    if (peek() != '\0' || next_ < text_.size()) {
      fail("expected the end of the file after the scene, but found " + found());
    }
  }
  bool accept_word(std::string_view word) {
    peek();
    if (text_.substr(next_, word.size()) != word) return false;
    next_ += word.size();
    return true;
  }

  /// What stands next, for a message.
  std::string found() {
    const char c = peek();
    if (next_ >= text_.size()) return "the end of the file";
    return c == '\'' ? "\"'\"" : std::string("'") + c + "'";
  }

  /// A string with its escapes resolved.
  std::string string() {
    expect('"', "to open a string");
    std::string out;
    for (;;) {
      if (next_ >= text_.size()) fail("a string is not closed");
      const char c = text_[next_];
      if (c == '"') {
        ++next_;
        return out;
      }
      if (c == '\\') {
        ++next_;
        out_escape(out);
        continue;
      }
      const std::size_t length = utf8_length(text_.substr(next_));
      constexpr unsigned char kFirstPrintable = 0x20;
      if (length == 0) fail("a string holds bytes that are not UTF-8");
      if (static_cast<unsigned char>(c) < kFirstPrintable) {
        fail("a string holds a control character, which must be written as \\u00XX");
      }
      out += text_.substr(next_, length);
      next_ += length;
    }
  }

  /// The characters of a number, checked against the grammar.
  std::string_view number() {
    peek();
    const std::size_t begin = next_;
    static_cast<void>(accept_here('-'));
    if (!accept_here('0')) digits();
    if (accept_here('.')) digits();
    if (accept_here('e') || accept_here('E')) {
      if (!accept_here('+')) static_cast<void>(accept_here('-'));
      digits();
    }
    return text_.substr(begin, next_ - begin);
  }

 private:
  static bool is_space(char c) noexcept { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  bool accept_here(char c) {
    if (next_ >= text_.size() || text_[next_] != c) return false;
    ++next_;
    return true;
  }
  void digits() {
    const std::size_t begin = next_;
    while (next_ < text_.size() && text_[next_] >= '0' && text_[next_] <= '9') ++next_;
    if (begin == next_) fail("expected a digit, but found " + found());
  }
  std::uint32_t four_hex_digits() {
    constexpr std::size_t kLength = 4;
    constexpr int kBase = 16;
    std::uint32_t value = 0;
    const std::string_view hex = text_.substr(next_, kLength);
    const auto end = std::from_chars(hex.data(), hex.data() + hex.size(), value, kBase);
    if (hex.size() != kLength || end.ptr != hex.data() + kLength) {
      fail("\\u must be followed by four hexadecimal digits");
    }
    next_ += kLength;
    return value;
  }
  void unicode_escape(std::string& out) {
    std::uint32_t point = four_hex_digits();
    const bool high = point >= 0xD800U && point < 0xDC00U;
    const bool low = point >= 0xDC00U && point < 0xE000U;
    if (high) {
      if (!accept_here('\\') || !accept_here('u')) fail("half of a surrogate pair stands alone");
      const std::uint32_t second = four_hex_digits();
      if (second < 0xDC00U || second >= 0xE000U) fail("half of a surrogate pair stands alone");
      point = 0x10000U + ((point - 0xD800U) << 10U) + (second - 0xDC00U);
    } else if (low) {
      fail("half of a surrogate pair stands alone");
    }
    append_utf8(out, point);
  }
  void out_escape(std::string& out) {
    const char c = next_ < text_.size() ? text_[next_++] : '\0';
    switch (c) {
      case '"':
      case '\\':
      case '/':
        out += c;
        return;
      case 'b':
        out += '\b';
        return;
      case 'f':
        out += '\f';
        return;
      case 'n':
        out += '\n';
        return;
      case 'r':
        out += '\r';
        return;
      case 't':
        out += '\t';
        return;
      case 'u':
        unicode_escape(out);
        return;
      default:
        fail("a string holds a backslash that begins no escape");
    }
  }

  std::string_view text_;
  std::size_t next_ = 0;
};

/// True when the whole text is a number by JSON's grammar: numbers in quotes keep to it too.
inline bool is_number(std::string_view text) {
  try {
    return JsonScanner(text).number().size() == text.size();
  } catch (const JsonFailure&) {
    return false;
  }
}

/// The whole text as a double, if it is one.
inline std::optional<double> to_double(std::string_view text) {
  if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
  if (text == "Infinity") return std::numeric_limits<double>::infinity();
  if (text == "-Infinity") return -std::numeric_limits<double>::infinity();
  if (!is_number(text)) return std::nullopt;
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool all = end.ptr == text.data() + text.size();
  // Too small to be told from zero is zero; too large is an error.
  if (all && end.ec == std::errc::result_out_of_range) {
    const bool negative = text.front() == '-';
    const bool small = text.find_first_of("eE") == std::string_view::npos
                           ? text.substr(negative ? 1 : 0, 2) == "0."
                           : text.find("e-") != text.npos || text.find("E-") != text.npos;
    return small ? std::optional(negative ? -0.0 : 0.0) : std::nullopt;
  }
  return all && end.ec == std::errc() ? std::optional(value) : std::nullopt;
}

/// The whole text as an integer; integral values with a point or an exponent count, as "1e3".
template <class Integer>
std::optional<Integer> to_integer(std::string_view text) {
  if (!is_number(text)) return std::nullopt;
  Integer value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec == std::errc() && end.ptr == text.data() + text.size()) return value;
  if (text.find_first_of(".eE") == std::string_view::npos) return std::nullopt;
  const std::optional<double> real = to_double(text);
  constexpr double kExact = 9007199254740992.0;  // 2^53: beyond it a double skips integers
  if (!real || std::abs(*real) > kExact || std::trunc(*real) != *real) return std::nullopt;
  if (*real < 0 && !std::numeric_limits<Integer>::is_signed) return std::nullopt;
  if (*real > static_cast<double>(std::numeric_limits<Integer>::max())) return std::nullopt;
  if (*real < static_cast<double>(std::numeric_limits<Integer>::min())) return std::nullopt;
  return static_cast<Integer>(*real);
}

}  // namespace stoss::idl

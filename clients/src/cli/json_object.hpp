// SPDX-License-Identifier: Apache-2.0
#pragma once

// One JSON object on one line, built field by field.

#include <stoss/engine/instant.hpp>
#include <stoss/idl/json_lines.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace stoss::client::cli {

/// 16 digits.
[[nodiscard]] inline std::string hexadecimal(std::uint64_t value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; value >>= 4) text[i] = kDigits[value & 0xFU];
  return text;
}

class JsonObject {
 public:
  JsonObject& number(std::string_view name, double value) {
    key(name);
    idl::append_number(text_, value);
    return *this;
  }
  /// As a JSON number; for counts that stay far below 2^53.
  JsonObject& count(std::string_view name, std::uint64_t value) {
    return raw(name, std::to_string(value));
  }
  /// As the canonical mapping has 64-bit integers: in quotes.
  JsonObject& integer(std::string_view name, std::uint64_t value) {
    return raw(name, '"' + std::to_string(value) + '"');
  }
  JsonObject& boolean(std::string_view name, bool value) {
    return raw(name, value ? "true" : "false");
  }
  JsonObject& string(std::string_view name, std::string_view value) {
    key(name);
    idl::append_string(text_, value);
    return *this;
  }
  JsonObject& instant(std::string_view name, const engine::Instant& value) {
    JsonObject object;
    if (value.seconds != 0) object.raw("seconds", '"' + std::to_string(value.seconds) + '"');
    if (value.fraction != 0) object.integer("fraction", value.fraction);
    return raw(name, object.text());
  }
  /// `json` is an object or array already.
  JsonObject& object(std::string_view name, std::string_view json) { return raw(name, json); }

  [[nodiscard]] std::string text() const { return '{' + text_ + '}'; }

 private:
  JsonObject& raw(std::string_view name, std::string_view value) {
    key(name);
    text_ += value;
    return *this;
  }
  void key(std::string_view name) {
    if (!text_.empty()) text_ += ',';
    text_ += '"';
    text_ += name;
    text_ += "\":";
  }

  std::string text_;
};

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
// One character of UTF-8 at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stoss::idl {

/// The length of the well-formed character that `bytes` begins with: 1 to 4, or 0 when there is
/// none. Source: the table of well-formed byte sequences in The Unicode Standard, section 3.9
/// (table 3-7).
[[nodiscard]] inline std::size_t utf8_length(std::string_view bytes) noexcept {
  if (bytes.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  std::size_t length = 2;
  unsigned lowest = 0x80U;  // bounds of the second byte exclude overlong forms and surrogates
  unsigned highest = 0xBFU;
  if (first >= 0xC2U && first <= 0xDFU) {
    length = 2;
  } else if (first >= 0xE0U && first <= 0xEFU) {
    length = 3;
    if (first == 0xE0U) lowest = 0xA0U;
    if (first == 0xEDU) highest = 0x9FU;
  } else if (first >= 0xF0U && first <= 0xF4U) {
    length = 4;
    if (first == 0xF0U) lowest = 0x90U;
    if (first == 0xF4U) highest = 0x8FU;
  } else {
    return 0;
  }
  if (bytes.size() < length || byte(1) < lowest || byte(1) > highest) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

/// Appends the character with this code point, which is not a surrogate, as UTF-8.
inline void append_utf8(std::string& out, std::uint32_t point) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (point < 0x80U) {
    put(point);
  } else if (point < 0x800U) {
    put(0xC0U | (point >> 6U));
    put(0x80U | (point & 0x3FU));
  } else if (point < 0x10000U) {
    put(0xE0U | (point >> 12U));
    put(0x80U | ((point >> 6U) & 0x3FU));
    put(0x80U | (point & 0x3FU));
  } else {
    put(0xF0U | (point >> 18U));
    put(0x80U | ((point >> 12U) & 0x3FU));
    put(0x80U | ((point >> 6U) & 0x3FU));
    put(0x80U | (point & 0x3FU));
  }
}

}  // namespace stoss::idl

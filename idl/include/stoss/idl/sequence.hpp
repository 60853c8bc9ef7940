// SPDX-License-Identifier: Apache-2.0
// Safe use of the generated sequences and strings, which are plain C.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace stoss::idl {

/// The type of a generated sequence's elements.
template <class Sequence>
using Element = std::remove_pointer_t<decltype(Sequence::_buffer)>;

/// The elements of a received sequence; valid as long as the sample is.
template <class Sequence>
[[nodiscard]] std::span<const Element<Sequence>> view(const Sequence& sequence) noexcept {
  return {sequence._buffer, sequence._length};
}

/// The i-th element, or `otherwise` where the array is empty or too short: how arrays that may be
/// empty are read.
template <class Sequence>
[[nodiscard]] Element<Sequence> at_or(const Sequence& sequence,
                                      std::size_t i,
                                      Element<Sequence> otherwise) noexcept {
  return i < sequence._length ? sequence._buffer[i] : otherwise;
}

/// Points a sequence at the caller's array, which must live until the sample is written. Nothing is
/// copied, nothing will be freed. The caller keeps to the type's bound (stoss_v1_MAX_...).
template <class Sequence>
void lend(Sequence& sequence, std::span<const Element<Sequence>> elements) noexcept {
  // Writing only reads through the pointer; the C type has no const form.
  sequence._buffer = const_cast<Element<Sequence>*>(elements.data());
  sequence._length = static_cast<std::uint32_t>(elements.size());
  sequence._maximum = sequence._length;
  sequence._release = false;
}

/// The text in a generated bounded string.
template <std::size_t N>
[[nodiscard]] std::string_view text(const char (&bounded)[N]) noexcept {
  return {bounded, strnlen(bounded, N)};
}

/// Copies text into a generated bounded string, cut at its bound (never inside a UTF-8 character).
/// False when it was cut.
template <std::size_t N>
bool assign(char (&bounded)[N], std::string_view value) noexcept {
  std::size_t length = std::min(value.size(), N - 1);
  const bool whole = length == value.size();
  constexpr unsigned kContinuationMask = 0xC0U;
  constexpr unsigned kContinuation = 0x80U;
  while (!whole && length > 0 &&
         (static_cast<unsigned char>(value[length]) & kContinuationMask) == kContinuation) {
    --length;
  }
  std::memcpy(bounded, value.data(), length);
  std::memset(bounded + length, 0, N - length);
  return whole;
}

}  // namespace stoss::idl

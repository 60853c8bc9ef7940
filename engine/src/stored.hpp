// SPDX-License-Identifier: Apache-2.0
#pragma once

// Numbers of commands and options as a world in S keeps them.

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/types.hpp>

namespace stoss::engine::detail {

/// -0 and 0 are one state, so they are one bit pattern.
inline double canonical(double x) { return x == 0 ? 0.0 : x; }

// Not inlined: where GCC 12 vectorises two of these side by side, it takes a double that was
// narrowed to float and widened again for the double itself, and the low word is lost.
template <class S>
[[gnu::noinline]] DoubleWord<S> stored(double x) {
  const double value = canonical(x);
  if constexpr (std::is_same_v<S, float>) {
    const auto high = static_cast<float>(value);
    return {high, static_cast<float>(value - static_cast<double>(high))};
  } else {
    return {S(value), S(0)};
  }
}

template <class S>
DoubleWord2<S> stored(const Vector2& v) {
  return {stored<S>(v.x()), stored<S>(v.y())};
}

}  // namespace stoss::engine::detail

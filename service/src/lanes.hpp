// SPDX-License-Identifier: Apache-2.0
// Four doubles side by side as one number, for which the engine's double words serve as they do for
// one double: each lane is rounded as a double by itself is, so its bits do not depend on the
// instruction set, only the time that they take.
#pragma once

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/lanes.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace stoss::service {

inline constexpr std::size_t kLanes = 4;
using engine::Four;
using FourWords = std::uint64_t __attribute__((vector_size(32)));

struct Lanes {
  Four of;

  [[gnu::always_inline]] friend inline Lanes operator+(const Lanes& a, const Lanes& b) {
    return {a.of + b.of};
  }
  [[gnu::always_inline]] friend inline Lanes operator-(const Lanes& a, const Lanes& b) {
    return {a.of - b.of};
  }
  [[gnu::always_inline]] friend inline Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.of * b.of};
  }
};

}  // namespace stoss::service

/// Their rounding errors are carried along, as a double's are.
template <>
inline constexpr bool stoss::engine::kCompensated<stoss::service::Lanes> = true;

namespace stoss::service {

/// engine::two_prod() of each lane. Found by the engine's double words, as it stands beside Lanes.
[[gnu::always_inline]] inline engine::DoubleWord<Lanes> two_prod(const Lanes& a, const Lanes& b) {
  engine::DoubleWord<Lanes> product;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const engine::DoubleWord<double> lane = engine::two_prod(double{a.of[i]}, double{b.of[i]});
    product.hi.of[i] = lane.hi;
    product.lo.of[i] = lane.lo;
  }
  return product;
}

[[gnu::always_inline]] inline void store(double* to, const Lanes& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

/// Four vectors that lie in memory as rows of x.hi, x.lo, y.hi, y.lo.
[[gnu::always_inline]] inline engine::DoubleWord2<Lanes> side_by_side(
    const engine::DoubleWord2<double>& first,
    const engine::DoubleWord2<double>& second,
    const engine::DoubleWord2<double>& third,
    const engine::DoubleWord2<double>& fourth) {
  static_assert(sizeof first == sizeof(Four));
  Four a, b, c, d;
  std::memcpy(&a, &first, sizeof a);
  std::memcpy(&b, &second, sizeof b);
  std::memcpy(&c, &third, sizeof c);
  std::memcpy(&d, &fourth, sizeof d);
  engine::lanes::transpose(a, b, c, d);
  return {{{a}, {b}}, {{c}, {d}}};
}

/// Whole numbers below 2^52 as doubles: they are the last bits of those from 2^52 on.
[[gnu::always_inline]] inline Lanes to_doubles(const FourWords& whole) {
  constexpr double kTwo52 = 0x1p52;
  const Four two52 = Four{} + kTwo52;
  return {reinterpret_cast<Four>(reinterpret_cast<FourWords>(two52) | whole) - two52};
}

/// Has any lane a bit that is set?
[[gnu::always_inline]] inline bool any(const FourWords& words) {
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

}  // namespace stoss::service

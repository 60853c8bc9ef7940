// SPDX-License-Identifier: Apache-2.0
#pragma once

// Four doubles side by side, and what one double and four have in common, so that one formula
// serves both. Each lane is rounded as a double by itself is: the lanes of a result do not depend
// on the instruction set, only the time that they take.
//
// Public for those who evaluate what the engine tells, many motions at a time.

#include <cmath>
#include <cstdint>

// Without AVX compilers warn that four doubles are passed in another way than with it. Nothing here
// is passed: every function is inlined.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace stoss::engine {

using Four = double __attribute__((vector_size(32)));
using FourWords = std::int64_t __attribute__((vector_size(32)));

namespace lanes {

[[gnu::always_inline]] inline double magnitude(double x) { return std::abs(x); }
[[gnu::always_inline]] inline Four magnitude(const Four& x) {
  constexpr std::int64_t kAllButSign = 0x7fffffffffffffff;
  return reinterpret_cast<Four>(reinterpret_cast<FourWords>(x) & kAllButSign);
}

/// Square root; 0 below zero.
[[gnu::always_inline]] inline double root(double x) { return std::sqrt(x < 0 ? 0 : x); }
[[gnu::always_inline]] inline Four root(const Four& x) {
  const Four radicand = x < 0 ? Four{} : x;
#if __has_builtin(__builtin_elementwise_sqrt)
  return __builtin_elementwise_sqrt(radicand);
#elif defined(__AVX__)
  return __builtin_ia32_sqrtpd256(radicand);
#else
  return Four{std::sqrt(radicand[0]),
              std::sqrt(radicand[1]),
              std::sqrt(radicand[2]),
              std::sqrt(radicand[3])};
#endif
}

/// Which are below zero: a bit for each, the lowest for the first.
[[gnu::always_inline]] inline unsigned below_zero(const FourWords& x) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(reinterpret_cast<Four>(x)));
#else
  unsigned bits = 0;
  for (int lane = 0; lane < 4; ++lane) bits |= (x[lane] < 0 ? 1U : 0U) << lane;
  return bits;
#endif
}

/// Rows to columns: `a` gets the first of each, `b` the second and so on.
[[gnu::always_inline]] inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

}  // namespace lanes
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#include "fp_environment.hpp"

#include <atomic>
#include <cfenv>
#include <limits>

namespace stoss::service {

// Tried out rather than read from a control register, so that it holds on every processor. The
// atomics keep the compiler from doing the arithmetic itself.
bool fp_environment_is_exact() {
  const std::atomic<double> smallest_normal{std::numeric_limits<double>::min()};
  const std::atomic<double> half{0.5};
  const double subnormal = smallest_normal.load() * half.load();
  const std::atomic<double> kept{subnormal};
  return std::fegetround() == FE_TONEAREST && subnormal > 0 &&
         kept.load() / half.load() == smallest_normal.load();
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// The floating-point environment that exact results need: round to nearest, subnormals kept. A
// library built with -ffast-math can change it for the thread that loads it.
#pragma once

namespace stoss::service {

/// Whether the calling thread rounds to nearest and keeps subnormal numbers.
[[nodiscard]] bool fp_environment_is_exact();

}  // namespace stoss::service

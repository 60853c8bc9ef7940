// SPDX-License-Identifier: Apache-2.0
#pragma once

// How much a test does: a little in a normal run, as much as it is worth behind `deploy/test
// --long`, which sets STOSS_LONG.

#include "support/random.hpp"

#include <cstdint>

namespace stoss::test {

inline bool is_long_run() { return environment_number("STOSS_LONG", 0) != 0; }

inline std::uint64_t campaign(std::uint64_t normally, std::uint64_t in_long_runs) {
  return is_long_run() ? in_long_runs : normally;
}

}  // namespace stoss::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Processor time of the whole process: what else the machine does is not in it.

#include <time.h>

namespace stoss::bench {

inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace stoss::bench

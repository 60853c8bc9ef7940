// SPDX-License-Identifier: Apache-2.0
#pragma once

// Time that this thread has computed for: other programs on the machine do not count.

#include <time.h>

namespace stoss::client::accuracy {

class CpuClock {
 public:
  /// Seconds since this clock was made.
  [[nodiscard]] double seconds() const { return now() - start_; }

 private:
  static double now() {
    constexpr double kNanosecond = 1e-9;
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * kNanosecond;
  }
  double start_ = now();
};

}  // namespace stoss::client::accuracy

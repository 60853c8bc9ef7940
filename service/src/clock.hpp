// SPDX-License-Identifier: Apache-2.0
// Real time, which paces ticks and never reaches a trajectory.
#pragma once

#include <chrono>

namespace stoss::service {

using Nanoseconds = std::chrono::nanoseconds;

/// A monotonic clock. Thread-safe.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;
  /// Time since an arbitrary zero; never goes back.
  [[nodiscard]] virtual Nanoseconds now() const = 0;
};

/// CLOCK_MONOTONIC.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Nanoseconds now() const override {
    return std::chrono::steady_clock::now().time_since_epoch();
  }
};

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// The daemon's log: spdlog on standard error, with Cyclone's own messages in it.
#pragma once

#include "clock.hpp"

#include <cstdint>
#include <string>

namespace stoss::service {

/// Lets so many lines through at once, and so many a second after that. Under attack Cyclone writes
/// tens of thousands of lines a second.
class LineBudget {
 public:
  LineBudget(double burst, double per_second)
      : burst_(burst), per_second_(per_second), left_(burst) {}

  /// Whether a line may be written at `now`; one that may not is counted.
  bool take(Nanoseconds now);
  /// How many lines were held back since the last call.
  std::uint64_t take_suppressed();

 private:
  double burst_;
  double per_second_;
  double left_;
  Nanoseconds last_{0};
  std::uint64_t suppressed_ = 0;
};

/// Sets up the log. `level`: as --log-level has it.
void start_log(const std::string& level);

}  // namespace stoss::service

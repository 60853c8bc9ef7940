// SPDX-License-Identifier: Apache-2.0
#pragma once

// Whether errors have a sign: their mean against its own standard error.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace stoss::test {

/// Errors that are taken as the independent steps of a random walk.
class Steps {
 public:
  void add(double error) {
    ++count_;
    sum_ += error;
    squares_ += error * error;
    worst_ = std::max(worst_, std::fabs(error));
  }

  [[nodiscard]] double mean() const { return sum_ / count(); }
  /// Root of the mean square: a step's size, a bias included.
  [[nodiscard]] double size() const { return std::sqrt(squares_ / count()); }
  /// Standard error of the mean, if there is no bias.
  [[nodiscard]] double error() const { return size() / std::sqrt(count()); }
  [[nodiscard]] double worst() const { return worst_; }

 private:
  [[nodiscard]] double count() const { return static_cast<double>(count_); }

  std::uint64_t count_ = 0;
  double sum_ = 0;
  double squares_ = 0;
  double worst_ = 0;
};

/// Prints them, and expects their mean within four standard errors of zero: one false alarm in
/// 16,000 seeds.
inline void expect_no_bias(const char* what, const Steps& steps) {
  std::printf("%s: mean %+.2g +- %.2g (%+.2f standard errors), step %.3g, worst %.3g\n",
              what,
              steps.mean(),
              steps.error(),
              steps.mean() / steps.error(),
              steps.size(),
              steps.worst());
  EXPECT_LE(std::fabs(steps.mean()), 4 * steps.error()) << what;
}

/// Groups of steps that share what might bias them all alike: the mean square of their means, in
/// standard errors, is 1 +- sqrt(2 / groups) if none does.
class GroupsOfSteps {
 public:
  void add(const Steps& steps) {
    const double off = steps.mean() / steps.error();
    ++count_;
    squares_ += off * off;
  }

  void expect_no_bias(const char* what) const {
    const auto count = static_cast<double>(count_);
    const double spread = squares_ / count;
    const double error = std::sqrt(2 / count);
    std::printf("%s: the means' square is %.3f +- %.3f of chance\n", what, spread, error);
    EXPECT_LE(spread, 1 + 4 * error) << what;
  }

 private:
  std::uint64_t count_ = 0;
  double squares_ = 0;
};

}  // namespace stoss::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Means with error bars, for comparing runs with theory.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace stoss::test {

/// Values that are taken as independent: runs of different seeds, or long batches of one run.
class Sample {
 public:
  void add(double value) { values_.push_back(value); }
  [[nodiscard]] std::size_t size() const { return values_.size(); }

  [[nodiscard]] double mean() const {
    double sum = 0;
    for (const double value : values_) sum += value;
    return sum / static_cast<double>(values_.size());
  }
  /// Standard deviation of one value.
  [[nodiscard]] double deviation() const {
    const double centre = mean();
    double sum = 0;
    for (const double value : values_) sum += (value - centre) * (value - centre);
    return std::sqrt(sum / static_cast<double>(values_.size() - 1));
  }
  /// Standard error of the mean.
  [[nodiscard]] double error() const {
    return deviation() / std::sqrt(static_cast<double>(values_.size()));
  }

 private:
  std::vector<double> values_;
};

/// Prints both, and expects them within four standard errors and, for what theory neglects,
/// `systematic` (a part of the theory's value).
inline void expect_agreement(const char* what,
                             const Sample& measured,
                             double theory,
                             double systematic = 0) {
  const double off = measured.mean() - theory;
  std::printf("%s: %.6g +- %.2g, theory %.6g (%+.2f standard errors, %+.2g of it)\n",
              what,
              measured.mean(),
              measured.error(),
              theory,
              off / measured.error(),
              off / theory);
  EXPECT_LE(std::abs(off), 4 * measured.error() + systematic * std::abs(theory)) << what;
}

}  // namespace stoss::test

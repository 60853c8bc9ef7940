// SPDX-License-Identifier: Apache-2.0
// The exact answers: contact times to 400 bits from the very words that the kernels were given, and
// the bookkeeping that measures the kernels against them in units in the last place.
// Thread-safety: none. Trusted because the inputs are exact in MPFR and nothing here is rearranged:
// the textbook quadratic is solved with 240 bits to spare over the worst cancellation tested.
#pragma once

#include "contact_time/contact_time.hpp"
#include "stoss/engine/double_word.hpp"

#include <boost/multiprecision/mpfr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stoss::test {

using Real = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<120, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

struct Real2 {
  Real x, y;
};

inline Real dot(const Real2& a, const Real2& b) { return a.x * b.x + a.y * b.y; }
inline Real cross(const Real2& a, const Real2& b) { return a.x * b.y - a.y * b.x; }

template <class S>
Real exact(const engine::DoubleWord<S>& x) {
  return Real(x.hi) + Real(x.lo);
}

template <class S>
Real2 exact(const engine::DoubleWord2<S>& a) {
  return {exact(a.x), exact(a.y)};
}

template <class S>
Real exact(const engine::Duration<S>& t) {
  return Real(t.hi) + Real(t.lo);
}

/// The nearest S; with `low_word` the nearest double word.
template <class S>
engine::DoubleWord<S> rounded(const Real& x, bool low_word) {
  const S hi = x.convert_to<S>();
  const S lo = low_word ? Real(x - Real(hi)).convert_to<S>() : S(0);
  return {hi, lo};
}

template <class S>
engine::DoubleWord2<S> rounded(const Real2& a, bool low_word) {
  return {rounded<S>(a.x, low_word), rounded<S>(a.y, low_word)};
}

/// First t >= 0 with |p + v t| <= d and decreasing.
inline std::optional<Real> exact_pair_contact(const Real2& p, const Real2& v, const Real& d) {
  const Real b = dot(p, v);
  if (b >= 0) return std::nullopt;
  const Real c = dot(p, p) - d * d;
  if (c <= 0) return Real(0);
  const Real moment = cross(p, v);
  const Real discriminant = dot(v, v) * d * d - moment * moment;
  if (discriminant <= 0) return std::nullopt;
  return Real(c / (sqrt(discriminant) - b));
}

struct ExactFaceContact {
  Real t;
  Real s;  ///< place on the edge, 0 at its start and 1 at its end
};

/// First t >= 0 at which the disk touches the infinite line through the wall while approaching.
inline std::optional<ExactFaceContact> exact_line_contact(const Real2& p,
                                                          const Real2& v,
                                                          const Real2& edge,
                                                          const Real& radius) {
  Real h = cross(edge, p);
  Real w = cross(edge, v);
  if (h < 0) {
    h = -h;
    w = -w;
  }
  if (w >= 0) return std::nullopt;
  const Real gap = h - radius * sqrt(dot(edge, edge));
  const Real t = gap <= 0 ? Real(0) : Real(gap / -w);
  const Real2 at{p.x + v.x * t, p.y + v.y * t};
  return ExactFaceContact{t, Real(dot(edge, at) / dot(edge, edge))};
}

/// |approximate - truth| in units in the last place that S has at the truth.
template <class S>
double error_in_ulp(const Real& approximate, const Real& truth) {
  if (truth == 0) return approximate == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  int exponent = 0;
  frexp(truth, &exponent);
  const int lowest = std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits;
  const Real ulp = ldexp(Real(1), std::max(exponent - std::numeric_limits<S>::digits, lowest));
  return Real(abs(approximate - truth) / ulp).template convert_to<double>();
}

/// Errors of one family of cases.
class Census {
 public:
  explicit Census(std::string family) : family_(std::move(family)) {}

  /// Compares an answer with the truth; a truth beyond the largest S counts as none.
  template <class S>
  void add(const std::optional<engine::Duration<S>>& answer, const std::optional<Real>& truth) {
    ++cases_;
    if (truth && *truth > Real(std::numeric_limits<S>::max())) {
      ++overflows_;
      false_ += answer ? 1 : 0;
    } else if (answer && truth) {
      add_error(error_in_ulp<S>(exact(*answer), *truth));
    } else {
      missed_ += truth ? 1 : 0;
      false_ += answer ? 1 : 0;
    }
  }

  void add_error(double ulp) { errors_.push_back(ulp); }

  [[nodiscard]] double max() {
    return errors_.empty() ? 0.0 : *std::max_element(errors_.begin(), errors_.end());
  }

  [[nodiscard]] double quantile(double fraction) {
    if (errors_.empty()) return 0.0;
    const auto rank =
        static_cast<std::ptrdiff_t>(fraction * static_cast<double>(errors_.size() - 1));
    std::nth_element(errors_.begin(), errors_.begin() + rank, errors_.end());
    return errors_[static_cast<std::size_t>(rank)];
  }

  [[nodiscard]] std::int64_t missed() const { return missed_; }
  [[nodiscard]] std::int64_t falses() const { return false_; }
  [[nodiscard]] std::size_t hits() const { return errors_.size(); }

  void print() {
    std::printf("%-42s cases %9lld hits %9zu  max %9.3g ulp  p99.9 %9.3g  missed %lld false %lld",
                family_.c_str(),
                static_cast<long long>(cases_),
                errors_.size(),
                max(),
                quantile(0.999),
                static_cast<long long>(missed_),
                static_cast<long long>(false_));
    if (overflows_ > 0) std::printf("  beyond range %lld", static_cast<long long>(overflows_));
    std::printf("\n");
  }

 private:
  std::string family_;
  std::vector<double> errors_;
  std::int64_t cases_ = 0;
  std::int64_t missed_ = 0;
  std::int64_t false_ = 0;
  std::int64_t overflows_ = 0;
};

}  // namespace stoss::test

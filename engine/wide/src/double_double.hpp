// SPDX-License-Identifier: Apache-2.0
#pragma once

// libqd's double-double (106 bits, 32 digits) with the conversions that a scalar of the engine has.
//
// Source: Hida, Li, Bailey, "Algorithms for quad-double precision floating point arithmetic", ARITH
// 15 (2001); the arithmetic is libqd's, only the face is ours.

#include <qd/dd_real.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace stoss::wide {

class DoubleDouble {
 public:
  DoubleDouble() : value_(0.0) {}
  DoubleDouble(double x) : value_(x) {}
  explicit DoubleDouble(int x) : value_(x) {}
  explicit DoubleDouble(float x) : value_(static_cast<double>(x)) {}
  explicit DoubleDouble(const dd_real& x) : value_(x) {}

  explicit operator double() const { return value_.x[0]; }
  const dd_real& value() const { return value_; }

  DoubleDouble operator-() const { return DoubleDouble(-value_); }
  DoubleDouble& operator+=(const DoubleDouble& o) { return *this = *this + o; }
  DoubleDouble& operator-=(const DoubleDouble& o) { return *this = *this - o; }
  DoubleDouble& operator*=(const DoubleDouble& o) { return *this = *this * o; }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    return DoubleDouble(dd_real::ieee_add(a.value_, b.value_));
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return DoubleDouble(dd_real::ieee_add(a.value_, -b.value_));
  }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    return DoubleDouble(a.value_ * b.value_);
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    return DoubleDouble(dd_real::accurate_div(a.value_, b.value_));
  }
  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.value_ == b.value_;
  }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.value_ < b.value_;
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.value_ <= b.value_;
  }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

 private:
  dd_real value_;
};

inline DoubleDouble sqrt(const DoubleDouble& a) {
  return a == DoubleDouble(0.0) ? a : DoubleDouble(::sqrt(a.value()));
}
inline DoubleDouble abs(const DoubleDouble& a) { return a < DoubleDouble(0.0) ? -a : a; }

}  // namespace stoss::wide

template <>
class std::numeric_limits<stoss::wide::DoubleDouble> {
 public:
  static constexpr bool is_specialized = true;
  static constexpr int digits = 104;
  static stoss::wide::DoubleDouble epsilon() { return {0x1p-104}; }
  static stoss::wide::DoubleDouble max() { return {std::numeric_limits<double>::max()}; }
  static stoss::wide::DoubleDouble infinity() { return {std::numeric_limits<double>::infinity()}; }
};

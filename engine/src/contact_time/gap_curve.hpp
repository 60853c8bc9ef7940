// SPDX-License-Identifier: Apache-2.0
// The gap of two disks along a parabola.
//   (1) F(t) = |x(t)|^2 - d^2,  x(t) = p + v t + a t^2 / 2,  u = x' = v + a t   p [m], v [m/s],
//       a [m/s^2] of b from a; d: reach [m]; t [s]
//   (2) F'/2 = B = x . u,   F''/2 = Q = |u|^2 + x . a,   Q' = 3 u . a
//   (3) F(t) = c + w . (p + x),  w = x - p,  c = |p|^2 - d^2     (near the start, where F cancels)
// F is a quartic. The roots of Q, a quadratic, part the cubic B into monotone pieces;
// gap_search.hpp does the rest. Source: elementary. Deviation: nothing is expanded into
// coefficients. F, B and Q come from p, v and a at each t, in one
//   word with a bound of its error, and in two words; (3) has its c in three words.
// Accuracy: of 10^5 cases in each of 14 families the worst root is off by 0.500 ulp; none
//   missed, none false: contact_time/accelerated_test.cpp.
// Preconditions: sizes within kSizeMin and kSizeMax, a != 0, no NaN.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/gap_search.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>

namespace stoss::engine::detail {

template <class S>
class ParabolicGap {
 public:
  ParabolicGap(const AcceleratedMotion<S>& motion, const DoubleWord<S>& reach) noexcept;

  [[nodiscard]] GapSample<S> coarse(const S& t) const noexcept;
  [[nodiscard]] GapSample<S> fine(const S& t) const noexcept;
  [[nodiscard]] int trend() const noexcept;
  [[nodiscard]] Inflections<S> inflections() const noexcept;

  [[nodiscard]] const S& gap_now() const noexcept { return gap_now_; }
  [[nodiscard]] const S& slope_now() const noexcept { return slope_now_; }
  [[nodiscard]] const S& reach2() const noexcept { return reach2_; }
  /// What it takes to fall the distance, or to turn.
  [[nodiscard]] S natural_time() const noexcept {
    using std::sqrt;
    return S(sqrt((p1_ + reach_.hi) / a1_)) + v1_ / a1_;
  }
  /// Does a step of that size leave no more than a cubic makes of it?
  [[nodiscard]] static constexpr bool settles(const S&) noexcept { return true; }

 private:
  const AcceleratedMotion<S>& motion_;
  const DoubleWord<S>& reach_;
  S p1_, v1_, a1_;  ///< |x| + |y| of p, v, a
  S reach2_;
  S gap_now_;     ///< c
  S slope_now_;   ///< p . v
  bool is_near_;  ///< c has lost a bit or more
};

template <class S>
ParabolicGap<S>::ParabolicGap(const AcceleratedMotion<S>& motion,
                              const DoubleWord<S>& reach) noexcept
    : motion_(motion),
      reach_(reach),
      p1_(sum_norm(motion.position)),
      v1_(sum_norm(motion.velocity)),
      a1_(sum_norm(motion.acceleration)),
      reach2_(S(reach.hi * reach.hi)),
      gap_now_{},
      slope_now_(rounded_dot(motion.position, motion.velocity)),
      is_near_(false) {
  const DoubleWord2<S>& p = motion.position;
  const S distance2 = p.x.hi * p.x.hi + p.y.hi * p.y.hi;
  const S low = p.x.hi * p.x.lo + p.y.hi * p.y.lo - reach.hi * reach.lo;
  gap_now_ = (distance2 - reach2_) + (low + low);
  is_near_ = !(gap_now_ >= S(0.5) * distance2);
  if (is_near_) gap_now_ = cancelling_gap(p, reach, distance2);
}

/// (1) and (2) in one word. The errors: 4 eps of each term of x, 2 of each product.
template <class S>
GapSample<S> ParabolicGap<S>::coarse(const S& t) const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const S half = S(0.5) * t;
  const S wx = t * (v.x.hi + half * a.x.hi), wy = t * (v.y.hi + half * a.y.hi);
  const S x = p.x.hi + wx, y = p.y.hi + wy;
  const S ux = v.x.hi + t * a.x.hi, uy = v.y.hi + t * a.y.hi;
  const S way = t * (v1_ + half * a1_), speed = v1_ + t * a1_;
  const S size = magnitude(x) + magnitude(y);
  const S eps = epsilon<S>(), misplaced = S(4) * eps * (p1_ + way);
  GapSample<S> s;
  if (is_near_ && S(4) * way < p1_) {
    s.value = gap_now_ + (wx * (p.x.hi + x) + wy * (p.y.hi + y));
    s.value_error = eps * (magnitude(gap_now_) + magnitude(s.value) + S(32) * way * p1_);
  } else {
    s.value = (x * x + y * y) - reach2_;
    s.value_error = misplaced * (size + size + misplaced) + S(4) * eps * (size * size + reach2_);
  }
  s.slope = x * ux + y * uy;
  s.slope_error = (misplaced + S(4) * eps * size) * speed;
  s.bend = (ux * ux + uy * uy) + (x * a.x.hi + y * a.y.hi);
  s.bend_rate = S(3) * (ux * a.x.hi + uy * a.y.hi);
  return s;
}

/// (1) and (2) in two words, rounded to one.
template <class S>
GapSample<S> ParabolicGap<S>::fine(const S& t) const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const S half = S(0.5) * t;
  const DoubleWord2<S> w = (v + a * half) * t, x = p + w, u = v + a * t;
  const S way = t * (v1_ + half * a1_), size = sum_norm(x);
  const S eps2 = epsilon<S>() * epsilon<S>();
  GapSample<S> s;
  if (is_near_ && S(4) * way < p1_) {
    s.value = to_scalar(gap_in_three_words(p, reach_) + dot(w, p + x));
    s.value_error = eps2 * S(32) * way * p1_;
  } else {
    s.value = to_scalar(square_norm(x) - square(reach_));
    s.value_error = S(8) * eps2 * ((p1_ + way) * size + reach2_);
  }
  s.slope = rounded_dot(x, u);
  s.slope_error = S(8) * eps2 * (p1_ + way) * (v1_ + t * a1_);
  s.bend = (u.x.hi * u.x.hi + u.y.hi * u.y.hi) + (x.x.hi * a.x.hi + x.y.hi * a.y.hi);
  s.bend_rate = S(3) * (u.x.hi * a.x.hi + u.y.hi * a.y.hi);
  return s;
}

/// The sign of the first derivative of F at t = 0 that is not zero, where F' counts as zero if
/// rounding can feign it. Positive if all vanish.
template <class S>
int ParabolicGap<S>::trend() const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const S terms = magnitude(S(p.x.hi * v.x.hi)) + magnitude(S(p.y.hi * v.y.hi));
  const bool low_words = has_low_words(p) || has_low_words(v);
  const S feigned = feigned_rate(S(terms), low_words, motion_.grain, p1_);
  if (slope_now_ < -feigned) return -1;
  if (slope_now_ > feigned) return 1;
  const int bend = sign(square_norm(v) + dot(p, a));
  if (bend != 0) return bend;
  return sign(dot(v, a)) < 0 ? -1 : 1;
}

/// Q(t) = Q(0) + 3 v . a t + 3/2 |a|^2 t^2
template <class S>
Inflections<S> ParabolicGap<S>::inflections() const noexcept {
  using std::sqrt;
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const S constant = (v.x.hi * v.x.hi + v.y.hi * v.y.hi) + rounded_dot(p, a);
  const S linear = S(3) * rounded_dot(v, a) * S(0.5);
  const S quadratic = S(3) * (a.x.hi * a.x.hi + a.y.hi * a.y.hi) * S(0.5);
  Inflections<S> bends;
  const S middle = -linear / quadratic;
  bends.first = bends.second = middle;
  const S d = linear * linear - quadratic * constant;
  bends.exist = d > S(0);
  if (!bends.exist) return bends;
  const S q = linear < S(0) ? S(sqrt(d) - linear) : S(-(linear + sqrt(d)));
  const S one = q / quadratic, other = constant / q;
  bends.first = one < other ? one : other;
  bends.second = one < other ? other : one;
  return bends;
}

}  // namespace stoss::engine::detail

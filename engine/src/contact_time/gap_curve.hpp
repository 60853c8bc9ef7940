// SPDX-License-Identifier: Apache-2.0
// The gap of two disks along a parabola, piece by piece between its stationary points.
//   (1) F(t) = |x(t)|^2 - d^2,  x(t) = p + v t + a t^2 / 2,  u = x' = v + a t   p [m], v [m/s],
//       a [m/s^2] of b from a; d: reach [m]; t [s]
//   (2) F'/2 = B = x . u,   F''/2 = Q = |u|^2 + x . a,   Q' = 3 u . a
//   (3) F(t) = c + w . (p + x),  w = x - p,  c = |p|^2 - d^2     (near the start, where F cancels)
//   (4) F + 2 B s + Q s^2 = 0  =>  s = F / (sqrt(B^2 - Q F) - B), or -(B + sqrt(B^2 - Q F)) / Q
//   (5) B + Q s + Q' s^2 / 2 = 0  =>  s = -2 B / (Q +- sqrt(Q^2 - 2 B Q'))
// F is a quartic. The roots of Q, a quadratic, part the cubic B into monotone pieces; the roots of
// B part F into monotone pieces; a falling piece has one contact if it starts above zero and ends
// below. (4) and (5) are the steps to the next iterate: the one is exact for straight motion.
// Source: the pieces: Yuksel, High-performance polynomial root finding, Proc. ACM Comput. Graph. 5
//   (2022) 7; the steps: Traub, Iterative Methods for the Solution of Equations (1964).
// Deviation: nothing is expanded into coefficients. F, B and Q come from p, v and a at each t,
//   in one word with a bound of its error, and in two words where the sign is not certain and for
//   the last steps; (3) has its c in three words. A bracket guards each iteration.
// Accuracy: of 10^5 cases in each of 14 families the worst root is off by 0.500 ulp; none
//   missed, none false: contact_time/accelerated_test.cpp.
// Preconditions: sizes within kSizeMin and kSizeMax, a != 0, no NaN.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine::detail {

/// (1) and (2) at one instant, and bounds of what rounding adds to the first two.
template <class S>
struct GapSample {
  S value{};
  S slope{};
  S bend{};
  S bend_rate{};
  S value_error{};
  S slope_error{};
};

/// Where a monotone piece of B crosses zero: from below, or from above.
enum class Crossing { Rising, Falling };

/// A stationary point of F, and F there.
template <class S>
struct Turn {
  Duration<S> t;
  S value{};
};

/// The roots of Q, in order.
template <class S>
struct Inflections {
  bool exist = false;
  S first{};
  S second{};
};

/// Iterations of a bracketed search. Halving alone needs fewer than 2^10 from any bracket of
/// doubles; the steps (4) and (5) need 3 to 6. Chosen; no unit. Larger: no effect; smaller: roots
/// that nearly coincide end on a bracket that is still wide.
inline constexpr int kSearchStepsMax = 1200;

/// A step of less than this share of t leaves an error of its cube, which a sample in double words
/// mends. Chosen; no unit. Larger: one sample in double words more; smaller: one in single more.
inline constexpr double kCoarseStep = 0x1p-18;

/// An extreme value of F below this share of |x|^2 + d^2 is formed in double words. Chosen; no
/// unit. Larger: slower; smaller: trusts stationary points that one word has misplaced.
inline constexpr double kShallow = 0x1p-20;

/// Newton steps in double words to a stationary point that is good to rounding already; the second
/// confirms the first. Chosen; no unit. Larger: no effect; smaller: coarse turns in far flights.
inline constexpr int kRefinements = 4;

template <class S>
class GapCurve {
 public:
  GapCurve(const AcceleratedMotion<S>& motion, const DoubleWord<S>& reach) noexcept;

  /// The infimum of the t <= t_max with F <= 0 and falling.
  [[nodiscard]] std::optional<Duration<S>> first_contact(const S& t_max) const noexcept;

 private:
  [[nodiscard]] GapSample<S> coarse(const S& t) const noexcept;
  [[nodiscard]] GapSample<S> fine(const S& t) const noexcept;
  [[nodiscard]] int slope_sign(const S& t) const noexcept;
  [[nodiscard]] int trend() const noexcept;
  [[nodiscard]] Inflections<S> inflections() const noexcept;
  [[nodiscard]] S stationary_between(S low, S high, S start, Crossing crossing) const noexcept;
  [[nodiscard]] S lowest_beyond(const S& start) const noexcept;
  [[nodiscard]] Turn<S> turn_at(const S& t) const noexcept;
  [[nodiscard]] Turn<S> refined_turn(S t) const noexcept;
  [[nodiscard]] Duration<S> root_between(S low, S high, S start) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> fall(const S& top, const S& bottom) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> first_fall(const Inflections<S>& bends,
                                                      bool hump,
                                                      const S& t_max) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> second_fall(const Inflections<S>& bends) const noexcept;

  const AcceleratedMotion<S>& motion_;
  const DoubleWord<S>& reach_;
  S p1_, v1_, a1_;  ///< |x| + |y| of p, v, a
  S reach2_;
  S gap_now_;     ///< c
  S slope_now_;   ///< p . v
  bool is_near_;  ///< c has lost a bit or more
};

template <class S>
GapCurve<S>::GapCurve(const AcceleratedMotion<S>& motion, const DoubleWord<S>& reach) noexcept
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
GapSample<S> GapCurve<S>::coarse(const S& t) const noexcept {
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
GapSample<S> GapCurve<S>::fine(const S& t) const noexcept {
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

template <class S>
int GapCurve<S>::slope_sign(const S& t) const noexcept {
  GapSample<S> s = coarse(t);
  if (!(magnitude(s.slope) > s.slope_error)) s = fine(t);
  return s.slope > S(0) ? 1 : (s.slope < S(0) ? -1 : 0);
}

/// The sign of the first derivative of F at t = 0 that is not zero, where F' counts as zero if
/// rounding can feign it. Positive if all vanish.
template <class S>
int GapCurve<S>::trend() const noexcept {
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
Inflections<S> GapCurve<S>::inflections() const noexcept {
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

/// The root of B between `low` and `high`, good to the cube of kCoarseStep or to rounding.
template <class S>
S GapCurve<S>::stationary_between(S low, S high, S start, Crossing crossing) const noexcept {
  using std::sqrt;
  const bool rising = crossing == Crossing::Rising;
  S t = start;
  for (int i = 0; i < kSearchStepsMax; ++i) {
    const GapSample<S> s = coarse(t);
    if (!(magnitude(s.slope) > s.slope_error)) break;
    ((s.slope < S(0)) == rising ? low : high) = t;
    const S d = s.bend * s.bend - S(2) * s.slope * s.bend_rate;
    const S root = d > S(0) ? S(sqrt(d)) : S(0);
    const S step = S(-2) * s.slope / (rising ? S(s.bend + root) : S(s.bend - root));
    S next = t + step;
    const bool steps = next > low && next < high;
    if (!steps) next = S(0.5) * (low + high);
    if (next == t || !(low < next && next < high)) break;
    t = next;
    if (steps && magnitude(step) <= S(kCoarseStep) * t) break;
  }
  return t;
}

/// The root of B beyond `start`, where B < 0 and from where on B is convex.
template <class S>
S GapCurve<S>::lowest_beyond(const S& start) const noexcept {
  using std::sqrt;
  const GapSample<S> s = coarse(start);
  const S d = s.bend * s.bend - S(2) * s.slope * s.bend_rate;
  // B exceeds its parabola (5), so that the parabola's root is an upper bound.
  S step = S(-2) * s.slope / (s.bend + S(sqrt(larger(d, S(0)))));
  const S natural = S(sqrt((p1_ + reach_.hi) / a1_)) + v1_ / a1_;
  if (!(step > S(0)) || !is_finite(step)) step = natural;
  S high = start + step;
  for (int i = 0; i < kSearchStepsMax && coarse(high).slope < S(0); ++i) {
    step = step + step;
    high = start + step;
  }
  return stationary_between(start, S(high + step), high, Crossing::Rising);
}

/// The stationary point next to `t` in double words.
template <class S>
Turn<S> GapCurve<S>::refined_turn(S t) const noexcept {
  Turn<S> turn;
  for (int i = 0; i < kRefinements; ++i) {
    const GapSample<S> s = fine(t);
    S rest = -s.slope / s.bend;
    if (!(magnitude(rest) <= S(0.5) * t)) rest = S(0);
    const DoubleWord<S> sum = two_sum(t, rest);
    turn = {Duration<S>{sum.hi, sum.lo}, S(s.value + s.slope * rest)};
    if (magnitude(turn.value) <= s.value_error) turn.value = S(0);
    if (sum.hi == t) break;
    t = sum.hi;
  }
  return turn;
}

/// F at the stationary point next to `t`, its sign certain.
template <class S>
Turn<S> GapCurve<S>::turn_at(const S& t) const noexcept {
  const GapSample<S> s = coarse(t);
  const S rest = -s.slope / s.bend;
  const S value = magnitude(rest) <= S(kCoarseStep) * t ? S(s.value + s.slope * rest) : s.value;
  const S unsure = S(kShallow) * (magnitude(s.value) + reach2_ + reach2_) + S(4) * s.value_error;
  if (magnitude(value) > unsure) return {Duration<S>{t, S(0)}, value};
  return refined_turn(t);
}

/// The contact on a falling piece with F(low) > 0 and a negative F towards `high`.
template <class S>
Duration<S> GapCurve<S>::root_between(S low, S high, S start) const noexcept {
  using std::sqrt;
  const S eps = epsilon<S>();
  bool is_fine = false;
  S t = start;
  for (int i = 0; i < kSearchStepsMax; ++i) {
    GapSample<S> s = is_fine ? fine(t) : coarse(t);
    if (!is_fine && !(magnitude(s.value) > s.value_error)) {
      is_fine = true;
      s = fine(t);
    }
    const bool past_bottom = s.slope > S(0) && s.bend > S(0);
    (s.value > S(0) && !past_bottom ? low : high) = t;
    const S d = s.slope * s.slope - s.bend * s.value;
    const S root = d > S(0) ? S(sqrt(d)) : S(0);
    const S step = s.slope <= S(0) ? S(s.value / (root - s.slope)) : S(-(s.slope + root) / s.bend);
    const S size = magnitude(step);
    const bool models = d > S(0);
    if (is_fine && models) {
      const bool is_small = size * size <= eps * t * t &&
                            size * size * (s.bend * s.bend) <= eps * (s.slope * s.slope);
      if (is_small || size <= eps * t) {
        const DoubleWord<S> sum = two_sum(t, step);
        return {sum.hi, sum.lo};
      }
    }
    S next = t + step;
    if (!models || !(next > low && next < high)) {
      next = S(0.5) * (low + high);
      if (!(low < next && next < high)) break;
    } else if (size <= S(kCoarseStep) * next) {
      is_fine = true;
    }
    t = next;
  }
  return {t, S(0)};
}

/// The contact on the falling piece from `top`, where F > 0, to the stationary point at `bottom`.
template <class S>
std::optional<Duration<S>> GapCurve<S>::fall(const S& top, const S& bottom) const noexcept {
  const Turn<S> lowest = turn_at(bottom);
  if (!(lowest.value < S(0))) return std::nullopt;
  const GapSample<S> s = coarse(top);
  const S square_slope = s.slope * s.slope;
  const bool from_top = square_slope - s.bend * s.value > S(0.5) * square_slope;
  const S end = larger(lowest.t.hi, bottom);
  return root_between(top, end, from_top ? top : lowest.t.hi);
}

/// The contact before F first turns.
template <class S>
std::optional<Duration<S>> GapCurve<S>::first_fall(const Inflections<S>& bends,
                                                   bool hump,
                                                   const S& t_max) const noexcept {
  const S zero(0);
  if (hump) {
    return fall(zero, stationary_between(zero, bends.first, zero, Crossing::Rising));
  }
  if (is_finite(t_max)) {  // Still falling at t_max: its sign there decides.
    const GapSample<S> last = coarse(t_max);
    if (last.slope < -last.slope_error) {
      if (last.value > last.value_error) return std::nullopt;
      if (last.value < -last.value_error) return root_between(zero, t_max, zero);
    }
  }
  if (!(bends.second > zero)) return fall(zero, lowest_beyond(zero));
  if (bends.exist || !(slope_sign(bends.second) > 0))
    return fall(zero, lowest_beyond(bends.second));
  return fall(zero, stationary_between(zero, bends.second, zero, Crossing::Rising));
}

/// The contact between the highest and the second lowest point of F, around the second inflection.
template <class S>
std::optional<Duration<S>> GapCurve<S>::second_fall(const Inflections<S>& bends) const noexcept {
  const S high = bends.second;
  GapSample<S> s = coarse(high);
  if (!(magnitude(s.value) > s.value_error)) s = fine(high);
  if (s.value > S(0)) return fall(high, lowest_beyond(high));
  const S low = larger(bends.first, S(0));
  const Turn<S> top =
      turn_at(stationary_between(low, high, S(0.5) * (low + high), Crossing::Falling));
  if (!(top.value > S(0))) return refined_turn(top.t.hi).t;
  return root_between(top.t.hi, high, top.t.hi);
}

template <class S>
std::optional<Duration<S>> GapCurve<S>::first_contact(const S& t_max) const noexcept {
  const S zero(0);
  bool falls = slope_now_ < zero;
  if (gap_now_ <= zero) {
    if (trend() < 0) return Duration<S>{};
    falls = false;
  }
  const Inflections<S> bends = inflections();
  const bool twice = bends.exist && bends.second > zero;
  if (!falls && !twice) return std::nullopt;
  const bool hump = falls && twice && bends.first > zero && slope_sign(bends.first) > 0;
  std::optional<Duration<S>> t;
  if (falls) t = first_fall(bends, hump, t_max);
  if (!t && (hump || !falls) && !(bends.first > t_max) && slope_sign(bends.second) < 0) {
    t = second_fall(bends);
  }
  if (t && is_later(*t, t_max)) return std::nullopt;
  return t;
}

}  // namespace stoss::engine::detail

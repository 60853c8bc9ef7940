// SPDX-License-Identifier: Apache-2.0
// The first contact of two disks along a curve, piece by piece between the stationary points of
// their gap.
//   (1) F(t) = |x(t)|^2 - d^2,  u = x'    d: reach [m]; x(t) [m] of b from a; t [s]
//   (2) F'/2 = B = x . u,   F''/2 = Q,   Q' = F'''/2
//   (3) F + 2 B s + Q s^2 = 0  =>  s = F / (sqrt(B^2 - Q F) - B), or -(B + sqrt(B^2 - Q F)) / Q
//   (4) B + Q s + Q' s^2 / 2 = 0  =>  s = -2 B / (Q +- sqrt(Q^2 - 2 B Q'))
// What a `Gap` promises: no more than two instants, its inflections, part the time into pieces on
// which B, but for a positive factor, rises, falls and rises; in the end F rises. The roots of B
// part F into monotone pieces; a falling piece has one contact if it starts above zero and ends
// below. (3) and (4) are the steps to the next iterate: the one is exact for straight motion.
// Source: the pieces: Yuksel, High-performance polynomial root finding, Proc. ACM Comput. Graph. 5
//   (2022) 7; the steps: Traub, Iterative Methods for the Solution of Equations (1964).
// Deviation: nothing is expanded into coefficients. A Gap samples F, B and Q at each t, coarsely
// with
//   a bound of the error, and finely where the sign is not certain and for the last steps. A
//   bracket guards each iteration.
// Accuracy: that of the gaps: gap_curve.hpp, drag_curve.hpp.
// Preconditions: those of the gaps.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
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
/// doubles; the steps (3) and (4) need 3 to 6. Chosen; no unit. Larger: no effect; smaller: roots
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

template <class S, class Gap>
class GapSearch {
 public:
  explicit GapSearch(const Gap& gap) noexcept : gap_(gap) {}

  /// The infimum of the t <= t_max with F <= 0 and falling.
  [[nodiscard]] std::optional<Duration<S>> first_contact(const S& t_max) const noexcept;

 protected:
  [[nodiscard]] int slope_sign(const S& t) const noexcept;
  [[nodiscard]] S stationary_between(S low, S high, S start, Crossing crossing) const noexcept;
  [[nodiscard]] S lowest_beyond(const S& start) const noexcept;
  [[nodiscard]] Turn<S> turn_at(const S& t) const noexcept;
  [[nodiscard]] Turn<S> refined_turn(S t) const noexcept;
  [[nodiscard]] Duration<S> root_between(S low, S high, S start, Crossing crossing) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> fall(const S& top, const S& bottom) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> first_fall(const Inflections<S>& bends,
                                                      bool hump,
                                                      const S& t_max) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> second_fall(const Inflections<S>& bends) const noexcept;

  const Gap& gap_;
};

template <class S, class Gap>
int GapSearch<S, Gap>::slope_sign(const S& t) const noexcept {
  GapSample<S> s = gap_.coarse(t);
  if (!(magnitude(s.slope) > s.slope_error)) s = gap_.fine(t);
  return s.slope > S(0) ? 1 : (s.slope < S(0) ? -1 : 0);
}

/// The root of B between `low` and `high`, good to the cube of kCoarseStep or to rounding.
template <class S, class Gap>
S GapSearch<S, Gap>::stationary_between(S low, S high, S start, Crossing crossing) const noexcept {
  using std::sqrt;
  const bool rising = crossing == Crossing::Rising;
  S t = start;
  for (int i = 0; i < kSearchStepsMax; ++i) {
    const GapSample<S> s = gap_.coarse(t);
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
template <class S, class Gap>
S GapSearch<S, Gap>::lowest_beyond(const S& start) const noexcept {
  using std::sqrt;
  const GapSample<S> s = gap_.coarse(start);
  const S d = s.bend * s.bend - S(2) * s.slope * s.bend_rate;
  // B exceeds its parabola (4), so that the parabola's root is an upper bound.
  S step = S(-2) * s.slope / (s.bend + S(sqrt(larger(d, S(0)))));
  if (!(step > S(0)) || !is_finite(step)) step = gap_.natural_time();
  S high = start + step;
  for (int i = 0; i < kSearchStepsMax && gap_.coarse(high).slope < S(0); ++i) {
    step = step + step;
    high = start + step;
  }
  return stationary_between(start, S(high + step), high, Crossing::Rising);
}

/// The stationary point next to `t` in double words.
template <class S, class Gap>
Turn<S> GapSearch<S, Gap>::refined_turn(S t) const noexcept {
  Turn<S> turn;
  for (int i = 0; i < kRefinements; ++i) {
    const GapSample<S> s = gap_.fine(t);
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
template <class S, class Gap>
Turn<S> GapSearch<S, Gap>::turn_at(const S& t) const noexcept {
  const GapSample<S> s = gap_.coarse(t);
  const S rest = -s.slope / s.bend;
  const S value = magnitude(rest) <= S(kCoarseStep) * t ? S(s.value + s.slope * rest) : s.value;
  const S unsure =
      S(kShallow) * (magnitude(s.value) + gap_.reach2() + gap_.reach2()) + S(4) * s.value_error;
  if (magnitude(value) > unsure) return {Duration<S>{t, S(0)}, value};
  return refined_turn(t);
}

/// The root on a falling piece with F(low) > 0 and a negative F towards `high`; on a rising one
/// with the signs the other way round, as that of -F.
template <class S, class Gap>
Duration<S> GapSearch<S, Gap>::root_between(S low,
                                            S high,
                                            S start,
                                            Crossing crossing) const noexcept {
  using std::sqrt;
  const S sense = crossing == Crossing::Falling ? S(1) : S(-1);
  const S eps = epsilon<S>();
  bool is_fine = false;
  S t = start;
  for (int i = 0; i < kSearchStepsMax; ++i) {
    GapSample<S> s = is_fine ? gap_.fine(t) : gap_.coarse(t);
    if (!is_fine && !(magnitude(s.value) > s.value_error)) {
      is_fine = true;
      s = gap_.fine(t);
    }
    s.value *= sense, s.slope *= sense, s.bend *= sense;
    const bool past_bottom = s.slope > S(0) && s.bend > S(0);
    (s.value > S(0) && !past_bottom ? low : high) = t;
    const S d = s.slope * s.slope - s.bend * s.value;
    const S root = d > S(0) ? S(sqrt(d)) : S(0);
    const S step = s.slope <= S(0) ? S(s.value / (root - s.slope)) : S(-(s.slope + root) / s.bend);
    const S size = magnitude(step);
    const bool models = d > S(0);
    if (is_fine && models) {
      const bool is_small = size * size <= eps * t * t &&
                            size * size * (s.bend * s.bend) <= eps * (s.slope * s.slope) &&
                            gap_.settles(size);
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
template <class S, class Gap>
std::optional<Duration<S>> GapSearch<S, Gap>::fall(const S& top, const S& bottom) const noexcept {
  const Turn<S> lowest = turn_at(bottom);
  if (!(lowest.value < S(0))) return std::nullopt;
  const GapSample<S> s = gap_.coarse(top);
  const S square_slope = s.slope * s.slope;
  const bool from_top = square_slope - s.bend * s.value > S(0.5) * square_slope;
  const S end = larger(lowest.t.hi, bottom);
  return root_between(top, end, from_top ? top : lowest.t.hi, Crossing::Falling);
}

/// The contact before F first turns.
template <class S, class Gap>
std::optional<Duration<S>> GapSearch<S, Gap>::first_fall(const Inflections<S>& bends,
                                                         bool hump,
                                                         const S& t_max) const noexcept {
  const S zero(0);
  if (hump) {
    return fall(zero, stationary_between(zero, bends.first, zero, Crossing::Rising));
  }
  if (is_finite(t_max)) {  // Still falling at t_max: its sign there decides.
    const GapSample<S> last = gap_.coarse(t_max);
    if (last.slope < -last.slope_error) {
      if (last.value > last.value_error) return std::nullopt;
      if (last.value < -last.value_error) {
        return root_between(zero, t_max, zero, Crossing::Falling);
      }
    }
  }
  if (!(bends.second > zero)) return fall(zero, lowest_beyond(zero));
  if (bends.exist || !(slope_sign(bends.second) > 0))
    return fall(zero, lowest_beyond(bends.second));
  return fall(zero, stationary_between(zero, bends.second, zero, Crossing::Rising));
}

/// The contact between the highest and the second lowest point of F, around the second inflection.
template <class S, class Gap>
std::optional<Duration<S>> GapSearch<S, Gap>::second_fall(
    const Inflections<S>& bends) const noexcept {
  const S high = bends.second;
  GapSample<S> s = gap_.coarse(high);
  if (!(magnitude(s.value) > s.value_error)) s = gap_.fine(high);
  if (s.value > S(0)) return fall(high, lowest_beyond(high));
  const S low = larger(bends.first, S(0));
  const Turn<S> top =
      turn_at(stationary_between(low, high, S(0.5) * (low + high), Crossing::Falling));
  if (!(top.value > S(0))) return refined_turn(top.t.hi).t;
  return root_between(top.t.hi, high, top.t.hi, Crossing::Falling);
}

template <class S, class Gap>
std::optional<Duration<S>> GapSearch<S, Gap>::first_contact(const S& t_max) const noexcept {
  const S zero(0);
  bool falls = gap_.slope_now() < zero;
  if (gap_.gap_now() <= zero) {
    if (gap_.trend() < 0) return Duration<S>{};
    falls = false;
  }
  const Inflections<S> bends = gap_.inflections();
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

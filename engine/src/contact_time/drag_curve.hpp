// SPDX-License-Identifier: Apache-2.0
// Earliest contact of two disks, or of a disk and a point, of which drag and a pull bend the
// relative motion: gravity against what does not fall, or anything that moves without drag.
//   (1) |x(t)| = d,  x = p + v s + a f,  u = x' = v l + a s,  u' = a - m u    s, f, l:
//   drag_clock.hpp;
//       p [m], v [m/s] of b from a; a [m/s^2]: gravity, less m V for a body that keeps its velocity
//       V; m: rate of the drag [1/s]; d: reach [m]
//   (2) B = x . u,  Q = B' = u . u + x . u',  Q' = 3 u . u' - m x . u'
//   (3) (e^(m t) B)' = e^(m t) M,  M = u . u + x . a
//   (4) M' = m (A . A - A . C l - 2 C . C l^2),  A = a / m,  C = v - A
//   (5)    = 3 v . a - 2 m v . v + g . (3 a - 4 m v) s - 2 m g . g s^2,  g = a - m v
// By (4) M falls until l is the one positive root of that quadratic, and rises from there on, for l
// falls from 1 to 0: so M has no more than two roots, and e^(m t) B, whose sign is that of B,
// rises, falls and rises between them. That is what gap_search.hpp asks for. Source: elementary;
// the search: gap_search.hpp; event rule: Bannerman, Strobl, Formella, Poeschel,
//   Comput. Part. Mech. 1 (2014) 191.
// Deviation: everything in double words; near the start F = c + w . (p + x) with w = x - p and c in
//   three words. Float runs in double.
// Accuracy: t to 0.51 ulp (measured 0.500), no missed and no false contact, for gaps and overlaps
// to
//   1e-17 d: contact_time/drag_curve_test.cpp. Wide scalars: as far as their one word tells.
// Preconditions: m > 0, d >= 0, t_max >= 0; sizes within kSizeMin and kSizeMax, or never. A pull
// below
//   2^-300 m/s^2 counts as none.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/drag.hpp"
#include "contact_time/drag_clock.hpp"
#include "contact_time/gap_search.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine {

namespace detail {

template <class S>
class DragGap {
 public:
  DragGap(const AcceleratedMotion<S>& motion, const DoubleWord<S>& reach, const S& rate) noexcept;

  /// As fine(), for the durations cost most; but near a root it asks for the last steps.
  [[nodiscard]] GapSample<S> coarse(const S& t) const noexcept {
    GapSample<S> s = fine(t);
    s.value_error = s.value_error + S(8) * epsilon<S>() * t * magnitude(s.slope);
    return s;
  }
  [[nodiscard]] GapSample<S> fine(const S& t) const noexcept;
  [[nodiscard]] int trend() const noexcept;
  [[nodiscard]] Inflections<S> inflections() const noexcept;

  [[nodiscard]] const S& gap_now() const noexcept { return gap_now_; }
  [[nodiscard]] const S& slope_now() const noexcept { return slope_now_; }
  [[nodiscard]] const S& reach2() const noexcept { return reach2_; }
  /// What it takes to fall the distance, or to turn, or to lose the speed.
  [[nodiscard]] S natural_time() const noexcept {
    using std::sqrt;
    return larger(S(sqrt((p1_ + reach_.hi) / a1_)) + v1_ / a1_, S(S(1) / rate_));
  }
  /// Does a step of that size leave no more than a cubic makes of it?
  [[nodiscard]] bool settles(const S& step) const noexcept {
    const S share = step * rate_;
    return share * share <= epsilon<S>();
  }

 private:
  /// M and M' at one instant.
  struct Bend {
    S value, rate;
  };

  [[nodiscard]] Bend bend(const S& t) const noexcept;
  [[nodiscard]] S lowest_bend() const noexcept;
  [[nodiscard]] S inflection_between(S low, S high, Crossing crossing) const noexcept;
  [[nodiscard]] S clear_of_turn(const S& first, const S& second) const noexcept;

  const AcceleratedMotion<S>& motion_;
  const DoubleWord<S>& reach_;
  S rate_;
  S p1_, v1_, a1_;  ///< |x| + |y| of p, v, a
  S reach2_;
  S gap_now_;    ///< c
  S slope_now_;  ///< p . v
  bool is_near_;
};

template <class S>
DragGap<S>::DragGap(const AcceleratedMotion<S>& motion,
                    const DoubleWord<S>& reach,
                    const S& rate) noexcept
    : motion_(motion),
      reach_(reach),
      rate_(rate),
      p1_(sum_norm(motion.position)),
      v1_(sum_norm(motion.velocity)),
      a1_(sum_norm(motion.acceleration)),
      reach2_(S(reach.hi * reach.hi)),
      gap_now_(to_scalar(gap_in_three_words(motion.position, reach))),
      slope_now_(rounded_dot(motion.position, motion.velocity)),
      is_near_(!(gap_now_ >= S(0.5) * to_scalar(square_norm(motion.position)))) {}

/// (1) and (2). The durations lose 2^11 of their words where they just do not come from a series.
template <class S>
GapSample<S> DragGap<S>::fine(const S& t) const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const DragClock<S> clock = drag_clock(DoubleWord<S>{t, S(0)}, rate_);
  const DoubleWord2<S> w = v * clock.run + a * clock.fall, x = p + w;
  const DoubleWord2<S> u = v * clock.left + a * clock.run, change = a - u * rate_;
  const S way = clock.run.hi * v1_ + clock.fall.hi * a1_, size = sum_norm(x);
  const S speed = clock.left.hi * v1_ + clock.run.hi * a1_;
  const S unit = kCompensated<S> ? S(epsilon<S>() * epsilon<S>()) : epsilon<S>();
  const S eps = S(0x1p14) * unit;
  GapSample<S> s;
  if (is_near_ && S(4) * way < p1_) {
    s.value = to_scalar(gap_in_three_words(p, reach_) + dot(w, p + x));
    s.value_error = eps * way * p1_;
  } else {
    s.value = to_scalar(square_norm(x) - square(reach_));
    s.value_error = eps * (way * size + p1_ * size + reach2_);
  }
  const DoubleWord<S> slope = dot(x, u);
  s.slope = to_scalar(slope);
  s.slope_error = eps * (p1_ + way) * speed;
  s.bend = to_scalar(square_norm(u) + dot(x, change));
  s.bend_rate = to_scalar(dot(u, change) * S(3) - dot(x, change) * rate_);
  return s;
}

/// The sign of the first derivative of F at t = 0 that is not zero, where F' counts as zero if
/// rounding can feign it. Positive if all vanish.
template <class S>
int DragGap<S>::trend() const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const S terms = magnitude(S(p.x.hi * v.x.hi)) + magnitude(S(p.y.hi * v.y.hi));
  const bool low_words = has_low_words(p) || has_low_words(v);
  const S feigned = feigned_rate(S(terms), low_words, motion_.grain, p1_);
  if (slope_now_ < -feigned) return -1;
  if (slope_now_ > feigned) return 1;
  const int bend = sign(square_norm(v) + dot(p, a));
  if (bend != 0) return bend;
  // There 3 v . u' - m p . u' = 3 v . a - 2 m v . v, for p . a = -v . v.
  return sign(dot(v, a) * S(3) - square_norm(v) * rate_ * S(2)) < 0 ? -1 : 1;
}

template <class S>
typename DragGap<S>::Bend DragGap<S>::bend(const S& t) const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const DragClock<S> clock = drag_clock(DoubleWord<S>{t, S(0)}, rate_);
  const DoubleWord2<S> x = p + v * clock.run + a * clock.fall;
  const DoubleWord2<S> u = v * clock.left + a * clock.run;
  const DoubleWord<S> speed2 = square_norm(u);
  return {to_scalar(speed2 + dot(x, a)), to_scalar(dot(u, a) * S(3) - speed2 * rate_ * S(2))};
}

/// Where M turns: 0 if it rises from the start.
template <class S>
S DragGap<S>::lowest_bend() const noexcept {
  using std::sqrt;
  const S zero(0), falls = bend(zero).rate;
  if (!(falls < zero)) return zero;
  // By (5) while not half of the speed is lost; slight drag does not show in the l of (4).
  const DoubleWord2<S>&v = motion_.velocity, &a = motion_.acceleration;
  const DoubleWord2<S> g = a - v * rate_;
  const S middle = to_scalar(dot(g, a * S(3) - v * (S(4) * rate_)));
  const S d = middle * middle + S(8) * rate_ * to_scalar(square_norm(g)) * falls;
  const S run = S(-2) * falls / (middle + S(sqrt(larger(d, zero))));
  if (run > zero && run * rate_ < S(0.5)) {
    return larger(to_scalar(log1p_words(DoubleWord<S>{run, zero} * -rate_) / -rate_), zero);
  }
  const DoubleWord2<S> end = {motion_.acceleration.x / rate_, motion_.acceleration.y / rate_};
  const DoubleWord2<S> excess = motion_.velocity - end;
  const S a2 = to_scalar(square_norm(end)), c2 = to_scalar(square_norm(excess));
  const S mixed = to_scalar(dot(end, excess));
  const S root = sqrt(S(mixed * mixed + S(8) * a2 * c2));
  // The positive root of 2 c2 l^2 + mixed l - a2 = 0.
  const S left = mixed > zero ? S(S(2) * a2 / (mixed + root)) : S((root - mixed) / (S(4) * c2));
  if (!(left > zero) || !(left < S(1))) return zero;
  const DoubleWord<S> t = log1p_words(DoubleWord<S>{left, zero} - S(1)) / -rate_;
  return larger(to_scalar(t), zero);
}

/// The root of M between `low` and `high`, near enough to part the pieces.
template <class S>
S DragGap<S>::inflection_between(S low, S high, Crossing crossing) const noexcept {
  const bool rising = crossing == Crossing::Rising;
  S t = S(0.5) * (low + high);
  for (int i = 0; i < kSearchStepsMax; ++i) {
    const Bend b = bend(t);
    ((b.value < S(0)) == rising ? low : high) = t;
    const S step = -b.value / b.rate;
    S next = t + step;
    const bool steps = next > low && next < high;
    if (!steps) next = S(0.5) * (low + high);
    if (!(low < next && next < high)) break;
    t = next;
    if (steps && magnitude(step) <= S(kCoarseStep) * t) break;
  }
  return t;
}

/// At terminal velocity B turns 1/m after M, which may be nothing beside t: if one word of t has
/// put the second root of M beyond that of B, a place before both.
template <class S>
S DragGap<S>::clear_of_turn(const S& first, const S& second) const noexcept {
  constexpr double kCrowded = 0x1p20;  // above it a root to 2^-36 t is not clear of the next
  if (!(rate_ * second > S(kCrowded)) || fine(second).slope < S(0)) return second;
  for (const double share : {0x1p-50, 0x1p-40, 0x1p-30, 0x1p-20}) {
    const S t = second - S(share) * second;
    if (!(t > first)) break;
    if (fine(t).slope < S(0)) return t;
  }
  return second;
}

/// The roots of M.
template <class S>
Inflections<S> DragGap<S>::inflections() const noexcept {
  const S zero(0);
  Inflections<S> bends;
  const S lowest = lowest_bend();
  bends.first = bends.second = lowest;
  bends.exist = bend(lowest).value < zero;
  if (!bends.exist) return bends;
  const bool starts_above = lowest > zero && bend(zero).value > zero;
  bends.first = starts_above ? inflection_between(zero, lowest, Crossing::Falling) : S(-1);
  S step = natural_time(), high = lowest + step;
  for (int i = 0; i < kSearchStepsMax && !(bend(high).value > zero); ++i) {
    step = step + step;
    high = lowest + step;
  }
  bends.second = clear_of_turn(bends.first, inflection_between(lowest, high, Crossing::Rising));
  return bends;
}

}  // namespace detail

/// The motion of b as seen from a under drag; metres, seconds.
template <class S>
struct DragMotion : AcceleratedMotion<S> {
  S rate{};  ///< 1/s
};

/// Relative position in metres at a duration.
template <class S>
[[nodiscard]] inline DoubleWord2<S> displacement_at(const DragMotion<S>& motion,
                                                    const Duration<S>& t) noexcept {
  using Wide = detail::Inner<S>;
  const auto clock = detail::drag_clock<Wide>(detail::widened(DoubleWord<S>{t.hi, t.lo}),
                                              static_cast<Wide>(motion.rate));
  return motion.position + motion.velocity * detail::stored_words<S>(clock.run) +
         motion.acceleration * detail::stored_words<S>(clock.fall);
}

/// True if at the duration the centre projects on the inside of the segment, or past an end by no
/// more than a margin of rounding; what projects_inside is for straight motion.
template <class S>
[[nodiscard]] inline bool projects_inside(const DragMotion<S>& motion,
                                          const DoubleWord2<S>& edge,
                                          const Duration<S>& t) noexcept {
  const DoubleWord2<S> from_start = displacement_at(motion, t), from_end = from_start - edge;
  const S speed = detail::sum_norm(motion.velocity) + t.hi * detail::sum_norm(motion.acceleration);
  const S way = t.lo == S(0) ? S(t.hi * speed) : S(0);
  const S unit = S(4 * detail::kMarginOfEnd) * detail::epsilon<S>() * detail::sum_norm(edge);
  return to_scalar(dot(edge, from_start)) > -unit * (detail::sum_norm(from_start) + way) &&
         to_scalar(dot(edge, from_end)) < unit * (detail::sum_norm(from_end) + way);
}

/// Seconds until two disks touch while approaching, (1), no later than t_max, which may be
/// infinite; none if they do not. `motion`: of b seen from a, its acceleration a of (1); `reach` =
/// r_a + r_b in metres, or one radius against a point; `rate` in 1/s.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> drag_curve_contact(
    const AcceleratedMotion<S>& motion,
    const DoubleWord<S>& reach,
    const S& rate,
    const S& t_max) noexcept {
  using Wide = detail::Inner<S>;
  constexpr double kFaintPull = 0x1p-300;
  if (!(t_max >= S(0))) return std::nullopt;
  const AcceleratedMotion<Wide> wide = detail::widened(motion);
  if (!(detail::sum_norm(wide.acceleration) > Wide(kFaintPull))) {
    const auto t = drag_disk_contact(detail::straight(motion), reach, rate);
    if (t && detail::is_later(*t, t_max)) return std::nullopt;
    return t;
  }
  const DoubleWord<Wide> wide_reach = detail::widened(reach);
  const Wide length = detail::whole_size(wide.position) + wide_reach.hi;
  const Wide rates = detail::whole_size(wide.velocity) + detail::whole_size(wide.acceleration);
  const Wide low = Wide(detail::kSizeMin), high = Wide(detail::kSizeMax);
  const auto wide_rate = static_cast<Wide>(rate);
  const bool in_range =
      length + rates <= high && wide_reach.hi >= low && wide_rate >= low && wide_rate <= high;
  if (!in_range) return std::nullopt;
  const detail::DragGap<Wide> gap(wide, wide_reach, wide_rate);
  const auto t =
      detail::GapSearch<Wide, detail::DragGap<Wide>>(gap).first_contact(static_cast<Wide>(t_max));
  if (!t) return std::nullopt;
  return detail::narrowed<S>(*t, detail::is_long_flight(wide, wide_reach.hi, t->hi));
}

}  // namespace stoss::engine

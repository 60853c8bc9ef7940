// SPDX-License-Identifier: Apache-2.0
// What the kernels for constant relative acceleration share: the motion, its range, its projection.
//   (1) x(t) = p + v t + a t^2 / 2   p [m], v [m/s], a [m/s^2] of b as seen from a; t [s]
//   (2) s(t) = e . x(t) / (e . e)    e [m]: a wall's edge, end - start; s: place on it
// An event is the infimum of the t in [0, t_max] with gap(t) <= 0 and d(gap)/dt < 0. Beyond what
// straight motion knows, that is: bodies that touch without closing speed meet now if the
// acceleration presses them together; bodies that overlap by rounding, separate, and turn before
// they are apart meet where they turn; those that come apart meet where they come together again.
// Source: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1 (2014) 191 (event rule).
// Deviation: (1) and (2) are evaluated in double words. Kernels for float run in double, into which
//   the two words of a float go without error. Other sizes than Range of the kernels are shifted by
//   powers of two, so that they follow flights for no more than 2^300 times their natural time.
// Accuracy: (1) to the operations of double_word.hpp; contact_time/accelerated_test.cpp: times.
// Preconditions: all inputs normalised double words. NaN and infinity never yield a contact, but
//   t_max may be infinite.
#pragma once

#include "contact_time/contact_time.hpp"
#include "stoss/engine/double_word.hpp"

#include <limits>
#include <optional>
#include <type_traits>

namespace stoss::engine {

/// The motion of b as seen from a at the reference instant; metres, seconds.
template <class S>
struct AcceleratedMotion {
  DoubleWord2<S> position;
  DoubleWord2<S> velocity;
  DoubleWord2<S> acceleration;
  /// As RelativeMotion::grain.
  S grain{};
};

/// Relative position in metres at a duration, (1).
template <class S>
[[nodiscard]] inline DoubleWord2<S> displacement_at(const AcceleratedMotion<S>& motion,
                                                    const Duration<S>& t) noexcept {
  const DoubleWord2<S>& a = motion.acceleration;
  const S half = S(0.5);
  if (t.lo == S(0)) {
    return motion.position + (motion.velocity + a * S(t.hi * half)) * t.hi;
  }
  const DoubleWord<S> time{t.hi, t.lo};
  const DoubleWord<S> half_time{S(t.hi * half), S(t.lo * half)};
  return motion.position + (motion.velocity + a * half_time) * time;
}

namespace detail {

template <class S>
[[nodiscard]] inline bool is_zero(const DoubleWord2<S>& a) noexcept {
  return a.x.hi == S(0) && a.y.hi == S(0) && a.x.lo == S(0) && a.y.lo == S(0);
}

/// The motion without its acceleration.
template <class S>
[[nodiscard]] inline RelativeMotion<S> straight(const AcceleratedMotion<S>& motion) noexcept {
  return {motion.position, motion.velocity, motion.grain};
}

/// The scalar in which a kernel for S computes: float's products are exact in double.
template <class S>
using Inner = std::conditional_t<std::is_same_v<S, float>, double, S>;

/// The same value in the inner scalar, exactly.
template <class S>
[[nodiscard]] constexpr DoubleWord<Inner<S>> widened(const DoubleWord<S>& x) noexcept {
  return two_sum(static_cast<Inner<S>>(x.hi), static_cast<Inner<S>>(x.lo));
}

template <class S>
[[nodiscard]] constexpr DoubleWord2<Inner<S>> widened(const DoubleWord2<S>& a) noexcept {
  return {widened(a.x), widened(a.y)};
}

template <class S>
[[nodiscard]] constexpr AcceleratedMotion<Inner<S>> widened(
    const AcceleratedMotion<S>& motion) noexcept {
  return {widened(motion.position),
          widened(motion.velocity),
          widened(motion.acceleration),
          static_cast<Inner<S>>(motion.grain)};
}

/// The duration in S: the low word where `two_words` says that one is too coarse. None if S cannot
/// hold it.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> narrowed(const Duration<Inner<S>>& t,
                                                         bool two_words) noexcept {
  if constexpr (std::is_same_v<S, Inner<S>>) {
    return checked_duration(two_words ? t : Duration<S>{t.hi, S(0)});
  } else {
    if (!(t.hi <= static_cast<Inner<S>>(std::numeric_limits<S>::max()))) return std::nullopt;
    const S hi = static_cast<S>(t.hi);
    if (!two_words) return Duration<S>{hi, S(0)};
    return Duration<S>{hi, static_cast<S>((t.hi - static_cast<Inner<S>>(hi)) + t.lo)};
  }
}

/// Does the duration end later than t_max?
template <class S>
[[nodiscard]] inline bool is_later(const Duration<S>& t, const S& t_max) noexcept {
  return t.hi > t_max || (t.hi == t_max && t.lo > S(0));
}

/// True where the contact at `t` moves by more than 32 ulp of `reach` per ulp of `t`.
template <class S>
[[nodiscard]] inline bool is_long_flight(const AcceleratedMotion<S>& motion,
                                         const S& reach,
                                         const S& t) noexcept {
  const S speed = sum_norm(motion.velocity) + t * sum_norm(motion.acceleration);
  return t * speed > S(kLongFlight) * reach;
}

/// Sizes of motions that the kernels take as they are. Lengths, speeds and accelerations below
/// 2^150, reaches and accelerations above 2^-150: then speed^2 / acceleration < 2^450, whose
/// square, the largest term of a gap, is finite, and the error of the smallest, 2^-406, is normal.
/// Derived; accelerated_test.cpp watches it with the family of mixed sizes.
inline constexpr double kSizeMax = 0x1p150;
inline constexpr double kSizeMin = 0x1p-150;

/// Beyond this many times its natural time no flight is followed; see kSizeMin. Chosen; no unit.
inline constexpr double kFaintest = 0x1p-300;

/// |x| + |y| with the low words, so that a NaN anywhere shows.
template <class S>
[[nodiscard]] inline S whole_size(const DoubleWord2<S>& a) noexcept {
  return S(sum_norm(a) + (magnitude(a.x.lo) + magnitude(a.y.lo)));
}

/// A motion shifted into the kernels' range: lengths times `length`, durations times `time`, both
/// powers of two.
template <class S>
struct Shift {
  S length{1};
  S time{1};
};

/// The power of two that brings `size` > 0 between 2^-32 and 1.
template <class S>
[[nodiscard]] inline S power_towards_one(S size) noexcept {
  const S step = S(0x1p32);
  const S back = S(1) / step;
  S power(1);
  for (; size > S(1); size = S(size * back)) power = S(power * back);
  for (; size < back; size = S(size * step)) power = S(power * step);
  return power;
}

/// Brings `length` towards 1, and the larger of speed and root of the acceleration as well.
template <class S>
[[nodiscard]] inline Shift<S> shift_of(const S& length, const S& speed, const S& pull) noexcept {
  using std::sqrt;
  const S by_length = power_towards_one(length);
  // In steps, for the products may lie beyond the range of S.
  const S root = sqrt(pull) * sqrt(by_length);
  const S along = speed * by_length;
  const S rate = larger(along, root);
  return {by_length, S(1) / power_towards_one(rate)};
}

template <class S>
[[nodiscard]] inline DoubleWord2<S> scaled(const DoubleWord2<S>& a, const S& by) noexcept {
  return {{S(a.x.hi * by), S(a.x.lo * by)}, {S(a.y.hi * by), S(a.y.lo * by)}};
}

template <class S>
[[nodiscard]] inline AcceleratedMotion<S> scaled(const AcceleratedMotion<S>& motion,
                                                 const Shift<S>& by) noexcept {
  const S per_time = S(1) / by.time;
  return {scaled(motion.position, by.length),
          scaled(scaled(motion.velocity, by.length), per_time),
          scaled(scaled(scaled(motion.acceleration, by.length), per_time), per_time),
          S(motion.grain * by.length * per_time)};
}

/// (2): is 0 < s < 1, or s within `margins` of it? As for straight motion.
template <class S>
[[nodiscard]] inline bool projects_within(const AcceleratedMotion<S>& motion,
                                          const DoubleWord2<S>& edge,
                                          const Duration<S>& t,
                                          int margins) noexcept {
  const S ex = edge.x.hi, ey = edge.y.hi, half = S(0.5) * t.hi;
  const DoubleWord2<S>&p = motion.position, &v = motion.velocity, &a = motion.acceleration;
  const S from_x = ex * p.x.hi, from_y = ey * p.y.hi;
  const S way_x = ex * v.x.hi, way_y = ey * v.y.hi;
  const S bend_x = ex * a.x.hi, bend_y = ey * a.y.hi;
  const S square_length = ex * ex + ey * ey;
  const S along = (from_x + from_y) + t.hi * ((way_x + way_y) + half * (bend_x + bend_y));
  const S rates =
      (magnitude(way_x) + magnitude(way_y)) + half * (magnitude(bend_x) + magnitude(bend_y));
  const S terms = (magnitude(from_x) + magnitude(from_y)) + t.hi * rates + square_length;
  const S slack = S(32) * epsilon<S>() * terms;
  if (along > slack && square_length - along > slack) return true;
  if (along < -slack || along - square_length > slack) return false;

  const DoubleWord2<S> from_start = displacement_at(motion, t);
  const DoubleWord2<S> from_end = from_start - edge;
  const S speed = sum_norm(v) + t.hi * sum_norm(a);
  const S way = t.lo == S(0) ? S(t.hi * speed) : S(0);
  const S unit = S(4 * margins) * epsilon<S>() * sum_norm(edge);
  return to_scalar(dot(edge, from_start)) > -unit * (sum_norm(from_start) + way) &&
         to_scalar(dot(edge, from_end)) < unit * (sum_norm(from_end) + way);
}

}  // namespace detail

/// True if at the duration the centre projects on the inside of the segment, or past an end by no
/// more than a margin of rounding; for accelerated motion what projects_inside is for straight.
template <class S>
[[nodiscard]] inline bool projects_inside(const AcceleratedMotion<S>& motion,
                                          const DoubleWord2<S>& edge,
                                          const Duration<S>& t) noexcept {
  return detail::projects_within(motion, edge, t, detail::kMarginOfEnd);
}

}  // namespace stoss::engine

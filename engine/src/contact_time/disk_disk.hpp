// SPDX-License-Identifier: Apache-2.0
// Earliest contact of two disks in straight relative motion.
//   (1) |p + v t| = d      p, v: position [m] and velocity [m/s] of b from a; d = r_a + r_b [m]
//   (2) b = v . p,  c = |p|^2 - d^2,  D = |v|^2 d^2 - (p x v)^2  (= b^2 - |v|^2 c)
//   (3) t = c / (-b + sqrt(D))   if b < 0, c > 0, D > 0;   t = 0 if b < 0, c <= 0;   else never
// Source: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1 (2014) 191 (event rule,
//   stable root); Joldes, Muller, Popescu, ACM TOMS 44 (2017) 15res (double words).
// Deviation: c and D cancel near contact and at grazing, and no rearrangement in one word helps.
//   They are formed in one word first, in two when less than 3/4 of |p|^2 or half of |v|^2 d^2
//   is left, in three when only 2^-44 is. Sizes beyond 2^+-200 are shifted by powers of two.
//   For flights longer than 32 d, (3) is solved again from the point reached, which yields the
//   low word of t.
// Accuracy: t to 6 ulp, no missed and no false contact, for gaps, depths and overlaps down to
//   1e-17 d and distances up to 1e14 d: contact_time/disk_disk_test.cpp. Wide scalars: plain (3).
// Preconditions: d >= 0; otherwise, and for NaN and infinity, never.
#pragma once

#include "contact_time/contact_time.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine {

namespace detail {

/// c in three words; c = 0 is decided exactly for gaps down to 2^-150 |p|.
template <class S>
[[nodiscard]] inline DoubleWord<S> gap_in_three_words(const DoubleWord2<S>& p,
                                                      const DoubleWord<S>& reach) noexcept {
  LongSum<S> sum;
  sum.add_product(p.x, p.x);
  sum.add_product(p.y, p.y);
  sum.add_product(-reach, reach);
  return sum.two_words();
}

/// c where it cancels; `distance2` = |p|^2.
template <class S>
[[nodiscard, gnu::always_inline]] inline S cancelling_gap(const DoubleWord2<S>& p,
                                                          const DoubleWord<S>& reach,
                                                          const S& distance2) noexcept {
  const S c = to_scalar(square_norm(p) - square(reach));
  if constexpr (kCompensated<S>) {
    if (magnitude(c) < S(kThirdWordShare) * epsilon<S>() * distance2) {
      return to_scalar(gap_in_three_words(p, reach));
    }
  }
  return c;
}

/// D where it cancels; `scale` = |v|^2 d^2, `b2` = b^2. For a pair that is near touching as well,
/// b^2 - |v|^2 c has far smaller terms than |v|^2 d^2 - (p x v)^2.
template <class S>
[[nodiscard]] inline S cancelling_discriminant(const RelativeMotion<S>& motion,
                                               const DoubleWord<S>& reach,
                                               const S& scale,
                                               const S& b2) noexcept {
  const DoubleWord2<S>& p = motion.position;
  const DoubleWord2<S>& v = motion.velocity;
  const DoubleWord<S> speed2 = square_norm(v);
  const S d = to_scalar(speed2 * square(reach) - square(cross(p, v)));
  if (magnitude(d) >= S(kThirdWordShare) * epsilon<S>() * scale || b2 >= scale) return d;
  LongSum<S> b;
  b.add_product(p.x, v.x);
  b.add_product(p.y, v.y);
  return to_scalar(square(b.two_words()) - speed2 * gap_in_three_words(p, reach));
}

/// The low word of a long flight's time: (3) once more from where `t` leads, |v| ulp(t) away from
/// the contact, where c and b are small. `root` = sqrt(D), which does not depend on the start.
template <class S>
[[nodiscard]] inline Duration<S> refined_pair_time(const RelativeMotion<S>& motion,
                                                   const DoubleWord<S>& reach,
                                                   const S& t,
                                                   const S& root) noexcept {
  const RelativeMotion<S> near{
      displacement_at(motion, Duration<S>{t, S(0)}), motion.velocity, S(0)};
  const S c = to_scalar(square_norm(near.position) - square(reach));
  const S b = rounded_dot(near.position, near.velocity);
  // Of the two forms of the smaller root the one that does not cancel.
  const S rest =
      b < S(0) ? S(c / (root - b)) : S(-(root + b) / to_scalar(square_norm(near.velocity)));
  const DoubleWord<S> sum = two_sum(t, rest);
  return {sum.hi, sum.lo};
}

/// b and what rounding can feign of it: is the touching pair approaching?
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> touching_pair(const RelativeMotion<S>& motion,
                                                              const S& b) noexcept {
  const S terms = S(magnitude(S(motion.position.x.hi * motion.velocity.x.hi)) +
                    magnitude(S(motion.position.y.hi * motion.velocity.y.hi)));
  const bool low_words = has_low_words(motion.position) || has_low_words(motion.velocity);
  const S feigned = feigned_rate(terms, low_words, motion.grain, sum_norm(motion.position));
  if (!(b < -feigned)) return std::nullopt;
  return Duration<S>{};
}

/// (3) with all terms in double words (plain for wide scalars). `zoom` steps enlarge d and p x v
/// in D alone, for disks so small against |p| that their square would underflow.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> pair_contact_in_double_words(
    const RelativeMotion<S>& motion, const DoubleWord<S>& reach, int zoom) noexcept {
  using std::sqrt;
  const S b = to_scalar(dot(motion.position, motion.velocity));
  if (!(b < S(0))) return std::nullopt;
  const DoubleWord<S> distance2 = square_norm(motion.position);
  const S c = cancelling_gap(motion.position, reach, distance2.hi);
  if (c <= S(0)) return touching_pair(motion, b);
  const DoubleWord<S> moment = shifted(cross(motion.position, motion.velocity), zoom);
  const DoubleWord<S> speed2 = square_norm(motion.velocity);
  const S d = to_scalar(speed2 * square(shifted(reach, zoom)) - square(moment));
  if (!(d > S(0))) return std::nullopt;
  const S root = shifted(S(sqrt(d)), -zoom);
  const S t = c / (root - b);
  if constexpr (kCompensated<S>) {
    const S far = S(kLongFlight) * reach.hi;
    if (distance2.hi > far * far) return refined_pair_time(motion, reach, t, root);
  }
  return Duration<S>{t, S(0)};
}

/// (3) in one word, and in two where that cancels; for lengths and speeds within Range<S>.
/// Clear misses must have been sorted out: `b` < 0 is exact, `speed2` = |v|^2.
template <class S>
[[nodiscard, gnu::always_inline]] inline std::optional<Duration<S>> pair_contact_adaptive(
    const RelativeMotion<S>& motion,
    const DoubleWord<S>& reach,
    const S& b,
    const S& speed2) noexcept {
  using std::sqrt;
  const DoubleWord2<S>& p = motion.position;
  const S distance2 = p.x.hi * p.x.hi + p.y.hi * p.y.hi;
  const S reach2 = reach.hi * reach.hi;
  const S low = p.x.hi * p.x.lo + p.y.hi * p.y.lo - reach.hi * reach.lo;
  S c = (distance2 - reach2) + (low + low);
  if (!(c >= S(0.75) * distance2)) c = cancelling_gap(p, reach, distance2);
  if (c <= S(0)) return touching_pair(motion, b);
  const S moment = rounded_cross(p, motion.velocity);
  const S scale = speed2 * reach2;
  S d = scale - moment * moment;
  if (magnitude(d) < S(0.5) * scale) d = cancelling_discriminant(motion, reach, scale, S(b * b));
  if (!(d > S(0))) return std::nullopt;
  const S root = sqrt(d);
  const S t = c / (root - b);
  if (!(t >= S(0))) return std::nullopt;
  if (distance2 > S(kLongFlight * kLongFlight) * reach2) {
    return refined_pair_time(motion, reach, t, root);
  }
  return Duration<S>{t, S(0)};
}

/// (3) for lengths and speeds within Range<S>: first the pairs that recede or pass by for sure.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> pair_contact_in_range(
    const RelativeMotion<S>& motion, const DoubleWord<S>& reach) noexcept {
  if constexpr (kCompensated<S>) {
    const DoubleWord2<S>& p = motion.position;
    const DoubleWord2<S>& v = motion.velocity;
    const S px = p.x.hi, py = p.y.hi, vx = v.x.hi, vy = v.y.hi;
    const S eps = epsilon<S>();
    const S along_x = vx * px, along_y = vy * py;
    if (along_x + along_y > S(8) * eps * (magnitude(along_x) + magnitude(along_y))) {
      return std::nullopt;  // recedes, whatever rounding and low words add
    }
    const S right = px * vy, left = py * vx;
    const S moment = right - left;
    const S speed2 = vx * vx + vy * vy;
    if (moment * moment > S(2) * speed2 * (reach.hi * reach.hi) &&
        magnitude(moment) > S(32) * eps * (magnitude(right) + magnitude(left))) {
      return std::nullopt;  // passes by at a distance of more than 1.2 d
    }
    const S b = rounded_dot(p, v);
    if (!(b < S(0))) return std::nullopt;
    return pair_contact_adaptive(motion, reach, b, speed2);
  } else {
    return pair_contact_in_double_words(motion, reach, 0);
  }
}

/// The same for lengths or speeds outside Range<S>.
template <class S>
[[nodiscard, gnu::noinline, gnu::cold]] inline std::optional<Duration<S>> pair_contact_shifted(
    const RelativeMotion<S>& motion, const DoubleWord<S>& reach) noexcept {
  const S length = larger(size_of(motion.position), reach.hi);
  const S speed = size_of(motion.velocity);
  if (!is_finite(length) || !is_finite(speed)) return std::nullopt;
  if (!(speed > S(0)) || !(reach.hi > S(0))) return std::nullopt;
  const int by_length = steps_into_range(length);
  const int by_speed = steps_into_range(speed);
  const RelativeMotion<S> near{shifted(motion.position, by_length),
                               shifted(motion.velocity, by_speed),
                               shifted(motion.grain, by_speed)};
  const DoubleWord<S> near_reach = shifted(reach, by_length);
  const int zoom = near_reach.hi < Range<S>::low() ? steps_into_range(near_reach.hi) : 0;
  const std::optional<Duration<S>> t = zoom == 0
                                           ? pair_contact_in_range(near, near_reach)
                                           : pair_contact_in_double_words(near, near_reach, zoom);
  if (!t) return std::nullopt;
  const int back = by_speed - by_length;
  return checked_duration(Duration<S>{shifted(t->hi, back), shifted(t->lo, back)});
}

}  // namespace detail

/// Seconds until two disks touch while approaching, (3); none if they never do.
/// `motion`: of b seen from a; `reach` = r_a + r_b in metres.
template <class S>
[[nodiscard, gnu::always_inline]] inline std::optional<Duration<S>> disk_disk_contact(
    const RelativeMotion<S>& motion, const DoubleWord<S>& reach) noexcept {
  const S length = detail::larger(detail::size_of(motion.position), reach.hi);
  const S speed = detail::size_of(motion.velocity);
  const S low = detail::Range<S>::low(), high = detail::Range<S>::high();
  if (length <= high && reach.hi >= low && speed <= high && speed >= low) [[likely]] {
    return detail::pair_contact_in_range(motion, reach);
  }
  return detail::pair_contact_shifted(motion, reach);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// When a point in straight motion crosses the rim of a fixed circle, inwards or outwards.
//   (1) |p + v t| = R      p, v: position [m] and velocity [m/s] from the centre; R: radius [m]
//   (2) b = v . p,  c = |p|^2 - R^2,  D = |v|^2 R^2 - (p x v)^2
//   (3) in:  t = c / (sqrt(D) - b), the contact of disk_disk.hpp
//   (4) out: t = (sqrt(D) - b) / |v|^2 if b <= 0;  t = -c / (sqrt(D) + b) if b > 0
// In is the first t >= 0 with |x| <= R and falling, out the infimum of those with |x| >= R and
// rising. Whether the point is inside is the caller's to know, not read off from c: on the rim
// itself rounding would tell it differently from one event to the next. A point that counts as
// inside but is not, by rounding, leaves where it is nearest to the centre; a tangent never enters.
// Source: elementary; event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1
//   (2014) 191.
// Deviation: c and D in two or three words where they cancel; float runs in double. The way out has
//   a second word of t, from (4) once more where the first leads, unless it is very short.
// Accuracy: t to 6 ulp, outwards to 16, none missed or false: contact_time/rim_crossing_test.cpp.
// Preconditions: R > 0. NaN and infinity never yield a crossing.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine {

namespace detail {

/// t sqrt(D) above this share of |p|^2 + R^2: the second word of t then gains. Chosen, far above
/// the 2^-52 where it breaks even; no unit. Larger: fewer exits have one; smaller: it may spoil the
/// first.
inline constexpr double kWorthASecondLook = 0x1p-40;

/// |p|^2 - R^2, its sign certain.
template <class S>
[[nodiscard]] inline S height_over_rim(const DoubleWord2<S>& p,
                                       const DoubleWord<S>& radius) noexcept {
  const DoubleWord<S> distance2 = square_norm(p);
  const DoubleWord<S> radius2 = square(radius);
  const S c = to_scalar(distance2 - radius2);
  if (magnitude(c) >= S(0.5) * radius2.hi) return c;
  return cancelling_gap(p, radius, distance2.hi);
}

/// b. On a flight along the rim it cancels to less than double words resolve.
template <class S>
[[nodiscard]] inline S rim_climb(const DoubleWord2<S>& p, const DoubleWord2<S>& v) noexcept {
  const S b = rounded_dot(p, v);
  if constexpr (kCompensated<S>) {
    const S terms = magnitude(S(p.x.hi * v.x.hi)) + magnitude(S(p.y.hi * v.y.hi));
    if (magnitude(b) < S(kThirdWordShare) * epsilon<S>() * terms) {
      LongSum<S> sum;
      sum.add_product(p.x, v.x);
      sum.add_product(p.y, v.y);
      return to_scalar(sum.two_words());
    }
  }
  return b;
}

/// D. `zoom` steps enlarge R and p x v, for circles so small against |p| that their square would
/// underflow.
template <class S>
[[nodiscard]] inline S rim_discriminant(const RelativeMotion<S>& motion,
                                        const DoubleWord<S>& radius,
                                        int zoom) noexcept {
  const DoubleWord2<S>&p = motion.position, &v = motion.velocity;
  const DoubleWord<S> speed2 = square_norm(v);
  if (zoom != 0) {
    return to_scalar(speed2 * square(shifted(radius, zoom)) - square(shifted(cross(p, v), zoom)));
  }
  const DoubleWord<S> whole = speed2 * square(radius);
  const DoubleWord<S> d = whole - square(cross(p, v));
  if constexpr (kCompensated<S>) {
    if (magnitude(d.hi) < S(0.5) * whole.hi) {
      const S b = rim_climb(p, v);
      return cancelling_discriminant(motion, radius, whole.hi, S(b * b));
    }
  }
  return to_scalar(d);
}

/// (4) for lengths and speeds within Range<S>.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> rim_exit_in_range(const RelativeMotion<S>& motion,
                                                                  const DoubleWord<S>& radius,
                                                                  int zoom) noexcept {
  using std::sqrt;
  const S zero(0);
  const S speed2 = to_scalar(square_norm(motion.velocity));
  if (!(speed2 > zero)) return std::nullopt;
  const S b = rim_climb(motion.position, motion.velocity);
  const S c = height_over_rim(motion.position, radius);
  if (c >= zero && b >= zero) return Duration<S>{};
  const S d = rim_discriminant(motion, radius, zoom);
  if (!(d > zero)) return Duration<S>{b < zero ? S(-b / speed2) : zero, zero};
  const S root = shifted(S(sqrt(d)), -zoom);
  const S t = b > zero ? S(-c / (root + b)) : S((root - b) / speed2);
  if constexpr (kCompensated<S>) {
    // (4) once more, from where `t` leads: for ways so short that double words place the rim no
    // better than `t` does, it would be worse.
    const S size2 = to_scalar(square_norm(motion.position) + square(radius));
    if (!(t * root > S(kWorthASecondLook) * size2)) return Duration<S>{t, zero};
    const DoubleWord2<S> there = displacement_at(motion, Duration<S>{t, zero});
    const S rise = rounded_dot(there, motion.velocity);
    const S rest = rise > zero ? S(-height_over_rim(there, radius) / (rise + root))
                               : S((root - rise) / speed2);
    const DoubleWord<S> sum = two_sum(t, rest);
    if (sum.hi >= zero) return Duration<S>{sum.hi, sum.lo};
  }
  return Duration<S>{t, zero};
}

/// (4)
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> rim_exit(const RelativeMotion<S>& motion,
                                                         const DoubleWord<S>& radius) noexcept {
  const S length = larger(size_of(motion.position), radius.hi);
  const S speed = size_of(motion.velocity);
  const S low = Range<S>::low(), high = Range<S>::high();
  if (length <= high && radius.hi >= low && speed <= high && speed >= low) [[likely]] {
    return rim_exit_in_range(motion, radius, 0);
  }
  if (!is_finite(length) || !is_finite(speed)) return std::nullopt;
  if (!(speed > S(0)) || !(radius.hi > S(0))) return std::nullopt;
  const int by_length = steps_into_range(length);
  const int by_speed = steps_into_range(speed);
  const RelativeMotion<S> near{
      shifted(motion.position, by_length), shifted(motion.velocity, by_speed), S(0)};
  const DoubleWord<S> near_radius = shifted(radius, by_length);
  const int zoom = near_radius.hi < low ? steps_into_range(near_radius.hi) : 0;
  const auto t = rim_exit_in_range(near, near_radius, zoom);
  if (!t) return std::nullopt;
  const int back = by_speed - by_length;
  return checked_duration(Duration<S>{shifted(t->hi, back), shifted(t->lo, back)});
}

}  // namespace detail

/// Seconds until a point crosses the rim the way that is left to it, (3) or (4); none if it never
/// does. `motion`: of the point seen from the centre; `radius` in metres.
template <class S>
[[nodiscard]] inline std::optional<Duration<detail::Inner<S>>> rim_crossing(
    const RelativeMotion<S>& motion, S radius, bool is_inside) noexcept {
  using Wide = detail::Inner<S>;
  // Without its grain: no impulse comes of a crossing.
  const RelativeMotion<Wide> wide{
      detail::widened(motion.position), detail::widened(motion.velocity), Wide(0)};
  const DoubleWord<Wide> wide_radius{static_cast<Wide>(radius), Wide(0)};
  return is_inside ? detail::rim_exit(wide, wide_radius) : disk_disk_contact(wide, wide_radius);
}

}  // namespace stoss::engine

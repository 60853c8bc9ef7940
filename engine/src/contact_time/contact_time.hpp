// SPDX-License-Identifier: Apache-2.0
// What all contact-time kernels share: relative motion, durations, range, projection on a segment.
//   (1) x(t) = p + v t             p [m], v [m/s] of b as seen from a at the reference instant
//   (2) s(t) = e . x(t) / (e . e)  e [m]: a wall's edge, end - start; s: place on it; t [s]
// An event is the first t >= 0 with gap(t) <= 0 and d(gap)/dt < 0: touching or overlapping bodies
// that approach meet at once; those that separate or slide never do.
// Source: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1 (2014) 191 (event rule).
// Deviation: (1) and (2) are evaluated in double words; a time is hi + lo where one word is coarser
//   than the contact needs. In bodies that touch, a closing speed that the low words cannot resolve
//   counts as none: an impulse of that size would be lost in the velocity and the event repeat.
// Accuracy: displacement_at 2^-102 (|p| + |v| t); tests/engine/contact_time/long_flight_test.cpp.
// Preconditions: all inputs normalised double words. NaN and infinity never yield a contact.
#pragma once

#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace stoss::engine {

/// Seconds from the reference instant, hi + lo >= 0. lo carries the correction for long flights and
/// is zero otherwise.
template <class S>
struct Duration {
  S hi{};
  S lo{};
};

/// The motion of b as seen from a at the reference instant; metres and metres per second.
template <class S>
struct RelativeMotion {
  DoubleWord2<S> position;
  DoubleWord2<S> velocity;
  /// The finest change, in m/s, that both bodies' own velocities can hold; velocity_grain(). Zero
  /// where they hold any, as single words do.
  S grain{};
};

/// Relative position in metres at a duration, (1).
template <class S>
[[nodiscard, gnu::always_inline]] inline DoubleWord2<S> displacement_at(
    const RelativeMotion<S>& motion, const Duration<S>& t) noexcept {
  const DoubleWord2<S>& p = motion.position;
  const DoubleWord2<S>& v = motion.velocity;
  if constexpr (kCompensated<S>) {
    if (t.lo != S(0)) return p + v * DoubleWord<S>{t.hi, t.lo};
  }
  return p + v * t.hi;
}

namespace detail {

template <class S>
[[nodiscard]] inline S magnitude(const S& x) noexcept {
  using std::abs;
  return S(abs(x));
}

template <class S>
[[nodiscard]] constexpr S larger(const S& a, const S& b) noexcept {
  return a < b ? b : a;
}

template <class S>
[[nodiscard]] constexpr bool is_finite(const S& x) noexcept {
  return S(x - x) == S(0);
}

/// eps = 2 u, the spacing at 1.
template <class S>
[[nodiscard]] constexpr S epsilon() noexcept {
  return std::numeric_limits<S>::epsilon();
}

/// A flight longer than this many reaches has its time refined to two words: below, an ulp of the
/// time moves the contact by less than 32 ulp of the reach. Chosen; no unit. Larger: blunter
/// normals of far bullets (long_flight_test.cpp); smaller: 20 ns more for nearer pairs.
inline constexpr double kLongFlight = 32;

/// Range of lengths and of speeds within which the kernels' products of four factors, and the
/// errors of these products, neither overflow nor underflow: high^4 and low^4 u^2 are normal
/// numbers (float: high 2^28, low 2^-24, u 2^-24; else: high 2^200, low 2^-200, u 2^-53 or finer).
/// disk_disk_test.cpp watches them with the families of extreme speeds and sizes.
template <class S>
struct Range {
  [[nodiscard]] static constexpr S low() noexcept { return S(0x1p-200); }
  [[nodiscard]] static constexpr S high() noexcept { return S(0x1p200); }
  [[nodiscard]] static constexpr S step() noexcept { return S(0x1p200); }
};
template <>
struct Range<float> {
  [[nodiscard]] static constexpr float low() noexcept { return 0x1p-24f; }
  [[nodiscard]] static constexpr float high() noexcept { return 0x1p28f; }
  [[nodiscard]] static constexpr float step() noexcept { return 0x1p24f; }
};

template <class S>
[[nodiscard]] constexpr bool is_in_range(const S& size) noexcept {
  return size >= Range<S>::low() && size <= Range<S>::high();
}

/// x * step^count, by exact products (but for the last one, if the result is subnormal).
template <class S>
[[nodiscard]] inline S shifted(S x, int count) noexcept {
  if (count == 0) return x;
  const S up = Range<S>::step();
  const S down = S(1) / up;
  for (; count > 0; --count) x = S(x * up);
  for (; count < 0; ++count) x = S(x * down);
  return x;
}

template <class S>
[[nodiscard]] inline DoubleWord<S> shifted(const DoubleWord<S>& x, int count) noexcept {
  return {shifted(x.hi, count), shifted(x.lo, count)};
}

template <class S>
[[nodiscard]] inline DoubleWord2<S> shifted(const DoubleWord2<S>& x, int count) noexcept {
  return {shifted(x.x, count), shifted(x.y, count)};
}

/// The count for which shifted(size, count) lies in range; 0 for zero, infinity and NaN.
template <class S>
[[nodiscard]] inline int steps_into_range(S size) noexcept {
  if (is_in_range(size)) [[likely]]
    return 0;
  if (!(size > S(0)) || !is_finite(size)) return 0;
  int count = 0;
  for (; size > Range<S>::high(); --count) size = shifted(size, -1);
  for (; size < Range<S>::low(); ++count) size = shifted(size, 1);
  return count;
}

/// max(|a.x|, |a.y|)
template <class S>
[[nodiscard]] inline S size_of(const DoubleWord2<S>& a) noexcept {
  return larger(magnitude(a.x.hi), magnitude(a.y.hi));
}

/// |a.x| + |a.y|
template <class S>
[[nodiscard]] inline S sum_norm(const DoubleWord2<S>& a) noexcept {
  return S(magnitude(a.x.hi) + magnitude(a.y.hi));
}

template <class S>
[[nodiscard]] inline bool has_low_words(const DoubleWord2<S>& a) noexcept {
  return a.x.lo != S(0) || a.y.lo != S(0);
}

/// The closing rate that rounding alone can feign, of a sum of products whose absolute values add
/// up to `terms`, with velocities that come in steps of `grain` and enter times `factor`: 2^4 units
/// in the last place. None where single words went in, for their products are exact. An impulse
/// below it could leave a pair as it found it, and be repeated for ever (elastic_test.cpp).
template <class S>
[[nodiscard]] inline S feigned_rate(const S& terms,
                                    bool low_words,
                                    const S& grain,
                                    const S& factor) noexcept {
  const S ulps(16);
  const S from_grain = ulps * grain * factor;
  if constexpr (kCompensated<S>) {
    return low_words ? S(from_grain + ulps * epsilon<S>() * epsilon<S>() * terms) : from_grain;
  } else {
    return S(from_grain + ulps * epsilon<S>() * terms);
  }
}

/// A duration from kernels that ran on shifted lengths and speeds; none if it is not a number >= 0
/// that S can hold.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> checked_duration(const Duration<S>& t) noexcept {
  if (!(t.hi >= S(0)) || !is_finite(t.hi)) return std::nullopt;
  return t;
}

/// Margins about a wall's ends, in units of 4 eps of the distance from the end, and of the flown
/// way as well where the time has one word: more than the errors of a time and of the sum in (2). A
/// face accepts in three margins, an end withdraws in one; the two margins between are the errors
/// of their two times, so no contact falls through. Derived; no unit. Larger: a contact with an end
/// that close takes the face's normal; smaller: leaks (wall_end_test.cpp).
inline constexpr int kMarginOfFace = 3;
inline constexpr int kMarginOfEnd = 1;

/// (2): is 0 < s < 1, or s within `margins` of it? Never for an edge without length.
template <class S>
[[nodiscard]] inline bool projects_within(const RelativeMotion<S>& motion,
                                          const DoubleWord2<S>& edge,
                                          const Duration<S>& t,
                                          int margins) noexcept {
  const S ex = edge.x.hi, ey = edge.y.hi;
  const S from_x = ex * motion.position.x.hi, from_y = ey * motion.position.y.hi;
  const S way_x = ex * motion.velocity.x.hi, way_y = ey * motion.velocity.y.hi;
  const S square_length = ex * ex + ey * ey;
  const S along = (from_x + from_y) + t.hi * (way_x + way_y);
  const S terms = (magnitude(from_x) + magnitude(from_y)) +
                  t.hi * (magnitude(way_x) + magnitude(way_y)) + square_length;
  const S slack = S(32) * epsilon<S>() * terms;
  if (along > slack && square_length - along > slack) return true;
  if (along < -slack || along - square_length > slack) return false;

  const DoubleWord2<S> from_start = displacement_at(motion, t);
  const DoubleWord2<S> from_end = from_start - edge;
  const S way = t.lo == S(0) ? S(t.hi * sum_norm(motion.velocity)) : S(0);
  const S unit = S(4 * margins) * epsilon<S>() * sum_norm(edge);
  return to_scalar(dot(edge, from_start)) > -unit * (sum_norm(from_start) + way) &&
         to_scalar(dot(edge, from_end)) < unit * (sum_norm(from_end) + way);
}

}  // namespace detail

/// RelativeMotion::grain of two bodies that move at these velocities: an ulp of their largest low
/// word; of their largest component for wide scalars, which have no low words.
template <class S>
[[nodiscard]] inline S velocity_grain(const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  using detail::larger;
  using detail::magnitude;
  if constexpr (kCompensated<S>) {
    return detail::epsilon<S>() * larger(larger(magnitude(a.x.lo), magnitude(a.y.lo)),
                                         larger(magnitude(b.x.lo), magnitude(b.y.lo)));
  } else {
    return S(detail::epsilon<S>() * larger(detail::size_of(a), detail::size_of(b)));
  }
}

}  // namespace stoss::engine

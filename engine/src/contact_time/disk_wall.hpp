// SPDX-License-Identifier: Apache-2.0
// Earliest contact of a disk with a wall: its two faces, and the points at its two ends.
//   (1) |e x (p + v t)| = r |e|    p, v: disk's centre [m] from the wall's start, and its velocity
//       [m/s] from the wall; e = end - start [m]; r: radius [m]
//   (2) h = e x p,  w = e x v  (both signs turned so that h >= 0),  g = h - r |e|
//   (3) t = g / -w  if w < 0, g > 0;  t = 0 if w < 0, g <= 0;  else never
//   (4) the face is hit if 0 <= e . (p + v t) <= e . e; an end if |p + v t| = r, disk_disk.hpp
// Source: (1)-(3) elementary; event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part.
//   Mech. 1 (2014) 191; double words: Joldes, Muller, Popescu, ACM TOMS 44 (2017) 15res.
// Deviation: no unit normal, whose rounding would be the largest error; g and |e| get a second
//   word when less than 0.9 h is left, and g and w a third when only 2^-44 is. (4) holds with a
//   margin of rounding, and ends are full circles, so nothing slips through between them. Flights
//   longer than 32 r get a second word of t.
// Accuracy: t to 4 ulp for gaps and slopes down to 1e-17, walls up to 1e9 m, no missed and no false
//   contact: tests/engine/contact_time/disk_wall_test.cpp. Wide scalars: plain (3).
// Preconditions: r > 0; |e| = 0 is a wall with ends only. NaN and infinity never yield a contact.
#pragma once

#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/wall_terms.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine {

/// What of a wall a disk meets.
enum class WallFeature { Face, Start, End };

namespace detail {

/// t = 0 for a disk that touches the line and closes in, at a rate `w` that rounding cannot feign.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> touching_face(const RelativeMotion<S>& motion,
                                                              const DoubleWord2<S>& edge,
                                                              const S& w) noexcept {
  const S terms = cross_terms(edge, motion.velocity);
  const bool low_words = has_low_words(edge) || has_low_words(motion.velocity);
  const S feigned = feigned_rate(terms, low_words, motion.grain, sum_norm(edge));
  if (!(w < -feigned)) return std::nullopt;
  return Duration<S>{};
}

/// (3) once more from where `t` leads, in double words. `side`: the sign of h.
template <class S>
[[nodiscard]] inline Duration<S> refined_face_time(const RelativeMotion<S>& motion,
                                                   const DoubleWord2<S>& edge,
                                                   const S& radius,
                                                   const S& t,
                                                   int side) noexcept {
  const DoubleWord<S> h = cross(edge, displacement_at(motion, Duration<S>{t, S(0)}));
  const DoubleWord<S> w = cross(edge, motion.velocity);
  const DoubleWord<S> gap = (side < 0 ? -h : h) - sqrt(square_norm(edge)) * radius;
  const DoubleWord<S> sum = two_sum(t, S(to_scalar(gap) / (side < 0 ? w.hi : S(-w.hi))));
  return {sum.hi, sum.lo};
}

/// Accepts a time on the line if it falls on the segment, (4).
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> on_segment(
    const RelativeMotion<S>& motion,
    const DoubleWord2<S>& edge,
    const std::optional<Duration<S>>& t) noexcept {
  if (!t || !projects_within(motion, edge, *t, kMarginOfFace)) return std::nullopt;
  return t;
}

/// cross(a, b) to an ulp, also where nothing but low words of its terms is left.
template <class S>
[[nodiscard]] inline S cancelling_cross(const DoubleWord2<S>& a, const DoubleWord2<S>& b) noexcept {
  const S result = rounded_cross(a, b);
  if constexpr (kCompensated<S>) {
    if (magnitude(result) < S(kThirdWordShare) * epsilon<S>() * cross_terms(a, b)) {
      return to_scalar(cross_in_three_words(a, b));
    }
  }
  return result;
}

/// g where it cancels, in two or in three words. `side`: the sign of h.
template <class S>
[[nodiscard]] inline S cancelling_face_gap(const DoubleWord2<S>& position,
                                           const DoubleWord2<S>& edge,
                                           const S& radius,
                                           int side) noexcept {
  const DoubleWord<S> height = cross(edge, position);
  const DoubleWord<S> length = sqrt(square_norm(edge));
  const S gap = to_scalar((side < 0 ? -height : height) - length * radius);
  if (magnitude(gap) >= S(kThirdWordShare) * epsilon<S>() * cross_terms(edge, position)) return gap;
  return to_scalar(face_gap_in_three_words(position, edge, radius, side));
}

/// (3) for lengths and speeds within Range<S>.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> line_contact(const RelativeMotion<S>& motion,
                                                             const DoubleWord2<S>& edge,
                                                             const S& radius) noexcept {
  using std::sqrt;
  S h = rounded_cross(edge, motion.position);
  S w = cancelling_cross(edge, motion.velocity);
  const int side = h < S(0) ? -1 : 1;
  if (side < 0) {
    h = -h;
    w = -w;
  }
  if (!(w < S(0))) return std::nullopt;
  S gap = h - radius * S(sqrt(S(edge.x.hi * edge.x.hi + edge.y.hi * edge.y.hi)));
  if constexpr (kCompensated<S>) {
    if (!(gap >= S(0.9) * h)) gap = cancelling_face_gap(motion.position, edge, radius, side);
  }
  if (gap <= S(0)) return touching_face(motion, edge, w);
  const S t = gap / -w;
  if (!(t >= S(0))) return std::nullopt;
  if constexpr (kCompensated<S>) {
    if (t * size_of(motion.velocity) > S(kLongFlight) * radius) {
      return refined_face_time(motion, edge, radius, t, side);
    }
  }
  return Duration<S>{t, S(0)};
}

/// The same for lengths or speeds outside Range<S>.
template <class S>
[[nodiscard, gnu::noinline, gnu::cold]] inline std::optional<Duration<S>> face_contact_shifted(
    const RelativeMotion<S>& motion, const DoubleWord2<S>& edge, const S& radius) noexcept {
  const S length = larger(larger(size_of(motion.position), size_of(edge)), radius);
  const S speed = size_of(motion.velocity);
  if (!is_finite(length) || !is_finite(speed)) return std::nullopt;
  if (!(speed > S(0)) || !(radius > S(0))) return std::nullopt;
  const int by_length = steps_into_range(length);
  const int by_speed = steps_into_range(speed);
  const RelativeMotion<S> near{shifted(motion.position, by_length),
                               shifted(motion.velocity, by_speed),
                               shifted(motion.grain, by_speed)};
  const DoubleWord2<S> near_edge = shifted(edge, by_length);
  const std::optional<Duration<S>> t =
      on_segment(near, near_edge, line_contact(near, near_edge, S(shifted(radius, by_length))));
  if (!t) return std::nullopt;
  const int back = by_speed - by_length;
  return checked_duration(Duration<S>{shifted(t->hi, back), shifted(t->lo, back)});
}

}  // namespace detail

/// Seconds until the disk touches either face of the wall while approaching, (3) and (4); none if
/// it never does. `motion`: the disk's centre seen from the wall's start; `edge`: end - start.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> disk_wall_face_contact(
    const RelativeMotion<S>& motion, const DoubleWord2<S>& edge, S radius) noexcept {
  using detail::magnitude;
  const DoubleWord2<S>& p = motion.position;
  const DoubleWord2<S>& v = motion.velocity;
  const S edge_size = detail::size_of(edge);
  const S length = detail::larger(detail::larger(detail::size_of(p), edge_size), radius);
  const S speed = detail::size_of(v);
  using Range = detail::Range<S>;
  if (!(length <= Range::high() && edge_size >= Range::low() && radius > S(0) &&
        speed <= Range::high() && speed >= Range::low())) [[unlikely]] {
    return detail::face_contact_shifted(motion, edge, radius);
  }
  if constexpr (kCompensated<S>) {
    const S slack = S(8) * detail::epsilon<S>();
    const S h_right = edge.x.hi * p.y.hi, h_left = edge.y.hi * p.x.hi;
    const S w_right = edge.x.hi * v.y.hi, w_left = edge.y.hi * v.x.hi;
    const S h = h_right - h_left, w = w_right - w_left;
    const bool certain = magnitude(h) > slack * (magnitude(h_right) + magnitude(h_left)) &&
                         magnitude(w) > slack * (magnitude(w_right) + magnitude(w_left));
    if (certain && (h > S(0)) == (w > S(0))) return std::nullopt;  // recedes beyond any rounding
  }
  return detail::on_segment(motion, edge, detail::line_contact(motion, edge, radius));
}

/// Seconds until the disk touches a point while approaching: a wall's end, met as a full circle.
/// `motion`: the disk's centre seen from the point.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> disk_point_contact(const RelativeMotion<S>& motion,
                                                                   S radius) noexcept {
  return disk_disk_contact(motion, DoubleWord<S>{radius, S(0)});
}

/// True if at the duration the centre projects on the inside of the segment, or past an end by no
/// more than a margin of rounding, in which disk_wall_face_contact accepts: a contact with an end
/// found there is the face's business, and one that the face does not share closes in by rounding
/// alone (a disk sliding along the wall). For chains, ask it of every wall that shares the point.
template <class S>
[[nodiscard]] inline bool projects_inside(const RelativeMotion<S>& motion,
                                          const DoubleWord2<S>& edge,
                                          const Duration<S>& t) noexcept {
  return detail::projects_within(motion, edge, t, detail::kMarginOfEnd);
}

}  // namespace stoss::engine

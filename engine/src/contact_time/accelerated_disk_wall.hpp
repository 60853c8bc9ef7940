// SPDX-License-Identifier: Apache-2.0
// Earliest contact of a disk with the faces of a wall under constant relative acceleration.
//   (1) |e x x(t)| = r |e|,  x(t) = p + v t + a t^2 / 2   p [m], v [m/s], a [m/s^2] of the disk's
//       centre from the wall's start; e = end - start [m]; r: radius [m]; t [s]
//   (2) h = e x p,  w = e x v,  k = e x a  (all signs turned so that h >= 0),  g = h - r |e|
//   (3) t = 2 g / (sqrt(D) - w)  if w < 0;   -(w + sqrt(D)) / k  if w >= 0, k < 0;  D = w^2 - 2 k g
//   (4) for the face on the other side the same with -h, -w, -k
//   (5) the face is hit if 0 <= e . x(t) <= e . e; ends: accelerated_disk_disk.hpp
// (3) is where the gap to one face falls to zero; each face has no more than one such instant. A
// disk may fly past an end, and come down on a face, or up on the other one, later.
// Source: elementary; event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1
//   (2014) 191; double words: Joldes, Muller, Popescu, ACM TOMS 44 (2017) 15res.
// Deviation: as disk_wall.hpp; D and its terms get more words if less than 2^-8 of w^2 is left. (3)
//   is solved again from the point reached, in two words.
// Accuracy: t to 0.51 ulp (measured 0.505), no missed and no false contact, for gaps and heights of
//   an apex down to 1e-17: contact_time/accelerated_wall_test.cpp. Wide scalars: plain (3).
// Preconditions: r > 0, t_max >= 0; |e| = 0 is a wall with ends only. NaN never yields a contact.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_wall.hpp"
#include "contact_time/wall_terms.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace stoss::engine {

namespace detail {

/// A gap of less than this share of h is formed in double words, as in disk_wall.hpp. Chosen; no
/// unit. Larger: slower; smaller: loses a bit of g.
inline constexpr double kPlainShare = 0.9;

/// If less than this share of w^2 is left in D, g, w and k are formed in three words: above, the
/// 2^-60 that g may have lost are 2^-4 ulp of t. Derived; no unit. Larger: slower; smaller: an apex
/// at the height of contact loses bits.
inline constexpr double kGrazingShare = 0x1p-8;

/// Relative errors of a time in one word, in units of eps; the true ones are below 4. Chosen.
/// Larger: no effect but time; smaller: contacts at t_max would be lost.
inline constexpr int kSlack = 16;

/// Is the centre certainly beside the segment at a time in one word? In doubt not.
template <class S>
[[nodiscard]] inline bool projects_outside(const AcceleratedMotion<S>& motion,
                                           const DoubleWord2<S>& edge,
                                           const S& t) noexcept {
  const S ex = edge.x.hi, ey = edge.y.hi, half = S(0.5) * t;
  const DoubleWord2<S>&p = motion.position, &v = motion.velocity, &a = motion.acceleration;
  const S x = p.x.hi + t * (v.x.hi + half * a.x.hi), y = p.y.hi + t * (v.y.hi + half * a.y.hi);
  const S along = ex * x + ey * y, square_length = ex * ex + ey * ey;
  const S path = sum_norm(p) + t * (sum_norm(v) + t * sum_norm(a)) + sum_norm(edge);
  const S slack = S(kSlack) * epsilon<S>() * path * sum_norm(edge);
  return along < -slack || along - square_length > slack;
}

/// (1)-(4) of one disk and one wall, for sizes within kSizeMin and kSizeMax.
template <class S>
class FaceCurve {
 public:
  FaceCurve(const AcceleratedMotion<S>& motion,
            const DoubleWord2<S>& edge,
            const S& radius) noexcept;

  /// The first contact within the segment, no later than t_max.
  [[nodiscard]] std::optional<Duration<S>> first_contact(const S& t_max) const noexcept;

 private:
  /// One face: its gap, the gap's rate, the rate's rate. `side`: +1 for the face left of the edge.
  struct Face {
    S gap, rate, pull;
    int side;
    bool is_far;  ///< the disk starts on the other face's side
  };

  /// g, w and k in two words each.
  struct Terms {
    DoubleWord<S> gap, rate, pull;
  };

  [[nodiscard]] S own_gap(const S& height, int side) const noexcept;
  [[nodiscard]] Terms terms_of(const Face& face, bool thorough) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> contact_with(const Face& face,
                                                        const S& t_max) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> touching(const Face& face,
                                                    const S& t_max) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> landing(const Face& face, const S& t_max) const noexcept;
  [[nodiscard]] Duration<S> turning_point(const Face& face) const noexcept;

  const AcceleratedMotion<S>& motion_;
  const DoubleWord2<S>& edge_;
  S radius_;
};

template <class S>
FaceCurve<S>::FaceCurve(const AcceleratedMotion<S>& motion,
                        const DoubleWord2<S>& edge,
                        const S& radius) noexcept
    : motion_(motion), edge_(edge), radius_(radius) {}

/// g of the face that the disk is on; `height` = h >= 0.
template <class S>
S FaceCurve<S>::own_gap(const S& height, int side) const noexcept {
  using std::sqrt;
  const S length = sqrt(S(edge_.x.hi * edge_.x.hi + edge_.y.hi * edge_.y.hi));
  const S gap = height - radius_ * length;
  if constexpr (kCompensated<S>) {
    if (!(gap >= S(kPlainShare) * height)) {
      return cancelling_face_gap(motion_.position, edge_, radius_, side);
    }
  }
  return gap;
}

template <class S>
typename FaceCurve<S>::Terms FaceCurve<S>::terms_of(const Face& face,
                                                    bool thorough) const noexcept {
  const DoubleWord2<S> edge = face.side < 0 ? -edge_ : edge_;
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  if (thorough) {
    return {face_gap_in_three_words(p, edge_, radius_, face.side),
            cross_in_three_words(edge, v),
            cross_in_three_words(edge, a)};
  }
  return {accurate_face_gap(p, edge_, radius_, face.side),
          accurate_cross(edge, v),
          accurate_cross(edge, a)};
}

/// The contact with a face that the disk touches.
template <class S>
std::optional<Duration<S>> FaceCurve<S>::touching(const Face& face, const S& t_max) const noexcept {
  const DoubleWord2<S>& v = motion_.velocity;
  const S terms = cross_terms(edge_, v);
  const bool low_words = has_low_words(edge_) || has_low_words(v);
  const S feigned = feigned_rate(terms, low_words, motion_.grain, sum_norm(edge_));
  if (face.rate < -feigned) return Duration<S>{};
  if (!(face.pull < S(0))) return std::nullopt;
  if (face.rate <= feigned) return Duration<S>{};
  const S square_rate = face.rate * face.rate;
  S d = square_rate - S(2) * face.pull * face.gap;
  if (magnitude(d) < S(kGrazingShare) * square_rate) {
    const Terms in = terms_of(face, true);
    d = to_scalar(square(in.rate) - in.pull * in.gap * S(2));
  }
  return d > S(0) ? landing(face, t_max) : turning_point(face);
}

/// Where the gap is widest, for a disk that turns before it has come off.
template <class S>
Duration<S> FaceCurve<S>::turning_point(const Face& face) const noexcept {
  if constexpr (kCompensated<S>) {
    const Terms in = terms_of(face, true);
    const DoubleWord<S> t = in.rate / -in.pull;
    return {t.hi, t.lo};
  } else {
    return {S(face.rate / -face.pull), S(0)};
  }
}

/// Where the gap falls to zero in the future, (3); none as well if that is late or off the segment.
template <class S>
std::optional<Duration<S>> FaceCurve<S>::landing(const Face& face, const S& t_max) const noexcept {
  using std::sqrt;
  const S zero(0), two(2);
  const bool closes = face.rate < zero;
  if (closes ? !(face.gap > zero) : !(face.pull < zero)) return std::nullopt;
  const S square_rate = face.rate * face.rate;
  S d = square_rate - two * face.pull * face.gap;
  const bool grazes = magnitude(d) < S(kGrazingShare) * square_rate;
  Terms in;
  if (kCompensated<S> && grazes) {
    in = terms_of(face, true);
    d = to_scalar(square(in.rate) - in.pull * in.gap * two);
  }
  if (!(d > zero)) return std::nullopt;
  const S root = sqrt(d);
  const S t = closes ? S(two * face.gap / (root - face.rate)) : S(-(face.rate + root) / face.pull);
  if (!(t >= zero)) return std::nullopt;
  if constexpr (kCompensated<S>) {
    if (t > t_max + t_max * S(kSlack) * epsilon<S>()) return std::nullopt;
    if (projects_outside(motion_, edge_, t)) return std::nullopt;
    // In two words always: the three roundings of g, w and D alone would add up to 3 ulp.
    if (!grazes) in = terms_of(face, false);
    const S gap = to_scalar(in.gap + (in.rate + in.pull * S(S(0.5) * t)) * t);
    const S closing = -to_scalar(in.rate + in.pull * t);
    const S rest_d = closing * closing - two * in.pull.hi * gap;
    const S rest = two * gap / (closing + S(sqrt(larger(rest_d, zero))));
    const DoubleWord<S> sum = is_finite(rest) ? two_sum(t, rest) : DoubleWord<S>{t, zero};
    return Duration<S>{sum.hi, sum.lo};
  }
  return Duration<S>{t, zero};
}

/// The contact with one face within the segment.
template <class S>
std::optional<Duration<S>> FaceCurve<S>::contact_with(const Face& face,
                                                      const S& t_max) const noexcept {
  const std::optional<Duration<S>> t =
      face.gap <= S(0) && !face.is_far ? touching(face, t_max) : landing(face, t_max);
  if (!t || is_later(*t, t_max)) return std::nullopt;
  if (!projects_within(motion_, edge_, *t, kMarginOfFace)) return std::nullopt;
  return t;
}

template <class S>
std::optional<Duration<S>> FaceCurve<S>::first_contact(const S& t_max) const noexcept {
  using std::sqrt;
  const S height = rounded_cross(edge_, motion_.position);
  const S rate = cancelling_cross(edge_, motion_.velocity);
  const S pull = cancelling_cross(edge_, motion_.acceleration);
  const int side = height < S(0) ? -1 : 1;
  const S h = magnitude(height);
  const S w = side < 0 ? S(-rate) : rate, k = side < 0 ? S(-pull) : pull;
  // A disk that recedes for good from the face it is on cannot reach the other one.
  if (w > S(0) && k >= S(0)) return std::nullopt;
  const Face own{own_gap(h, side), w, k, side, false};
  const std::optional<Duration<S>> first = contact_with(own, t_max);
  if (first || !(w < S(0) && k > S(0))) return first;
  // It falls past the wall, and comes back from below.
  const S length = sqrt(S(edge_.x.hi * edge_.x.hi + edge_.y.hi * edge_.y.hi));
  return contact_with(Face{S(-(h + radius_ * length)), S(-w), S(-k), -side, true}, t_max);
}

/// (1) for sizes outside the range of FaceCurve.
template <class S>
[[nodiscard, gnu::noinline, gnu::cold]] inline std::optional<Duration<S>> face_curve_shifted(
    const AcceleratedMotion<S>& motion,
    const DoubleWord2<S>& edge,
    const S& radius,
    const S& t_max) noexcept {
  const S length = larger(larger(whole_size(motion.position), whole_size(edge)), radius);
  const S speed = whole_size(motion.velocity), pull = whole_size(motion.acceleration);
  if (!is_finite(length) || !is_finite(speed) || !is_finite(pull)) return std::nullopt;
  if (!(radius > S(0)) || !(sum_norm(edge) > S(0))) return std::nullopt;
  const Shift<S> by = shift_of(length, speed, pull);
  const AcceleratedMotion<S> near = scaled(motion, by);
  std::optional<Duration<S>> t;
  if (!(sum_norm(near.acceleration) > S(kFaintest))) {
    t = disk_wall_face_contact(straight(motion), edge, radius);
  } else {
    const DoubleWord2<S> near_edge = scaled(edge, by.length);
    const FaceCurve<S> curve(near, near_edge, S(radius * by.length));
    t = curve.first_contact(std::numeric_limits<S>::infinity());
    if (t) t = checked_duration(Duration<S>{S(t->hi / by.time), S(t->lo / by.time)});
  }
  if (t && is_later(*t, t_max)) return std::nullopt;
  return t;
}

template <class S>
[[nodiscard]] inline std::optional<Duration<S>> face_curve_contact(
    const AcceleratedMotion<S>& motion,
    const DoubleWord2<S>& edge,
    const S& radius,
    const S& t_max) noexcept {
  const S edge_size = whole_size(edge);
  const S length = whole_size(motion.position) + edge_size + radius;
  const S speed = whole_size(motion.velocity), pull = whole_size(motion.acceleration);
  const S low = S(kSizeMin), high = S(kSizeMax);
  if (!(length <= high && edge_size >= low && radius > S(0) && speed <= high && pull <= high &&
        pull >= low)) [[unlikely]] {
    return face_curve_shifted(motion, edge, radius, t_max);
  }
  return FaceCurve<S>(motion, edge, radius).first_contact(t_max);
}

}  // namespace detail

/// Seconds until the disk touches either face of the wall while approaching, (3) to (5), no later
/// than t_max, which may be infinite; none if it does not. `motion`: the disk's centre seen from
/// the wall's start; `edge`: end - start.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> accelerated_face_contact(
    const AcceleratedMotion<S>& motion,
    const DoubleWord2<S>& edge,
    S radius,
    const S& t_max) noexcept {
  using detail::Inner;
  if (!(t_max >= S(0))) return std::nullopt;
  if (detail::is_zero(motion.acceleration)) {
    const std::optional<Duration<S>> t =
        disk_wall_face_contact(detail::straight(motion), edge, radius);
    if (t && detail::is_later(*t, t_max)) return std::nullopt;
    return t;
  }
  const AcceleratedMotion<Inner<S>> wide = detail::widened(motion);
  const auto wide_radius = static_cast<Inner<S>>(radius);
  const auto t = detail::face_curve_contact(
      wide, detail::widened(edge), wide_radius, static_cast<Inner<S>>(t_max));
  if (!t) return std::nullopt;
  return detail::narrowed<S>(*t, detail::is_long_flight(wide, wide_radius, t->hi));
}

}  // namespace stoss::engine

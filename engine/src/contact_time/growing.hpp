// SPDX-License-Identifier: Apache-2.0
// Earliest contact of growing disks in straight relative motion, with disks and walls.
//   (1) |p + v t| = d + m t     p [m], v [m/s] of b from a; d [m]: r_a + r_b now; m [m/s]: growth
//   (2) a = |v|^2 - m^2,  b = p . v - d m,  c = |p|^2 - d^2,
//       D = |d v - m p|^2 - (p x v)^2  (= b^2 - a c)
//   (3) t = c / (sqrt(D) - b)  if b < 0, c > 0, D > 0;   (b + sqrt(D)) / -a  if b >= 0, a < 0
//   (4) t = g / -u   walls: g = |e x p| - r |e|,  u = +-(e x v) - m |e|; e [m]: edge, r [m]: radius
// Overlaps by rounding, b > 0, a < 0 with D <= 0 turn where they are deepest: t = b / -a.
// Source: Lubachevsky, Stillinger, J. Stat. Phys. 60 (1990) 561 (the law of growth); the factors of
//   (2): elementary; event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1.
// Deviation: D, a, b and c in double words, in three words where they cancel further; (3) is solved
//   once more from the point reached. Float runs in double. Without growth: disk_disk.hpp.
// Accuracy: t to 0.51 ulp (measured 0.500), no missed and no false contact, for gaps, depths and
//   differences |v| - m down to 1e-17: contact_time/growing_test.cpp. Wide scalars: plain (3), (4).
// Preconditions: d >= 0, r > 0; where d + m t would be negative, never. NaN never yields a contact.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"
#include "contact_time/wall_terms.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine {

/// The distance at which two disks touch: metres now, and metres per second.
template <class S>
struct GrowingReach {
  DoubleWord<S> now;
  DoubleWord<S> growth;
};

namespace detail {

/// (1)-(3) for sizes within Range<S>.
template <class S>
class GrowingPair {
 public:
  GrowingPair(const RelativeMotion<S>& motion, const GrowingReach<S>& reach) noexcept
      : motion_(motion), reach_(reach) {}

  [[nodiscard]] std::optional<Duration<S>> first_contact() const noexcept;

  /// (3) once more from where `t` leads, in double words.
  [[nodiscard]] Duration<S> refined(const S& t) const noexcept;

 private:
  /// a, b or c in two words, of three where they cancel.
  [[nodiscard]] DoubleWord<S> spread() const noexcept;
  [[nodiscard]] DoubleWord<S> trend() const noexcept;
  [[nodiscard]] DoubleWord<S> gap() const noexcept;

  [[nodiscard]] S discriminant(const DoubleWord<S>& b) const noexcept;
  const RelativeMotion<S>& motion_;
  const GrowingReach<S>& reach_;
};

/// x . y - d m in two words, of three where it cancels.
template <class S>
[[nodiscard]] inline DoubleWord<S> accurate_difference(const DoubleWord2<S>& x,
                                                       const DoubleWord2<S>& y,
                                                       const DoubleWord<S>& d,
                                                       const DoubleWord<S>& m) noexcept {
  const DoubleWord<S> result = dot(x, y) - d * m;
  const S terms =
      magnitude(S(x.x.hi * y.x.hi)) + magnitude(S(x.y.hi * y.y.hi)) + magnitude(S(d.hi * m.hi));
  if (magnitude(result.hi) >= S(kThirdWordShare) * epsilon<S>() * terms) return result;
  LongSum<S> sum;
  sum.add_product(x.x, y.x);
  sum.add_product(x.y, y.y);
  sum.add_product(-d, m);
  return sum.two_words();
}

template <class S>
DoubleWord<S> GrowingPair<S>::spread() const noexcept {
  return accurate_difference(motion_.velocity, motion_.velocity, reach_.growth, reach_.growth);
}

template <class S>
DoubleWord<S> GrowingPair<S>::trend() const noexcept {
  return accurate_difference(motion_.position, motion_.velocity, reach_.now, reach_.growth);
}

template <class S>
DoubleWord<S> GrowingPair<S>::gap() const noexcept {
  return accurate_difference(motion_.position, motion_.position, reach_.now, reach_.now);
}

/// D by that one of its two forms whose terms are the smaller.
template <class S>
S GrowingPair<S>::discriminant(const DoubleWord<S>& b) const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity;
  const DoubleWord<S>&d = reach_.now, &m = reach_.growth;
  const DoubleWord2<S> skew = v * d - p * m;
  const S result = to_scalar(square_norm(skew) - square(cross(p, v)));
  const S side = d.hi * sum_norm(v) + magnitude(m.hi) * sum_norm(p);
  if (magnitude(result) >= S(kThirdWordShare) * epsilon<S>() * side * side) return result;
  return to_scalar(square(b) - spread() * gap());
}

template <class S>
Duration<S> GrowingPair<S>::refined(const S& t) const noexcept {
  using std::sqrt;
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity;
  const DoubleWord<S> c = gap(), b = trend(), a = spread();
  const DoubleWord2<S> x = displacement_at(motion_, Duration<S>{t, S(0)});
  const DoubleWord<S> r = reach_.now + reach_.growth * t;
  const bool is_near = S(4) * t * sum_norm(v) < sum_norm(p);
  const S rest =
      is_near ? to_scalar(c + (b + b + a * t) * t) : to_scalar(square_norm(x) - square(r));
  const S closing =
      is_near ? S(-to_scalar(b + a * t)) : S(-to_scalar(dot(x, v) - r * reach_.growth));
  const S d = closing * closing - a.hi * rest;
  const S step = rest / (closing + S(sqrt(larger(d, S(0)))));
  const DoubleWord<S> sum = is_finite(step) ? two_sum(t, step) : DoubleWord<S>{t, S(0)};
  return {sum.hi, sum.lo};
}

template <class S>
std::optional<Duration<S>> GrowingPair<S>::first_contact() const noexcept {
  using std::sqrt;
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity;
  const S d1 = reach_.now.hi, m1 = reach_.growth.hi, zero(0);
  const S along_x = p.x.hi * v.x.hi, along_y = p.y.hi * v.y.hi, swelling = d1 * m1;
  const S terms = magnitude(along_x) + magnitude(along_y) + magnitude(swelling);
  const S speed2 = v.x.hi * v.x.hi + v.y.hi * v.y.hi, growth2 = m1 * m1;
  if constexpr (kCompensated<S>) {  // recedes for good, whatever rounding and low words add?
    const S slack = S(8) * epsilon<S>();
    if ((along_x + along_y) - swelling > slack * terms &&
        speed2 - growth2 > slack * (speed2 + growth2)) {
      return std::nullopt;
    }
  }
  const DoubleWord<S> b = trend();
  const DoubleWord<S> a = spread();
  bool closes = b.hi < zero;
  const DoubleWord<S> c = gap();
  if (!(c.hi > zero)) {
    const bool low_words = has_low_words(p) || has_low_words(v) || reach_.now.lo != zero;
    const S feigned = feigned_rate(terms, low_words, motion_.grain, sum_norm(p));
    if (b.hi < -feigned) return Duration<S>{};
    if (!(a.hi < zero)) return std::nullopt;
    if (b.hi <= feigned) return Duration<S>{};
    closes = false;
  }
  if (!closes && !(a.hi < zero)) return std::nullopt;
  const S disc = discriminant(b);
  if (!(disc > zero)) {
    if (closes || c.hi > zero) return std::nullopt;
    const DoubleWord<S> turn = b / -a;
    return Duration<S>{turn.hi, turn.lo};
  }
  const S root = sqrt(disc);
  const S t = closes ? S(c.hi / (root - b.hi)) : S((b.hi + root) / -a.hi);
  if (!(t >= zero) || !is_finite(t)) return std::nullopt;
  if (!(reach_.now.hi + reach_.growth.hi * t >= zero)) return std::nullopt;
  if constexpr (kCompensated<S>) return refined(t);
  return Duration<S>{t, zero};
}

/// A line and a disk whose radius grows, (4), for sizes within Range<S>.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> growing_line_contact(
    const RelativeMotion<S>& motion,
    const DoubleWord2<S>& edge,
    const GrowingReach<S>& radius) noexcept {
  const S h = rounded_cross(edge, motion.position);
  const int side = h < S(0) ? -1 : 1;
  const DoubleWord<S> rate = accurate_face_gap(motion.velocity, edge, radius.growth, side);
  if (!(rate.hi < S(0))) return std::nullopt;
  const DoubleWord<S> gap = accurate_face_gap(motion.position, edge, radius.now, side);
  if (!(gap.hi > S(0))) {
    const S terms =
        cross_terms(edge, motion.velocity) + magnitude(radius.growth.hi) * sum_norm(edge);
    const bool low_words = has_low_words(edge) || has_low_words(motion.velocity);
    const S feigned = feigned_rate(terms, low_words, motion.grain, sum_norm(edge));
    if (!(rate.hi < -feigned)) return std::nullopt;
    return Duration<S>{};
  }
  const DoubleWord<S> t = gap / -rate;
  if (!is_finite(t.hi)) return std::nullopt;
  if (!(radius.now.hi + radius.growth.hi * t.hi >= S(0))) return std::nullopt;
  return Duration<S>{t.hi, t.lo};
}

template <class S>
[[nodiscard]] inline RelativeMotion<S> shifted_motion(const RelativeMotion<S>& motion,
                                                      int by_length,
                                                      int by_speed) noexcept {
  return {shifted(motion.position, by_length),
          shifted(motion.velocity, by_speed),
          shifted(motion.grain, by_speed)};
}

/// Lengths are shifted by one count of steps and speeds by another, if they lie outside Range<S>.
struct Counts {
  int length = 0;
  int speed = 0;
};

template <class S>
[[nodiscard]] inline Counts counts_into_range(const S& length, const S& speed) noexcept {
  return {steps_into_range(length), steps_into_range(speed)};
}

/// The duration in the lengths and speeds that were given, and with no more words than it needs.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> unshifted(
    const std::optional<Duration<Inner<S>>>& t, const Counts& by, bool two_words) noexcept {
  if (!t) return std::nullopt;
  const int back = by.speed - by.length;
  const Duration<Inner<S>> moved{shifted(t->hi, back), shifted(t->lo, back)};
  if (!is_finite(moved.hi)) return std::nullopt;
  return narrowed<S>(moved, two_words);
}

template <class S>
[[nodiscard]] inline RelativeMotion<Inner<S>> widened(const RelativeMotion<S>& motion) noexcept {
  return {widened(motion.position), widened(motion.velocity), static_cast<Inner<S>>(motion.grain)};
}

}  // namespace detail

/// Seconds until two growing disks touch while approaching, (1)-(3); none if they never do.
/// `motion`: of b seen from a; a wall's end is a disk of no radius and no growth.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> growing_disk_contact(
    const RelativeMotion<S>& motion, const GrowingReach<S>& reach) noexcept {
  using detail::Inner;
  using Wide = Inner<S>;
  if (reach.growth.hi == S(0)) return disk_disk_contact(motion, reach.now);
  const RelativeMotion<Wide> wide = detail::widened(motion);
  const GrowingReach<Wide> wide_reach{detail::widened(reach.now), detail::widened(reach.growth)};
  const Wide length = detail::whole_size(wide.position) + wide_reach.now.hi;
  const Wide speed = detail::whole_size(wide.velocity) + detail::magnitude(wide_reach.growth.hi);
  const Wide all = length + speed + wide_reach.now.lo + wide_reach.growth.lo;
  if (!detail::is_finite(all) || !(wide_reach.now.hi >= Wide(0))) return std::nullopt;
  const detail::Counts by = detail::counts_into_range(length, speed);
  const RelativeMotion<Wide> near = detail::shifted_motion(wide, by.length, by.speed);
  const GrowingReach<Wide> near_reach{detail::shifted(wide_reach.now, by.length),
                                      detail::shifted(wide_reach.growth, by.speed)};
  const auto t = detail::GrowingPair<Wide>(near, near_reach).first_contact();
  const bool is_long = t && t->hi * (detail::sum_norm(near.velocity)) >
                                Wide(detail::kLongFlight) * near_reach.now.hi;
  return detail::unshifted<S>(t, by, is_long);
}

/// Seconds until a disk whose radius grows touches either face of the wall while approaching, (4);
/// none if it never does. `motion`: the disk's centre seen from the wall's start; `edge`: end -
/// start.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> growing_face_contact(
    const RelativeMotion<S>& motion,
    const DoubleWord2<S>& edge,
    const GrowingReach<S>& radius) noexcept {
  using detail::Inner;
  using Wide = Inner<S>;
  if (radius.growth.hi == S(0)) return disk_wall_face_contact(motion, edge, radius.now.hi);
  const RelativeMotion<Wide> wide = detail::widened(motion);
  const DoubleWord2<Wide> wide_edge = detail::widened(edge);
  const GrowingReach<Wide> wide_radius{detail::widened(radius.now), detail::widened(radius.growth)};
  const Wide length =
      detail::larger(detail::whole_size(wide.position), detail::whole_size(wide_edge)) +
      wide_radius.now.hi;
  const Wide speed = detail::whole_size(wide.velocity) + detail::magnitude(wide_radius.growth.hi);
  const Wide all = length + detail::whole_size(wide_edge) + speed;
  if (!detail::is_finite(all) || !(radius.now.hi > S(0))) return std::nullopt;
  const detail::Counts by = detail::counts_into_range(length, speed);
  const RelativeMotion<Wide> near = detail::shifted_motion(wide, by.length, by.speed);
  const DoubleWord2<Wide> near_edge = detail::shifted(wide_edge, by.length);
  const GrowingReach<Wide> near_radius{detail::shifted(wide_radius.now, by.length),
                                       detail::shifted(wide_radius.growth, by.speed)};
  const auto t = detail::growing_line_contact(near, near_edge, near_radius);
  if (!t || !detail::projects_within(near, near_edge, *t, detail::kMarginOfFace)) {
    return std::nullopt;
  }
  const bool is_long =
      t->hi * detail::sum_norm(near.velocity) > Wide(detail::kLongFlight) * near_radius.now.hi;
  return detail::unshifted<S>(t, by, is_long);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// Earliest contact under linear drag: of two disks, or a disk and a wall, that all share its rate.
//   (1) x(t) = p + v s,  s(t) = (1 - e^(-m t)) / m   p [m], v [m/s]; m: rate of the drag [1/s]
//   (2) t = -log(1 - m s) / m   if m s < 1;   else never: the motion ends before
//   (3) with gravity a [m/s^2] against what is fixed: x(t) = p + v s + a (t - s) / m
//   (4) h = e x p,  w = e x v,  k = e x a  (signs so that h >= 0), g = h - r |e|  as for walls
//       G(t) = g + w s + k (t - s) / m,   G' = w e^(-m t) + k s,   sign G'' = sign (k - m w)
// (1) is a straight flight in the warped time s, which the kernels for straight motion solve. In
// (3) gravity is the same for two disks and drops out of their relative motion, but not against
// walls. G turns once, at t = log(1 - m w / k) / m, or never; each piece falls to one zero or none.
// Source: (1)-(4) elementary; event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part.
//   Mech. 1 (2014) 191.
// Deviation: s and G in double words, exponentials from elementary.hpp, so that m s may
//   come as near to 1 as double words tell. (t - s) / m from a series where it cancels. Float runs
//   in double.
// Accuracy: t to 0.51 ulp (1 + 2^-8 / (1 - m s)), measured 0.500, no missed and no false contact:
//   contact_time/drag_test.cpp. Wide scalars: as far as their one word tells.
// Preconditions: m > 0, r > 0, t_max >= 0; for (4) sizes within kSizeMin and kSizeMax, or never.
// NaN and infinity never yield a contact.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/accelerated_disk_wall.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"
#include "contact_time/gap_curve.hpp"
#include "contact_time/growing.hpp"
#include "contact_time/wall_terms.hpp"
#include "elementary.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

namespace stoss::engine {

/// s(t) of (1) in two words; `rate` in 1/s.
template <class S>
[[nodiscard]] inline DoubleWord<detail::Inner<S>> warped_duration(const Duration<S>& t,
                                                                  const S& rate) noexcept {
  using Wide = detail::Inner<S>;
  const DoubleWord<Wide> time = detail::widened(DoubleWord<S>{t.hi, t.lo});
  return time * decay_mean_words(time * static_cast<Wide>(rate));
}

namespace detail {

/// (2) in two words; none if the motion ends before.
template <class S>
[[nodiscard]] inline std::optional<DoubleWord<S>> unwarped(const DoubleWord<S>& s,
                                                           const S& rate) noexcept {
  const DoubleWord<S> share = s * rate;
  if (!(sign(share - S(1)) < 0)) return std::nullopt;
  if (share.hi == S(0)) return s;
  return log1p_words(-share) / -rate;
}

/// The warped time of a contact of disks at `coarse`, in two words.
template <class S>
[[nodiscard]] inline DoubleWord<S> refined_warped_time(const RelativeMotion<S>& motion,
                                                       const DoubleWord<S>& reach,
                                                       const Duration<S>& coarse) noexcept {
  const S length = larger(size_of(motion.position), reach.hi), speed = size_of(motion.velocity);
  const S low = Range<S>::low(), high = Range<S>::high();
  if (!(kCompensated<S> && length <= high && reach.hi >= low && speed <= high && speed >= low)) {
    return {coarse.hi, coarse.lo};
  }
  const Duration<S> s = GrowingPair<S>(motion, {reach, {}}).refined(coarse.hi);
  return {s.hi, s.lo};
}

}  // namespace detail

/// Seconds until two disks under the same drag touch while approaching, (1) and (2); none if they
/// never do. `motion`: of b seen from a; `reach` = r_a + r_b in metres; `rate` in 1/s. A wall's
/// end, without gravity, is a disk of no radius.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> drag_disk_contact(const RelativeMotion<S>& motion,
                                                                  const DoubleWord<S>& reach,
                                                                  const S& rate) noexcept {
  using Wide = detail::Inner<S>;
  if (rate == S(0)) return disk_disk_contact(motion, reach);
  const RelativeMotion<Wide> wide = detail::widened(motion);
  const DoubleWord<Wide> wide_reach = detail::widened(reach);
  const auto s = disk_disk_contact(wide, wide_reach);
  if (!s) return std::nullopt;
  if (s->hi == Wide(0)) return Duration<S>{};
  const auto t =
      detail::unwarped(detail::refined_warped_time(wide, wide_reach, *s), static_cast<Wide>(rate));
  if (!t) return std::nullopt;
  const bool is_long =
      s->hi * detail::sum_norm(wide.velocity) > Wide(detail::kLongFlight) * wide_reach.hi;
  return detail::narrowed<S>(Duration<Wide>{t->hi, t->lo}, is_long);
}

namespace detail {

/// e^-y may be taken for zero from here on. Derived: below 2^-1000. No unit.
inline constexpr double kSpent = 700;

/// Below it (y - 1 + e^-y) / y^2 cancels too much to be formed as it stands. Chosen; no unit.
/// Larger: the series needs more terms; smaller: it loses more than 2^-90.
inline constexpr double kSlightDrag = 0x1p-10;

/// (y - 1 + e^-y) / y^2 = 1/2! - y/3! + y^2/4! - ... in two words, for y < kSlightDrag.
template <class S>
[[nodiscard]] inline DoubleWord<S> fall_mean_of_slight(const DoubleWord<S>& y) noexcept {
  S tail(0);
  for (std::size_t i = kInverseFactorialsOfTail.size(); i-- > 0;) {
    tail = S(kInverseFactorialsOfTail[i]) - tail * y.hi;
  }
  DoubleWord<S> sum{tail, S(0)};
  for (std::size_t i = kInverseFactorials.size(); i-- > 0;) {
    const DoubleWord<S> term{S(kInverseFactorials[i].hi), S(kInverseFactorials[i].lo)};
    sum = term - sum * y;
  }
  return sum;
}

/// Both durations of (3), s and (t - s) / m, and e^(-m t).
template <class S>
struct DragClock {
  DoubleWord<S> run;   ///< s
  DoubleWord<S> fall;  ///< (t - s) / m
  DoubleWord<S> left;  ///< e^(-m t)
};

template <class S>
[[nodiscard]] inline DragClock<S> drag_clock(const DoubleWord<S>& t, const S& rate) noexcept {
  const DoubleWord<S> y = t * rate;
  const DoubleWord<S> spent = expm1_words(-y);
  const DoubleWord<S> run = y.hi == S(0) ? t : spent / -rate;
  const DoubleWord<S> fall =
      y.hi < S(kSlightDrag) ? square(t) * fall_mean_of_slight(y) : (t - run) / rate;
  return {run, fall, spent + S(1)};
}

/// (3) and (4) of a disk and a wall. Sizes within kSizeMin and kSizeMax.
template <class S>
class DragFace {
 public:
  DragFace(const AcceleratedMotion<S>& motion,
           const DoubleWord2<S>& edge,
           const S& radius,
           const S& rate) noexcept
      : motion_(motion), edge_(edge), radius_(radius), rate_(rate) {}

  [[nodiscard]] std::optional<Duration<S>> first_contact(const S& t_max) const noexcept;

 private:
  /// g, w and k of one face.
  struct Face {
    DoubleWord<S> gap, speed, pull;
  };

  /// G, G' and G'' at one instant.
  struct Sample {
    S value, slope, bend;
  };

  [[nodiscard]] Sample sample(const Face& face, const S& t) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> touching(const Face& face) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> landing(const Face& face) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> fall_beyond(const Face& face, S low) const noexcept;
  [[nodiscard]] Duration<S> root_between(const Face& face, S low, S high) const noexcept;
  [[nodiscard]] DoubleWord<S> turn(const Face& face) const noexcept;
  [[nodiscard]] bool is_hit(const std::optional<Duration<S>>& t, const S& t_max) const noexcept;

  const AcceleratedMotion<S>& motion_;
  const DoubleWord2<S>& edge_;
  S radius_;
  S rate_;
};

template <class S>
typename DragFace<S>::Sample DragFace<S>::sample(const Face& face, const S& t) const noexcept {
  const DragClock<S> clock = drag_clock(DoubleWord<S>{t, S(0)}, rate_);
  const DoubleWord<S> slope = face.speed * clock.left + face.pull * clock.run;
  return {to_scalar((face.gap + face.speed * clock.run) + face.pull * clock.fall),
          to_scalar(slope),
          clock.left.hi * to_scalar(face.pull - face.speed * rate_)};
}

/// Where G turns: e^(m t) = 1 - m w / k.
template <class S>
DoubleWord<S> DragFace<S>::turn(const Face& face) const noexcept {
  return log1p_words(-face.speed * rate_ / face.pull) / rate_;
}

/// The contact with a face that the disk touches.
template <class S>
std::optional<Duration<S>> DragFace<S>::touching(const Face& face) const noexcept {
  const DoubleWord2<S>& v = motion_.velocity;
  const bool low_words = has_low_words(edge_) || has_low_words(v);
  const S feigned = feigned_rate(cross_terms(edge_, v), low_words, motion_.grain, sum_norm(edge_));
  if (face.speed.hi < -feigned) return Duration<S>{};
  if (!(face.pull.hi < S(0))) return std::nullopt;
  if (face.speed.hi <= feigned) return Duration<S>{};
  return landing(face);
}

/// Where G falls to zero in the future.
template <class S>
std::optional<Duration<S>> DragFace<S>::landing(const Face& face) const noexcept {
  const S zero(0);
  const bool touches = !(face.gap.hi > zero);
  if (face.speed.hi < zero) {
    if (touches) return std::nullopt;
    if (!(face.pull.hi > zero)) return fall_beyond(face, zero);
    const DoubleWord<S> bottom = turn(face);
    if (!(sample(face, bottom.hi).value < zero)) return std::nullopt;
    return root_between(face, zero, bottom.hi);
  }
  if (!(face.pull.hi < zero)) return std::nullopt;
  const DoubleWord<S> top = turn(face);
  if (!(sample(face, top.hi).value > zero)) return Duration<S>{top.hi, top.lo};
  return fall_beyond(face, top.hi);
}

/// The contact on the piece that falls from `low`, where G > 0, for ever.
template <class S>
std::optional<Duration<S>> DragFace<S>::fall_beyond(const Face& face, S low) const noexcept {
  using std::sqrt;
  const S zero(0), last = S(kSpent) / rate_;
  if (!(face.pull.hi < zero)) {  // the pull is along the wall: a straight flight
    const std::optional<DoubleWord<S>> t = unwarped(face.gap / -face.speed, rate_);
    if (!t) return std::nullopt;
    return Duration<S>{t->hi, t->lo};
  }
  if (low < last) {
    const Sample start = sample(face, low);
    const S d = start.slope * start.slope - S(2) * start.value * start.bend;
    S step = S(2) * start.value / (S(sqrt(larger(d, zero))) - start.slope);
    if (!(step > zero) || !(step < last)) step = S(1) / rate_;
    for (S high = low + step; high < last; high = low + step) {
      if (!(sample(face, high).value > zero)) return root_between(face, low, high);
      step = step + step;
    }
    if (!(sample(face, last).value > zero)) return root_between(face, low, last);
  }
  // Nothing is left of the start's motion but its way: G = g + w / m + k (t - 1 / m) / m.
  const DoubleWord<S> t =
      (face.gap * rate_ + face.speed) / -face.pull + S(1) / DoubleWord<S>{rate_, zero};
  return Duration<S>{t.hi, t.lo};
}

/// The zero of G on a falling piece with G(low) > 0 >= G(high).
template <class S>
Duration<S> DragFace<S>::root_between(const Face& face, S low, S high) const noexcept {
  using std::sqrt;
  const S eps = epsilon<S>(), zero(0);
  const bool from_low = low == zero;
  S t = from_low ? low : high;
  for (int i = 0; i < kSearchStepsMax; ++i) {
    const Sample s = sample(face, t);
    (s.value > zero ? low : high) = t;
    const S d = s.slope * s.slope - S(2) * s.value * s.bend;
    const S step = S(2) * s.value / (S(sqrt(larger(d, zero))) - s.slope);
    const S size = magnitude(step);
    const S turn_share = size * s.bend;
    if (d > zero && size * size <= eps * t * t &&
        turn_share * turn_share <= eps * (s.slope * s.slope)) {
      const DoubleWord<S> sum = two_sum(t, step);
      return {sum.hi, sum.lo};
    }
    S next = t + step;
    if (!(d > zero) || !(next > low && next < high)) next = S(0.5) * (low + high);
    if (!(low < next && next < high)) break;
    t = next;
  }
  return {t, zero};
}

template <class S>
bool DragFace<S>::is_hit(const std::optional<Duration<S>>& t, const S& t_max) const noexcept {
  if (!t || is_later(*t, t_max)) return false;
  const bool is_spent = !(t->hi * rate_ < S(kSpent));
  const DoubleWord<S> time{t->hi, t->lo};
  const DoubleWord<S> end = S(1) / DoubleWord<S>{rate_, S(0)};
  const DragClock<S> clock =
      is_spent ? DragClock<S>{end, (time - end) * end, {}} : drag_clock(time, rate_);
  const DoubleWord2<S> from_start =
      motion_.position + motion_.velocity * clock.run + motion_.acceleration * clock.fall;
  const DoubleWord2<S> from_end = from_start - edge_;
  const S unit = S(4 * kMarginOfFace) * epsilon<S>() * sum_norm(edge_);
  return to_scalar(dot(edge_, from_start)) > -unit * sum_norm(from_start) &&
         to_scalar(dot(edge_, from_end)) < unit * sum_norm(from_end);
}

template <class S>
std::optional<Duration<S>> DragFace<S>::first_contact(const S& t_max) const noexcept {
  const DoubleWord2<S>&p = motion_.position, &v = motion_.velocity, &a = motion_.acceleration;
  const int side = cross(edge_, p).hi < S(0) ? -1 : 1;
  const DoubleWord2<S> edge = side < 0 ? -edge_ : edge_;
  const Face own{face_gap_in_three_words(p, edge_, radius_, side),
                 cross_in_three_words(edge, v),
                 cross_in_three_words(edge, a)};
  const S zero(0);
  if (own.speed.hi >= zero && own.pull.hi >= zero) return std::nullopt;
  const auto first = own.gap.hi > zero ? landing(own) : touching(own);
  if (is_hit(first, t_max)) return first;
  if (!(own.speed.hi < zero && own.pull.hi > zero)) return std::nullopt;
  const Face far{face_gap_in_three_words(p, edge_, radius_, -side), -own.speed, -own.pull};
  // From that side it has to come out beyond the other face before it can land on it.
  if (!(sample(far, turn(far).hi).value > zero)) return std::nullopt;
  const auto second = landing(far);
  if (is_hit(second, t_max)) return second;
  return std::nullopt;
}

}  // namespace detail

/// Seconds until a disk under drag and gravity touches either face of the wall while approaching,
/// (3) and (4), no later than t_max, which may be infinite; none if it does not. `motion`: the
/// disk's centre seen from the wall's start, its acceleration that of gravity alone; `rate` in 1/s.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> drag_face_contact(
    const AcceleratedMotion<S>& motion,
    const DoubleWord2<S>& edge,
    S radius,
    S rate,
    const S& t_max) noexcept {
  using Wide = detail::Inner<S>;
  if (!(t_max >= S(0))) return std::nullopt;
  if (rate == S(0)) return accelerated_face_contact(motion, edge, radius, t_max);
  const AcceleratedMotion<Wide> wide = detail::widened(motion);
  const DoubleWord2<Wide> wide_edge = detail::widened(edge);
  const auto wide_radius = static_cast<Wide>(radius), wide_rate = static_cast<Wide>(rate);
  const Wide edge_size = detail::whole_size(wide_edge);
  const Wide size = detail::whole_size(wide.position) + edge_size + wide_radius;
  const Wide rates = detail::whole_size(wide.velocity) + detail::whole_size(wide.acceleration);
  const Wide low = Wide(detail::kSizeMin), high = Wide(detail::kSizeMax);
  const bool in_range = size + rates <= high && edge_size >= low && radius > S(0) &&
                        wide_rate >= low && wide_rate <= high;
  if (!in_range) return std::nullopt;
  const detail::DragFace<Wide> face(wide, wide_edge, wide_radius, wide_rate);
  const auto t = face.first_contact(static_cast<Wide>(t_max));
  if (!t) return std::nullopt;
  return detail::narrowed<S>(*t, detail::is_long_flight(wide, wide_radius, t->hi));
}

}  // namespace stoss::engine

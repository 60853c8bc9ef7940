// SPDX-License-Identifier: Apache-2.0
// Earliest contact of a disk with the faces of a wall under linear drag and a constant pull.
//   (1) x(t) = p + v s + a f    p [m], v [m/s] of the disk from the wall's start; s, f:
//   drag_clock.hpp;
//       a [m/s^2]: gravity, less m V for a wall that moves at V, which feels no drag; m: rate [1/s]
//   (2) h = e x p,  w = e x v,  k = e x a  (signs so that h >= 0), g = h - r |e|  as for walls
//       G(t) = g + w s + k f,   G' = w e^(-m t) + k s,   sign G'' = sign (k - m w)
// G turns once, at t = log(1 - m w / k) / m, or never; each piece falls to one zero or none.
// Source: elementary; event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1
// (2014)
//   191.
// Deviation: G in double words, its constants in three. Float runs in double.
// Accuracy: t to 0.51 ulp (1 + 2^-8 / (1 - m s)), measured 0.500, no missed and no false contact:
//   contact_time/drag_test.cpp. Wide scalars: as far as their one word tells.
// Preconditions: m >= 0, r > 0, t_max >= 0; sizes within kSizeMin and kSizeMax, or never. NaN and
// infinity never yield a contact.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/accelerated_disk_wall.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_wall.hpp"
#include "contact_time/drag.hpp"
#include "contact_time/drag_clock.hpp"
#include "contact_time/gap_curve.hpp"
#include "contact_time/wall_terms.hpp"
#include "elementary.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <optional>

namespace stoss::engine {

namespace detail {

/// G of (2): a distance that drag and a pull change.
template <class S>
class DragFall {
 public:
  DragFall(const DoubleWord<S>& gap,
           const DoubleWord<S>& speed,
           const DoubleWord<S>& pull,
           const S& rate) noexcept
      : gap_(gap), speed_(speed), pull_(pull), rate_(rate) {}

  /// Where G falls to zero in the future, however far.
  [[nodiscard]] std::optional<Duration<S>> landing() const noexcept;
  /// Where G turns; k != 0.
  [[nodiscard]] DoubleWord<S> turn() const noexcept;
  [[nodiscard]] S value(const S& t) const noexcept { return sample(t).value; }

  [[nodiscard]] const DoubleWord<S>& gap() const noexcept { return gap_; }
  [[nodiscard]] const DoubleWord<S>& speed() const noexcept { return speed_; }
  [[nodiscard]] const DoubleWord<S>& pull() const noexcept { return pull_; }

 private:
  /// G, G' and G'' at one instant.
  struct Sample {
    S value, slope, bend;
  };

  [[nodiscard]] Sample sample(const S& t) const noexcept;
  [[nodiscard]] std::optional<Duration<S>> fall_beyond(S low) const noexcept;
  [[nodiscard]] Duration<S> root_between(S low, S high) const noexcept;

  DoubleWord<S> gap_, speed_, pull_;
  S rate_;
};

template <class S>
typename DragFall<S>::Sample DragFall<S>::sample(const S& t) const noexcept {
  const DragClock<S> clock = drag_clock(DoubleWord<S>{t, S(0)}, rate_);
  const DoubleWord<S> slope = speed_ * clock.left + pull_ * clock.run;
  return {to_scalar((gap_ + speed_ * clock.run) + pull_ * clock.fall),
          to_scalar(slope),
          clock.left.hi * to_scalar(pull_ - speed_ * rate_)};
}

/// Where G turns: e^(m t) = 1 - m w / k.
template <class S>
DoubleWord<S> DragFall<S>::turn() const noexcept {
  return log1p_words(-speed_ * rate_ / pull_) / rate_;
}

/// Where G falls to zero in the future.
template <class S>
std::optional<Duration<S>> DragFall<S>::landing() const noexcept {
  const S zero(0);
  const bool touches = !(gap_.hi > zero);
  if (speed_.hi < zero) {
    if (touches) return std::nullopt;
    if (!(pull_.hi > zero)) return fall_beyond(zero);
    const DoubleWord<S> bottom = turn();
    if (!(sample(bottom.hi).value < zero)) return std::nullopt;
    return root_between(zero, bottom.hi);
  }
  if (!(pull_.hi < zero)) return std::nullopt;
  const DoubleWord<S> top = turn();
  if (!(sample(top.hi).value > zero)) return Duration<S>{top.hi, top.lo};
  return fall_beyond(top.hi);
}

/// The contact on the piece that falls from `low`, where G > 0, for ever.
template <class S>
std::optional<Duration<S>> DragFall<S>::fall_beyond(S low) const noexcept {
  using std::sqrt;
  const S zero(0), last = S(kSpent) / rate_;
  if (!(pull_.hi < zero)) {  // the pull is along the wall: a straight flight
    const std::optional<DoubleWord<S>> t = unwarped(gap_ / -speed_, rate_);
    if (!t) return std::nullopt;
    return Duration<S>{t->hi, t->lo};
  }
  if (low < last) {
    const Sample start = sample(low);
    const S d = start.slope * start.slope - S(2) * start.value * start.bend;
    S step = S(2) * start.value / (S(sqrt(larger(d, zero))) - start.slope);
    if (!(step > zero) || !(step < last)) step = S(1) / rate_;
    for (S high = low + step; high < last; high = low + step) {
      if (!(sample(high).value > zero)) return root_between(low, high);
      step = step + step;
    }
    if (!(sample(last).value > zero)) return root_between(low, last);
  }
  // Nothing is left of the start's motion but its way: G = g + w / m + k (t - 1 / m) / m.
  const DoubleWord<S> t = (gap_ * rate_ + speed_) / -pull_ + S(1) / DoubleWord<S>{rate_, zero};
  return Duration<S>{t.hi, t.lo};
}

/// The zero of G on a falling piece with G(low) > 0 >= G(high).
template <class S>
Duration<S> DragFall<S>::root_between(S low, S high) const noexcept {
  using std::sqrt;
  const S eps = epsilon<S>(), zero(0);
  const bool from_low = low == zero;
  S t = from_low ? low : high;
  for (int i = 0; i < kSearchStepsMax; ++i) {
    const Sample s = sample(t);
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

/// (1) and (2) of a disk and a wall. Sizes within kSizeMin and kSizeMax.
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
  [[nodiscard]] std::optional<Duration<S>> touching(const DragFall<S>& face) const noexcept;
  [[nodiscard]] bool is_hit(const std::optional<Duration<S>>& t, const S& t_max) const noexcept;

  const AcceleratedMotion<S>& motion_;
  const DoubleWord2<S>& edge_;
  S radius_;
  S rate_;
};

/// The contact with a face that the disk touches.
template <class S>
std::optional<Duration<S>> DragFace<S>::touching(const DragFall<S>& face) const noexcept {
  const DoubleWord2<S>& v = motion_.velocity;
  const bool low_words = has_low_words(edge_) || has_low_words(v);
  const S feigned = feigned_rate(cross_terms(edge_, v), low_words, motion_.grain, sum_norm(edge_));
  if (face.speed().hi < -feigned) return Duration<S>{};
  if (!(face.pull().hi < S(0))) return std::nullopt;
  if (face.speed().hi <= feigned) return Duration<S>{};
  return face.landing();
}

template <class S>
bool DragFace<S>::is_hit(const std::optional<Duration<S>>& t, const S& t_max) const noexcept {
  if (!t || is_later(*t, t_max)) return false;
  const DragClock<S> clock = drag_clock(DoubleWord<S>{t->hi, t->lo}, rate_);
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
  const DragFall<S> own(face_gap_in_three_words(p, edge_, radius_, side),
                        cross_in_three_words(edge, v),
                        cross_in_three_words(edge, a),
                        rate_);
  const S zero(0);
  if (own.speed().hi >= zero && own.pull().hi >= zero) return std::nullopt;
  const auto first = own.gap().hi > zero ? own.landing() : touching(own);
  if (is_hit(first, t_max)) return first;
  if (!(own.speed().hi < zero && own.pull().hi > zero)) return std::nullopt;
  const DragFall<S> far(
      face_gap_in_three_words(p, edge_, radius_, -side), -own.speed(), -own.pull(), rate_);
  // From that side it has to come out beyond the other face before it can land on it.
  if (!(far.value(far.turn().hi) > zero)) return std::nullopt;
  const auto second = far.landing();
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

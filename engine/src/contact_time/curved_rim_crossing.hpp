// SPDX-License-Identifier: Apache-2.0
// When a point on a curve, a parabola or one under drag, crosses the rim of a fixed circle.
//   (1) |x(t)| = R    x(t) [m]: place seen from the centre; R: radius [m]; t [s]
// Inwards it is the first contact of gap_search.hpp. Outwards it is on the first of the pieces of
// F = |x|^2 - R^2 that rises and ends above zero: where it crosses zero, or at its start if F is
// not below zero there. The last piece rises for ever. Without a pull the flight is straight, or
// straight in the warped time of drag.hpp.
// Source: event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1 (2014) 191; the
//   pieces and their roots: gap_search.hpp. What counts as inside: rim_crossing.hpp.
// Deviation: as gap_curve.hpp and drag_curve.hpp. A crossing keeps within its piece.
// Accuracy: t to 0.51 ulp, from within to 40 where double words run out, no missed and no false
//   crossing: contact_time/rim_crossing_test.cpp. Wide scalars: as far as their one word tells.
// Preconditions: R > 0, t_max >= 0; under drag sizes within kSizeMin and kSizeMax, or never. NaN
// and infinity never yield a crossing.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/accelerated_disk_disk.hpp"
#include "contact_time/drag.hpp"
#include "contact_time/drag_curve.hpp"
#include "contact_time/gap_curve.hpp"
#include "contact_time/gap_search.hpp"
#include "contact_time/rim_crossing.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace stoss::engine {

namespace detail {

template <class S>
[[nodiscard]] inline bool is_before(const Duration<S>& a, const Duration<S>& b) noexcept {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

template <class S, class Gap>
class RimSearch : GapSearch<S, Gap> {
 public:
  explicit RimSearch(const Gap& gap) noexcept : GapSearch<S, Gap>(gap) {}

  [[nodiscard]] std::optional<Duration<S>> crossing(bool is_inside) const noexcept {
    return is_inside ? exit() : this->first_contact(std::numeric_limits<S>::infinity());
  }

 private:
  [[nodiscard]] std::optional<Duration<S>> exit() const noexcept;
  [[nodiscard]] Duration<S> rise(const Turn<S>& from, const S& to) const noexcept;
  [[nodiscard]] Duration<S> last_rise(const Turn<S>& from) const noexcept;
};

// F' rises to the first root of Q, falls to the second and rises for ever; without these roots it
// rises throughout.
template <class S, class Gap>
std::optional<Duration<S>> RimSearch<S, Gap>::exit() const noexcept {
  const S zero(0);
  const Inflections<S> bends = this->gap_.inflections();
  const S slope_now = this->gap_.slope_now();
  int slope = slope_now > zero ? 1 : (slope_now < zero ? -1 : this->gap_.trend());
  Turn<S> from{Duration<S>{}, this->gap_.gap_now()};
  S start = zero;
  if (bends.first > zero) {
    if (slope < 0 && this->slope_sign(bends.first) > 0) {
      from = this->turn_at(this->stationary_between(zero, bends.first, zero, Crossing::Rising));
      slope = 1;
    }
    start = bends.first;
  }
  if (bends.exist && bends.second > zero) {
    if (slope > 0 && this->slope_sign(bends.second) < 0) {
      const S middle = S(0.5) * (start + bends.second);
      const Turn<S> top =
          this->turn_at(this->stationary_between(start, bends.second, middle, Crossing::Falling));
      if (top.value > zero) {
        if (!(from.value < zero)) return from.t;
        const Duration<S> t = rise(from, top.t.hi);
        return is_before(top.t, t) ? top.t : t;
      }
      slope = -1;
    }
    start = bends.second;
  }
  if (slope < 0) from = this->turn_at(this->lowest_beyond(start));
  if (!(from.value < zero)) return from.t;
  return last_rise(from);
}

/// The root on the piece that rises from a lowest point, or the start, to beyond the rim.
template <class S, class Gap>
Duration<S> RimSearch<S, Gap>::rise(const Turn<S>& from, const S& to) const noexcept {
  const GapSample<S> s = this->gap_.coarse(from.t.hi);
  const S square_slope = s.slope * s.slope;
  const bool from_start = square_slope - s.bend * s.value > S(0.5) * square_slope;
  const S low = from.t.hi, high = larger(to, low);
  const Duration<S> root = this->root_between(low, high, from_start ? low : high, Crossing::Rising);
  return is_before(root, from.t) ? from.t : root;
}

template <class S, class Gap>
Duration<S> RimSearch<S, Gap>::last_rise(const Turn<S>& from) const noexcept {
  using std::sqrt;
  // A step that leads across the circle if the motion is about as fast as here.
  const GapSample<S> s = this->gap_.coarse(from.t.hi);
  const S speed2 = magnitude(s.bend), natural = this->gap_.natural_time();
  S step = S(2) * S(sqrt(this->gap_.reach2() / speed2));
  if (!(step < natural) || !(step > S(0))) step = natural;
  S high = from.t.hi + step;
  for (int i = 0; i < kSearchStepsMax && !(this->gap_.coarse(high).value > S(0)); ++i) {
    step = step + step;
    high = from.t.hi + step;
  }
  return rise(from, high);
}

/// (1) on a parabola, for sizes outside the range of the search.
template <class S>
[[nodiscard, gnu::noinline, gnu::cold]] inline std::optional<Duration<S>> curved_rim_shifted(
    const AcceleratedMotion<S>& motion, const DoubleWord<S>& radius, bool is_inside) noexcept {
  const S length = larger(whole_size(motion.position), radius.hi);
  const S speed = whole_size(motion.velocity), pull = whole_size(motion.acceleration);
  if (!is_finite(length) || !is_finite(speed) || !is_finite(pull)) return std::nullopt;
  if (!(radius.hi > S(0))) return std::nullopt;
  const Shift<S> by = shift_of(length, speed, pull);
  const AcceleratedMotion<S> near = scaled(motion, by);
  if (!(sum_norm(near.acceleration) > S(kFaintest))) {
    return rim_crossing(straight(motion), radius.hi, is_inside);
  }
  const DoubleWord<S> near_radius{S(radius.hi * by.length), S(0)};
  const ParabolicGap<S> gap(near, near_radius);
  const auto t = RimSearch<S, ParabolicGap<S>>(gap).crossing(is_inside);
  if (!t) return std::nullopt;
  return checked_duration(Duration<S>{S(t->hi / by.time), S(t->lo / by.time)});
}

template <class S>
[[nodiscard]] inline AcceleratedMotion<Inner<S>> widened_without_grain(
    const AcceleratedMotion<S>& motion) noexcept {
  AcceleratedMotion<Inner<S>> wide = widened(motion);
  wide.grain = Inner<S>(0);
  return wide;
}

template <class S>
[[nodiscard]] inline std::optional<Duration<S>> until(
    const S& t_max, const std::optional<Duration<S>>& t) noexcept {
  return t && !is_later(*t, t_max) ? t : std::nullopt;
}

/// Straight in the warped time of drag.hpp.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> warped_rim_crossing(const RelativeMotion<S>& motion,
                                                                    const DoubleWord<S>& radius,
                                                                    const S& rate,
                                                                    bool is_inside) noexcept {
  const auto s = is_inside ? rim_exit(motion, radius) : disk_disk_contact(motion, radius);
  if (!s || s->hi == S(0)) return s;
  const auto t = unwarped(
      is_inside ? DoubleWord<S>{s->hi, s->lo} : refined_warped_time(motion, radius, *s), rate);
  if (!t) return std::nullopt;
  return Duration<S>{t->hi, t->lo};
}

}  // namespace detail

/// Seconds until a point under constant acceleration crosses the rim the way that is left to it,
/// (1), no later than t_max, which may be infinite. `motion`: seen from the centre.
template <class S>
[[nodiscard]] inline std::optional<Duration<detail::Inner<S>>> accelerated_rim_crossing(
    const AcceleratedMotion<S>& motion, S radius, bool is_inside, const S& t_max) noexcept {
  using Wide = detail::Inner<S>;
  if (!(t_max >= S(0))) return std::nullopt;
  const auto end = static_cast<Wide>(t_max);
  if (detail::is_zero(motion.acceleration)) {
    return detail::until(end, rim_crossing(detail::straight(motion), radius, is_inside));
  }
  const AcceleratedMotion<Wide> wide = detail::widened_without_grain(motion);
  const DoubleWord<Wide> wide_radius{static_cast<Wide>(radius), Wide(0)};
  const Wide length = detail::larger(detail::whole_size(wide.position), wide_radius.hi);
  const Wide speed = detail::whole_size(wide.velocity);
  const Wide pull = detail::whole_size(wide.acceleration);
  const Wide low = Wide(detail::kSizeMin), high = Wide(detail::kSizeMax);
  if (!(length <= high && wide_radius.hi >= low && speed <= high && pull <= high && pull >= low))
      [[unlikely]] {
    return detail::until(end, detail::curved_rim_shifted(wide, wide_radius, is_inside));
  }
  const detail::ParabolicGap<Wide> gap(wide, wide_radius);
  return detail::until(
      end, detail::RimSearch<Wide, detail::ParabolicGap<Wide>>(gap).crossing(is_inside));
}

/// The same under drag; the acceleration is that of drag_curve.hpp.
template <class S>
[[nodiscard]] inline std::optional<Duration<detail::Inner<S>>> drag_rim_crossing(
    const DragMotion<S>& motion, S radius, bool is_inside, const S& t_max) noexcept {
  using Wide = detail::Inner<S>;
  constexpr double kFaintPull = 0x1p-300;
  if (!(t_max >= S(0))) return std::nullopt;
  const AcceleratedMotion<Wide> wide = detail::widened_without_grain<S>(motion);
  const DoubleWord<Wide> wide_radius{static_cast<Wide>(radius), Wide(0)};
  const auto rate = static_cast<Wide>(motion.rate), end = static_cast<Wide>(t_max);
  if (!(detail::sum_norm(wide.acceleration) > Wide(kFaintPull))) {
    return detail::until(
        end, detail::warped_rim_crossing(detail::straight(wide), wide_radius, rate, is_inside));
  }
  const Wide length = detail::whole_size(wide.position) + wide_radius.hi;
  const Wide rates = detail::whole_size(wide.velocity) + detail::whole_size(wide.acceleration);
  const Wide low = Wide(detail::kSizeMin), high = Wide(detail::kSizeMax);
  const bool in_range =
      length + rates <= high && wide_radius.hi >= low && rate >= low && rate <= high;
  if (!in_range) return std::nullopt;
  const detail::DragGap<Wide> gap(wide, wide_radius, rate);
  return detail::until(end,
                       detail::RimSearch<Wide, detail::DragGap<Wide>>(gap).crossing(is_inside));
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// Earliest contact of two disks, or of a disk and a point, under constant relative acceleration.
//   (1) |p + v t + a t^2 / 2| = d   p [m], v [m/s], a [m/s^2] of b from a; d: reach [m]; t [s]
// Uniform gravity against what rests, or is moved, or the friction of a floor: one quartic for all.
// Source: event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1 (2014) 191; the
//   solution: gap_curve.hpp.
// Deviation: no complex roots, no coefficients: see gap_curve.hpp. Without acceleration the
//   quadratic of disk_disk.hpp. Flights longer than 32 d have a second word of t.
// Accuracy: t to 0.51 ulp (measured 0.500), no missed and no false contact, for gaps, depths and
//   overlaps down to 1e-17 d: contact_time/accelerated_test.cpp. Where v^2 / |a| or |p| exceeds
//   1e14 d, as far as double words tell. Wide scalars: as far as their one word tells.
// Preconditions: d >= 0, t_max >= 0; otherwise, and for NaN, never.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/gap_curve.hpp"
#include "stoss/engine/double_word.hpp"

#include <limits>
#include <optional>

namespace stoss::engine {

namespace detail {

/// (1) for sizes within kSizeMin and kSizeMax.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> curve_contact(const AcceleratedMotion<S>& motion,
                                                              const DoubleWord<S>& reach,
                                                              const S& t_max) noexcept {
  const ParabolicGap<S> gap(motion, reach);
  return GapSearch<S, ParabolicGap<S>>(gap).first_contact(t_max);
}

/// (1) for sizes outside this range.
template <class S>
[[nodiscard, gnu::noinline, gnu::cold]] inline std::optional<Duration<S>> curved_contact_shifted(
    const AcceleratedMotion<S>& motion, const DoubleWord<S>& reach, const S& t_max) noexcept {
  const S length = larger(whole_size(motion.position), reach.hi);
  const S speed = whole_size(motion.velocity), pull = whole_size(motion.acceleration);
  if (!is_finite(S(length + reach.lo)) || !is_finite(speed) || !is_finite(pull)) {
    return std::nullopt;
  }
  if (!(reach.hi > S(0))) return std::nullopt;
  const Shift<S> by = shift_of(length, speed, pull);
  const AcceleratedMotion<S> near = scaled(motion, by);
  std::optional<Duration<S>> t;
  if (!(sum_norm(near.acceleration) > S(kFaintest))) {
    t = disk_disk_contact(straight(motion), reach);
  } else {
    const DoubleWord<S> near_reach{S(reach.hi * by.length), S(reach.lo * by.length)};
    t = curve_contact(near, near_reach, std::numeric_limits<S>::infinity());
    if (t) t = checked_duration(Duration<S>{S(t->hi / by.time), S(t->lo / by.time)});
  }
  if (t && is_later(*t, t_max)) return std::nullopt;
  return t;
}

/// (1) with both words of the time.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> curved_contact(const AcceleratedMotion<S>& motion,
                                                               const DoubleWord<S>& reach,
                                                               const S& t_max) noexcept {
  const S length = larger(whole_size(motion.position), reach.hi) + reach.lo;
  const S speed = whole_size(motion.velocity), pull = whole_size(motion.acceleration);
  const S low = S(kSizeMin), high = S(kSizeMax);
  if (!(length <= high && reach.hi >= low && speed <= high && pull <= high && pull >= low))
      [[unlikely]] {
    return curved_contact_shifted(motion, reach, t_max);
  }
  // Can the way that is left be flown at all?
  const S way = t_max * (speed + S(0.5) * t_max * pull);
  if (sum_norm(motion.position) > S(2) * (reach.hi + way)) return std::nullopt;
  return curve_contact(motion, reach, t_max);
}

}  // namespace detail

/// Seconds until two disks touch while approaching, (1), no later than t_max, which may be
/// infinite; none if they do not. `motion`: of b seen from a; `reach` = r_a + r_b in metres.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> accelerated_disk_contact(
    const AcceleratedMotion<S>& motion, const DoubleWord<S>& reach, const S& t_max) noexcept {
  using detail::Inner;
  if (!(t_max >= S(0))) return std::nullopt;
  if (detail::is_zero(motion.acceleration)) {
    const std::optional<Duration<S>> t = disk_disk_contact(detail::straight(motion), reach);
    if (t && detail::is_later(*t, t_max)) return std::nullopt;
    return t;
  }
  const AcceleratedMotion<Inner<S>> wide = detail::widened(motion);
  const DoubleWord<Inner<S>> wide_reach = detail::widened(reach);
  const auto t = detail::curved_contact(wide, wide_reach, static_cast<Inner<S>>(t_max));
  if (!t) return std::nullopt;
  return detail::narrowed<S>(*t, detail::is_long_flight(wide, wide_reach.hi, t->hi));
}

/// Seconds until a disk touches a point while approaching: a wall's end, met as a full circle.
/// `motion`: the disk's centre seen from the point.
template <class S>
[[nodiscard]] inline std::optional<Duration<S>> accelerated_point_contact(
    const AcceleratedMotion<S>& motion, S radius, const S& t_max) noexcept {
  return accelerated_disk_contact(motion, DoubleWord<S>{radius, S(0)}, t_max);
}

}  // namespace stoss::engine

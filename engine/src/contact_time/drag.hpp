// SPDX-License-Identifier: Apache-2.0
// Earliest contact of two disks under linear drag, where they share its rate and what else pulls.
//   (1) x(t) = p + v s,  s(t) = (1 - e^(-m t)) / m   p [m], v [m/s]; m: rate of the drag [1/s]
//   (2) t = -log(1 - m s) / m   if m s < 1;   else never: the motion ends before
// (1) is a straight flight in the warped time s, which the kernels for straight motion solve.
// Gravity is the same for two disks and drops out of their relative motion. Source: elementary;
// event rule: Bannerman, Strobl, Formella, Poeschel, Comput. Part. Mech. 1 (2014)
//   191.
// Deviation: s in double words, exponentials from elementary.hpp, so that m s may come as near to 1
//   as double words tell. Float runs in double.
// Accuracy: t to 0.51 ulp (1 + 2^-8 / (1 - m s)), measured 0.500, no missed and no false contact:
//   contact_time/drag_test.cpp. Wide scalars: as far as their one word tells.
// Preconditions: m >= 0. NaN and infinity never yield a contact.
#pragma once

#include "contact_time/accelerated.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/drag_clock.hpp"
#include "contact_time/growing.hpp"
#include "elementary.hpp"
#include "stoss/engine/double_word.hpp"

#include <optional>

namespace stoss::engine {

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

}  // namespace stoss::engine

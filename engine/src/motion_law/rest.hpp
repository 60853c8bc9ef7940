// SPDX-License-Identifier: Apache-2.0
// What holds a disk that gravity presses on something: it slides along a wall's face, or lies.
//   (1) sliding: x(t) = p + v t + (g . e) e t^2 / (2 e . e)    e: the wall's edge [m]; v along e
//   [m/s];
//       g: gravity [m/s^2]
//   (2) the slide ends where the centre's projection on the edge leaves it:
//       e . (x(t) - start) = 0 or e . e
//   (3) lying between two supports with unit normals n1, n2 towards the disk: g = -(k1 n1 + k2 n2)
//       with k1, k2 >= 0; on one: the same with k2 = 0
//   (4) a bounce series that begins with the normal speed u and shrinks by e < 1 is over after
//       2 u / (g_n (1 - e)) [s]: a finite time and a way along the normal of at most u^2 / (2 g_n)
// Source: elementary; (4): the geometric series of NUMERICS B1.
// Deviation: (1) and (2) in double words. The rest of a series whose rebound is no faster than the
//   rest speed is taken as nothing: the disk slides or lies from that contact on, off by at most
//   (4).
// Accuracy: (1) keeps its distance from the wall to 2^-100 of the way; (2) to 4 ulp of the time:
//   tests/engine/effects/rest_test.cpp.
// Preconditions: e != 0.
#pragma once

#include "contact_time/contact_time.hpp"
#include "contact_time/drag_face.hpp"

#include <stoss/engine/types.hpp>

#include <limits>
#include <optional>

namespace stoss::engine {

/// The part of gravity along a wall, (1); m/s^2.
template <class S>
[[nodiscard]] inline DoubleWord2<S> pull_along(const DoubleWord2<S>& gravity,
                                               const DoubleWord2<S>& edge) noexcept {
  const DoubleWord<S> share = dot(gravity, edge) / square_norm(edge);
  return edge * share;
}

namespace detail {

/// First t > 0 at which a way of `ahead` >= 0 is covered that begins with `speed` and gains `pull`;
/// none if it never is.
template <class S>
[[nodiscard]] inline std::optional<DoubleWord<S>> time_to_cover(
    const DoubleWord<S>& ahead, const DoubleWord<S>& speed, const DoubleWord<S>& pull) noexcept {
  const DoubleWord<S> inside = square(speed) + (pull * ahead) * S(2);
  if (sign(inside) < 0) return std::nullopt;
  const DoubleWord<S> root = sqrt(inside);
  if (sign(speed) >= 0) {
    const DoubleWord<S> sum = speed + root;
    if (sign(sum) <= 0) {  // at rest: it goes only where it is pulled from the very end
      if (sign(ahead) == 0 && sign(pull) > 0) return ahead;
      return std::nullopt;
    }
    return (ahead * S(2)) / sum;
  }
  if (sign(pull) <= 0) return std::nullopt;  // it moves away and is not called back
  return (root - speed) / pull;
}

}  // namespace detail

/// How long a slide lasts, (2), s; infinite where it never ends. `from_start`: the disk's centre
/// seen from the wall's start; `velocity`: seen from the wall.
template <class S>
[[nodiscard]] inline DoubleWord<S> slide_lasts(const DoubleWord2<S>& from_start,
                                               const DoubleWord2<S>& velocity,
                                               const DoubleWord2<S>& pull,
                                               const DoubleWord2<S>& edge) noexcept {
  const DoubleWord<S> place = dot(edge, from_start);
  const DoubleWord<S> speed = dot(edge, velocity);
  const DoubleWord<S> gain = dot(edge, pull);
  const DoubleWord<S> none{S(0), S(0)};
  const auto covered = [&](DoubleWord<S> ahead, const DoubleWord<S>& v, const DoubleWord<S>& a) {
    if (sign(ahead) < 0) ahead = none;  // past the end by rounding
    return detail::time_to_cover(ahead, v, a);
  };
  const auto to_end = covered(square_norm(edge) - place, speed, gain);
  const auto to_start = covered(place, -speed, -gain);
  DoubleWord<S> first{std::numeric_limits<S>::infinity(), S(0)};
  if (to_end) first = *to_end;
  if (to_start && to_start->hi < first.hi) first = *to_start;
  return first;
}

/// The same under drag at `rate` (1/s), which falls with the way along the wall.
template <class S>
[[nodiscard]] inline DoubleWord<S> slide_under_drag_lasts(const DoubleWord2<S>& from_start,
                                                          const DoubleWord2<S>& velocity,
                                                          const DoubleWord2<S>& pull,
                                                          const DoubleWord2<S>& edge,
                                                          const S& rate) noexcept {
  using Wide = detail::Inner<S>;
  const auto e = detail::widened(edge);
  const DoubleWord<Wide> place = dot(e, detail::widened(from_start));
  const DoubleWord<Wide> speed = dot(e, detail::widened(velocity));
  const DoubleWord<Wide> gain = dot(e, detail::widened(pull));
  const DoubleWord<Wide> none{Wide(0), Wide(0)};
  const auto covered = [&](DoubleWord<Wide> ahead,
                           const DoubleWord<Wide>& v,
                           const DoubleWord<Wide>& a) -> std::optional<Duration<Wide>> {
    if (!(ahead.hi > Wide(0))) {  // at the end, or past it by rounding
      if (sign(v) > 0 || (sign(v) == 0 && sign(a) > 0)) return Duration<Wide>{};
      ahead = none;
    }
    return detail::DragFall<Wide>(ahead, -v, -a, static_cast<Wide>(rate)).landing();
  };
  const auto to_end = covered(square_norm(e) - place, speed, gain);
  const auto to_start = covered(place, -speed, -gain);
  DoubleWord<Wide> first{std::numeric_limits<Wide>::infinity(), Wide(0)};
  if (to_end) first = {to_end->hi, to_end->lo};
  if (to_start && to_start->hi < first.hi) first = {to_start->hi, to_start->lo};
  if (!detail::is_finite(first.hi)) return {std::numeric_limits<S>::infinity(), S(0)};
  return detail::stored_words<S>(first);
}

/// (3): do these supports hold a disk under gravity? Normals are unit vectors towards the disk;
/// for a single support give the same twice.
[[nodiscard]] inline bool holds_up(const Vector2& gravity, const Vector2& n1, const Vector2& n2) {
  constexpr double kBalance = 1e-12;  // rad; chosen: what rounding makes of a right angle, and more
  const auto cross = [](const Vector2& a, const Vector2& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const double g = gravity.norm();
  const auto balances = [&](const Vector2& n) {
    return gravity.dot(n) < 0 && std::abs(cross(gravity, n)) <= kBalance * g;
  };
  if (balances(n1) || balances(n2)) return true;
  const double d = cross(n1, n2);
  if (std::abs(d) <= kBalance) return false;
  return -cross(gravity, n2) / d >= 0 && -cross(n1, gravity) / d >= 0;
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// The textbook contact formulas in place of the engine's, for what they cost. Included by a build
// of the engine under another namespace (seed_world.cpp), before its loop is instantiated; the
// engine's own sources know nothing of it.
//
//   pair: t = (-b - sqrt(b^2 - v^2 (p^2 - d^2))) / v^2      wall: t = (n . p - r) / -(n . v)
//
// All in one word. A negative time counts as now; the engine's promises do not hold.

#include "contact_law/elastic.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stoss::engine {

template <>
inline std::optional<Duration<double>> disk_disk_contact<double>(
    const RelativeMotion<double>& motion, const DoubleWord<double>& reach) noexcept {
  const double px = motion.position.x.hi, py = motion.position.y.hi;
  const double vx = motion.velocity.x.hi, vy = motion.velocity.y.hi;
  const double b = px * vx + py * vy;
  if (!(b < 0)) return std::nullopt;
  const double v2 = vx * vx + vy * vy;
  const double root = b * b - v2 * (px * px + py * py - reach.hi * reach.hi);
  if (!(root >= 0)) return std::nullopt;
  return Duration<double>{std::max(0.0, (-b - std::sqrt(root)) / v2), 0.0};
}

template <>
inline std::optional<Duration<double>> disk_wall_face_contact<double>(
    const RelativeMotion<double>& motion, const DoubleWord2<double>& edge, double radius) noexcept {
  const double ex = edge.x.hi, ey = edge.y.hi;
  const double length = std::sqrt(ex * ex + ey * ey);
  double nx = -ey / length, ny = ex / length;
  double height = nx * motion.position.x.hi + ny * motion.position.y.hi;
  double rate = nx * motion.velocity.x.hi + ny * motion.velocity.y.hi;
  if (height < 0) {
    height = -height;
    rate = -rate;
  }
  if (!(rate < 0)) return std::nullopt;
  const double t = std::max(0.0, (height - radius) / -rate);
  const double along = ex * (motion.position.x.hi + motion.velocity.x.hi * t) +
                       ey * (motion.position.y.hi + motion.velocity.y.hi * t);
  if (!(along >= 0 && along <= length * length)) return std::nullopt;
  return Duration<double>{t, 0.0};
}

#ifdef STOSS_SEED_LAW
/// The textbook impulse along the unit normal, in one word.
template <>
inline PairImpulse<double> elastic_impulse<double>(const DoubleWord2<double>& contact_vector,
                                                   const DoubleWord2<double>& relative_velocity,
                                                   double mass_a,
                                                   bool fixed_a,
                                                   double mass_b,
                                                   bool fixed_b) noexcept {
  PairImpulse<double> result;
  const double px = contact_vector.x.hi, py = contact_vector.y.hi;
  const double length = std::sqrt(px * px + py * py);
  result.normal_x = px / length;
  result.normal_y = py / length;
  const double closing =
      relative_velocity.x.hi * result.normal_x + relative_velocity.y.hi * result.normal_y;
  if (closing >= 0 || (fixed_a && fixed_b)) return result;
  result.approach_speed = -closing;
  const double inverse_a = fixed_a ? 0 : 1 / mass_a;
  const double inverse_b = fixed_b ? 0 : 1 / mass_b;
  result.impulse = -2 * closing / (inverse_a + inverse_b);
  const double a = -result.impulse * inverse_a, b = result.impulse * inverse_b;
  result.delta_a = {{a * result.normal_x, 0}, {a * result.normal_y, 0}};
  result.delta_b = {{b * result.normal_x, 0}, {b * result.normal_y, 0}};
  return result;
}
#endif

}  // namespace stoss::engine

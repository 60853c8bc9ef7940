// SPDX-License-Identifier: Apache-2.0
// Contact of growing disks: their surfaces come towards each other while their centres rest.
//   (1) w = u - m p / |p|         u = v_b - v_a [m/s]; p: contact vector [m], from a to b; m:
//   growth
//       of the reach [m/s], of both radii or of one against a wall
//   (2) w' . p = -e w . p         any law of contacts, of the surfaces' velocity w for that of the
//       centres; so u' . n = m + e (m - u . n) with n = p / |p|
//   (3) dE = (1 + e) / 2 M (m - u . n) ((1 + e) m + (1 - e) u . n),  M = m_a m_b / (m_a + m_b)
// (3) is what the growth puts in: even elastic disks heat up. Growing disks separate after a
// contact at no less than m, and cannot press on each other. Source: Lubachevsky, Stillinger, J.
// Stat. Phys. 60 (1990) 561, with e = 1. Deviation: (1) in double words. Restitution e < 1, which
// they have not, takes out what (3) puts in,
//   so that a packing can be driven to its jam in few contacts.
// Accuracy: momentum, (2) and (3) to 64 u^2: tests/engine/contact_law/growing_contact_test.cpp.
// Preconditions: p != 0, m >= 0.
#pragma once

#include "contact_time/contact_time.hpp"
#include "stoss/engine/double_word.hpp"

namespace stoss::engine {

/// (1): the velocity of b's surface seen from a's where they touch; m/s.
template <class S>
[[nodiscard]] inline DoubleWord2<S> velocity_of_growing_surfaces(
    const DoubleWord2<S>& contact_vector,
    const DoubleWord2<S>& relative_velocity,
    const DoubleWord<S>& growth) noexcept {
  if (growth.hi == S(0)) return relative_velocity;
  const int by_length = detail::steps_into_range(detail::size_of(contact_vector));
  const DoubleWord2<S> p = detail::shifted(contact_vector, by_length);
  return relative_velocity - p * (growth / sqrt(square_norm(p)));
}

}  // namespace stoss::engine

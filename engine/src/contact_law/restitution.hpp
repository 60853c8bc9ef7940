// SPDX-License-Identifier: Apache-2.0
// Contact that loses energy: the normal relative velocity is reversed and shrinks by e.
//   (1) u' . p = -e u . p     u = v_b - v_a [m/s] before, u' after; p: contact vector [m]; e: in
//   [0, 1] (2) the changes of elastic.hpp (1)-(3) with (1 + e) for 2 (3) dE = -(1 - e^2) (m_a m_b /
//   (m_a + m_b)) (u . p)^2 / (2 p . p) (4) e = 1 if less than t_c [s] has passed since an earlier
//   contact of either disk
// Source: Newton's law of restitution; (5): Luding and McNamara, Granular Matter 1 (1998) 113.
// Deviation: 1 + e is a double word, so that a rounded sum does not bias the loss; e = 1 gives the
//   bits of elastic.hpp.
// Accuracy: momentum and (3) to 64 u^2: tests/engine/contact_law/restitution_test.cpp.
// Preconditions: as elastic.hpp, and 0 <= e <= 1.
#pragma once

#include "contact_law/elastic.hpp"

namespace stoss::engine {

/// The law (1)-(2); arguments and result as elastic_impulse has them.
template <class S>
[[nodiscard]] inline PairImpulse<S> restitution_impulse(const DoubleWord2<S>& contact_vector,
                                                        const DoubleWord2<S>& relative_velocity,
                                                        S mass_a,
                                                        bool fixed_a,
                                                        S mass_b,
                                                        bool fixed_b,
                                                        S restitution) noexcept {
  const DoubleWord<S> factor = two_sum(S(1), restitution);
  const auto reduce = [&factor](const DoubleWord<S>& closing, const DoubleWord<S>&, int) {
    return closing * factor;
  };
  return detail::normal_impulse(
      contact_vector, relative_velocity, mass_a, fixed_a, mass_b, fixed_b, reduce);
}

/// The least bounce: afterwards the bodies separate at `speed` (m/s), however slowly they met.
template <class S>
[[nodiscard]] inline PairImpulse<S> hop_impulse(const DoubleWord2<S>& contact_vector,
                                                const DoubleWord2<S>& relative_velocity,
                                                S mass_a,
                                                bool fixed_a,
                                                S mass_b,
                                                bool fixed_b,
                                                S speed) noexcept {
  const auto lift = [&](const DoubleWord<S>& closing, const DoubleWord<S>& length2, int by_speed) {
    return closing - sqrt(length2) * detail::shifted(speed, by_speed);
  };
  return detail::normal_impulse<S, true>(
      contact_vector, relative_velocity, mass_a, fixed_a, mass_b, fixed_b, lift);
}

}  // namespace stoss::engine

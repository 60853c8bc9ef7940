// SPDX-License-Identifier: Apache-2.0
// Elastic contact of two bodies: the velocity changes that reverse the normal relative velocity.
//   (1) k_a = 2 m_b (u . p) / ((m_a + m_b) (p . p)),  k_b with m_a for m_b
//       u = v_b - v_a [m/s] before; p: any vector [m] along the contact normal from a to b, for its
//       length cancels; m: masses [kg]; m_b / (m_a + m_b) is 1 if b is fixed, 0 if a is
//   (2) dv_a = + k_a p,   dv_b = - k_b p
//   (3) J = m_a |k_a| |p| = m_b |k_b| |p|  [N s]
// Source: conservation of momentum and kinetic energy; Goldstein, Classical Mechanics, 3.11.
// Deviation: p is the actual vector, never a rounded unit normal nor divided by the nominal
//   distance: either would change the energy with a bias. k and the changes are double words, and
//   each k is divided once, lest a rounded share of the masses err alike in all contacts of a pair.
// Accuracy: energy and momentum of a contact to 32 u^2 (4e-31 in double), with a bias below
//   0.4 u^2; heavy masses do not stagnate: tests/engine/contact_law/elastic_test.cpp.
// Preconditions: masses > 0 (that of a fixed body is not read), p != 0.
#pragma once

#include "contact_time/contact_time.hpp"
#include "stoss/engine/double_word.hpp"

#include <cmath>

namespace stoss::engine {

/// What a contact does to its two bodies.
template <class S>
struct PairImpulse {
  DoubleWord2<S> delta_a;  ///< to add to the velocity of a, m/s
  DoubleWord2<S> delta_b;  ///< to add to the velocity of b, m/s
  S impulse{};             ///< >= 0, N s; 0 if the bodies do not approach
  S approach_speed{};      ///< >= 0, m/s, along the normal
  S normal_x{};            ///< unit normal from a to b
  S normal_y{};
};

namespace detail {

/// (1) for the body of mass `self`; `change` stands for 2 u . p, `length2` = p . p.
template <class S>
[[nodiscard]] inline DoubleWord<S> share_of_impulse(const DoubleWord<S>& change,
                                                    const DoubleWord<S>& length2,
                                                    const S& self,
                                                    const S& other) noexcept {
  const int by_mass = steps_into_range(larger(self, other));
  const S m = shifted(self, by_mass), n = shifted(other, by_mass);
  return (change * n) / (length2 * two_sum(m, n));
}

/// The impulse along the normal that takes `gain(closing, p . p, by_speed)` from u . p, where
/// closing = u . p < 0 before, and speeds are 1 / shifted(1, by_speed) m/s; see elastic_impulse for
/// the rest. `Always`: also where the bodies do not approach.
template <class S, bool Always = false, class Gain>
[[nodiscard]] inline PairImpulse<S> normal_impulse(const DoubleWord2<S>& contact_vector,
                                                   const DoubleWord2<S>& relative_velocity,
                                                   S mass_a,
                                                   bool fixed_a,
                                                   S mass_b,
                                                   bool fixed_b,
                                                   const Gain& gain) noexcept {
  using std::sqrt;
  // p cancels and u is linear in (1): both may be shifted into the range where squares are safe.
  const int by_length = steps_into_range(size_of(contact_vector));
  const int by_speed = steps_into_range(size_of(relative_velocity));
  const DoubleWord2<S> p = shifted(contact_vector, by_length);
  const DoubleWord2<S> u = shifted(relative_velocity, by_speed);

  PairImpulse<S> result;
  const DoubleWord<S> length2 = square_norm(p);
  const S length = sqrt(to_scalar(length2));
  result.normal_x = p.x.hi / length;
  result.normal_y = p.y.hi / length;
  const DoubleWord<S> closing = dot(u, p);
  if (!Always && sign(closing) >= 0) return result;
  result.approach_speed = shifted(S(-to_scalar(closing) / length), -by_speed);
  if (fixed_a && fixed_b) return result;

  const DoubleWord<S> change = gain(closing, length2, by_speed);
  const DoubleWord<S> none{S(0), S(0)};
  const bool free = !fixed_a && !fixed_b;
  const DoubleWord<S> whole = free ? none : change / length2;
  const DoubleWord<S> k_a =
      fixed_a ? none : (free ? share_of_impulse(change, length2, mass_a, mass_b) : whole);
  const DoubleWord<S> k_b =
      fixed_b ? none : (free ? share_of_impulse(change, length2, mass_b, mass_a) : whole);
  result.delta_a = shifted(p * k_a, -by_speed);
  result.delta_b = shifted(-(p * k_b), -by_speed);
  const S momentum = fixed_a ? S(mass_b * k_b.hi) : S(mass_a * k_a.hi);
  result.impulse = shifted(S(-momentum * length), -by_speed);
  return result;
}

}  // namespace detail

/// The elastic law (1)-(3). `contact_vector` points from a to b, of any length; `relative_velocity`
/// = v_b - v_a. Bodies that do not approach get no impulse. A fixed body (static, kinematic, wall)
/// gets no change, whatever it weighs.
template <class S>
[[nodiscard]] inline PairImpulse<S> elastic_impulse(const DoubleWord2<S>& contact_vector,
                                                    const DoubleWord2<S>& relative_velocity,
                                                    S mass_a,
                                                    bool fixed_a,
                                                    S mass_b,
                                                    bool fixed_b) noexcept {
  const auto reverse = [](const DoubleWord<S>& closing, const DoubleWord<S>&, int) {
    return closing + closing;
  };
  return detail::normal_impulse(
      contact_vector, relative_velocity, mass_a, fixed_a, mass_b, fixed_b, reverse);
}

}  // namespace stoss::engine

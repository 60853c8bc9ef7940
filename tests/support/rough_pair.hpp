// SPDX-License-Identifier: Apache-2.0
#pragma once

// Two bodies at the instant of a contact, and their exact conserved quantities, for tests of
// contact laws.

#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <cmath>
#include <numbers>

namespace stoss::test {

template <class S>
struct ContactBody {
  S mass{};
  S radius{};
  bool is_fixed = false;
  engine::DoubleWord2<S> velocity;
  engine::DoubleWord<S> spin;

  /// Kinetic, J; a fixed body has none to give.
  Real energy() const {
    if (is_fixed) return Real(0);
    const Real2 v = exact(velocity);
    const Real rim = exact(spin) * Real(radius);
    return Real(mass) * (dot(v, v) / 2 + rim * rim / 4);
  }
  Real speed() const { return sqrt(dot(exact(velocity), exact(velocity))); }
  Real2 momentum() const {
    const Real2 v = exact(velocity);
    return {Real(mass) * v.x, Real(mass) * v.y};
  }
  /// About the point from which the centre stands at `place`.
  Real angular_momentum(const Real2& place) const {
    return Real(mass) *
           (cross(place, exact(velocity)) + exact(spin) * Real(radius) * Real(radius) / 2);
  }
};

/// Two bodies that touch and approach.
template <class S>
struct ContactCase {
  ContactBody<S> a, b;
  engine::DoubleWord2<S> contact;  ///< from a to b

  Real closing() const { return dot(exact(b.velocity - a.velocity), exact(contact)); }
  /// |p| times the relative velocity of the surfaces along the tangent.
  Real surface() const {
    const Real2 p = exact(contact);
    const Real2 u = exact(b.velocity - a.velocity);
    const Real rim = exact(a.spin) * Real(a.radius) + exact(b.spin) * Real(b.radius);
    return (p.x * u.y - p.y * u.x) - rim * sqrt(dot(p, p));
  }
};

template <class S>
ContactCase<S> random_contact(Random& random, double mass_decades, bool fixed_b) {
  const auto word = [](double x) { return engine::DoubleWord<S>{static_cast<S>(x), S(0)}; };
  const auto body = [&] {
    ContactBody<S> result;
    result.mass = static_cast<S>(random.decades(-mass_decades, mass_decades));
    result.radius = static_cast<S>(random.uniform(0.25, 2));
    const double x = random.uniform(-1, 1);
    result.velocity = {word(x), word(random.uniform(-1, 1))};
    result.spin = word(random.uniform(-2, 2));
    return result;
  };
  ContactCase<S> result{body(), body(), {}};
  result.b.is_fixed = fixed_b;
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double reach = static_cast<double>(result.a.radius + result.b.radius);
  result.contact = {word(reach * std::cos(angle)), word(reach * std::sin(angle))};
  if (result.closing() >= 0) result.contact = -result.contact;
  return result;
}

}  // namespace stoss::test

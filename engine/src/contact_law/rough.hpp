// SPDX-License-Identifier: Apache-2.0
// Rough contact: what the surfaces do to each other along the tangent, and to the spins.
//   (1) g = u . t - |p| (r_a w_a + r_b w_b)     |p| times the relative velocity of the surfaces,
//   with
//       t = p turned by +90 degrees [m], u = v_b - v_a [m/s], w: spins [rad/s], r: radii [m]
//   (2) X = -(1 + beta) g / 3               sticking: afterwards g' = -beta g
//       |X| <= mu (1 + e) |u . p|           sliding: Coulomb's limit
//   (3) k_b = X m_a / ((m_a + m_b) p . p),  k_a likewise; dv_b = k_b t, dv_a = -k_a t
//   (4) dw_a = -2 k_a |p| / r_a,            dw_b = -2 k_b |p| / r_b
// The 3 is 1 + m r^2 / I for uniform disks, I = m r^2 / 2.
// Source: Walton and Braun, J. Rheol. 30 (1986) 949; Luding, Phys. Rev. E 52 (1995) 4442.
// Deviation: p is the actual contact vector and all terms are double words, as in elastic.hpp. Both
//   branches take away energy or none, so no rounding of a case distinction can add any.
// Accuracy: momentum and angular momentum to 64 u^2; the energy falls by the exact loss:
//   tests/engine/contact_law/rough_test.cpp.
// Preconditions: as elastic.hpp; beta in [-1, 1], mu >= 0. A wall has radius and spin 0.
#pragma once

#include "contact_law/elastic.hpp"

namespace stoss::engine {

/// One of the two bodies, as a rough contact sees it.
template <class S>
struct RoughBody {
  S mass{};    ///< kg; not read of a fixed body
  S radius{};  ///< m; 0 for a wall
  bool is_fixed = false;
  DoubleWord<S> spin;  ///< rad/s
};

/// How rough surfaces answer.
template <class S>
struct Roughness {
  S restitution{};             ///< e, along the normal
  S tangential_restitution{};  ///< beta
  S friction{};                ///< mu
};

/// What a rough contact adds to the spins, rad/s.
template <class S>
struct SpinChange {
  DoubleWord<S> a, b;
};

namespace detail {

/// X of (2). `surface` = g, `closing` = u . p < 0.
template <class S>
[[nodiscard]] inline DoubleWord<S> tangential_change(const DoubleWord<S>& surface,
                                                     const DoubleWord<S>& closing,
                                                     const Roughness<S>& rough) noexcept {
  const DoubleWord<S> stick =
      -(surface * two_sum(S(1), rough.tangential_restitution)) / DoubleWord<S>{S(3), S(0)};
  const DoubleWord<S> limit = -(closing * two_sum(S(1), rough.restitution)) * rough.friction;
  if (magnitude(to_scalar(stick)) <= to_scalar(limit)) return stick;
  return sign(stick) < 0 ? -limit : limit;
}

}  // namespace detail

/// (1)-(4): adds the tangential part to `impulse`, which holds the normal part of the same contact,
/// and returns what the spins get. Nothing where the bodies do not approach.
template <class S>
[[nodiscard]] inline SpinChange<S> add_rough_impulse(PairImpulse<S>& impulse,
                                                     const DoubleWord2<S>& contact_vector,
                                                     const DoubleWord2<S>& relative_velocity,
                                                     const RoughBody<S>& a,
                                                     const RoughBody<S>& b,
                                                     const Roughness<S>& rough) noexcept {
  const DoubleWord<S> rim = a.spin * a.radius + b.spin * b.radius;
  const DoubleWord2<S> direction = detail::unit_if_exact(contact_vector);
  const int by_length = detail::steps_into_range(detail::size_of(direction));
  const int by_speed = detail::steps_into_range(
      detail::larger(detail::size_of(relative_velocity), detail::magnitude(rim.hi)));
  const DoubleWord2<S> p = detail::shifted(direction, by_length);
  const DoubleWord2<S> u = detail::shifted(relative_velocity, by_speed);
  const DoubleWord2<S> t{-p.y, p.x};
  const DoubleWord<S> closing = dot(u, p);
  if (sign(closing) >= 0 || (a.is_fixed && b.is_fixed)) return {};

  const detail::TripleWord<S> length2 = detail::square_norm_in_three_words(p);
  const DoubleWord<S> length = sqrt(length2.two_words());
  const DoubleWord<S> surface = dot(u, t) - detail::shifted(rim, by_speed) * length;
  const DoubleWord<S> change = detail::tangential_change(surface, closing, rough);
  const detail::Shares<S> k =
      detail::shares_of_impulse(change, length2, a.mass, a.is_fixed, b.mass, b.is_fixed);
  impulse.delta_a = impulse.delta_a - detail::shifted(t * k.a, -by_speed);
  impulse.delta_b = impulse.delta_b + detail::shifted(t * k.b, -by_speed);
  const auto turn = [&](const RoughBody<S>& self, const DoubleWord<S>& share) -> DoubleWord<S> {
    if (self.is_fixed) return {};
    const DoubleWord<S> twice = share + share;
    return detail::shifted(-(twice * length) / self.radius, -by_speed);
  };
  return {turn(a, k.a), turn(b, k.b)};
}

}  // namespace stoss::engine

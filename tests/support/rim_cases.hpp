// SPDX-License-Identifier: Apache-2.0
// Crossings of a circle's rim: the exact answers to 400 bits, and cases that start inside. Trusted
// because the oracle knows nothing of vectors: it walks the monotone pieces of the polynomial.
#pragma once

#include "contact_time/rim_crossing.hpp"
#include "support/accelerated_cases.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace stoss::test {

/// Every crossing of f through zero, in order, of a point that begins inside or outside: inwards
/// the first t with f(t) <= 0 and falling, outwards the infimum of those with f(t) >= 0 and rising.
inline std::vector<Real> exact_crossings(const Polynomial& given, bool is_inside) {
  const Polynomial f = trimmed(given);
  const Polynomial slope = derivative_of(f);
  std::vector<Real> points{Real(0)};
  const Real end = std::max(root_bound(f), root_bound(slope)) + 1;
  for (const Real& t : sign_changes(slope, end)) points.push_back(t);
  points.push_back(end);
  std::vector<Real> crossings;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const bool falls = value_of(slope, Real((points[i] + points[i + 1]) / 2)) < 0;
    const Real left = value_of(f, points[i]), right = value_of(f, points[i + 1]);
    const bool crosses = falls ? !is_inside && right < 0 : is_inside && right > 0;
    if (!crosses) continue;
    const bool is_beyond = falls ? left <= 0 : left >= 0;
    crossings.push_back(is_beyond ? points[i]
                                  : root_in_bracket(f, slope, points[i], points[i + 1]));
    is_inside = falls;
  }
  return crossings;
}

template <class S>
struct RimCase {
  engine::AcceleratedMotion<S> motion;  ///< of the point seen from the centre
  S radius{};
};

template <class S>
Polynomial polynomial_of(const RimCase<S>& c) {
  return gap_polynomial(exact(c.motion.position),
                        exact(c.motion.velocity),
                        exact(c.motion.acceleration),
                        Real(c.radius));
}

template <class S>
RimCase<S> rim_of(const PairCase<S>& c) {
  return {{c.motion.position, c.motion.velocity, {}, S(0)}, c.reach.hi};
}

template <class S>
RimCase<S> rim_of(const CurvedCase<S>& c) {
  return {{c.motion.position, c.motion.velocity, c.motion.acceleration, S(0)}, c.reach.hi};
}

/// The case taken up on its way through the circle, near the rim or deep inside; none where it does
/// not enter.
template <class S>
std::optional<RimCase<S>> taken_up_inside(const RimCase<S>& c, Random& random, double finest) {
  const std::vector<Real> all = exact_crossings(polynomial_of(c), false);
  if (all.size() < 2) return std::nullopt;
  const bool near_end = random.one_in(2);
  const Real share = Real(random.decades(finest, 0)) / 2;
  const Real t = all[0] + (all[1] - all[0]) * (near_end ? Real(1 - share) : share);
  const Real2 p = exact(c.motion.position), v = exact(c.motion.velocity);
  const Real2 a = exact(c.motion.acceleration);
  const bool low_words = random.one_in(2);
  RimCase<S> inside = c;
  inside.motion.position = rounded<S>(Real2{p.x + v.x * t + a.x * t * t / 2,  //
                                            p.y + v.y * t + a.y * t * t / 2},
                                      low_words);
  inside.motion.velocity = rounded<S>(Real2{v.x + a.x * t, v.y + a.y * t}, low_words);
  return inside;
}

/// What a family has shown: the errors of the next crossing, and wrong answers whether there is
/// one.
struct RimCensus {
  explicit RimCensus(const std::string& name) : errors(name) {}

  /// `kernel`: the crossing of a point that is inside, or is not.
  template <class S, class Kernel>
  void add(const RimCase<S>& c, const Kernel& kernel) {
    const Polynomial f = polynomial_of(c);
    const bool is_inside = f[0] < 0;
    const std::vector<Real> truth = exact_crossings(f, is_inside);
    errors.add<engine::detail::Inner<S>>(
        kernel(c, is_inside), truth.empty() ? std::nullopt : std::optional<Real>(truth[0]));
  }

  Census errors;
};

}  // namespace stoss::test

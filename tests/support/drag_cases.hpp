// SPDX-License-Identifier: Apache-2.0
// Curves under drag and a pull: the exact answers to 400 bits, and cases out of those for
// parabolas. Trusted because the oracle knows nothing of vectors: it evaluates the gap from
// coefficients and isolates its roots between those of its derivative, down to where the bend
// turns.
#pragma once

#include "contact_time/drag_curve.hpp"
#include "support/accelerated_cases.hpp"
#include "support/oracle.hpp"

#include <cmath>
#include <optional>
#include <vector>

namespace stoss::test {

struct ExactClock {
  Real run, fall, left;
};

inline ExactClock exact_clock(const Real& t, const Real& rate) {
  const Real y = rate * t;
  if (y > 1) {
    const Real left = exp(Real(-y)), run = (1 - left) / rate;
    return {run, Real((t - run) / rate), left};
  }
  const Real passed = -expm1(Real(-y)), run = passed / rate, left = 1 - passed;
  if (y > Real(1e-20)) return {run, Real((t - run) / rate), left};
  Real mean(0);  // five terms are exact to 400 bits' last hundred
  for (int n = 12; n > 0; --n) mean = (1 - mean * y) / (n + 1);
  return {run, Real(t * t * mean), left};
}

/// The gap of one case, and its derivatives as drag_curve.hpp has them, from coefficients.
class ExactGap {
 public:
  ExactGap(const Real2& p, const Real2& v, const Real2& a, const Real& d, const Real& rate)
      : v_(v), a_(a), c_(dot(p, p) - d * d), rate_(rate) {
    pv_ = dot(p, v), pa_ = dot(p, a), vv_ = dot(v, v), va_ = dot(v, a), aa_ = dot(a, a);
  }

  Real value(const Real& t) const { return gap_at(t).f; }
  Real slope(const Real& t) const { return slope_at(t).f; }

  std::optional<Real> contact() const { return crossing(false); }

  /// The infimum of the t >= 0 with F <= 0 and falling; of one inside, with F >= 0 and rising.
  std::optional<Real> crossing(bool is_inside) const {
    std::vector<Real> bends{Real(0)};
    if (const auto turn = lowest_bend()) bends.push_back(*turn);
    Real end = bends.back() + 1 / rate_;
    const auto high = [&] { return bend_at(end).f > 0 && slope(end) > 0 && value(end) > 0; };
    while (!high()) end *= 2;
    bends.push_back(end);
    const std::vector<Real> slopes = with_changes(&ExactGap::bend_at, bends);
    const std::vector<Real> pieces = with_changes(&ExactGap::slope_at, slopes);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const bool falls = slope(Real((pieces[i] + pieces[i + 1]) / 2)) < 0;
      if (falls == is_inside) continue;
      const Real left = value(pieces[i]), right = value(pieces[i + 1]);
      const bool is_beyond = is_inside ? left >= 0 : left <= 0;
      if (is_inside ? right <= 0 : right >= 0 && !is_beyond) continue;
      if (is_beyond) return pieces[i];
      return zero_between(&ExactGap::gap_at, pieces[i], pieces[i + 1]);
    }
    return std::nullopt;
  }

 private:
  /// A function of time and its derivative.
  struct Point {
    Real f, derivative;
  };
  using Function = Point (ExactGap::*)(const Real&) const;

  Point gap_at(const Real& t) const {
    const ExactClock k = exact_clock(t, rate_);
    const Real along = vv_ * k.run + va_ * k.fall, across = va_ * k.run + aa_ * k.fall;
    return {Real(c_ + (2 * pv_ + along) * k.run + (2 * pa_ + across) * k.fall),
            Real(2 * ((pv_ + along) * k.left + (pa_ + across) * k.run))};
  }
  /// Half the derivative of the gap.
  Point slope_at(const Real& t) const {
    const ExactClock k = exact_clock(t, rate_);
    const Real pull = pa_ + va_ * k.run + aa_ * k.fall;
    const Real f = (pv_ + vv_ * k.run + va_ * k.fall) * k.left + pull * k.run;
    return {f, Real(bend_of(k) - rate_ * f)};
  }
  Point bend_at(const Real& t) const {
    const ExactClock k = exact_clock(t, rate_);
    const Real turning = va_ * k.left + aa_ * k.run;
    return {bend_of(k),
            Real((1 + 2 * k.left) * turning - 2 * rate_ * k.left * (vv_ * k.left + va_ * k.run))};
  }
  Real bend_of(const ExactClock& k) const {
    return (vv_ * k.left + va_ * k.run) * k.left + (va_ * k.left + aa_ * k.run) * k.run + pa_ +
           va_ * k.run + aa_ * k.fall;
  }
  /// Where the bend turns, or nothing.
  std::optional<Real> lowest_bend() const {
    const Real2 end{a_.x / rate_, a_.y / rate_};
    const Real2 excess{v_.x - end.x, v_.y - end.y};
    const Real a2 = dot(end, end), c2 = dot(excess, excess), mixed = dot(end, excess);
    if (c2 == 0) return std::nullopt;
    const Real left = (sqrt(Real(mixed * mixed + 8 * a2 * c2)) - mixed) / (4 * c2);
    if (left >= 1) return std::nullopt;
    return Real(-log(left) / rate_);
  }

  /// By Newton's steps within a bracket that every one of them narrows.
  Real zero_between(Function function, Real low, Real high) const {
    const bool rising = (this->*function)(low).f < 0;
    const Real close = ldexp(Real(1), -300);
    Real t = (low + high) / 2;
    for (int i = 0; i < 3000; ++i) {
      const Point at = (this->*function)(t);
      if (at.f == 0) return t;
      ((at.f < 0) == rising ? low : high) = t;
      const Real step = at.derivative == 0 ? Real(high) : Real(-at.f / at.derivative);
      Real next = t + step;
      if (abs(step) <= close * t) return next;
      if (!(next > low && next < high)) {  // brackets over many decades are halved in exponents
        const bool decades = high > 4 * low;
        next = !decades ? Real((low + high) / 2) : low > 0 ? Real(sqrt(low * high)) : high / 1024;
      }
      if (high - low <= close * high) return next;
      t = next;
    }
    return t;
  }
  /// The points, and where the function changes its sign between them.
  std::vector<Real> with_changes(Function function, const std::vector<Real>& points) const {
    std::vector<Real> all{points.front()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Real left = (this->*function)(points[i]).f;
      const Real right = (this->*function)(points[i + 1]).f;
      if ((left < 0 && right > 0) || (left > 0 && right < 0)) {
        all.push_back(zero_between(function, points[i], points[i + 1]));
      }
      all.push_back(points[i + 1]);
    }
    return all;
  }

  Real2 v_, a_;
  Real c_, rate_;
  Real pv_, pa_, vv_, va_, aa_;
};

template <class S>
struct DraggedCase {
  CurvedCase<S> curve;
  S rate{};
  ExactGap gap() const {
    return {exact(curve.motion.position),
            exact(curve.motion.velocity),
            exact(curve.motion.acceleration),
            exact(curve.reach),
            Real(rate)};
  }
};

/// The shape's contact, reached under a drag of `strength` in units of the time to it.
template <class S>
DraggedCase<S> make_dragged(const CurvedShape& shape,
                            double strength,
                            Random& random,
                            bool low_words) {
  DraggedCase<S> c;
  CurvedShape at_contact = shape;
  at_contact.t = 0;
  c.curve = make_curved<S>(at_contact, random, low_words);
  const Real scale = shape.t > 0 ? shape.t : Real(1);
  c.rate = Real(strength / scale).convert_to<S>();
  const ExactClock clock = exact_clock(shape.t, Real(c.rate));
  auto& m = c.curve.motion;
  const Real2 x = exact(m.position), u = exact(m.velocity);
  const Real2 a = exact(m.acceleration);
  const auto before = [&](const Real& w, const Real& b) {
    return Real((w - b * clock.run) / clock.left);
  };
  m.velocity = rounded<S>(Real2{before(u.x, a.x), before(u.y, a.y)}, low_words);
  const Real2 v = exact(m.velocity);
  m.position = rounded<S>(
      Real2{x.x - v.x * clock.run - a.x * clock.fall, x.y - v.y * clock.run - a.y * clock.fall},
      low_words);
  return c;
}

}  // namespace stoss::test

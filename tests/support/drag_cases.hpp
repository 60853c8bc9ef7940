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
  const Real run = -expm1(Real(-rate * t)) / rate;
  if (rate * t > Real(1e-20)) return {run, Real((t - run) / rate), exp(Real(-rate * t))};
  const Real y = rate * t;  // five terms are exact to 400 bits' last hundred
  Real mean(0);
  for (int n = 12; n > 0; --n) mean = (1 - mean * y) / (n + 1);
  return {run, Real(t * t * mean), exp(Real(-y))};
}

/// The gap of one case, and its derivatives as drag_curve.hpp has them, from coefficients.
class ExactGap {
 public:
  ExactGap(const Real2& p, const Real2& v, const Real2& a, const Real& d, const Real& rate)
      : p_(p), v_(v), a_(a), d_(d), rate_(rate) {}

  Real value(const Real& t) const {
    const ExactClock c = exact_clock(t, rate_);
    return dot(p_, p_) - d_ * d_ + 2 * (dot(p_, v_) * c.run + dot(p_, a_) * c.fall) +
           dot(v_, v_) * c.run * c.run + 2 * dot(v_, a_) * c.run * c.fall +
           dot(a_, a_) * c.fall * c.fall;
  }
  Real slope(const Real& t) const {
    const ExactClock c = exact_clock(t, rate_);
    return (dot(p_, v_) + dot(v_, v_) * c.run + dot(v_, a_) * c.fall) * c.left +
           (dot(p_, a_) + dot(v_, a_) * c.run + dot(a_, a_) * c.fall) * c.run;
  }
  Real bend(const Real& t) const {
    const ExactClock c = exact_clock(t, rate_);
    return dot(v_, v_) * c.left * c.left + 2 * dot(v_, a_) * c.left * c.run +
           dot(a_, a_) * c.run * c.run + dot(p_, a_) + dot(v_, a_) * c.run + dot(a_, a_) * c.fall;
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

  std::optional<Real> contact() const { return crossing(false); }

  /// The infimum of the t >= 0 with F <= 0 and falling; of one inside, with F >= 0 and rising.
  std::optional<Real> crossing(bool is_inside) const {
    std::vector<Real> bends{Real(0)};
    if (const auto turn = lowest_bend()) bends.push_back(*turn);
    Real end = bends.back() + 1 / rate_;
    const auto high = [&] { return bend(end) > 0 && slope(end) > 0 && value(end) > 0; };
    while (!high()) end *= 2;
    const auto on_bend = [this](const Real& t) { return bend(t); };
    const auto on_slope = [this](const Real& t) { return slope(t); };
    bends.push_back(end);
    const std::vector<Real> slopes = with_changes(on_bend, bends);
    const std::vector<Real> pieces = with_changes(on_slope, slopes);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const bool falls = slope(Real((pieces[i] + pieces[i + 1]) / 2)) < 0;
      if (falls == is_inside) continue;
      const Real left = value(pieces[i]), right = value(pieces[i + 1]);
      const bool is_beyond = is_inside ? left >= 0 : left <= 0;
      if (is_inside ? right <= 0 : right >= 0 && !is_beyond) continue;
      if (is_beyond) return pieces[i];
      return zero_between([this](const Real& t) { return value(t); }, pieces[i], pieces[i + 1]);
    }
    return std::nullopt;
  }

 private:
  template <class Function>
  static Real zero_between(const Function& f, Real low, Real high) {
    const bool rising = f(low) < 0;
    const Real close = ldexp(Real(1), -250);
    for (int i = 0; i < 3000 && high - low > close * high; ++i) {
      Real middle = low > 0 && high > 4 * low ? Real(sqrt(low * high)) : Real((low + high) / 2);
      if (low == 0) middle = high / 1024;
      ((f(middle) < 0) == rising ? low : high) = middle;
      // Regula falsi on both sides of the secant, so that each pass gains digits.
      const Real left = f(low), right = f(high);
      if (left == right) continue;
      const Real secant = low - left * (high - low) / (right - left);
      const Real nudge = (high - low) * (high - low) / high;
      for (const Real& t : {Real(secant - nudge), Real(secant + nudge)}) {
        if (!(t > low && t < high)) continue;
        ((f(t) < 0) == rising ? low : high) = t;
      }
    }
    return (low + high) / 2;
  }
  /// The points, and where f changes its sign between them.
  template <class Function>
  static std::vector<Real> with_changes(const Function& f, const std::vector<Real>& points) {
    std::vector<Real> all{points.front()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Real left = f(points[i]), right = f(points[i + 1]);
      if ((left < 0 && right > 0) || (left > 0 && right < 0)) {
        all.push_back(zero_between(f, points[i], points[i + 1]));
      }
      all.push_back(points[i + 1]);
    }
    return all;
  }

  Real2 p_, v_, a_;
  Real d_, rate_;
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

// SPDX-License-Identifier: Apache-2.0
// Contacts of disks whose relative motion drag and a pull bend, against 400 bits: adversarial
// families, single cases by hand, and the durations that all of it is made of.
#include "contact_time/drag_curve.hpp"

#include "support/accelerated_cases.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::Census;
using test::CurvedCase;
using test::CurvedFamily;
using test::CurvedShape;
using test::Random;
using test::Real;
using test::Real2;

struct ExactClock {
  Real run, fall, left;
};

ExactClock exact_clock(const Real& t, const Real& rate) {
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

  /// The infimum of the t >= 0 with F <= 0 and falling.
  std::optional<Real> contact() const {
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
      if (slope(Real((pieces[i] + pieces[i + 1]) / 2)) >= 0) continue;
      if (value(pieces[i]) <= 0) return pieces[i];
      if (value(pieces[i + 1]) >= 0) continue;
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
    return {test::exact(curve.motion.position),
            test::exact(curve.motion.velocity),
            test::exact(curve.motion.acceleration),
            test::exact(curve.reach),
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
  c.curve = test::make_curved<S>(at_contact, random, low_words);
  const Real scale = shape.t > 0 ? shape.t : Real(1);
  c.rate = Real(strength / scale).convert_to<S>();
  const ExactClock clock = exact_clock(shape.t, Real(c.rate));
  auto& m = c.curve.motion;
  const Real2 x = test::exact(m.position), u = test::exact(m.velocity);
  const Real2 a = test::exact(m.acceleration);
  const auto before = [&](const Real& w, const Real& b) {
    return Real((w - b * clock.run) / clock.left);
  };
  m.velocity = test::rounded<S>(Real2{before(u.x, a.x), before(u.y, a.y)}, low_words);
  const Real2 v = test::exact(m.velocity);
  m.position = test::rounded<S>(
      Real2{x.x - v.x * clock.run - a.x * clock.fall, x.y - v.y * clock.run - a.y * clock.fall},
      low_words);
  return c;
}

template <class S>
Census census_of(const CurvedFamily& family, bool low_words, const std::string& scalar) {
  Census census(scalar + (low_words ? " two words, " : ", ") + family.name);
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::environment_number("STOSS_CASES", test::campaign(150, 10'000));
  for (std::uint64_t i = 0; i < cases; ++i) {
    const double strength = random.one_in(3) ? random.decades(-15, 0) : random.uniform(0.01, 3);
    const DraggedCase<S> c = make_dragged<S>(family.shape(random), strength, random, low_words);
    if (detail::is_zero(c.curve.motion.acceleration) || !(c.rate > S(0))) continue;
    std::optional<Real> truth = c.gap().contact();
    const S t_max = c.curve.t_max;
    if (truth && detail::is_finite(t_max) && *truth > Real(t_max)) truth.reset();
    census.add(drag_curve_contact(c.curve.motion, c.curve.reach, c.rate, t_max), truth);
  }
  census.print();
  return census;
}

template <class S>
void expect_exact_families(const std::string& scalar) {
  for (const bool low_words : {false, true}) {
    for (const CurvedFamily& family : test::curved_families(test::kDecades<S>)) {
      if (family.name == "all mixed" || family.name == "no acceleration") continue;
      SCOPED_TRACE(family.name + (low_words ? ", two words" : ""));
      Census census = census_of<S>(family, low_words, scalar);
      EXPECT_EQ(census.missed(), 0);
      EXPECT_EQ(census.falses(), 0);
      EXPECT_LE(census.max(), 0.51);
    }
  }
}

TEST(DragCurve, DoubleMissesNothingAndIsRoundedOnce) { expect_exact_families<double>("double"); }

TEST(DragCurve, FloatMissesNothingAndIsRoundedOnce) { expect_exact_families<float>("float"); }

// The oracle itself knows where pieces part by a theorem; here the gap is walked along instead.
TEST(DragCurve, NothingIsTouchedBeforeTheContact) {
  Random random(test::seed_of_run());
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const double strength = random.uniform(0.01, 5);
    const auto c = make_dragged<double>(test::generic_curve(random), strength, random, false);
    const ExactGap gap = c.gap();
    const auto t = drag_curve_contact(
        c.curve.motion, c.curve.reach, c.rate, std::numeric_limits<double>::infinity());
    const Real end = t ? Real(t->hi) : Real(20 / c.rate);
    met += t ? 1 : 0;
    Real before = gap.value(Real(0));
    for (int k = 1; k < 400; ++k) {
      const Real now = gap.value(Real(end * k / 400));
      EXPECT_FALSE(now < 0 && now < before && before > 0) << i << " at " << k;
      before = now;
    }
  }
  EXPECT_GT(met, 100);
}

TEST(DragCurve, DurationsAreAsGoodAsTheySay) {
  Random random(test::seed_of_run());
  double worst_run = 0, worst_left = 0, worst_fall = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double rate = random.decades(-3, 3);
    const double y = random.one_in(2) ? random.decades(-20, 0) : random.uniform(0, 600);
    const double t = y / rate;
    const auto clock = detail::drag_clock<double>({t, 0}, rate);
    const ExactClock truth = exact_clock(Real(t), Real(rate));
    const auto off = [](const DoubleWord<double>& x, const Real& exact) {
      return Real(abs(test::exact(x) - exact) / exact).convert_to<double>();
    };
    worst_run = std::max(worst_run, off(clock.run, truth.run));
    worst_left =
        std::max(worst_left, Real(abs(test::exact(clock.left) - truth.left)).convert_to<double>());
    worst_fall = std::max(worst_fall, off(clock.fall, truth.fall));
  }
  std::printf("drag: run off by 2^%.1f, what is left by 2^%.1f of 1, fall by 2^%.1f\n",
              std::log2(worst_run),
              std::log2(worst_left),
              std::log2(worst_fall));
  EXPECT_LT(worst_run, 0x1p-100);
  EXPECT_LT(worst_left, 0x1p-100);
  EXPECT_LT(worst_fall, 0x1p-88);
}

template <class S>
AcceleratedMotion<S> flying(S px, S py, S vx, S vy, S ax, S ay) {
  return {{{px, S(0)}, {py, S(0)}}, {{vx, S(0)}, {vy, S(0)}}, {{ax, S(0)}, {ay, S(0)}}};
}

template <class S>
class DragCurveByHand : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(DragCurveByHand, Scalars);

// At terminal velocity, a / m, a fall takes its height over that.
TYPED_TEST(DragCurveByHand, AtTerminalVelocityTheFallIsUniform) {
  using S = TypeParam;
  const S forever = std::numeric_limits<S>::infinity();
  const auto motion = flying<S>(S(0), S(9), S(0), S(-2), S(0), S(-1));
  const auto t = drag_curve_contact(motion, DoubleWord<S>{S(1), S(0)}, S(0.5), forever);
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(4));
  EXPECT_FALSE(drag_curve_contact(motion, DoubleWord<S>{S(1), S(0)}, S(0.5), S(3.9)).has_value());
}

TYPED_TEST(DragCurveByHand, TouchingWithoutClosingSpeedIsDecidedByThePull) {
  using S = TypeParam;
  const S forever = std::numeric_limits<S>::infinity();
  const auto pressed = flying<S>(S(0), S(1), S(0), S(0), S(0), S(-8));
  const auto lifted = flying<S>(S(0), S(1), S(0), S(0), S(0), S(8));
  const DoubleWord<S> reach{S(1), S(0)};
  ASSERT_TRUE(drag_curve_contact(pressed, reach, S(0.5), forever).has_value());
  EXPECT_EQ(drag_curve_contact(pressed, reach, S(0.5), forever)->hi, S(0));
  EXPECT_FALSE(drag_curve_contact(lifted, reach, S(0.5), forever).has_value());
}

TYPED_TEST(DragCurveByHand, NonsenseNeverMeets) {
  using S = TypeParam;
  const S forever = std::numeric_limits<S>::infinity();
  const S nan = std::numeric_limits<S>::quiet_NaN();
  const DoubleWord<S> reach{S(1), S(0)};
  for (const S bad : {nan, forever}) {
    EXPECT_FALSE(
        drag_curve_contact(flying<S>(bad, S(1), S(0), S(0), S(0), S(-8)), reach, S(1), forever));
    EXPECT_FALSE(
        drag_curve_contact(flying<S>(S(3), S(1), S(0), bad, S(0), S(-8)), reach, S(1), forever));
    EXPECT_FALSE(
        drag_curve_contact(flying<S>(S(3), S(1), S(0), S(0), bad, S(-8)), reach, S(1), forever));
    EXPECT_FALSE(drag_curve_contact(
        flying<S>(S(3), S(1), S(0), S(0), S(0), S(-8)), DoubleWord<S>{bad, S(0)}, S(1), forever));
    EXPECT_FALSE(
        drag_curve_contact(flying<S>(S(3), S(1), S(0), S(0), S(0), S(-8)), reach, bad, forever));
  }
}

}  // namespace
}  // namespace stoss::engine

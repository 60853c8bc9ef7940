// SPDX-License-Identifier: Apache-2.0
// Crossings of a circle's rim against 400 bits: adversarial families from without and from within,
// straight and on parabolas, and single cases by hand.
#include "contact_time/rim_crossing.hpp"

#include "contact_time/curved_rim_crossing.hpp"
#include "support/drag_cases.hpp"
#include "support/rim_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace stoss::engine {
namespace {

using test::Random;
using test::Real;
using test::RimCase;
using test::RimCensus;

/// No crossing was missed, none was made up, and none is further off than `ulp_max`.
void expect_none_missed(test::Census& census, double ulp_max) {
  census.print();
  EXPECT_EQ(census.missed(), 0);
  EXPECT_EQ(census.falses(), 0);
  EXPECT_LE(census.max(), ulp_max);
}

/// Runs the cases of `make` as they are, and taken up inside the circle.
template <class S, class Make, class Kernel>
void expect_exact(const std::string& name,
                  std::uint64_t cases,
                  const Make& make,
                  const Kernel& kernel,
                  double ulp_max,
                  double ulp_max_within) {
  RimCensus from_without(name), from_within(name + ", from within");
  Random random(test::seed_of_run());
  for (std::uint64_t i = 0; i < cases; ++i) {
    const RimCase<S> c = make(random);
    from_without.add(c, kernel);
    const auto inside = test::taken_up_inside(c, random, test::kDecades<S>.finest);
    if (inside) from_within.add(*inside, kernel);
  }
  expect_none_missed(from_without.errors, ulp_max);
  expect_none_missed(from_within.errors, ulp_max_within);
}

template <class S>
void expect_exact_straight_families(const std::string& scalar) {
  constexpr double kUlpMax = 6;
  constexpr double kUlpMaxWithin = 16;  // where neither word of the time is much the better
  for (const bool low_words : {false, true}) {
    for (const auto& family : test::pair_families(test::kDecades<S>)) {
      const std::string name = scalar + (low_words ? " two words, " : ", ") + family.name;
      SCOPED_TRACE(name);
      expect_exact<S>(
          name,
          test::cases_per_family(2000),
          [&](Random& r) {
            return test::rim_of(test::make_pair<S>(family.shape(r), r, low_words));
          },
          [](const RimCase<S>& c, bool is_inside) {
            return rim_crossing(detail::straight(c.motion), c.radius, is_inside);
          },
          kUlpMax,
          kUlpMaxWithin);
    }
  }
}

TEST(RimCrossing, DoubleMissesNothingOnStraightFlights) {
  expect_exact_straight_families<double>("double");
}
TEST(RimCrossing, FloatMissesNothingOnStraightFlights) {
  expect_exact_straight_families<float>("float");
}

template <class S>
void expect_exact_curved_families(const std::string& scalar) {
  // From within a case may begin 1e-17 of a chord of 1e-9 from the rim, where double words run out.
  constexpr double kUlpMax = 0.51;
  constexpr double kUlpMaxWithin = 40;
  constexpr double kUlpMaxStraight = 6;
  for (const bool low_words : {false, true}) {
    for (const auto& family : test::curved_families(test::kDecades<S>)) {
      const std::string name = scalar + (low_words ? " two words, " : ", ") + family.name;
      SCOPED_TRACE(name);
      expect_exact<S>(
          name,
          test::environment_number("STOSS_CASES", test::campaign(500, 100'000)),
          [&](Random& r) {
            return test::rim_of(test::make_curved<S>(family.shape(r), r, low_words));
          },
          [](const RimCase<S>& c, bool is_inside) {
            return accelerated_rim_crossing(
                c.motion, c.radius, is_inside, std::numeric_limits<S>::infinity());
          },
          family.name == "no acceleration" ? kUlpMaxStraight : kUlpMax,
          kUlpMaxWithin);
    }
  }
}

TEST(RimCrossing, DoubleMissesNothingOnParabolas) {
  expect_exact_curved_families<double>("double");
}
TEST(RimCrossing, FloatMissesNothingOnParabolas) { expect_exact_curved_families<float>("float"); }

template <class S>
class RimCrossingByHand : public testing::Test {
 protected:
  static AcceleratedMotion<S> flying(S px, S py, S vx, S vy, S ay = S(0)) {
    return {{{px, S(0)}, {py, S(0)}}, {{vx, S(0)}, {vy, S(0)}}, {{S(0), S(0)}, {ay, S(0)}}, S(0)};
  }
  /// The next crossing of a circle of radius 1.
  static std::optional<S> in(const AcceleratedMotion<S>& motion) { return next(motion, false); }
  static std::optional<S> out(const AcceleratedMotion<S>& motion) { return next(motion, true); }

 private:
  static std::optional<S> next(const AcceleratedMotion<S>& motion, bool is_inside) {
    const auto t =
        accelerated_rim_crossing(motion, S(1), is_inside, std::numeric_limits<S>::infinity());
    if (!t) return std::nullopt;
    return static_cast<S>(t->hi);
  }
};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(RimCrossingByHand, Scalars);

TYPED_TEST(RimCrossingByHand, PassesThroughTheMiddleInAndOut) {
  using S = TypeParam;
  EXPECT_EQ(this->in(this->flying(S(-3), S(0), S(2), S(0))), S(1));
  EXPECT_EQ(this->out(this->flying(S(-3), S(0), S(2), S(0))), S(2));
  EXPECT_EQ(this->out(this->flying(S(0), S(0), S(2), S(0))), S(0.5));
  EXPECT_EQ(this->out(this->flying(S(0), S(0), S(0), S(0))), std::nullopt);
}

TYPED_TEST(RimCrossingByHand, OnTheRimTheStateAndTheDirectionDecide) {
  using S = TypeParam;
  const auto inwards = this->flying(S(-1), S(0), S(2), S(0));
  const auto outwards = this->flying(S(1), S(0), S(2), S(0));
  const auto along = this->flying(S(1), S(0), S(0), S(2));
  EXPECT_EQ(this->in(inwards), S(0));
  EXPECT_EQ(this->out(inwards), S(1));
  EXPECT_EQ(this->in(outwards), std::nullopt);
  EXPECT_EQ(this->out(outwards), S(0));
  EXPECT_EQ(this->in(along), std::nullopt);
  EXPECT_EQ(this->out(along), S(0));
}

TYPED_TEST(RimCrossingByHand, ATangentIsNoCrossing) {
  using S = TypeParam;
  EXPECT_EQ(this->in(this->flying(S(-3), S(1), S(1), S(0))), std::nullopt);
  // Thrown up with 4 m/s against 8 m/s^2: an apex 1 m higher, on the rim.
  EXPECT_EQ(this->in(this->flying(S(0), S(-2), S(0), S(4), S(-8))), std::nullopt);
  EXPECT_EQ(this->out(this->flying(S(0), S(0), S(0), S(4), S(-8))), S(0.5) + S(std::sqrt(S(0.5))));
}

TYPED_TEST(RimCrossingByHand, AParabolaComesBack) {
  using S = TypeParam;
  const auto thrown = this->flying(S(0), S(-1), S(0), S(4), S(-8));
  EXPECT_EQ(this->in(thrown), S(0));
  EXPECT_EQ(this->out(thrown), S(1));
  // Fast enough to leave by the top: -1 + 6 t - 4 t^2 = 1 at t = 1/2, and again at t = 1.
  const auto faster = this->flying(S(0), S(-1), S(0), S(6), S(-8));
  EXPECT_NEAR(static_cast<double>(*this->out(faster)), 0.5, 1e-15);
  // From above the rim down into it.
  EXPECT_EQ(this->in(this->flying(S(0), S(1), S(0), S(2), S(-8))), S(0.5));
}

TYPED_TEST(RimCrossingByHand, NothingComesAfterTheMotionEnds) {
  using S = TypeParam;
  const auto motion = this->flying(S(0), S(0), S(0), S(4), S(-2));
  EXPECT_TRUE(accelerated_rim_crossing(motion, S(1), true, S(0.3)).has_value());
  EXPECT_FALSE(accelerated_rim_crossing(motion, S(1), true, S(0.2)).has_value());
}

/// The case taken up on its way through the circle; none where it does not enter.
template <class S>
std::optional<test::DraggedCase<S>> taken_up_inside(const test::DraggedCase<S>& c, Random& random) {
  const auto in = c.gap().crossing(false);
  if (!in) return std::nullopt;
  // Where it leaves, seen from deep enough inside to have entered.
  const auto at = [&](const Real& t) {
    const test::ExactClock clock = test::exact_clock(t, Real(c.rate));
    const test::Real2 p = test::exact(c.curve.motion.position);
    const test::Real2 v = test::exact(c.curve.motion.velocity);
    const test::Real2 a = test::exact(c.curve.motion.acceleration);
    const auto flown = [&](const Real& x, const Real& u, const Real& b) {
      return Real(x + u * clock.run + b * clock.fall);
    };
    const auto speed = [&](const Real& u, const Real& b) {
      return Real(u * clock.left + b * clock.run);
    };
    test::DraggedCase<S> there = c;
    there.curve.motion.position =
        test::rounded<S>(test::Real2{flown(p.x, v.x, a.x), flown(p.y, v.y, a.y)}, false);
    there.curve.motion.velocity =
        test::rounded<S>(test::Real2{speed(v.x, a.x), speed(v.y, a.y)}, false);
    return there;
  };
  const auto left = at(*in * (1 + ldexp(Real(1), -20))).gap().crossing(true);
  if (!left) return std::nullopt;
  return at(*in + *left * random.uniform(0.01, 0.99));
}

TEST(RimCrossing, MissesNothingUnderDrag) {
  for (const auto& family : test::curved_families(test::kDecades<double>)) {
    if (family.name == "all mixed" || family.name == "no acceleration") continue;
    SCOPED_TRACE(family.name);
    test::Census from_without("drag, " + family.name);
    test::Census from_within("drag, " + family.name + ", from within");
    Random random(test::seed_of_run());
    const std::uint64_t cases = test::environment_number("STOSS_CASES", test::campaign(60, 50'000));
    for (std::uint64_t i = 0; i < cases; ++i) {
      const double strength = random.one_in(3) ? random.decades(-15, 0) : random.uniform(0.01, 3);
      auto c = test::make_dragged<double>(family.shape(random), strength, random, false);
      if (detail::is_zero(c.curve.motion.acceleration) || !(c.rate > 0)) continue;
      c.curve.reach.lo = 0;
      const auto ask = [&](const test::DraggedCase<double>& one, test::Census& census) {
        const bool is_inside = one.gap().value(Real(0)) < 0;
        const auto& m = one.curve.motion;
        const DragMotion<double> motion{{m.position, m.velocity, m.acceleration, 0}, one.rate};
        census.add(
            drag_rim_crossing(
                motion, one.curve.reach.hi, is_inside, std::numeric_limits<double>::infinity()),
            one.gap().crossing(is_inside));
      };
      ask(c, from_without);
      if (const auto inside = taken_up_inside(c, random)) ask(*inside, from_within);
    }
    expect_none_missed(from_without, 0.51);
    expect_none_missed(from_within, 0.51);
  }
}

// Straight in the warped time, which ends: the nearer to its end, the more an error of the start
// tells.
TEST(RimCrossing, MissesNothingOnStraightFlightsUnderDrag) {
  for (const auto& family : test::pair_families(test::kDecades<double>)) {
    if (family.name == "extreme speeds" || family.name == "all mixed") continue;
    SCOPED_TRACE(family.name);
    test::Census from_without("drag, straight, " + family.name);
    test::Census from_within("drag, straight, " + family.name + ", from within");
    Random random(test::seed_of_run());
    const std::uint64_t cases = test::cases_per_family(1000);
    for (std::uint64_t i = 0; i < cases; ++i) {
      const auto outside =
          test::rim_of(test::make_pair<double>(family.shape(random), random, false));
      const auto ask = [&](const RimCase<double>& c, test::Census& census) {
        const auto f = test::polynomial_of(c);
        const bool is_inside = f[0] < 0;
        const auto warped = test::exact_crossings(f, is_inside);
        const double rate = warped.empty() || warped[0] == 0
                                ? 1.0
                                : Real(random.uniform(0, 1.2) / warped[0]).convert_to<double>();
        if (!(rate > 0)) return;
        std::optional<Real> truth;
        if (!warped.empty() && warped[0] * rate < 1) {
          truth = Real(-log1p(Real(-warped[0] * rate)) / rate);
        }
        const DragMotion<double> motion{{c.motion.position, c.motion.velocity, {}, 0}, rate};
        const auto t =
            drag_rim_crossing(motion, c.radius, is_inside, std::numeric_limits<double>::infinity());
        if (truth && warped[0] * rate > 0.99) return;
        census.add(t, truth);
      };
      ask(outside, from_without);
      if (const auto c = test::taken_up_inside(outside, random, -17)) ask(*c, from_within);
    }
    expect_none_missed(from_without, 200);
    expect_none_missed(from_within, 200);
  }
}

// x(t) = v (1 - e^(-m t)) / m: with m = 1 and v = 4 it is 1 at t = log(4/3), and ends at 4.
TEST(RimCrossing, UnderDragTheWayEnds) {
  const auto cross = [](double from, double speed, bool is_inside) {
    const DragMotion<double> motion{{{{from, 0}, {0, 0}}, {{speed, 0}, {0, 0}}, {}, 0}, 1.0};
    const auto t =
        drag_rim_crossing(motion, 1.0, is_inside, std::numeric_limits<double>::infinity());
    return t ? t->hi : -1;
  };
  EXPECT_DOUBLE_EQ(cross(0, 4, true), std::log(4.0 / 3));
  EXPECT_EQ(cross(0, 0.9, true), -1);
  EXPECT_DOUBLE_EQ(cross(-3, 4, false), std::log(2.0));
  EXPECT_EQ(cross(-3, 1.5, false), -1);
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// Contacts of disks whose relative motion drag and a pull bend, against 400 bits: adversarial
// families, single cases by hand, and the durations that all of it is made of.
#include "contact_time/drag_curve.hpp"

#include "support/accelerated_cases.hpp"
#include "support/contact_cases.hpp"
#include "support/drag_cases.hpp"
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
using test::CurvedFamily;
using test::DraggedCase;
using test::exact_clock;
using test::ExactClock;
using test::ExactGap;
using test::Random;
using test::Real;

template <class S>
Census census_of(const CurvedFamily& family, bool low_words, const std::string& scalar) {
  Census census(scalar + (low_words ? " two words, " : ", ") + family.name);
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::environment_number("STOSS_CASES", test::campaign(150, 100'000));
  for (std::uint64_t i = 0; i < cases; ++i) {
    const double strength = random.one_in(3) ? random.decades(-15, 0) : random.uniform(0.01, 3);
    const DraggedCase<S> c =
        test::make_dragged<S>(family.shape(random), strength, random, low_words);
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
    const auto c = test::make_dragged<double>(test::generic_curve(random), strength, random, false);
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

// SPDX-License-Identifier: Apache-2.0
// Contacts under linear drag, alone and with gravity, against 400 bits: adversarial families, and
// single cases by hand.
#include "contact_time/drag.hpp"

#include "contact_time/drag_face.hpp"
#include "support/accelerated_cases.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::Census;
using test::FacedCase;
using test::FacedFamily;
using test::FacedShape;
using test::PairCase;
using test::PairFamily;
using test::Random;
using test::Real;
using test::Real2;

// Tolerance: of 20000 cases per family the worst is off by 0.501 ulp.
constexpr double kUlpMax = 0.51;

/// Where the drag ends the motion almost at contact, the warped time's error counts 1 / (1 - m s)
/// times. It is 2^-60 of s where c is about to get its third word, which is 2^-8 ulp.
constexpr double kShareOfCondition = 0x1p-8;

/// What a rate is measured by: m times the warped time of the contact.
struct Strength {
  std::string name;
  std::function<double(Random&)> draw;
};

std::vector<Strength> strengths(double finest) {
  return {{"moderate", [](Random& r) { return r.uniform(0, 1.2); }},
          {"slight", [=](Random& r) { return r.decades(finest - 3, 0); }},
          {"almost in vain", [=](Random& r) { return 1 - r.either_sign(r.decades(finest, 0)); }}};
}

template <class S>
Census census_of_pairs(const PairFamily& family,
                       const Strength& strength,
                       bool low_words,
                       const std::string& scalar) {
  Census census(scalar + (low_words ? " two words, " : ", ") + family.name + ", " + strength.name);
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(2000);
  for (std::uint64_t i = 0; i < cases; ++i) {
    const PairCase<S> c = test::make_pair<S>(family.shape(random), random, low_words);
    const std::optional<Real> s = test::exact_pair_contact(
        test::exact(c.motion.position), test::exact(c.motion.velocity), test::exact(c.reach));
    const double share = strength.draw(random);
    const S rate = s && *s > 0 ? Real(share / *s).template convert_to<S>() : static_cast<S>(share);
    if (!(rate > S(0)) || !detail::is_finite(rate)) continue;
    std::optional<Real> truth;
    if (s && *s * Real(rate) < 1) truth = Real(-log1p(Real(-*s * Real(rate))) / Real(rate));
    const auto t = drag_disk_contact(c.motion, c.reach, rate);
    if (t && truth) {  // in units of what the condition number 1 / (1 - m s) of (2) allows
      const double condition = Real(1 / (1 - *s * Real(rate))).template convert_to<double>();
      const double allowed = 1 + condition * kShareOfCondition;
      census.add_error(test::error_in_ulp<S>(test::exact(*t), *truth) / allowed);
    } else {
      census.add(t, truth);
    }
  }
  census.print();
  return census;
}

template <class S>
void expect_exact_pairs(const std::string& scalar) {
  const test::Decades decades = test::kDecades<S>;
  for (const bool low_words : {false, true}) {
    for (const PairFamily& family : test::pair_families(decades)) {
      if (family.name == "extreme speeds" || family.name == "all mixed") continue;
      for (const Strength& strength : strengths(decades.finest)) {
        SCOPED_TRACE(family.name + ", " + strength.name + (low_words ? ", two words" : ""));
        Census census = census_of_pairs<S>(family, strength, low_words, scalar);
        EXPECT_EQ(census.missed(), 0);
        EXPECT_EQ(census.falses(), 0);
        EXPECT_LE(census.max(), kUlpMax);
      }
    }
  }
}

TEST(Drag, PairsInDoubleMissNothingAndAreRoundedOnce) { expect_exact_pairs<double>("double"); }

TEST(Drag, PairsInFloatMissNothingAndAreRoundedOnce) { expect_exact_pairs<float>("float"); }

/// The zero of the falling G(t) = g + w s + k (t - s) / m between low and high, by bisection and
/// Newton's steps.
struct ExactFall {
  Real g, w, k, m;

  Real value(const Real& t) const {
    const Real s = -expm1(Real(-m * t)) / m;
    return g + w * s + k * (t - s) / m;
  }

  Real slope(const Real& t) const {
    const Real left = exp(Real(-m * t));
    return w * left + k * (1 - left) / m;
  }

  Real root(Real low, Real high) const {
    const Real close = ldexp(Real(1), -300);
    Real t = (low + high) / 2;
    for (int i = 0; i < 3000; ++i) {
      const Real f = value(t);
      (f > 0 ? low : high) = t;
      const Real step = Real(-f / slope(t));
      Real next = t + step;
      if (abs(step) <= close * abs(t)) return next;
      if (!(next > low && next < high)) {
        next = low > 0 && high > 4 * low ? Real(sqrt(low * high)) : Real((low + high) / 2);
      }
      t = next;
    }
    return t;
  }

  /// The first landing; `is_far`: only from beyond the top.
  std::optional<Real> landing(bool is_far) const {
    if (g <= 0 && w < 0 && !is_far) return Real(0);
    Real start = 0;
    if (w >= 0 || is_far) {
      if (k >= 0 || w < 0) return std::nullopt;
      start = log1p(Real(-m * w / k)) / m;
      if (value(start) <= 0) return is_far ? std::nullopt : std::optional<Real>(start);
    } else if (k > 0) {
      const Real bottom = log1p(Real(-m * w / k)) / m;
      if (value(bottom) >= 0) return std::nullopt;
      return root(0, bottom);
    }
    if (k == 0 && g + w / m >= 0) return std::nullopt;
    Real step = 1 / m;
    while (value(Real(start + step)) > 0) step = step * 2;
    return root(start, Real(start + step));
  }
};

template <class S>
test::ExactLanding exact_landing(const FacedCase<S>& c, const S& rate) {
  const Real2 p = test::exact(c.motion.position), v = test::exact(c.motion.velocity);
  const Real2 a = test::exact(c.motion.acceleration), e = test::exact(c.edge);
  const Real reach = Real(c.radius) * sqrt(dot(e, e)), m(rate);
  const int side = cross(e, p) < 0 ? -1 : 1;
  const Real h = cross(e, p) * side, w = cross(e, v) * side, k = cross(e, a) * side;
  const std::optional<Real> landings[] = {ExactFall{Real(h - reach), w, k, m}.landing(false),
                                          ExactFall{Real(-h - reach), -w, -k, m}.landing(true)};
  for (const std::optional<Real>& t : landings) {
    if (!t) continue;
    const Real s = -expm1(Real(-m * *t)) / m, fall = (*t - s) / m;
    const Real along = dot(e, p) + dot(e, v) * s + dot(e, a) * fall;
    const Real terms = abs(dot(e, p)) + abs(dot(e, v)) * s + abs(dot(e, a)) * fall + dot(e, e);
    const Real margin = 4096 * Real(std::numeric_limits<S>::epsilon()) * terms;
    if (abs(along) < margin || abs(along - dot(e, e)) < margin) return {std::nullopt, true};
    if (along > 0 && along < dot(e, e)) {
      if (*t > Real(c.t_max)) return {};
      return {t, false};
    }
  }
  return {};
}

template <class S>
Census census_of_faces(const FacedFamily& family, bool low_words, const std::string& scalar) {
  Census census(scalar + (low_words ? " two words, " : ", ") + family.name);
  Random random(test::seed_of_run());
  const std::uint64_t cases =
      test::environment_number("STOSS_CASES", test::campaign(1000, 100'000));
  for (std::uint64_t i = 0; i < cases; ++i) {
    const FacedShape shape = family.shape(random);
    const FacedCase<S> c = test::make_faced<S>(shape, random, low_words);
    const S rate = static_cast<S>(random.decades(-6, 1));
    const test::ExactLanding truth = exact_landing(c, rate);
    if (truth.is_at_an_end) continue;
    census.add(drag_face_contact(c.motion, c.edge, c.radius, rate, c.t_max), truth.t);
  }
  census.print();
  return census;
}

template <class S>
void expect_exact_faces(const std::string& scalar) {
  for (const bool low_words : {false, true}) {
    for (const FacedFamily& family : test::faced_families(test::kDecades<S>)) {
      if (family.name == "all mixed" || family.name == "far flights") continue;
      SCOPED_TRACE(family.name + (low_words ? ", two words" : ""));
      Census census = census_of_faces<S>(family, low_words, scalar);
      EXPECT_EQ(census.missed(), 0);
      EXPECT_EQ(census.falses(), 0);
      EXPECT_LE(census.max(), kUlpMax);
    }
  }
}

TEST(Drag, WallsInDoubleMissNothingAndAreRoundedOnce) { expect_exact_faces<double>("double"); }

TEST(Drag, WallsInFloatMissNothingAndAreRoundedOnce) { expect_exact_faces<float>("float"); }

template <class S>
class DragByHand : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(DragByHand, Scalars);

template <class S>
std::optional<Duration<S>> meet(S px, S vx, S reach, S rate) {
  const RelativeMotion<S> motion{{{px, S(0)}, {S(0.25), S(0)}}, {{vx, S(0)}, {S(0), S(0)}}};
  return drag_disk_contact(motion, DoubleWord<S>{reach, S(0)}, rate);
}

TYPED_TEST(DragByHand, MotionThatEndsBeforeContactNeverMeets) {
  using S = TypeParam;
  const auto hit = meet(S(-5), S(3), S(1), S(0.5));
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(static_cast<double>(hit->hi), 2.22923352290477014, 1e-6);
  EXPECT_FALSE(meet(S(-5), S(1), S(1), S(0.25)).has_value());
}

TYPED_TEST(DragByHand, WithoutDragItIsStraightFlight) {
  using S = TypeParam;
  const RelativeMotion<S> motion{{{S(-5), S(0)}, {S(0), S(0)}}, {{S(2), S(0)}, {S(0), S(0)}}};
  const auto t = drag_disk_contact(motion, DoubleWord<S>{S(1), S(0)}, S(0));
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(2));
}

/// On the wall from (0, 0) to (4, 0) with a radius of 1 under gravity 8 downwards and drag 1/s.
template <class S>
std::optional<Duration<S>> land(S px, S py, S vx, S vy) {
  const AcceleratedMotion<S> motion{
      {{px, S(0)}, {py, S(0)}}, {{vx, S(0)}, {vy, S(0)}}, {{S(0), S(0)}, {S(-8), S(0)}}};
  return drag_face_contact(motion,
                           DoubleWord2<S>{{S(4), S(0)}, {S(0), S(0)}},
                           S(1),
                           S(1),
                           std::numeric_limits<S>::infinity());
}

TYPED_TEST(DragByHand, LongFallEndsAtTerminalSpeed) {
  using S = TypeParam;
  // 8 (t - 1 + e^-t) = h: after 1000 s nothing is left of the exponential.
  const auto t = land(S(2), S(1) + S(8) * S(999), S(0), S(0));
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->hi, S(1000));
}

TYPED_TEST(DragByHand, DiskOnTheFloorRestsAndOneThrownUpComesDown) {
  using S = TypeParam;
  const auto pressed = land(S(2), S(1), S(0), S(0));
  ASSERT_TRUE(pressed.has_value());
  EXPECT_EQ(pressed->hi, S(0));
  const auto t = land(S(2), S(1), S(0), S(4));
  ASSERT_TRUE(t.has_value());
  // 4 s = 8 (t - s): 1.5 (1 - e^-t) = t
  EXPECT_NEAR(static_cast<double>(t->hi), 1.5 * -std::expm1(-static_cast<double>(t->hi)), 1e-6);
  EXPECT_FALSE(land(S(5), S(1), S(0), S(4)).has_value());
}

}  // namespace
}  // namespace stoss::engine

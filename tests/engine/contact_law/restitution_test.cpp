// SPDX-License-Identifier: Apache-2.0
// The law of restitution against 400 bits: the reversed speed, the exact loss of energy, momentum;
// and that e = 1 is the elastic law to the bit.
#include "contact_law/restitution.hpp"

#include "support/rough_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace stoss::engine {
namespace {

using test::ContactBody;
using test::ContactCase;
using test::exact;
using test::Random;
using test::Real;
using test::Real2;

template <class S>
PairImpulse<S> impulse_in(const ContactCase<S>& c, S e) {
  return restitution_impulse<S>(
      c.contact, c.b.velocity - c.a.velocity, c.a.mass, c.a.is_fixed, c.b.mass, c.b.is_fixed, e);
}

template <class S>
ContactCase<S> after(ContactCase<S> c, const PairImpulse<S>& impulse) {
  c.a.velocity = c.a.velocity + impulse.delta_a;
  c.b.velocity = c.b.velocity + impulse.delta_b;
  return c;
}

template <class S>
void expect_the_law(double mass_decades) {
  Random random(test::seed_of_run());
  constexpr S kUnit = std::numeric_limits<S>::epsilon() / 2;
  const Real allowed = Real(64) * Real(kUnit) * Real(kUnit);
  Real worst(0);
  for (int i = 0; i < 20'000; ++i) {
    const ContactCase<S> c = test::random_contact<S>(random, mass_decades, random.one_in(4));
    const S e = random.one_in(8) ? S(0) : static_cast<S>(random.uniform(0, 1));
    const ContactCase<S> d = after(c, impulse_in(c, e));
    const Real2 p = exact(c.contact);
    const Real speed = c.a.speed() + c.b.speed();
    const Real scale = sqrt(dot(p, p)) * speed;
    worst = std::max(worst, Real(abs(d.closing() + Real(e) * c.closing()) / scale));

    const Real reduced = c.b.is_fixed
                             ? Real(c.a.mass)
                             : Real(c.a.mass) * Real(c.b.mass) / (Real(c.a.mass) + Real(c.b.mass));
    const Real loss =
        (1 - Real(e) * Real(e)) * reduced * c.closing() * c.closing() / (2 * dot(p, p));
    const Real energy = c.a.energy() + c.b.energy();
    // A fixed body's own motion does work, which is no part of (3).
    if (c.b.is_fixed) continue;
    worst = std::max(worst, Real(abs(energy - loss - d.a.energy() - d.b.energy()) / energy));
    const Real2 before{c.a.momentum().x + c.b.momentum().x, c.a.momentum().y + c.b.momentum().y};
    const Real2 now{d.a.momentum().x + d.b.momentum().x, d.a.momentum().y + d.b.momentum().y};
    const Real size = sqrt(2 * energy * (Real(c.a.mass) + Real(c.b.mass)));
    worst = std::max(worst, Real(abs(now.x - before.x) / size));
    worst = std::max(worst, Real(abs(now.y - before.y) / size));
  }
  EXPECT_LE(worst, allowed);
  std::printf("restitution, masses 10^+-%g: worst %.1f u^2\n",
              mass_decades,
              Real(worst / (Real(kUnit) * Real(kUnit))).template convert_to<double>());
}

TEST(Restitution, DoubleKeepsTheLawToTheLowWords) {
  expect_the_law<double>(0);
  expect_the_law<double>(15);
}
TEST(Restitution, FloatKeepsTheLawToTheLowWords) {
  expect_the_law<float>(0);
  expect_the_law<float>(6);
}

TEST(Restitution, OneIsTheElasticLawToTheBit) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 10'000; ++i) {
    const auto c = test::random_contact<double>(random, 3, random.one_in(4));
    const PairImpulse<double> lossy = impulse_in(c, 1.0);
    const PairImpulse<double> elastic = elastic_impulse<double>(
        c.contact, c.b.velocity - c.a.velocity, c.a.mass, c.a.is_fixed, c.b.mass, c.b.is_fixed);
    ASSERT_EQ(lossy.delta_a.x.hi, elastic.delta_a.x.hi);
    ASSERT_EQ(lossy.delta_a.x.lo, elastic.delta_a.x.lo);
    ASSERT_EQ(lossy.delta_b.y.hi, elastic.delta_b.y.hi);
    ASSERT_EQ(lossy.delta_b.y.lo, elastic.delta_b.y.lo);
    ASSERT_EQ(lossy.impulse, elastic.impulse);
  }
}

TEST(Restitution, GivesNothingToBodiesThatSeparate) {
  Random random(test::seed_of_run());
  auto c = test::random_contact<double>(random, 0, false);
  c.contact = -c.contact;
  const PairImpulse<double> impulse = impulse_in(c, 0.5);
  EXPECT_EQ(impulse.impulse, 0);
  EXPECT_EQ(impulse.delta_a.x.hi, 0);
}

}  // namespace
}  // namespace stoss::engine

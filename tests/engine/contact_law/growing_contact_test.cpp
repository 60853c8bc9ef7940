// SPDX-License-Identifier: Apache-2.0
// Contacts of growing disks against 400 bits: the surfaces' reversed speed, momentum, and what the
// growth puts into the energy.
#include "contact_law/growing.hpp"
#include "contact_law/restitution.hpp"
#include "support/rough_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace stoss::engine {
namespace {

using test::ContactCase;
using test::exact;
using test::Random;
using test::Real;
using test::Real2;

template <class S>
void expect_the_law(double mass_decades) {
  Random random(test::seed_of_run());
  constexpr S kUnit = std::numeric_limits<S>::epsilon() / 2;
  const Real allowed = Real(64) * Real(kUnit) * Real(kUnit);
  Real worst(0);
  for (int i = 0; i < 20'000; ++i) {
    ContactCase<S> c = test::random_contact<S>(random, mass_decades, random.one_in(4));
    if (random.one_in(3)) {  // the centres part, slower than the surfaces come
      c.contact = -c.contact;
    }
    const S e = random.one_in(4) ? S(1) : static_cast<S>(random.uniform(0, 1));
    const Real2 p = exact(c.contact);
    const Real length = sqrt(dot(p, p));
    const Real parting = c.closing() / length;  // u . n
    const double faster = static_cast<double>(parting.template convert_to<double>());
    const DoubleWord<S> growth =
        two_sum(static_cast<S>(std::max(faster, 0.0) + random.decades(-6, 1)), S(0));
    const Real m = exact(growth);
    const DoubleWord2<S> u = c.b.velocity - c.a.velocity;
    const auto impulse = restitution_impulse<S>(c.contact,
                                                velocity_of_growing_surfaces(c.contact, u, growth),
                                                c.a.mass,
                                                c.a.is_fixed,
                                                c.b.mass,
                                                c.b.is_fixed,
                                                e);
    ContactCase<S> d = c;
    d.a.velocity = d.a.velocity + impulse.delta_a;
    d.b.velocity = d.b.velocity + impulse.delta_b;
    const Real speed = c.a.speed() + c.b.speed() + m;
    const Real wanted = m + Real(e) * (m - parting);
    worst = std::max(worst, Real(abs(d.closing() / length - wanted) / speed));
    if (c.b.is_fixed) continue;
    const Real reduced = Real(c.a.mass) * Real(c.b.mass) / (Real(c.a.mass) + Real(c.b.mass));
    const Real gain =
        (1 + Real(e)) / 2 * reduced * (m - parting) * ((1 + Real(e)) * m + (1 - Real(e)) * parting);
    const Real before = c.a.energy() + c.b.energy(), after = d.a.energy() + d.b.energy();
    worst = std::max(worst, Real(abs(after - before - gain) / (before + after)));
    const Real2 lost{c.a.momentum().x + c.b.momentum().x - d.a.momentum().x - d.b.momentum().x,
                     c.a.momentum().y + c.b.momentum().y - d.a.momentum().y - d.b.momentum().y};
    const Real size = sqrt(2 * (before + after) * (Real(c.a.mass) + Real(c.b.mass)));
    worst = std::max(worst, Real(sqrt(dot(lost, lost)) / size));
  }
  EXPECT_LE(worst, allowed);
  std::printf("growing contact, masses 10^+-%g: worst %.1f u^2\n",
              mass_decades,
              Real(worst / (Real(kUnit) * Real(kUnit))).template convert_to<double>());
}

TEST(GrowingContact, DoubleKeepsTheLawToTheLowWords) {
  expect_the_law<double>(0);
  expect_the_law<double>(15);
}

TEST(GrowingContact, FloatKeepsTheLawToTheLowWords) {
  expect_the_law<float>(0);
  expect_the_law<float>(6);
}

TEST(GrowingContact, WithoutGrowthIsTheLawOfRestitutionToTheBit) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 1'000; ++i) {
    const ContactCase<double> c = test::random_contact<double>(random, 3, false);
    const DoubleWord2<double> u = c.b.velocity - c.a.velocity;
    const DoubleWord2<double> w = velocity_of_growing_surfaces<double>(c.contact, u, {0, 0});
    EXPECT_EQ(w.x.hi, u.x.hi);
    EXPECT_EQ(w.x.lo, u.x.lo);
    EXPECT_EQ(w.y.hi, u.y.hi);
    EXPECT_EQ(w.y.lo, u.y.lo);
  }
}

}  // namespace
}  // namespace stoss::engine

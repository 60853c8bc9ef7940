// SPDX-License-Identifier: Apache-2.0
// The rough law against 400 bits: momentum and angular momentum are kept, surfaces that stick
// rebound by beta, those that slide obey Coulomb, and energy never grows.
#include "contact_law/rough.hpp"

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
RoughBody<S> rough_body(const ContactBody<S>& body) {
  return {body.mass, body.radius, body.is_fixed, body.spin};
}

template <class S>
ContactCase<S> after(ContactCase<S> c, const Roughness<S>& rough) {
  const DoubleWord2<S> velocity = c.b.velocity - c.a.velocity;
  PairImpulse<S> impulse = restitution_impulse<S>(
      c.contact, velocity, c.a.mass, c.a.is_fixed, c.b.mass, c.b.is_fixed, rough.restitution);
  const SpinChange<S> spins =
      add_rough_impulse<S>(impulse, c.contact, velocity, rough_body(c.a), rough_body(c.b), rough);
  c.a.velocity = c.a.velocity + impulse.delta_a;
  c.b.velocity = c.b.velocity + impulse.delta_b;
  c.a.spin = c.a.spin + spins.a;
  c.b.spin = c.b.spin + spins.b;
  return c;
}

template <class S>
Roughness<S> random_roughness(Random& random) {
  const double beta = random.one_in(6) ? 1.0 : random.uniform(-1, 1);
  const double mu = random.one_in(3) ? 10.0 : random.uniform(0, 1);
  return {static_cast<S>(random.uniform(0, 1)), static_cast<S>(beta), static_cast<S>(mu)};
}

/// With the centres as far apart as touching disks are: a rounded contact vector is not quite.
template <class S>
Real angular_momentum(const ContactCase<S>& c) {
  Real2 p = exact(c.contact);
  const Real stretch = (Real(c.a.radius) + Real(c.b.radius)) / sqrt(dot(p, p));
  p = {p.x * stretch, p.y * stretch};
  return c.a.angular_momentum({Real(0), Real(0)}) + c.b.angular_momentum(p);
}

template <class S>
void expect_the_law(double mass_decades) {
  Random random(test::seed_of_run());
  constexpr S kUnit = std::numeric_limits<S>::epsilon() / 2;
  const Real unit2 = Real(kUnit) * Real(kUnit);
  Real drift(0);
  Real gain(0);
  Real rebound(0);
  int stuck = 0;
  int slid = 0;
  for (int i = 0; i < 20'000; ++i) {
    ContactCase<S> c = test::random_contact<S>(random, mass_decades, random.one_in(4));
    if (c.b.is_fixed) {  // its motion would do work
      c.b.velocity = {};
      c.b.spin = {};
    }
    if (c.closing() >= 0) continue;
    const Roughness<S> rough = random_roughness<S>(random);
    const ContactCase<S> d = after(c, rough);
    const Real energy = c.a.energy() + c.b.energy();
    gain = std::max(gain, Real((d.a.energy() + d.b.energy() - energy) / energy));

    const Real speed = sqrt(dot(exact(c.contact), exact(c.contact))) * 6;
    const Real stick = -Real(rough.tangential_restitution) * c.surface();
    const Real change = abs(d.surface() - c.surface()) / 3;
    const Real limit = Real(rough.friction) * (1 + Real(rough.restitution)) * -c.closing();
    if (abs(d.surface() - stick) <= 64 * unit2 * speed) {
      ++stuck;
      EXPECT_LE(change, limit * (1 + 64 * unit2));
    } else {
      ++slid;
      rebound = std::max(rebound, Real(abs(change - limit) / speed));
      EXPECT_LT(abs(d.surface() - c.surface()), abs(stick - c.surface())) << "less than sticking";
    }
    if (c.b.is_fixed) continue;
    const Real size = Real(c.a.mass) + Real(c.b.mass);
    drift = std::max(drift, Real(abs(angular_momentum(d) - angular_momentum(c)) / (16 * size)));
    drift = std::max(
        drift,
        Real(abs(d.a.momentum().x + d.b.momentum().x - c.a.momentum().x - c.b.momentum().x) /
             size));
  }
  EXPECT_GT(stuck, 2'000);
  EXPECT_GT(slid, 2'000);
  EXPECT_LE(drift, 64 * unit2);
  EXPECT_LE(gain, 64 * unit2);
  EXPECT_LE(rebound, 64 * unit2);
  const auto in_units = [&](const Real& x) {
    return Real(x / unit2).template convert_to<double>();
  };
  std::printf("rough, masses 10^+-%g: drift %.1f, gain %.1f, Coulomb %.1f u^2; %d stuck, %d slid\n",
              mass_decades,
              in_units(drift),
              in_units(gain),
              in_units(rebound),
              stuck,
              slid);
}

TEST(Rough, DoubleKeepsTheLawToTheLowWords) {
  expect_the_law<double>(0);
  expect_the_law<double>(8);
}
TEST(Rough, FloatKeepsTheLawToTheLowWords) { expect_the_law<float>(0); }

TEST(Rough, PerfectlyRoughElasticDisksKeepTheirEnergy) {
  Random random(test::seed_of_run());
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  for (int i = 0; i < 5'000; ++i) {
    const auto c = test::random_contact<double>(random, 2, false);
    const auto d = after(c, {1, 1, 1e9});
    const Real energy = c.a.energy() + c.b.energy();
    EXPECT_LE(abs(d.a.energy() + d.b.energy() - energy), energy * 64 * Real(kUnit) * Real(kUnit));
  }
}

TEST(Rough, SmoothDisksTurnAsBefore) {
  Random random(test::seed_of_run());
  for (const Roughness<double>& smooth : {Roughness<double>{0.5, -1, 1}, {0.5, 1, 0}}) {
    const auto c = test::random_contact<double>(random, 0, false);
    const auto d = after(c, smooth);
    EXPECT_EQ(d.a.spin.hi, c.a.spin.hi);
    EXPECT_EQ(d.b.spin.hi, c.b.spin.hi);
  }
}

}  // namespace
}  // namespace stoss::engine

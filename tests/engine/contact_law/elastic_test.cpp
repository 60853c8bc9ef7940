// SPDX-License-Identifier: Apache-2.0
// The elastic contact law against 400 bits: conservation of energy and momentum, its bias over many
// contacts, and bodies so heavy that single-word velocities would not feel the hits.
#include "contact_law/elastic.hpp"

#include "contact_time/disk_disk.hpp"
#include "support/bias.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>

namespace stoss::engine {
namespace {

using test::Random;
using test::Real;
using test::Real2;

template <class S>
struct Body {
  S mass{};
  bool fixed = false;
  DoubleWord2<S> velocity;
};

template <class S>
PairImpulse<S> collide(Body<S>& a, Body<S>& b, const DoubleWord2<S>& contact) {
  const PairImpulse<S> result =
      elastic_impulse(contact, b.velocity - a.velocity, a.mass, a.fixed, b.mass, b.fixed);
  a.velocity = a.velocity + result.delta_a;
  b.velocity = b.velocity + result.delta_b;
  return result;
}

template <class S>
DoubleWord2<S> single(double x, double y) {
  return {{static_cast<S>(x), S(0)}, {static_cast<S>(y), S(0)}};
}

template <class S>
Real energy(const Body<S>& a) {
  const Real2 v = test::exact(a.velocity);
  return Real(a.mass) * test::dot(v, v) / 2;
}

template <class S>
Real2 momentum(const Body<S>& a) {
  const Real2 v = test::exact(a.velocity);
  return {Real(a.mass) * v.x, Real(a.mass) * v.y};
}

template <class S>
DoubleWord2<S> random_velocity(Random& random) {
  const double x = random.uniform(-1, 1);
  return single<S>(x, random.uniform(-1, 1));
}

/// A contact at random, approaching.
template <class S>
DoubleWord2<S> approaching_contact(const Body<S>& a, const Body<S>& b, Random& random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double length = random.uniform(0.5, 2);
  const DoubleWord2<S> p = single<S>(length * std::cos(angle), length * std::sin(angle));
  return sign(dot(p, b.velocity - a.velocity)) < 0 ? p : -p;
}

template <class S>
Real unit2() {
  const Real u = Real(std::numeric_limits<S>::epsilon()) / 2;
  return u * u;
}

/// What one contact does to the energy of the two, relative to it and in units of u^2.
template <class S>
double energy_error(Body<S>& a, Body<S>& b, const DoubleWord2<S>& contact) {
  const Real before = energy(a) + energy(b);
  collide(a, b, contact);
  const Real gained = (energy(a) + energy(b) - before) / before / unit2<S>();
  return gained.template convert_to<double>();
}

/// A number of two full words, as moved bodies have them.
template <class S>
DoubleWord<S> fine(double x, Random& random) {
  const S hi = static_cast<S>(x);
  const S half_ulp = std::numeric_limits<S>::epsilon() * hi / 2;
  return quick_two_sum(hi, static_cast<S>(random.uniform(-1, 1)) * half_ulp);
}

template <class S>
DoubleWord2<S> fine_velocity(Random& random) {
  const double x = random.uniform(-1, 1);
  const double y = random.uniform(-1, 1);
  const DoubleWord<S> fine_x = fine<S>(x, random);
  return {fine_x, fine<S>(y, random)};
}

/// The same contact seen with a second word.
template <class S>
DoubleWord2<S> fine_contact(const DoubleWord2<S>& p, Random& random) {
  const DoubleWord<S> x = fine<S>(static_cast<double>(p.x.hi), random);
  return {x, fine<S>(static_cast<double>(p.y.hi), random)};
}

/// Relative errors of single contacts between bodies of any mass ratio, in units of u^2.
template <class S>
void expect_conservation(double mass_decades) {
  Random random(test::seed_of_run());
  const std::uint64_t cases = test::cases_per_family(60000);
  test::Steps steps;
  double momentum_max = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const S mass_a = static_cast<S>(random.decades(-mass_decades, mass_decades));
    const S mass_b = static_cast<S>(random.decades(-mass_decades, mass_decades));
    Body<S> a{mass_a, false, fine_velocity<S>(random)};
    Body<S> b{mass_b, false, fine_velocity<S>(random)};
    const Real2 pa = momentum(a), pb = momentum(b);
    const DoubleWord2<S> contact = approaching_contact(a, b, random);
    steps.add(energy_error(a, b, fine_contact(contact, random)));
    const Real scale = abs(pa.x) + abs(pa.y) + abs(pb.x) + abs(pb.y);
    const Real2 qa = momentum(a), qb = momentum(b);
    const Real lost = abs(qa.x + qb.x - pa.x - pb.x) + abs(qa.y + qb.y - pa.y - pb.y);
    const Real error = lost / scale / unit2<S>();
    momentum_max = std::max(momentum_max, error.template convert_to<double>());
  }
  std::printf(
      "%zu-byte, masses 1e+-%g: momentum worst %.3g u^2\n", sizeof(S), mass_decades, momentum_max);
  test::expect_no_bias("energy of a contact, u^2", steps);
  EXPECT_LE(steps.worst(), 20);
  EXPECT_LE(momentum_max, 4);
}

TEST(Elastic, SingleContactsConserveEnergyAndMomentumInDouble) {
  expect_conservation<double>(0);
  expect_conservation<double>(15);
}

TEST(Elastic, SingleContactsConserveEnergyAndMomentumInFloat) {
  expect_conservation<float>(0);
  expect_conservation<float>(6);
}

// What is the same in all contacts with one wall is its normal, in all of one pair its masses. An
// error that they make to one side would add up however the rest is rounded.
template <class S>
void expect_no_wall_with_a_bias() {
  Random random(test::seed_of_run());
  test::GroupsOfSteps walls;
  for (int i = 0; i < 300; ++i) {
    const DoubleWord2<S> normal = fine_velocity<S>(random);
    Body<S> wall{S(1), true, single<S>(0, 0)};
    test::Steps steps;
    for (int k = 0; k < 1000; ++k) {
      Body<S> disk{S(1), false, fine_velocity<S>(random)};
      if (sign(dot(normal, disk.velocity)) > 0) disk.velocity = -disk.velocity;
      const Real before = energy(disk);
      collide(wall, disk, normal);
      const Real gained = (energy(disk) / before - 1) / unit2<S>();
      steps.add(gained.template convert_to<double>());
    }
    walls.add(steps);
  }
  walls.expect_no_bias("energy of contacts with one wall");
}

TEST(Elastic, NoWallAddsEnergyOfItsOwn) {
  expect_no_wall_with_a_bias<double>();
  expect_no_wall_with_a_bias<float>();
}

template <class S>
void expect_no_pair_with_a_bias() {
  Random random(test::seed_of_run());
  test::GroupsOfSteps pairs;
  for (int i = 0; i < 300; ++i) {
    const S mass_a = static_cast<S>(random.decades(-1, 1));
    const S mass_b = static_cast<S>(random.decades(-1, 1));
    test::Steps steps;
    for (int k = 0; k < 1000; ++k) {
      Body<S> a{mass_a, false, fine_velocity<S>(random)};
      Body<S> b{mass_b, false, fine_velocity<S>(random)};
      // Along one line, as in a row of disks: p . p is the same each time, too.
      const DoubleWord2<S> along = single<S>(1, 0.75);
      if (sign(dot(along, b.velocity - a.velocity)) >= 0) std::swap(a.velocity, b.velocity);
      steps.add(energy_error(a, b, along));
    }
    pairs.add(steps);
  }
  pairs.expect_no_bias("energy of contacts of one pair along one line");
}

TEST(Elastic, NoPairOfMassesAddsEnergyOfItsOwn) {
  expect_no_pair_with_a_bias<double>();
  expect_no_pair_with_a_bias<float>();
}

/// Relative energy error of a pair after `contacts` contacts along random normals, in u^2.
template <class S>
double drift(std::uint64_t contacts, std::uint64_t seed) {
  Random random(seed);
  Body<S> a{S(1), false, single<S>(0.5, 0.25)}, b{S(0.7), false, single<S>(-0.75, 0.125)};
  const Real before = energy(a) + energy(b);
  for (std::uint64_t i = 0; i < contacts; ++i) collide(a, b, approaching_contact(a, b, random));
  const Real error = (energy(a) + energy(b) - before) / before / unit2<S>();
  return error.template convert_to<double>();
}

// Many contacts of one pair with unequal masses: a random walk, whose step is 1.3 u^2 and whose
// mean over the walks is within four standard errors of zero. A bias of 0.01 u^2 a contact would be
// 13 of them.
template <class S>
void expect_random_walk() {
  const std::uint64_t seed = test::seed_of_run();
  constexpr int kWalks = 24;
  constexpr std::uint64_t kContacts = 100000;
  test::Steps walks;
  for (std::uint64_t i = 0; i < kWalks; ++i) walks.add(drift<S>(kContacts, seed + i));
  test::expect_no_bias("energy after 1e5 contacts, u^2", walks);
  EXPECT_LE(walks.size(), 2 * std::sqrt(static_cast<double>(kContacts)));
}

TEST(Elastic, EnergyOfManyContactsWalksAtRandomInDouble) { expect_random_walk<double>(); }

TEST(Elastic, EnergyOfManyContactsWalksAtRandomInFloat) { expect_random_walk<float>(); }

// A unit mass at speed -1 hits M, which flies at 1, a million times over:
// V_n = (V_0 + 1) (1 - 2 / (1 + M))^n - 1. A single-word velocity loses 0.08 % at M = 1e15 and
// everything at 1e17.
TEST(Elastic, HeavyBodyFeelsAMillionLightHits) {
  constexpr unsigned kHits = 1000000;
  for (const double mass : {1e15, 1e17, 1e25}) {
    Body<double> heavy{mass, false, single<double>(1, 0)};
    for (unsigned i = 0; i < kHits; ++i) {
      Body<double> light{1, false, single<double>(-1, 0)};
      collide(heavy, light, single<double>(1, 0));
    }
    const Real expected = 2 * pow(1 - Real(2) / (1 + Real(mass)), kHits) - 2;
    const Real change = test::exact(heavy.velocity.x) - 1;
    std::printf("M = %g: change %.12g, relative error %.2g\n",
                mass,
                change.convert_to<double>(),
                Real(change / expected - 1).convert_to<double>());
    EXPECT_LE(abs(change / expected - 1), mass < 1e20 ? 1e-9 : 1e-3);
  }
}

/// How often the law is applied to a touching pair that slides past at a closing speed of
/// `closing`, in a frame that moves at `carrier` times their relative speed, before the kernel sees
/// no contact.
template <class S>
int applications(Random& random, double carrier, double closing) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const DoubleWord2<S> p = single<S>(std::cos(angle), std::sin(angle));
  const DoubleWord2<S> tangent{-p.y, p.x};
  const S low = std::numeric_limits<S>::epsilon() / 4;
  Body<S> a{S(1), false, random_velocity<S>(random) * static_cast<S>(carrier)};
  a.velocity = a.velocity + a.velocity * S(low * static_cast<S>(random.uniform(-1, 1)));
  Body<S> b{S(3), false, a.velocity + tangent - p * static_cast<S>(closing)};
  const DoubleWord<S> reach{S(1) + S(1e-6), S(0)};
  for (int count = 0; count < 100; ++count) {
    const RelativeMotion<S> motion{
        p, b.velocity - a.velocity, velocity_grain(a.velocity, b.velocity)};
    if (!disk_disk_contact(motion, reach)) return count;
    collide(a, b, p);
  }
  return 100;
}

// A contact must not repeat at one instant for ever, as it would if it closed in more slowly than
// the velocities can be changed: what the impulse cannot resolve is no contact.
template <class S>
void expect_no_repetition() {
  Random random(test::seed_of_run());
  const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
  int most = 0;
  for (const double carrier : {0.0, 1.0, 1e3, 1e6}) {
    for (int i = 0; i < 20000; ++i) {
      const double closing = eps * random.decades(std::log10(eps) - 3, 0);
      most = std::max(most, applications<S>(random, carrier, closing));
    }
  }
  EXPECT_LE(most, 1);
}

TEST(Elastic, ContactIsResolvedAtOnceHoweverSlowlyItClosesIn) {
  expect_no_repetition<double>();
  expect_no_repetition<float>();
  expect_no_repetition<long double>();
}

TEST(Elastic, EqualMassesHeadOnExchangeVelocities) {
  Body<double> a{2, false, single<double>(3, 1)}, b{2, false, single<double>(-1, 5)};
  const PairImpulse<double> result = collide(a, b, single<double>(0.5, 0));
  EXPECT_EQ(a.velocity.x.hi, -1.0);
  EXPECT_EQ(b.velocity.x.hi, 3.0);
  EXPECT_EQ(a.velocity.y.hi, 1.0);
  EXPECT_EQ(b.velocity.y.hi, 5.0);
  EXPECT_EQ(result.impulse, 8.0);
  EXPECT_EQ(result.approach_speed, 4.0);
  EXPECT_EQ(result.normal_x, 1.0);
  EXPECT_EQ(result.normal_y, 0.0);
}

TEST(Elastic, FixedBodyReflectsTheOtherAndKeepsItsVelocity) {
  for (const bool a_fixed : {true, false}) {
    Body<double> a{a_fixed ? 1e-300 : 3, a_fixed, single<double>(0, 0)};
    Body<double> b{a_fixed ? 3 : 1e300, !a_fixed, single<double>(0, 0)};
    Body<double>& moving = a_fixed ? b : a;
    const Body<double>& fixed = a_fixed ? a : b;
    moving.velocity = single<double>(a_fixed ? -3 : 3, a_fixed ? -4 : 4);
    const PairImpulse<double> result = collide(a, b, single<double>(0.75, 1));  // straight on
    EXPECT_EQ(moving.velocity.x.hi, a_fixed ? 3.0 : -3.0);
    EXPECT_EQ(moving.velocity.y.hi, a_fixed ? 4.0 : -4.0);
    EXPECT_EQ(fixed.velocity.x.hi, 0.0);
    EXPECT_EQ(result.impulse, 30.0);
  }
}

TEST(Elastic, MovingWallThrowsBackAtTwiceItsSpeed) {
  Body<double> piston{1, true, single<double>(2, 0)}, disk{1, false, single<double>(-5, 1)};
  collide(piston, disk, single<double>(1, 0));
  EXPECT_EQ(disk.velocity.x.hi, 9.0);  // 2 V - v
  EXPECT_EQ(disk.velocity.y.hi, 1.0);
  EXPECT_EQ(piston.velocity.x.hi, 2.0);
}

TEST(Elastic, BodiesThatDoNotApproachGetNothing) {
  for (const double vx : {0.0, 1.0}) {
    const PairImpulse<double> result =
        elastic_impulse(single<double>(1, 0), single<double>(vx, 3), 1.0, false, 1.0, false);
    EXPECT_EQ(result.impulse, 0.0);
    EXPECT_EQ(result.approach_speed, 0.0);
    EXPECT_EQ(result.delta_a.x.hi, 0.0);
    EXPECT_EQ(result.delta_b.y.hi, 0.0);
    EXPECT_EQ(result.normal_x, 1.0);
  }
}

TEST(Elastic, TwoFixedBodiesGetNothing) {
  const PairImpulse<double> result =
      elastic_impulse(single<double>(1, 0), single<double>(-1, 0), 1.0, true, 1.0, true);
  EXPECT_EQ(result.impulse, 0.0);
  EXPECT_EQ(result.delta_a.x.hi, 0.0);
  EXPECT_EQ(result.delta_b.x.hi, 0.0);
}

TEST(Elastic, AnyLengthOfTheContactVectorAndAnySpeedWillDo) {
  for (const double length : {1e-300, 1e-160, 1.0, 1e160, 1e300}) {
    for (const double speed : {1e-300, 1.0, 1e300}) {
      const PairImpulse<double> result = elastic_impulse(
          single<double>(0, length), single<double>(speed, -speed), 1.0, false, 1.0, false);
      EXPECT_EQ(result.delta_b.y.hi, speed) << length << " " << speed;
      EXPECT_EQ(result.delta_b.x.hi, 0.0);
      EXPECT_DOUBLE_EQ(result.approach_speed, speed);
      EXPECT_EQ(result.normal_y, 1.0);
    }
  }
}

TEST(Elastic, WideScalarConservesEnergyToItsOwnPrecision) {
  Body<long double> a{3.0L, false, single<long double>(1, 2)};
  Body<long double> b{5.0L, false, single<long double>(-2, 1)};
  const Real before = energy(a) + energy(b);
  collide(a, b, single<long double>(0.6, 0.3));
  EXPECT_LE(abs((energy(a) + energy(b)) / before - 1), 1e-18);
  EXPECT_EQ(a.velocity.x.lo, 0.0L);
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// A body is what was written of it, however its parts are kept.
#include "bodies.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace stoss::engine {
namespace {

template <class Kept>
class Kinds : public ::testing::Test {};
using AllKinds =
    ::testing::Types<Bodies<double, PlainLaws>, Bodies<float, PlainLaws>, Bodies<double, DragLaws>>;
TYPED_TEST_SUITE(Kinds, AllKinds);

template <class S>
DoubleWord2<S> some_vector(test::Random& random) {
  const auto some = [&random] {
    return two_sum(static_cast<S>(random.uniform(-1, 1)),
                   static_cast<S>(random.uniform(-1, 1) * 1e-20));
  };
  const DoubleWord<S> x = some();
  return {x, some()};
}

template <class S>
bool are_same(const DoubleWord2<S>& a, const DoubleWord2<S>& b) {
  return a.x.hi == b.x.hi && a.x.lo == b.x.lo && a.y.hi == b.y.hi && a.y.lo == b.y.lo;
}

TYPED_TEST(Kinds, GiveBackWhatWasWritten) {
  TypeParam bodies;
  using S = decltype(bodies.at(0).radius());
  test::Random random(test::seed_of_run());
  for (Slot slot = 0; slot < 100; ++slot) {
    bodies.add();
    auto&& body = bodies.at(slot);
    body.id = static_cast<Id>(slot + 1);
    body.type = static_cast<BodyType>(slot % 4);
    const DoubleWord2<S> position = some_vector<S>(random), velocity = some_vector<S>(random);
    const auto radius = static_cast<S>(random.decades(-3, 3));
    body.set_since({slot, 7});
    body.set_position(position);
    body.set_velocity(velocity);
    if (body.is_wall()) {
      body.set_wall(slot);
    } else {
      body.set_radius(radius);
      body.set_mass(radius);
    }
    const TypeParam& kept = bodies;
    const auto& again = kept.at(slot);
    EXPECT_EQ(again.id, static_cast<Id>(slot + 1));
    EXPECT_EQ(again.since(), (Instant{slot, 7}));
    EXPECT_TRUE(are_same(again.position(), position));
    EXPECT_TRUE(are_same(again.velocity(), velocity));
    EXPECT_TRUE(are_same(again.motion().position, position));
    EXPECT_TRUE(are_same(again.motion().velocity, velocity));
    EXPECT_EQ(again.motion().since, again.since());
    if (again.is_wall()) {
      EXPECT_EQ(again.wall(), slot);
      EXPECT_EQ(again.radius(), S(0));
    } else {
      EXPECT_EQ(again.radius(), radius);
      EXPECT_EQ(again.mass(), radius);
    }
  }
}

TYPED_TEST(Kinds, KeepTheirCountOfChangesWhenTheyAreCleared) {
  TypeParam bodies;
  bodies.add();
  bodies.at(0).id = 5;
  bodies.at(0).changes = 12;
  bodies.clear(0);
  EXPECT_EQ(bodies.at(0).id, kNoId);
  EXPECT_EQ(bodies.at(0).changes, 12U);
  EXPECT_FALSE(is_like(bodies.sight(0)));
}

// Only they hold a pair by sight.
TEST(PlainBodies, LookLikeTheRestIfTheyAreDynamic) {
  Bodies<double, PlainLaws> bodies;
  for (Slot slot = 0; slot < 4; ++slot) {
    bodies.add();
    bodies.at(slot).type = static_cast<BodyType>(slot);
    if (!bodies.at(slot).is_wall()) bodies.at(slot).set_radius(0.5);
    EXPECT_EQ(is_like(bodies.sight(slot)), bodies.at(slot).is_dynamic());
  }
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// A plain world pays for no effect: there is no setting to branch on and no byte in a body.
#include "basic_world.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace stoss::engine {
namespace {

/// What a body was before there were effects.
template <class S>
struct alignas(64) BareBody {
  Motion<S> motion;
  S radius{};
  S mass{};
  Id id = kNoId;
  std::uint32_t changes = 0;
  BodyType type = BodyType::Dynamic;
  std::int32_t wall = -1;
};

template <class S>
constexpr bool kHoldsNothingMore =
    std::is_empty_v<PlainLaws::BodyPart<S>>&& std::is_empty_v<PlainLaws::Settings<S>> &&
    sizeof(Body<S, PlainLaws>) == sizeof(BareBody<S>) &&
    sizeof(PlainLaws::Relative<S>) == sizeof(RelativeMotion<S>);

static_assert(kHoldsNothingMore<float>);
static_assert(kHoldsNothingMore<double>);
static_assert(kHoldsNothingMore<long double>);
static_assert(PlainLaws::kPlain && !PlainLaws::kCurved);

TEST(PlainWorld, HoldsAsManyBytesABodyAsBeforeThereWereEffects) {
  EXPECT_EQ(laws_for(Effects{}), LawsKind::Plain);
  EXPECT_EQ(sizeof(Body<double, PlainLaws>), sizeof(BareBody<double>));
  // In canonical bytes: id, type, instant, four double words, radius, mass, angle, spin.
  const auto bytes_of = [](std::size_t disks) {
    World world;
    std::vector<DiskSpec> specs;
    for (std::size_t i = 0; i < disks; ++i) {
      specs.push_back(test::disk(kNoId, {2.5 * static_cast<double>(i), 0}, {1, 0}, 1));
    }
    test::must_spawn(world, specs);
    return world.serialise().size();
  };
  EXPECT_EQ(bytes_of(8) - bytes_of(7), (2 + 2 + 2 * 4 + 2 + 2) * sizeof(double));
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// What physics keeps, over random worlds: energy, momentum, walls that hold, order in the log, and
// the way back. Environment: STOSS_SEED, STOSS_STORIES.

#include "support/story.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::Result;
using test::Story;
using test::StoryTeller;

class Conservation : public testing::Test {
 protected:
  /// Plays stories and calls check(story, result) on each.
  template <class Check>
  static void for_each_played(Check&& check) {
    const std::uint64_t count = test::environment_number("STOSS_STORIES", 300);
    for (std::uint64_t i = 0; i < count; ++i) {
      StoryTeller teller(test::seed_of_run() + 1'000'000 + i);
      Story story;
      for (std::uint64_t k = 0; k <= i % StoryTeller::kKinds; ++k) story = teller.any();
      SCOPED_TRACE("story " + std::to_string(i) + " (" + story.name + ")");
      const Result result = test::play(story);
      if (result.endless) continue;
      check(story, result);
      if (HasFailure()) return;
    }
  }
};

World beginning_of(const Story& story) {
  World world(WorldOptions{.start = {}, .period = story.period});
  test::must_spawn(world, story.disks, story.walls);
  return world;
}

// Looked at when it is most likely: at the instants of contacts (within 1e-16 s of them).
TEST_F(Conservation, NothingOverlapsByMoreThanRounding) {
  double deepest = 0;
  for_each_played([&](const Story& story, const Result& result) {
    test::Run run;
    for (const Collision& c : result.collisions) {
      if (run.ticks.size() < 40) run.ticks.push_back(seconds_between(Instant{}, c.instant));
    }
    run.at_each_tick = [&](const World& world) {
      deepest = std::max(deepest, test::deepest_overlap(world));
    };
    test::play(story, run);
    EXPECT_LT(deepest, 1e-12);
  });
  std::printf("deepest overlap: %.3g of the reach\n", deepest);
}

TEST_F(Conservation, EnergyDriftsByRoundingAlone) {
  double worst = 0;
  for_each_played([&](const Story& story, const Result& result) {
    if (!story.conserves_energy) return;
    const double before = beginning_of(story).conserved().kinetic_energy;
    const double after = result.world.conserved().kinetic_energy;
    if (before == 0) {
      EXPECT_EQ(after, 0);
      return;
    }
    worst = std::max(worst, std::abs(after / before - 1));
    EXPECT_LT(worst, 4e-16);
  });
  std::printf("largest energy drift: %.3g\n", worst);
}

TEST_F(Conservation, MomentumDriftsByRoundingAlone) {
  double worst = 0;
  for_each_played([&](const Story& story, const Result& result) {
    if (!story.conserves_momentum) return;
    double scale = 0;
    for (const DiskSpec& d : story.disks) scale += d.mass * d.velocity.norm();
    const Vector2 before = beginning_of(story).conserved().momentum;
    worst = std::max(worst, (result.world.conserved().momentum - before).norm() / scale);
    EXPECT_LT(worst, 4e-16);
  });
  std::printf("largest momentum drift: %.3g\n", worst);
}

TEST_F(Conservation, NobodyLeavesAClosedBox) {
  for_each_played([&](const Story& story, const Result& result) {
    if (!story.is_closed) return;
    result.world.for_each_disk([&](const BodyState& body) {
      if (body.kind != BodyKind::Dynamic) return;
      EXPECT_GE((body.position - story.low).minCoeff(), body.radius * (1 - 1e-12)) << body.id;
      EXPECT_GE((story.high - body.position).minCoeff(), body.radius * (1 - 1e-12)) << body.id;
    });
  });
}

TEST_F(Conservation, TheLogIsInOrderAndEveryContactIsOne) {
  for_each_played([&](const Story&, const Result& result) {
    Collision last;
    for (const Collision& c : result.collisions) {
      SCOPED_TRACE(test::describe(c));
      EXPECT_EQ(c.sequence, last.sequence + 1);
      EXPECT_GE(c.instant, last.instant);
      EXPECT_GE(c.approach_speed, 0);  // 0: a tangent contact that rounding made
      EXPECT_EQ(c.impulse > 0, c.approach_speed > 0);
      EXPECT_NEAR(c.normal.norm(), 1, 4e-16);
      EXPECT_GE((c.velocity_b - c.velocity_a).dot(c.normal),
                -1e-14 * (c.velocity_a.norm() + c.velocity_b.norm()));  // they separate
      EXPECT_NE(c.a, c.b);
      EXPECT_TRUE(c.kind != ContactKind::DiskDisk || c.a < c.b);
      last = c;
    }
  });
}

TEST_F(Conservation, NoMotionIsFromTheFutureAndNoneIsWrittenWithoutAnEvent) {
  for_each_played([&](const Story&, const Result& result) {
    std::map<Id, Instant> last;
    for (const Collision& c : result.collisions) last[c.a] = last[c.b] = c.instant;
    for (const Id id : result.world.ids()) {
      const Instant since = result.world.motion(id).value().since;
      EXPECT_LE(since, result.world.now());
      const BodyRecord body = result.world.body(id).value();
      if (!body.is_wall && body.kind == BodyKind::Dynamic && last.contains(id)) {
        EXPECT_GE(since, last[id]);  // later than the contact only by a command
      }
    }
  });
}

/// Turns every velocity round.
void reverse(World& world) {
  std::vector<VectorFor> velocities;
  world.for_each_disk([&](const BodyState& body) {
    if (body.kind != BodyKind::Static) velocities.push_back({body.id, -body.velocity});
  });
  ASSERT_TRUE(world.set_velocity(velocities).ok());
}

// Chaos costs about 0.7 digits a collision and disk (area fraction 0.2); velocities are rounded to
// one word as they are turned round, so the way back starts 1e-16 off.
TEST(TimeReversal, AGasFindsItsWayBack) {
  test::Random random(test::seed_of_run());
  World world;
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 100; ++i) {
    disks.push_back(test::disk(static_cast<Id>(i + 1),
                               {2 * (i % 10) + 1.0, 2 * (i / 10) + 1.0},
                               {random.uniform(-1.7, 1.7), random.uniform(-1.7, 1.7)},
                               0.5));
  }
  test::must_spawn(world, disks, test::box(1000, {0, 0}, {20, 20}));
  std::uint64_t collisions = 0;
  while (collisions < 5 * 100) collisions += test::run_for(world, 0.25).size();  // 10 per disk
  const double elapsed = seconds_between(Instant{}, world.now());
  reverse(world);
  test::run_for(world, elapsed);
  double worst = 0;
  for (const DiskSpec& d : disks) {
    worst = std::max(worst, (test::state(world, d.id).position - d.position).norm());
  }
  std::printf("after %llu collisions and back: %.3g m off\n",
              static_cast<unsigned long long>(collisions),
              worst);
  EXPECT_LT(worst, 1e-6);
}

}  // namespace
}  // namespace stoss::engine

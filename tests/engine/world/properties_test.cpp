// SPDX-License-Identifier: Apache-2.0
// The one rule as properties of random worlds: a trajectory's bits depend on physical events alone.
// Environment: STOSS_SEED, STOSS_STORIES (stories per property).

#include "support/story.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::Result;
using test::Run;
using test::Story;
using test::StoryTeller;
using Break = test::Run::Break;

std::uint64_t stories() { return test::environment_number("STOSS_STORIES", 300); }

/// Calls check(story, teller) for each of many stories.
template <class Check>
void for_each_story(Check&& check) {
  std::uint64_t collisions = 0;
  std::uint64_t endless = 0;
  for (std::uint64_t i = 0; i < stories(); ++i) {
    StoryTeller teller(test::seed_of_run() + i);
    Story story;
    for (std::uint64_t k = 0; k <= i % StoryTeller::kKinds; ++k) story = teller.any();
    SCOPED_TRACE("story " + std::to_string(i) + " (" + story.name + ")");
    if (test::play(story).endless) {
      ++endless;
      continue;
    }
    collisions += check(story, teller).collisions.size();
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(collisions, 10 * stories());  // they are stories, not still lives
  EXPECT_LE(endless, 1 + stories() / 50);
}

void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(test::difference(a.collisions, b.collisions), "");
  EXPECT_EQ(a.codes, b.codes);
  EXPECT_EQ(test::fingerprint(a.world), test::fingerprint(b.world));
}

TEST(Properties, NeighboursAndAllPairsGiveTheSameBytes) {
  for_each_story([](const Story& story, StoryTeller&) {
    const Result base = test::play(story);
    expect_same(base, test::play(story, {.broad_phase = BroadPhaseKind::AllPairs}));
    return base;
  });
}

TEST(Properties, NeighboursAndAllPairsGiveTheSameBytesInOtherArithmetics) {
  for_each_story([](const Story& story, StoryTeller&) {
    for (const Arithmetic arithmetic : {Arithmetic::Float, Arithmetic::LongDouble}) {
      const Result base = test::play(story, {.arithmetic = arithmetic});
      if (base.endless) continue;  // in this arithmetic: it stops where events are too many
      expect_same(
          base,
          test::play(story, {.arithmetic = arithmetic, .broad_phase = BroadPhaseKind::AllPairs}));
    }
    return test::play(story);
  });
}

TEST(Properties, OneLeapAndOddTicksGiveTheSameBytes) {
  for_each_story([](const Story& story, StoryTeller& teller) {
    const Result base = test::play(story);
    expect_same(base, test::play(story, {.ticks = teller.odd_ticks(story)}));
    std::vector<double> even;
    for (int i = 1; i / 60.0 < story.length; ++i) even.push_back(i / 60.0);
    expect_same(base, test::play(story, {.ticks = even}));
    return base;
  });
}

TEST(Properties, AForkRunsOnLikeTheOriginal) {
  for_each_story([](const Story& story, StoryTeller& teller) {
    const Result base = test::play(story);
    expect_same(base,
                test::play(story, {.ticks = teller.odd_ticks(story), .at_ticks = Break::Fork}));
    return base;
  });
}

TEST(Properties, ASnapshotRunsOnLikeTheOriginal) {
  for_each_story([](const Story& story, StoryTeller& teller) {
    const Result base = test::play(story);
    const auto ticks = teller.odd_ticks(story);
    expect_same(base, test::play(story, {.ticks = ticks, .at_ticks = Break::Snapshot}));
    expect_same(base, test::play(story, {.ticks = ticks, .at_ticks = Break::OtherBroadPhase}));
    return base;
  });
}

TEST(Properties, SnapshotsRunOnLikeTheOriginalInOtherArithmetics) {
  for_each_story([](const Story& story, StoryTeller& teller) {
    const auto ticks = teller.odd_ticks(story);
    for (const Arithmetic arithmetic : {Arithmetic::Float, Arithmetic::LongDouble}) {
      const Result base = test::play(story, {.arithmetic = arithmetic});
      if (base.endless) continue;
      expect_same(
          base,
          test::play(story,
                     {.arithmetic = arithmetic, .ticks = ticks, .at_ticks = Break::Snapshot}));
    }
    return test::play(story);
  });
}

TEST(Properties, TheAgeOfAWorldShiftsItAndNothingElse) {
  for_each_story([](const Story& story, StoryTeller& teller) {
    const Result young = test::play(story);
    for (const std::int64_t start : {std::int64_t{1} << 40, -(std::int64_t{1} << 40) - 7}) {
      const Result old = test::play(story, {.start = start, .ticks = teller.odd_ticks(story)});
      EXPECT_EQ(test::difference(young.collisions, test::earlier_by(old.collisions, start)), "");
      EXPECT_EQ(young.codes, old.codes);
      EXPECT_EQ(young.world.ids(), old.world.ids());
      young.world.for_each_disk([&](const BodyState& body) {
        EXPECT_EQ(body.position, test::state(old.world, body.id).position);
        EXPECT_EQ(body.velocity, test::state(old.world, body.id).velocity);
      });
    }
    return young;
  });
}

TEST(Properties, TheOrderOfInsertionIsForgotten) {
  for_each_story([](const Story& story, StoryTeller&) {
    const Result base = test::play(story);
    expect_same(base, test::play(story, {.backwards = true}));
    expect_same(base, test::play(story, {.backwards = true, .one_by_one = true}));
    expect_same(base, test::play(story, {.one_by_one = true}));
    return base;
  });
}

/// The story with every length multiplied by `scale`.
Story scaled(Story story, double scale) {
  const auto scale_disk = [=](DiskSpec& d) {
    d.position *= scale;
    d.velocity *= scale;
    d.radius *= scale;
  };
  const auto scale_wall = [=](WallSpec& w) {
    w.start *= scale;
    w.end *= scale;
    w.velocity *= scale;
  };
  story.period *= scale;
  std::for_each(story.disks.begin(), story.disks.end(), scale_disk);
  std::for_each(story.walls.begin(), story.walls.end(), scale_wall);
  for (test::Step& step : story.steps) {
    std::for_each(step.disks.begin(), step.disks.end(), scale_disk);
    std::for_each(step.walls.begin(), step.walls.end(), scale_wall);
    for (VectorFor& v : step.velocities) v.value *= scale;
    for (VectorFor& v : step.impulses) v.value *= scale;
  }
  return story;
}

TEST(Properties, ScaledByAPowerOfTwoAWorldIsTheSameInEveryBit) {
  for_each_story([](const Story& story, StoryTeller&) {
    const Result base = test::play(story);
    for (const double scale : {0x1p-60, 0x1p40}) {
      Result other = test::play(scaled(story, scale));
      for (Collision& c : other.collisions) {
        c.point /= scale;
        c.impulse /= scale;
        c.approach_speed /= scale;
        c.velocity_a /= scale;
        c.velocity_b /= scale;
      }
      EXPECT_EQ(test::difference(base.collisions, other.collisions), "") << "scale " << scale;
    }
    return base;
  });
}

/// The story seen in a mirror: x becomes -x.
Story mirrored(Story story) {
  const auto mirror_disk = [](DiskSpec& d) {
    d.position.x() *= -1;
    d.velocity.x() *= -1;
  };
  const auto mirror_wall = [](WallSpec& w) {
    w.start.x() *= -1;
    w.end.x() *= -1;
    w.velocity.x() *= -1;
  };
  std::for_each(story.disks.begin(), story.disks.end(), mirror_disk);
  std::for_each(story.walls.begin(), story.walls.end(), mirror_wall);
  for (test::Step& step : story.steps) {
    std::for_each(step.disks.begin(), step.disks.end(), mirror_disk);
    std::for_each(step.walls.begin(), step.walls.end(), mirror_wall);
    for (VectorFor& v : step.velocities) v.value.x() *= -1;
    for (VectorFor& v : step.impulses) v.value.x() *= -1;
  }
  return story;
}

TEST(Properties, AMirroredWorldIsTheMirrorImageInEveryBit) {
  const auto plus_zero = [](Vector2& v) { v += Vector2::Zero(); };  // -0 becomes 0
  for_each_story([&](const Story& story, StoryTeller&) {
    Result base = test::play(story);
    Result image = test::play(mirrored(story));
    for (Collision& c : image.collisions) {
      for (Vector2* v : {&c.point, &c.normal, &c.velocity_a, &c.velocity_b}) v->x() *= -1;
    }
    for (auto* collisions : {&base.collisions, &image.collisions}) {
      for (Collision& c : *collisions) {
        if (story.period.x() > 0) c.point.x() = 0;  // shown at x and at period - x
        for (Vector2* v : {&c.point, &c.normal, &c.velocity_a, &c.velocity_b}) plus_zero(*v);
      }
    }
    EXPECT_EQ(test::difference(base.collisions, image.collisions), "");
    return base;
  });
}

}  // namespace
}  // namespace stoss::engine

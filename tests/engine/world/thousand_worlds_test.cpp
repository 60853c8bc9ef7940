// SPDX-License-Identifier: Apache-2.0
// A thousand random worlds, full and busy: what lists, boxes, sights and guesses make of them is
// what all pairs give, to the last bit. Environment: STOSS_SEED, STOSS_WORLDS (how many; with
// STOSS_LONG twenty thousand).

#include "support/story.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace stoss::engine {
namespace {

using test::Result;
using test::Story;

std::uint64_t worlds() {
  const bool is_long = std::getenv("STOSS_LONG") != nullptr;
  return test::environment_number("STOSS_WORLDS", is_long ? 20'000 : 1'000);
}

/// What happened in all worlds together, so that a test of still lives would be seen.
struct Tally {
  std::uint64_t collisions = 0;
  std::uint64_t done = 0;     ///< commands that took effect
  std::uint64_t refused = 0;  ///< and that did not
  std::uint64_t endless = 0;

  void count(const Result& result) {
    collisions += result.collisions.size();
    for (const Code code : result.codes) ++(code == Code::Ok ? done : refused);
  }
};

TEST(ThousandWorlds, NeighboursInTicksGiveTheBytesOfAllPairsInOneLeap) {
  Tally tally;
  for (std::uint64_t i = 0; i < worlds(); ++i) {
    test::StoryTeller teller(test::seed_of_run() + i);
    const Story story = teller.crowd();
    SCOPED_TRACE("world " + std::to_string(i) + " (" + story.name + ")");
    const Result fast = test::play(story, {.ticks = teller.odd_ticks(story)});
    if (fast.endless) {
      ++tally.endless;
      continue;
    }
    const Result slow = test::play(story, {.broad_phase = BroadPhaseKind::AllPairs});
    EXPECT_EQ(test::difference(fast.collisions, slow.collisions), "");
    EXPECT_EQ(fast.codes, slow.codes);
    EXPECT_EQ(test::fingerprint(fast.world), test::fingerprint(slow.world));
    tally.count(fast);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(tally.collisions, 50 * worlds());
  EXPECT_GT(tally.done, 5 * worlds());
  EXPECT_GT(tally.refused, worlds() / 2);
  EXPECT_LE(tally.endless, 1 + worlds() / 20);
  std::printf("%llu collisions, %llu commands done, %llu refused, %llu worlds given up\n",
              static_cast<unsigned long long>(tally.collisions),
              static_cast<unsigned long long>(tally.done),
              static_cast<unsigned long long>(tally.refused),
              static_cast<unsigned long long>(tally.endless));
}

}  // namespace
}  // namespace stoss::engine

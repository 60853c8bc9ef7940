// SPDX-License-Identifier: Apache-2.0
// Worlds with more events than time: questions are still answered, and nothing hangs.
#include "fixture.hpp"

namespace stoss::service::testing {
namespace {

using engine::Code;
using engine::Instant;

class Storms : public SimulationTest {
 protected:
  /// A disk between two walls a millionth of a metre from it.
  static translate::SceneBodies pinball(double speed) {
    translate::SceneBodies scene = one_disk();
    scene.disks[0].velocity = {speed, 0};
    scene.walls.push_back({.id = 2, .start = {0.500001, -1}, .end = {0.500001, 1}});
    scene.walls.push_back({.id = 3, .start = {-0.500001, -1}, .end = {-0.500001, 1}});
    scene.wall_names.resize(2);
    return scene;
  }

  static translate::QuerySpec state_of_the_disk() {
    translate::QuerySpec query;
    query.op = idl::wire_value(idl::Ask::kStates);
    query.ids = {1};
    return query;
  }
};

TEST_F(Storms, QuestionsAreAnsweredInTheMiddleOfALongTick) {
  begin({.tick_rate = 1}, pinball(1000));  // some 10^9 events a second
  clock.advance(1);
  simulation->turn();
  EXPECT_EQ(simulation->moment().tick, 0U);
  const Instant reached = simulation->world().now();
  EXPECT_GT(reached, Instant{});
  ask(1, 1, state_of_the_disk());
  simulation->turn();
  const Told all = told();
  ASSERT_EQ(all.answers.size(), 1U);
  EXPECT_EQ(all.answers[0].moment.value_or(Moment{}).at, reached);
  EXPECT_GT(simulation->world().now(), reached) << "and the tick goes on";
}

TEST_F(Storms, CollisionsThatWaitTooLongAreDroppedAndTheGapShows) {
  begin({.tick_rate = 1}, pinball(1000));
  clock.advance(1);
  for (std::uint64_t done = 0; done < 2 * kCollisionsWaitingMax; done += kEventsPerTurn) {
    simulation->turn();
  }
  send(1, 1, make(idl::Op::kPause));
  simulation->stop();
  const Told all = told();
  ASSERT_FALSE(all.ticks.empty());
  const auto& collisions = all.ticks.back().collisions;
  ASSERT_FALSE(collisions.empty());
  EXPECT_LE(collisions.size(), kCollisionsWaitingMax);
  EXPECT_EQ(collisions.front().sequence - 1, all.statuses.back().collisions_lost);
}

TEST_F(Storms, AWorldThatStallsHasFailedButCanBeLookedAtAndReset) {
  begin({.tick_rate = 1}, pinball(1e30));  // a flight is shorter than the grid of time
  clock.advance(1);
  for (int i = 0; i < 1000 && !simulation->failed(); ++i) simulation->turn();
  ASSERT_TRUE(simulation->failed());
  ask(1, 1, state_of_the_disk());
  send(1, 2, spawn_at(5, 5));
  settle();
  Told all = told();
  EXPECT_EQ(all.statuses.back().state, idl::WorldState::kFailed);
  EXPECT_NE(all.statuses.back().reason.find("body"), std::string::npos);
  EXPECT_EQ(all.answers.size(), 1U);
  EXPECT_EQ(all.code_of(1, 2), Code::FailedPrecondition);
  send(1, 3, make(idl::Op::kReset));
  settle();
  all = told();
  EXPECT_EQ(all.code_of(1, 3), Code::Ok);
  EXPECT_FALSE(simulation->failed());
  EXPECT_FALSE(simulation->running()) << "it would fail again at once";
}

TEST_F(Storms, ASlowPublisherGetsFewerRecordsAndMissesNothing) {
  begin({.tick_rate = 1000}, pinball(1e-3));
  run(0.5);  // nobody takes what is told
  EXPECT_LE(outbox.ticks_waiting(), kTicksWaitingMax);
  told();
  run(0.01);
  const Told all = told();
  ASSERT_FALSE(all.ticks.empty());
  EXPECT_EQ(all.ticks.back().moment, simulation->moment());
  std::uint64_t next = 0;
  for (const TickRecord& tick : all.ticks) {
    for (const engine::Collision& collision : tick.collisions) {
      if (next != 0) {
        EXPECT_EQ(collision.sequence, next);
      }
      next = collision.sequence + 1;
    }
  }
  EXPECT_EQ(next, simulation->world().counters().collisions + 1);
}

}  // namespace
}  // namespace stoss::service::testing

// SPDX-License-Identifier: Apache-2.0
// Ticks: their instants, their pace, pauses and runs to an end.
#include "fixture.hpp"

namespace stoss::service::testing {
namespace {

using engine::Code;
using engine::Instant;

class Ticks : public SimulationTest {};

TEST_F(Ticks, InstantsComeFromTheNumberOfTheTickAlone) {
  begin({.tick_rate = 3});
  run(2.0);
  const Told all = told();
  ASSERT_EQ(all.ticks.size(), 6U);
  const auto clock_of = engine::TickClock::from_rate({}, 3).value();
  for (std::size_t i = 0; i < all.ticks.size(); ++i) {
    EXPECT_EQ(all.ticks[i].moment.tick, i + 1);
    EXPECT_EQ(all.ticks[i].moment.at, clock_of.instant_of(i + 1));
  }
  EXPECT_EQ(all.ticks[2].moment.at, (Instant{1, 0}));  // no thirds are summed up
}

TEST_F(Ticks, BeginWhenTheyAreDueAndNotBefore) {
  begin({.tick_rate = 100});
  clock.advance(0.0099);
  settle();
  EXPECT_EQ(simulation->moment().tick, 0U);
  clock.advance(0.0001);
  settle();
  EXPECT_EQ(simulation->moment().tick, 1U);
}

TEST_F(Ticks, SpeedScalesRealTimeOnly) {
  begin({.tick_rate = 10, .speed = 4});
  run(0.5);
  EXPECT_EQ(simulation->moment().tick, 20U);
  EXPECT_EQ(simulation->moment().at, (Instant{2, 0}));
}

TEST_F(Ticks, AreCaughtUpAFewAtATimeAndThenSlip) {
  begin({.tick_rate = 10});
  clock.advance(10);  // a hundred ticks are due
  simulation->turn();
  EXPECT_EQ(simulation->moment().tick, kCatchUpTicks);
  settle();
  EXPECT_EQ(simulation->moment().tick, kCatchUpTicks + 1);  // the one that is due now
  run(1.0);
  const Told all = told();
  EXPECT_EQ(simulation->moment().tick, kCatchUpTicks + 1 + 10);
  EXPECT_GE(all.statuses.back().ticks_slipped, 95U);
  EXPECT_GE(all.statuses.back().ticks_late, kCatchUpTicks);
  for (std::size_t i = 0; i < all.ticks.size(); ++i) {
    EXPECT_EQ(all.ticks[i].moment.tick, i + 1) << "a tick was skipped";
  }
}

TEST_F(Ticks, FlatOutRunsWithoutRealTime) {
  begin({.speed = std::numeric_limits<double>::infinity()});
  send(1, 1, [] {
    auto spec = make(idl::Op::kRunTo);
    spec.target = {1000, 0};
    return spec;
  }());
  for (int i = 0; i < 100'000 && simulation->running(); ++i) {
    simulation->turn();
    clock.advance(0.01);
  }
  EXPECT_EQ(simulation->world().now(), (Instant{1000, 0}));
  EXPECT_EQ(simulation->moment().tick, 60'000U);
}

TEST_F(Ticks, PausedWorldStandsStillAndTakesCommandsAtOnce) {
  begin({.paused = true});
  run(1.0);
  EXPECT_EQ(simulation->world().now(), Instant{});
  send(1, 1, spawn_at(5, 0));
  settle();
  const Told all = told();
  EXPECT_EQ(all.code_of(1, 1), Code::Ok);
  EXPECT_EQ(all.moment_of(1, 1).at, Instant{});
  EXPECT_EQ(simulation->world().disk_count(), 2U);
  ASSERT_EQ(all.ticks.size(), 1U);
  EXPECT_EQ(all.ticks[0].changes.size(), 1U);
}

TEST_F(Ticks, PauseAndResumeLoseNoSimulatedTime) {
  begin({.tick_rate = 10});
  run(1.0);
  send(1, 1, make(idl::Op::kPause));
  run(5.0);
  const std::uint64_t paused_at = simulation->moment().tick;
  EXPECT_EQ(paused_at, 11U);
  send(1, 2, make(idl::Op::kResume));
  run(1.001);  // the first millisecond brings the command
  EXPECT_EQ(simulation->moment().tick, paused_at + 10);
  EXPECT_LE(told().statuses.back().ticks_late, 1U);
}

TEST_F(Ticks, StepRunsSoManyTicksAndPauses) {
  begin({.tick_rate = 10, .paused = true});
  auto step = make(idl::Op::kStep);
  step.count = 3;
  send(1, 1, step);
  run(2.0);
  EXPECT_EQ(simulation->moment().tick, 3U);
  EXPECT_FALSE(simulation->running());
  const Told all = told();
  EXPECT_EQ(all.moment_of(1, 1).tick, 0U) << "the reply tells when the run began";
  EXPECT_EQ(all.ticks.size(), 3U);
}

TEST_F(Ticks, RunToLandsOnTheInstantBetweenTicks) {
  begin({.tick_rate = 10});
  auto run_to = make(idl::Op::kRunTo);
  run_to.target = seconds(0.7321);
  send(1, 1, run_to);
  run(2.0);
  EXPECT_EQ(simulation->world().now(), seconds(0.7321));
  EXPECT_EQ(simulation->moment().tick, 7U);
  EXPECT_FALSE(simulation->running());
  EXPECT_EQ(told().ticks.back().moment.at, seconds(0.7321));
  send(1, 2, make(idl::Op::kResume));
  run(1.0);
  EXPECT_EQ(simulation->world().now().fraction,
            engine::TickClock({}, 10, 1).instant_of(simulation->moment().tick).fraction)
      << "back on the grid of ticks";
}

TEST_F(Ticks, RunForEndsExactlyThatMuchLater) {
  begin({.paused = true});
  auto run_for = make(idl::Op::kRunFor);
  run_for.value = 0.25;
  send(1, 1, run_for);
  run(1.0);
  EXPECT_EQ(simulation->world().now(), seconds(0.25));
  send(1, 2, run_for);
  run(1.0);
  EXPECT_EQ(simulation->world().now(), seconds(0.5));
}

TEST_F(Ticks, SpeedMayChangeWhileRunning) {
  begin({.tick_rate = 10});
  run(1.0);
  auto faster = make(idl::Op::kSetSpeed);
  faster.value = 10;
  send(1, 1, faster);
  run(1.05);
  EXPECT_NEAR(static_cast<double>(simulation->moment().tick), 10 + 100, 7);
  EXPECT_EQ(told().statuses.back().speed_asked, 10);
}

TEST_F(Ticks, TrajectoryDoesNotDependOnTheTickRate) {
  std::vector<std::uint64_t> hashes;
  for (const double rate : {1.0, 60.0, 997.0}) {
    translate::SceneBodies scene = one_disk();
    scene.walls.push_back({.id = 2, .start = {3, -1}, .end = {3, 1}});
    scene.walls.push_back({.id = 3, .start = {-1, -1}, .end = {-1, 1}});
    scene.wall_names.resize(2);
    begin({.tick_rate = rate, .speed = std::numeric_limits<double>::infinity()}, scene);
    auto run_to = make(idl::Op::kRunTo);
    run_to.target = seconds(100.5);
    send(1, 1, run_to);
    for (int i = 0; i < 200'000 && simulation->running(); ++i) simulation->turn();
    hashes.push_back(simulation->world().state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace
}  // namespace stoss::service::testing

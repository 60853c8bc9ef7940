// SPDX-License-Identifier: Apache-2.0
// Commands: their order, their instants, duplicates, refusals.
#include "fixture.hpp"

namespace stoss::service::testing {
namespace {

using engine::Code;
using engine::Instant;

class Commands : public SimulationTest {};

TEST_F(Commands, WithoutAnInstantTakeEffectAtTheNextTick) {
  begin({.tick_rate = 10});
  clock.advance(0.05);
  settle();
  send(1, 1, spawn_at(5, 5));
  clock.advance(0.01);
  settle();
  EXPECT_EQ(told().replies.size(), 0U);
  run(0.05);
  const Told all = told();
  ASSERT_EQ(all.replies.size(), 1U);
  EXPECT_EQ(all.replies[0].moment.value_or(Moment{}).tick, 1U);
  EXPECT_EQ(all.replies[0].moment.value_or(Moment{}).at,
            engine::TickClock({}, 10, 1).instant_of(1));
}

TEST_F(Commands, WithAnInstantTakeEffectExactlyThenBetweenTicks) {
  begin({.tick_rate = 10});
  auto turn_back = set_velocity(1, -1, 0);
  turn_back.at = seconds(0.333);
  send(1, 1, turn_back);
  run(1.0);
  const Told all = told();
  EXPECT_EQ(all.moment_of(1, 1).at, seconds(0.333));
  const auto state = simulation->world().state(1).value();
  EXPECT_NEAR(state.position.x(), 0.333 - (1.0 - 0.333), 1e-12);
}

TEST_F(Commands, ComeInTheOrderOfInstantClientNumberWhateverTheirArrival) {
  // Each sets the same velocity; the last one in the order wins.
  begin({.tick_rate = 10, .paused = true});
  auto timed = [&](double at, double vx) {
    auto spec = set_velocity(1, vx, 0);
    spec.at = seconds(at);
    return spec;
  };
  send(2, 1, timed(0.5, 4));
  send(1, 2, timed(0.5, 3));
  send(1, 1, timed(0.5, 2));
  send(3, 1, timed(0.25, 9));
  settle();
  send(1, 3, make(idl::Op::kResume));
  run(1.0);
  const Told all = told();
  std::vector<RequestId> order;
  for (const ReplyRecord& reply : all.replies) order.push_back(reply.request);
  const std::vector<RequestId> expected = {
      {client(1), 3}, {client(3), 1}, {client(1), 1}, {client(1), 2}, {client(2), 1}};
  EXPECT_EQ(order, expected);
  EXPECT_EQ(simulation->world().state(1).value().velocity.x(), 4);
}

TEST_F(Commands, OfOneTickComeInTheOrderOfClientAndNumber) {
  begin({.tick_rate = 10});
  send(2, 1, set_velocity(1, 7, 0));
  send(1, 9, set_velocity(1, 6, 0));
  send(1, 8, set_velocity(1, 5, 0));
  run(0.1);
  const Told all = told();
  ASSERT_EQ(all.replies.size(), 3U);
  EXPECT_EQ(all.replies[0].request.number, 8U);
  EXPECT_EQ(all.replies[1].request.number, 9U);
  EXPECT_EQ(all.replies[2].request.client, client(2));
  EXPECT_EQ(simulation->world().state(1).value().velocity.x(), 7);
}

TEST_F(Commands, TimedAndUntimedOnesOfOneInstantShareOneOrder) {
  begin({.tick_rate = 10});
  auto timed = set_velocity(1, 3, 0);
  timed.at = engine::TickClock({}, 10, 1).instant_of(1);
  send(2, 1, timed);                  // client 2, at the tick by its own wish
  send(1, 1, set_velocity(1, 2, 0));  // client 1, at the tick because it is the next
  run(0.1);
  const Told all = told();
  ASSERT_EQ(all.replies.size(), 2U);
  EXPECT_EQ(all.replies[0].request.client, client(1));
  EXPECT_EQ(simulation->world().state(1).value().velocity.x(), 3);
}

TEST_F(Commands, EventsOfAnInstantComeBeforeItsCommands) {
  // The disk touches the wall at exactly 2 s; a command of that instant finds it reflected.
  translate::SceneBodies scene = one_disk();
  scene.walls.push_back({.id = 2, .start = {2.5, -1}, .end = {2.5, 1}});
  scene.wall_names.emplace_back();
  begin({.tick_rate = 1, .speed = 100}, scene);
  auto pause = make(idl::Op::kPause);
  pause.at = Instant{2, 0};
  send(1, 1, pause);
  run(1.0);
  EXPECT_EQ(simulation->world().now(), (Instant{2, 0}));
  EXPECT_EQ(simulation->world().state(1).value().velocity.x(), -1);
}

TEST_F(Commands, InThePastAreRefused) {
  begin({.tick_rate = 10});
  run(1.0);
  auto late = spawn_at(5, 5);
  late.at = seconds(0.5);
  send(1, 1, late);
  const std::uint64_t hash = simulation->world().state_hash();
  run(0.1);
  EXPECT_EQ(told().code_of(1, 1), Code::DeadlinePassed);
  EXPECT_EQ(simulation->world().state_hash(), hash);
}

TEST_F(Commands, TimedOnesWaitInAPausedWorldUntilTheirInstant) {
  begin({.tick_rate = 10, .paused = true});
  auto later = spawn_at(5, 5);
  later.at = seconds(0.15);
  send(1, 1, later);
  auto now = spawn_at(9, 9);
  now.at = Instant{};
  send(1, 2, now);
  run(1.0);
  Told all = told();
  EXPECT_EQ(all.code_of(1, 2), Code::Ok);
  EXPECT_FALSE(all.has_reply(1, 1));
  send(1, 3, make(idl::Op::kResume));
  run(0.3);
  all = told();
  EXPECT_EQ(all.moment_of(1, 1).at, seconds(0.15));
}

TEST_F(Commands, DuplicatesAreAnsweredAgainAndNotApplied) {
  begin({.paused = true});
  send(1, 1, spawn_at(5, 0));
  settle();
  send(1, 1, spawn_at(5, 0));
  settle();
  const Told all = told();
  ASSERT_EQ(all.replies.size(), 2U);
  EXPECT_FALSE(all.replies[0].duplicate);
  EXPECT_TRUE(all.replies[1].duplicate);
  EXPECT_EQ(all.replies[0].ids, all.replies[1].ids);
  EXPECT_EQ(simulation->world().disk_count(), 2U);
  EXPECT_EQ(all.statuses.size(), 1U);
  run(1.1);
  EXPECT_EQ(told().statuses.back().duplicates, 1U);
}

TEST_F(Commands, DuplicatesOfWaitingOnesAreAnsweredOnce) {
  begin({.tick_rate = 10});
  send(1, 1, spawn_at(5, 0));
  send(1, 1, spawn_at(5, 0));
  run(0.2);
  EXPECT_EQ(told().replies.size(), 1U);
  EXPECT_EQ(simulation->world().disk_count(), 2U);
}

TEST_F(Commands, OlderThanTheKeptRepliesAreRefusedAndNotApplied) {
  begin({.paused = true});
  for (std::uint64_t number = 1; number <= kRepliesKept + 10; ++number) {
    send(1, number, make(idl::Op::kPause));
  }
  settle();
  told();
  send(1, 3, spawn_at(5, 0));
  settle();
  EXPECT_EQ(told().code_of(1, 3), Code::FailedPrecondition);
  EXPECT_EQ(simulation->world().disk_count(), 1U);
}

TEST_F(Commands, PauseInTheMiddleOfATickLetsTheRestOfItsCommandsTakeEffectThere) {
  begin({.tick_rate = 10});
  auto pause = make(idl::Op::kPause);
  pause.at = seconds(0.05);
  send(2, 1, pause);
  send(1, 1, spawn_at(5, 5));
  run(1.0);
  const Told all = told();
  EXPECT_EQ(all.moment_of(2, 1).at, seconds(0.05));
  EXPECT_EQ(all.moment_of(1, 1).at, seconds(0.05));
  EXPECT_EQ(simulation->moment().tick, 0U);
}

TEST_F(Commands, ResetBringsTheSceneBackInANewEpoch) {
  begin({.tick_rate = 10, .epoch = 7});
  const std::uint64_t hash = simulation->world().state_hash();
  send(1, 1, spawn_at(5, 5));
  auto far = spawn_at(50, 50);
  far.at = Instant{100, 0};
  send(1, 2, far);
  run(1.0);
  send(1, 3, make(idl::Op::kReset));
  run(0.1);
  const Told all = told();
  ASSERT_EQ(all.epochs.size(), 2U);
  EXPECT_EQ(all.epochs[1].moment, (Moment{8, 0, {}}));
  EXPECT_EQ(all.epochs[1].bodies.size(), 1U);
  EXPECT_EQ(all.epochs[1].names, (std::vector<NamedBody>{{1, "ball"}}));
  EXPECT_EQ(all.epochs[1].state_hash, hash);
  EXPECT_EQ(all.code_of(1, 2), Code::Unavailable);
  EXPECT_EQ(all.code_of(1, 3), Code::Ok);
  EXPECT_EQ(all.moment_of(1, 3).epoch, 8U);
  run(1.0);
  EXPECT_EQ(simulation->moment().tick, 10U);
}

TEST_F(Commands, EveryRefusalLeavesTheWorldAsItWas) {
  begin({.paused = true, .bodies_max = 3});
  const std::uint64_t hash = simulation->world().state_hash();
  auto no_such = make(idl::Op::kRemove);
  no_such.ids = {99};
  auto used = spawn_at(5, 5);
  used.disks[0].id = 1;
  auto backwards = make(idl::Op::kSetSpeed);
  backwards.value = -1;
  auto too_many = spawn_at(5, 5);
  too_many.disks.push_back({.position = {7, 7}, .radius = 0.5});
  too_many.disks.push_back({.position = {9, 9}, .radius = 0.5});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<translate::CommandSpec, Code>> cases = {
      {spawn_at(0.2, 0), Code::Overlap},
      {spawn_at(nan, 0), Code::InvalidArgument},
      {spawn_at(5, 0, -1), Code::InvalidArgument},
      {make(idl::Op::kSpawn), Code::InvalidArgument},
      {used, Code::AlreadyExists},
      {no_such, Code::NotFound},
      {make(idl::Op::kRemove), Code::InvalidArgument},
      {set_velocity(1, nan, 0), Code::InvalidArgument},
      {set_velocity(99, 1, 0), Code::NotFound},
      {make(idl::Op::kApplyImpulse), Code::InvalidArgument},
      {make(idl::Op::kStep), Code::InvalidArgument},
      {make(idl::Op::kRunFor), Code::InvalidArgument},
      {backwards, Code::InvalidArgument},
      {make(idl::Op::kWatch), Code::InvalidArgument},
      {make(idl::Op::kSnapshot), Code::Unimplemented},
      {too_many, Code::ResourceExhausted},
  };
  std::uint64_t number = 0;
  for (const auto& [spec, code] : cases) send(1, ++number, spec);
  settle();
  const Told all = told();
  number = 0;
  for (const auto& [spec, code] : cases) {
    ++number;
    EXPECT_EQ(all.code_of(1, number), code) << "case " << number;
  }
  EXPECT_EQ(simulation->world().state_hash(), hash);
  EXPECT_TRUE(all.ticks.empty()) << "nothing has changed, so nothing is told";
  run(1.1);
  EXPECT_EQ(told().statuses.back().rejected, cases.size());
}

TEST_F(Commands, StopAnswersEverythingThatWaits) {
  begin({.tick_rate = 10});
  auto later = spawn_at(5, 5);
  later.at = Instant{100, 0};
  send(1, 1, later);
  run(0.2);
  send(1, 2, spawn_at(7, 7));
  translate::QuerySpec query;
  query.op = idl::wire_value(idl::Ask::kStates);
  ask(1, 3, query);
  simulation->stop();
  const Told all = told();
  EXPECT_EQ(all.code_of(1, 1), Code::Unavailable);
  EXPECT_EQ(all.code_of(1, 2), Code::Unavailable);
  ASSERT_EQ(all.answers.size(), 1U);
  EXPECT_EQ(std::get<engine::Reject>(all.answers[0].content).code, Code::Unavailable);
  EXPECT_EQ(all.statuses.back().state, idl::WorldState::kStopped);
}

}  // namespace
}  // namespace stoss::service::testing

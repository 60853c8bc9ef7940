// SPDX-License-Identifier: Apache-2.0
// Questions to the world's thread, and the publisher's picture of the world.
#include "fixture.hpp"

#include <picture.hpp>
#include <questions.hpp>

#include <thread>

namespace stoss::service::testing {
namespace {

using engine::Code;
using engine::Instant;
using idl::Ask;

class Questions : public SimulationTest {
 protected:
  static translate::QuerySpec make_query(Ask op) {
    translate::QuerySpec query;
    query.op = idl::wire_value(op);
    return query;
  }

  /// The answer that comes first, from whatever thread.
  AnswerItem wait_for_answer() {
    for (int i = 0; i < 5000; ++i) {
      Told all = told();
      if (!all.answers.empty()) return std::move(all.answers[0]);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return {{}, std::nullopt, engine::Reject{}, {}};
  }
};

TEST_F(Questions, AboutThePastAreRefusedAndAboutThePresentAreNot) {
  begin({.tick_rate = 10});
  run(1.0);
  told();
  auto query = make_query(Ask::kRay);
  query.direction = {1, 0};
  query.distance = 10;
  query.at = Instant{1, 0};
  ask(1, 1, query);
  settle();
  EXPECT_TRUE(std::holds_alternative<Rows>(wait_for_answer().content));
  query.at = Instant{0, 5};
  ask(1, 2, query);
  settle();
  const AnswerItem past = wait_for_answer();
  ASSERT_TRUE(std::holds_alternative<engine::Reject>(past.content));
  EXPECT_EQ(std::get<engine::Reject>(past.content).code, Code::DeadlinePassed);
}

TEST_F(Questions, AboutTheFutureRunACopyAhead) {
  begin({.tick_rate = 10, .paused = true});
  const std::uint64_t hash = simulation->world().state_hash();
  auto query = make_query(Ask::kStates);
  query.ids = {1};
  query.at = seconds(2.5);
  ask(1, 1, query);
  settle();
  const AnswerItem answer = wait_for_answer();
  ASSERT_TRUE(std::holds_alternative<Rows>(answer.content));
  EXPECT_EQ(answer.moment.value_or(Moment{}).at, seconds(2.5));
  EXPECT_EQ(answer.moment.value_or(Moment{}).tick, 25U);
  EXPECT_EQ(simulation->world().state_hash(), hash);
  EXPECT_EQ(simulation->world().now(), Instant{});
}

TEST_F(Questions, AboutAFutureOfTooManyEventsAreRefused) {
  translate::SceneBodies scene = one_disk();
  scene.disks[0].velocity = {1000, 0};
  scene.walls.push_back({.id = 2, .start = {0.500001, -1}, .end = {0.500001, 1}});
  scene.walls.push_back({.id = 3, .start = {-0.500001, -1}, .end = {-0.500001, 1}});
  scene.wall_names.resize(2);
  begin({.paused = true}, scene);
  auto query = make_query(Ask::kForecast);
  query.distance = 1;
  ask(1, 1, query);
  settle();
  const AnswerItem answer = wait_for_answer();
  ASSERT_TRUE(std::holds_alternative<engine::Reject>(answer.content));
  EXPECT_EQ(std::get<engine::Reject>(answer.content).code, Code::ResourceExhausted);
}

TEST_F(Questions, ThatAreLargeGoToThePublisherBehindTheRecords) {
  begin({.paused = true});
  told();
  send(1, 1, spawn_at(5, 5));
  settle();
  ask(1, 2, make_query(Ask::kWorld));
  ask(1, 3, make_query(Ask::kList));
  settle();
  const Told all = told();
  EXPECT_EQ(all.ticks.size(), 1U);
  EXPECT_EQ(all.picture_queries.size(), 2U);
}

class Pictures : public Questions, public ::testing::WithParamInterface<double> {};

// In open space, and around a world of 20 m.
INSTANTIATE_TEST_SUITE_P(Questions, Pictures, ::testing::Values(0.0, 20.0));

TEST_P(Pictures, FollowTheWorldBitForBit) {
  translate::SceneBodies scene = one_disk();
  scene.period = {GetParam(), 0};
  scene.disks.push_back(
      {.id = 5, .position = {3, 0.25}, .velocity = {-0.7, 0.1}, .radius = 0.4, .spin = 2});
  scene.disk_names.emplace_back("other");
  scene.walls.push_back({.id = 7, .start = {6, -9}, .end = {7, 9}, .velocity = {-0.1, 0}});
  scene.walls.push_back({.id = 8, .start = {-6, -9}, .end = {-6, 9}});
  scene.wall_names.resize(2);
  begin({.tick_rate = 7}, scene);
  Picture picture(engine::Arithmetic::Double, scene.period);
  for (int round = 0; round < 50; ++round) {
    if (round == 20) send(1, 1, spawn_at(0, 4));
    if (round == 30) {
      auto remove = make(idl::Op::kRemove);
      remove.ids = {5};
      send(1, 2, remove);
    }
    run(0.3);
    const Told all = told();
    for (const EpochRecord& record : all.epochs) picture.begin(record);
    for (const TickRecord& record : all.ticks) picture.apply(record);
    ASSERT_EQ(picture.moment(), simulation->moment());
    simulation->world().for_each_disk([&](const engine::BodyState& state) {
      const std::optional<Picture::Body> body = picture.find(state.id);
      ASSERT_TRUE(body);
      const engine::BodyState mine = picture.state_of(*body);
      EXPECT_EQ(mine.position, state.position);
      EXPECT_EQ(mine.velocity, state.velocity);
      EXPECT_EQ(mine.angle, state.angle);
    });
    simulation->world().for_each_wall([&](const engine::WallState& wall) {
      const engine::WallState mine = picture.wall_of(*picture.find(wall.id));
      EXPECT_EQ(mine.start, wall.start);
      EXPECT_EQ(mine.end, wall.end);
    });
  }
  EXPECT_EQ(picture.size(), 4U);
  EXPECT_EQ(picture.names().at(1), "ball");
  EXPECT_FALSE(picture.names().contains(5));
}

TEST_F(Questions, ARemovalTellsWhereAndWhen) {
  begin({.tick_rate = 10});
  auto remove = make(idl::Op::kRemove);
  remove.ids = {1};
  remove.at = seconds(0.25);
  send(1, 1, remove);
  run(1.0);
  const Told all = told();
  std::vector<BodyChange> changes;
  for (const TickRecord& tick : all.ticks) {
    changes.insert(changes.end(), tick.changes.begin(), tick.changes.end());
  }
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, engine::ChangeKind::Removed);
  EXPECT_EQ(changes[0].motion.since, seconds(0.25));
  EXPECT_EQ(changes[0].motion.x.high, 0.25);
}

}  // namespace
}  // namespace stoss::service::testing

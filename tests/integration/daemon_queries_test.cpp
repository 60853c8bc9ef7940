// SPDX-License-Identifier: Apache-2.0
// Every question, through DDS, against a real daemon.
#include "daemon_client.hpp"
#include "daemon_process.hpp"

#include <algorithm>
#include <limits>

namespace stoss::tests {
namespace {

using engine::Code;
using engine::Instant;
using idl::Ask;
using idl::Op;

constexpr unsigned kDomain = 61;

/// One daemon with the tutorial's scene, paused: disk 1 at (0, 0), disk 2 at (2, 0) which flies at
/// 100 km/s towards wall 3 at x = 4.
class DaemonQueries : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(client.connect()) << daemon.log(); }
  void TearDown() override {
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0) << daemon.log();
  }

  Process daemon{stossd(kDomain, {"--scene", scene("tutorial"), "--paused"})};
  WireClient client{kDomain, "tutorial", 1};
};

TEST_F(DaemonQueries, FindBodies) {
  GotAnswer got = client.ask(Ask::kList);
  ASSERT_EQ(got.states.size(), 2U);
  EXPECT_EQ(got.states[0].id, 1U);
  ASSERT_EQ(got.walls.size(), 1U);
  EXPECT_EQ(got.walls[0].end, engine::Vector2(4, 1));

  got = client.ask(Ask::kStates, Targets({3}));
  ASSERT_EQ(got.walls.size(), 1U);
  EXPECT_EQ(got.walls[0].start, engine::Vector2(4, -1));

  got = client.ask(Ask::kRegion, [](wire::Query& q) {
    q.min_x = 1.5;
    q.max_x = 10;
    q.min_y = -1;
    q.max_y = 1;
  });
  ASSERT_EQ(got.states.size(), 1U);
  EXPECT_EQ(got.states[0].id, 2U);
  EXPECT_EQ(got.walls.size(), 1U);

  got = client.ask(Ask::kNearest, [](wire::Query& q) {
    q.x = 1.5;
    q.count = 2;
  });
  ASSERT_EQ(got.states.size(), 2U);
  EXPECT_EQ(got.states[0].id, 2U);
  EXPECT_NEAR(got.distances[0], 0.4, 1e-15);
  EXPECT_NEAR(got.distances[1], 1.0, 1e-15);

  got = client.ask(Ask::kRay, [](wire::Query& q) {
    q.x = -5;
    q.direction_x = 3;
    q.distance = std::numeric_limits<double>::infinity();
  });
  ASSERT_EQ(got.hits.size(), 1U);
  EXPECT_EQ(got.hits[0].id, 1U);
  EXPECT_NEAR(got.hits[0].distance, 4.5, 1e-15);
}

TEST_F(DaemonQueries, AreRefusedWithTheFieldAtFault) {
  const auto code = [&](Ask ask, const WireClient::FillQuery& fill) {
    const GotAnswer got = client.ask(ask, fill);
    EXPECT_FALSE(got.reject.field.empty());
    return got.reject.code;
  };
  EXPECT_EQ(code(Ask::kStates, {}), Code::InvalidArgument);
  EXPECT_EQ(code(Ask::kStates, Targets({99})), Code::NotFound);
  EXPECT_EQ(code(Ask::kRegion, [](wire::Query& q) { q.min_x = 1; }), Code::InvalidArgument);
  EXPECT_EQ(code(Ask::kRay, [](wire::Query& q) { q.distance = 1; }), Code::InvalidArgument);
  EXPECT_EQ(code(Ask::kCollisions, {}), Code::InvalidArgument);
  EXPECT_EQ(code(Ask::kPredict, {}), Code::Unimplemented);
  EXPECT_EQ(code(Ask::kZoneEvents, {}), Code::InvalidArgument);
  EXPECT_EQ(code(Ask{999}, {}), Code::Unimplemented);
  EXPECT_EQ(code(Ask::kList, [](wire::Query& q) { q.protocol = 7; }), Code::Unimplemented);
  const auto past = [](wire::Query& q) {
    q.timed = true;
    q.at = {-1, 0};
  };
  EXPECT_EQ(code(Ask::kList, past), Code::DeadlinePassed);
}

TEST_F(DaemonQueries, LookIntoTheFutureWithoutChangingThePresent) {
  const std::uint64_t before = client.status().state_hash;
  const auto later = [](wire::Query& q) {
    q.timed = true;
    q.at = {1, 0};
  };
  const GotAnswer then = client.ask(Ask::kList, later);
  ASSERT_EQ(then.reject.code, Code::Ok) << then.reject.reason;
  EXPECT_EQ(then.at, (Instant{1, 0}));
  EXPECT_EQ(then.tick, 60U);
  ASSERT_EQ(then.states.size(), 2U);
  EXPECT_EQ(client.status().state_hash, before);
  EXPECT_EQ(client.status().at.seconds, 0);

  const GotAnswer forecast = client.ask(Ask::kForecast, [](wire::Query& q) { q.distance = 1; });
  ASSERT_EQ(forecast.states.size(), 2U);
  EXPECT_EQ(forecast.states[1].position, then.states[1].position);

  // What was foretold comes to pass, to the bit.
  client.command(Op::kRunTo, [](auto& c) { c.target = {1, 0}; });
  ASSERT_TRUE(
      client.until(WireClient::Seconds(10), [&] { return client.status().at.seconds == 1; }));
  const GotAnswer now = client.ask(Ask::kList);
  ASSERT_EQ(now.states.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(now.states[i].position, then.states[i].position);
    EXPECT_EQ(now.states[i].velocity, then.states[i].velocity);
  }
}

TEST_F(DaemonQueries, GiveTheWholeWorldAndTheCollisionsSoFar) {
  client.command(Op::kRunTo, [](auto& c) { c.target = {1, 0}; });
  ASSERT_TRUE(
      client.until(WireClient::Seconds(10), [&] { return client.status().at.seconds == 1; }));
  const GotAnswer world = client.ask(Ask::kWorld);
  EXPECT_EQ(world.motions.size(), 3U);
  ASSERT_EQ(world.statics.size(), 3U);
  EXPECT_TRUE(world.statics[2].is_wall);
  EXPECT_EQ(world.statics[2].edge_y.high, 2);

  const std::uint64_t count = client.status().collisions;
  ASSERT_GT(count, 0U);
  const GotAnswer all = client.ask(Ask::kCollisions, [](wire::Query& q) { q.number = 1; });
  ASSERT_EQ(all.collisions.size(), count);
  EXPECT_EQ(all.collision_number, count);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(all.collisions[i].sequence, i + 1);
  const GotAnswer beyond =
      client.ask(Ask::kCollisions, [&](wire::Query& q) { q.number = count + 1; });
  EXPECT_EQ(beyond.reject.code, Code::Ok);
  EXPECT_TRUE(beyond.collisions.empty());
}

TEST_F(DaemonQueries, TellFeaturesAndStatus) {
  const GotAnswer features = client.ask(Ask::kFeatures);
  const auto has = [&](const char* word) {
    return std::find(features.features.begin(), features.features.end(), word) !=
           features.features.end();
  };
  EXPECT_TRUE(has("SPAWNING"));
  EXPECT_TRUE(has("command:SPAWN"));
  EXPECT_TRUE(has("scalar:double"));

  const GotAnswer got = client.ask(Ask::kStatus);
  ASSERT_TRUE(got.status);
  const wire::Status& status = *got.status;
  EXPECT_EQ(idl::text(status.world), "tutorial");
  EXPECT_EQ(status.bodies, 2U);
  EXPECT_EQ(status.walls, 1U);
  EXPECT_EQ(status.pid, static_cast<std::uint32_t>(daemon.pid()));
  EXPECT_EQ(status.tick_rate, 60);
  EXPECT_EQ(status.dropped, 0U);
  EXPECT_TRUE(got.counters.contains("mailboxes"));
}

}  // namespace
}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// The client library against a real stossd: commands that wait, many at once, silence, feeds.
#include "daemon_process.hpp"

#include <stoss/client/discovery.hpp>
#include <stoss/client/feeds.hpp>
#include <stoss/client/replica.hpp>
#include <stoss/client/session.hpp>

#include <atomic>
#include <future>
#include <map>
#include <set>
#include <thread>
#include <vector>

namespace stoss::tests {
namespace {

using namespace stoss::client;

constexpr unsigned kDomain = 81;
constexpr Milliseconds kPatience{20'000};

ConnectOptions options(const std::string& world, Milliseconds timeout = kPatience) {
  return {.world = world, .domain = kDomain, .timeout = timeout, .network = {}};
}

engine::DiskSpec disk(double x, double y) { return {.position = {x, y}, .radius = 0.5}; }

TEST(ClientSession, CommandsAreAnsweredWithTheirInstantAndIds) {
  Process daemon(stossd(kDomain, {"--world", "session"}));
  Session session(options("session"));
  EXPECT_EQ(session.first_status().world, "session");
  const Result<Reply> reply =
      session.command(Command::spawn({disk(0, 0), disk(5, 0)}, {{.start = {9, 0}, .end = {9, 1}}}));
  ASSERT_TRUE(reply.ok()) << reply.failure().reject.reason;
  EXPECT_EQ(reply.value().ids.size(), 3U);
  EXPECT_GT(reply.value().at, engine::Instant{});
  const Result<Reply> refused = session.command(Command::remove({12345}));
  ASSERT_FALSE(refused.ok());
  EXPECT_TRUE(refused.failure().answered);
  EXPECT_EQ(refused.failure().reject.code, engine::Code::NotFound);
  EXPECT_EQ(refused.failure().reject.body, 12345U);
}

TEST(ClientSession, ManyCommandsMayBeUnderWayFromManyThreads) {
  Process daemon(stossd(kDomain, {"--world", "session"}));
  Session session(options("session"));
  constexpr int kThreads = 4;
  constexpr int kEach = 200;
  std::vector<std::vector<engine::Id>> made(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&session, &made, t] {
      std::vector<std::future<Result<Reply>>> replies;
      for (int i = 0; i < kEach; ++i) {
        replies.push_back(session.submit(Command::spawn({disk(3.0 * i, 10.0 * t)})));
      }
      for (auto& reply : replies) {
        const Result<Reply> result = reply.get();
        EXPECT_TRUE(result.ok()) << result.failure().reject.reason;
        if (result) made[static_cast<std::size_t>(t)].push_back(result.value().ids.at(0));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::set<engine::Id> ids;
  for (const auto& some : made) ids.insert(some.begin(), some.end());
  EXPECT_EQ(ids.size(), std::size_t{kThreads * kEach}) << "each command made one disk, once";
  const Result<Answer> list = session.ask(Query::list());
  ASSERT_TRUE(list.ok());
  EXPECT_EQ(list.value().bodies.size(), std::size_t{kThreads * kEach});
}

// The same disk comes by again and again; what the feed tells has no gaps, and the scene and the
// replica have the zone.
TEST(ClientSession, ZoneEventsComeInOrderWithoutGaps) {
  Process daemon(stossd(kDomain, {"--world", "session", "--speed", "max", "--paused"}));
  Session session(options("session"));
  const Result<Reply> reply = session.command(
      Command::spawn({{.position = {0, 0}, .velocity = {10, 3}, .radius = 0.5}},
                     {{.start = {-9, -9}, .end = {9, -9}},
                      {.start = {9, -9}, .end = {9, 9}},
                      {.start = {9, 9}, .end = {-9, 9}},
                      {.start = {-9, 9}, .end = {-9, -9}}},
                     {{.center = {0, 0}, .radius = 4}, {.center = {5, 5}, .radius = 2}}));
  ASSERT_TRUE(reply.ok()) << reply.failure().reject.reason;
  ASSERT_EQ(reply.value().ids.size(), 7U);
  const engine::Id first_zone = reply.value().ids[5];
  ZoneFeed feed(session, 1);
  ASSERT_TRUE(session.command(Command::run_for(1000)).ok());
  std::vector<engine::ZoneEvent> events;
  const auto end = steady_clock::now() + kPatience;
  while (events.size() < 500 && steady_clock::now() < end) {
    if (const auto run = feed.next(Milliseconds{100})) {
      EXPECT_EQ(run->lost, 0U);
      events.insert(events.end(), run->events.begin(), run->events.end());
    }
  }
  ASSERT_GE(events.size(), 500U);
  std::map<engine::Id, bool> inside{{first_zone, true}};
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].sequence, i + 1);
    EXPECT_NE(inside[events[i].zone], events[i].entered);
    inside[events[i].zone] = events[i].entered;
  }
  Replica replica(session);
  ASSERT_TRUE(replica.wait_until_complete(kPatience));
  std::vector<engine::ZoneState> zones;
  while (zones.empty() && steady_clock::now() < end) zones = replica.zones();
  ASSERT_EQ(zones.size(), 2U);
  EXPECT_EQ(zones[0], (engine::ZoneState{first_zone, {0, 0}, 4}));
  EXPECT_EQ(replica.disks().size(), 1U);
}

TEST(ClientSession, WhatIsTooLargeIsRefusedBeforeItIsSent) {
  Process daemon(stossd(kDomain, {"--world", "session"}));
  Session session(options("session"));
  const std::vector<engine::Id> many(kCommandBodiesMax + 1, 1);
  const Result<Reply> reply = session.command(Command::remove(many));
  ASSERT_FALSE(reply.ok());
  EXPECT_EQ(reply.failure().reject.code, engine::Code::InvalidArgument);
  EXPECT_EQ(reply.failure().reject.field, "ids");
  const Result<Answer> answer = session.ask(Query::states(many));
  ASSERT_FALSE(answer.ok());
  EXPECT_EQ(answer.failure().reject.code, engine::Code::InvalidArgument);
}

TEST(ClientSession, NoWorldIsAnErrorInTime) {
  const auto begun = steady_clock::now();
  EXPECT_THROW(Session(options("nowhere", Milliseconds{300})), NoWorldError);
  EXPECT_LT(steady_clock::now() - begun, std::chrono::seconds(5));
  EXPECT_THROW(Session(options("no/where", Milliseconds{300})), std::invalid_argument);
}

TEST(ClientSession, ASilentWorldLeavesEveryRequestAnsweredOnce) {
  Process daemon(stossd(kDomain, {"--world", "session"}));
  Session session(options("session"));
  daemon.signal(SIGSTOP);
  std::atomic<int> replies{0};
  std::atomic<int> silent{0};
  for (int i = 0; i < 10; ++i) {
    session.submit(
        Command::spawn({disk(3.0 * i, 0)}), Milliseconds{700}, [&](const Result<Reply>& reply) {
          ++replies;
          if (!reply && !reply.failure().answered) ++silent;
        });
  }
  const Result<Answer> answer = session.ask(Query::status(), Milliseconds{500});
  EXPECT_FALSE(answer.ok());
  std::this_thread::sleep_for(milliseconds(600));
  EXPECT_EQ(replies, 10);
  EXPECT_EQ(silent, 10);
  EXPECT_GT(session.counters().retries, 0U);
  daemon.signal(SIGCONT);
  // Each was sent several times, and none is applied twice.
  ASSERT_TRUE(session.command(Command::pause()).ok());
  const Result<Answer> list = session.ask(Query::list());
  ASSERT_TRUE(list.ok());
  EXPECT_EQ(list.value().bodies.size(), 10U);
  EXPECT_EQ(replies, 10) << "late replies are nobody's any more";
}

TEST(ClientSession, ACommandGivenUpByItsSessionStillCompletes) {
  Process daemon(stossd(kDomain, {"--world", "session"}));
  std::future<Result<Reply>> reply;
  {
    Session session(options("session"));
    daemon.signal(SIGSTOP);
    reply = session.submit(Command::pause());
  }
  daemon.signal(SIGCONT);
  const Result<Reply> result = reply.get();
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(result.failure().answered);
}

TEST(ClientSession, ADaemonThatIsStartedAgainIsFoundAgain) {
  auto daemon = std::make_unique<Process>(stossd(kDomain, {"--world", "session"}));
  Session session(options("session"));
  daemon->signal(SIGTERM);
  ASSERT_EQ(daemon->wait(), 0);
  daemon = std::make_unique<Process>(stossd(kDomain, {"--world", "session"}));
  const Result<Reply> reply = session.command(Command::spawn({disk(0, 0)}));
  ASSERT_TRUE(reply.ok()) << reply.failure().reject.reason;
  EXPECT_NE(reply.value().epoch, session.first_status().epoch);
}

TEST(ClientSession, CollisionsFromTheBeginningComeWithoutAGap) {
  Process daemon(stossd(kDomain, {"--scene", scene("pi-2"), "--world", "pi", "--speed", "max"}));
  Session session(options("pi"));
  CollisionFeed feed(session, 1);
  std::uint64_t next = 1;
  const auto end = steady_clock::now() + std::chrono::seconds(15);
  while (next <= 314 && steady_clock::now() < end) {
    const std::optional<CollisionRun> run = feed.next(Milliseconds{100});
    if (!run) continue;
    EXPECT_EQ(run->lost, 0U);
    for (const engine::Collision& collision : run->collisions) {
      EXPECT_EQ(collision.sequence, next++);
    }
  }
  EXPECT_EQ(next, 315U);
}

TEST(ClientSession, FeedsTellOfTheSceneTheStatusAndWatchedBodies) {
  Process daemon(stossd(kDomain, {"--scene", scene("tutorial"), "--world", "feeds"}));
  Session session(options("feeds"));
  SceneFeed scenes(session);
  const std::optional<SceneImage> image = scenes.next(kPatience);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->scene_name, "tutorial");
  EXPECT_EQ(image->disks.size(), 2U);
  EXPECT_EQ(image->walls.size(), 1U);
  ASSERT_EQ(image->names.size(), 3U);
  EXPECT_TRUE(image->effects.empty());
  ASSERT_TRUE(session.command(Command::set_effects({}, {{"restitution.coefficient", 0.5}})).ok());
  const std::optional<SceneImage> later = scenes.next(kPatience);
  ASSERT_TRUE(later);
  EXPECT_EQ(later->effects, std::vector<std::string>{"restitution"});
  StatusFeed statuses(session);
  const std::optional<Status> status = statuses.next(kPatience);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->bodies, 2U);
  BodyFeed bodies(session);
  BodyFeed idle(session);
  ASSERT_TRUE(session.command(Command::watch({1})).ok());
  std::optional<BodyUpdate> update = bodies.next(kPatience);
  ASSERT_TRUE(update);
  EXPECT_FALSE(update->gone);
  EXPECT_EQ(update->state.id, 1U);
  ASSERT_TRUE(session.command(Command::remove({1})).ok());
  for (int i = 0; i < 200 && update && !update->gone; ++i) update = bodies.next(kPatience);
  ASSERT_TRUE(update);
  EXPECT_TRUE(update->gone);
  // One that has not looked meanwhile finds a state and its end in one.
  update = idle.next(kPatience);
  ASSERT_TRUE(update);
  if (!update->gone) update = idle.next(milliseconds(500));
  ASSERT_TRUE(update);
  EXPECT_TRUE(update->gone);
}

TEST(ClientSession, WorldsSideBySideAreTold) {
  Process one(stossd(kDomain, {"--world", "one"}));
  Process two(stossd(kDomain, {"--world", "two", "--paused"}));
  std::vector<Status> found;
  const auto end = steady_clock::now() + std::chrono::seconds(15);
  while (found.size() < 2 && steady_clock::now() < end) {
    found = worlds(kDomain, {}, Milliseconds{2000}, Milliseconds{500});
  }
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].world, "one");
  EXPECT_EQ(found[1].state, idl::WorldState::kPaused);
}

}  // namespace
}  // namespace stoss::tests

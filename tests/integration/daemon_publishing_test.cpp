// SPDX-License-Identifier: Apache-2.0
// What a daemon publishes, as a subscriber sees it.
#include "daemon_client.hpp"
#include "daemon_process.hpp"

#include <stoss/engine/motion.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace stoss::tests {
namespace {

using engine::Code;
using engine::Instant;
using idl::Ask;
using idl::Op;
using Seconds = WireClient::Seconds;

constexpr unsigned kDomain = 62;

/// All that a subscriber keeps to hold the whole world: a plain replica.
struct Follower {
  explicit Follower(WireClient& client)
      : motion_topic(idl::make_topic(client.participant(), idl::kMotionTopic)),
        collision_topic(idl::make_topic(client.participant(), idl::kCollisionTopic)),
        motion(idl::make_reader(client.subscriber(), motion_topic, idl::kMotionTopic)),
        collision(idl::make_reader(client.subscriber(), collision_topic, idl::kCollisionTopic)) {}

  void load(const GotAnswer& world) {
    bodies.clear();
    for (const engine::MotionRecord& record : world.motions) bodies[record.id] = record;
    number = world.motion_number;
    epoch = world.epoch;
  }

  void take_motions() {
    motion.drain([&](const dds::Sample<wire::MotionBatch>& sample) {
      if (!sample.valid() || sample.data.epoch != epoch || sample.data.number <= number) return;
      const wire::MotionBatch& batch = sample.data;
      if (batch.number != number + 1) ++gaps;
      number = batch.number;
      at = translate::to_engine(batch.at);
      hash = batch.state_hash;
      ASSERT_TRUE(translate::consistent(batch.motions));
      for (std::size_t i = 0; i < batch.motions.id._length; ++i) {
        const engine::MotionRecord record = translate::motion_at(batch.motions, i);
        if (translate::change_at(batch.motions, i).kind == engine::ChangeKind::Removed) {
          bodies.erase(record.id);
        } else {
          bodies[record.id] = record;
        }
      }
    });
  }

  void take_collisions() {
    collision.drain([&](const dds::Sample<wire::CollisionBatch>& sample) {
      if (!sample.valid()) return;
      const wire::CollisionBatch& batch = sample.data;
      if (next_collision != 0 && batch.first_number != next_collision) ++gaps;
      next_collision = batch.first_number + batch.collisions.a._length;
      for (std::size_t i = 0; i < batch.collisions.a._length; ++i) {
        const auto got = translate::collision_at(batch.collisions, batch.first_number, i);
        if (got.instant < last_collision) ++out_of_order;
        last_collision = got.instant;
      }
    });
  }

  dds::Topic<wire::MotionBatch> motion_topic;
  dds::Topic<wire::CollisionBatch> collision_topic;
  dds::Reader<wire::MotionBatch> motion;
  dds::Reader<wire::CollisionBatch> collision;
  std::map<engine::Id, engine::MotionRecord> bodies;
  std::uint64_t number = 0;
  std::uint64_t epoch = 0;
  std::uint64_t hash = 0;
  Instant at;
  std::uint64_t gaps = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t next_collision = 0;
  Instant last_collision;
};

TEST(DaemonPublishing, ASubscriberHoldsTheWholeWorldBitForBit) {
  Process daemon(stossd(kDomain, {"--scene", scene("gas-10000"), "--frame-rate", "30"}));
  WireClient client(kDomain, "gas-10000", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  Follower follower(client);
  ASSERT_TRUE(WireClient::until(Seconds(10), [&] { return follower.motion.writers() > 0; }));
  const auto began = std::chrono::steady_clock::now();
  const GotAnswer world = client.ask(Ask::kWorld);
  const Seconds took = std::chrono::steady_clock::now() - began;
  ASSERT_EQ(world.reject.code, Code::Ok) << world.reject.reason;
  EXPECT_EQ(world.motions.size(), 10'004U);
  std::printf("whole world of 10,000 disks in %.1f ms\n", took.count() * 1e3);
  follower.load(world);

  std::uint64_t compared = 0;
  for (int round = 0; round < 10; ++round) {
    std::this_thread::sleep_for(milliseconds(100));
    const GotAnswer list = client.ask(Ask::kList);
    WireClient::until(Seconds(5), [&] {
      follower.take_motions();
      follower.take_collisions();
      return follower.number >= list.motion_number;
    });
    // A motion that was published since may have changed already; those must be left out.
    if (follower.number != list.motion_number) continue;
    for (const engine::BodyState& state : list.states) {
      const engine::Vector2 mine =
          engine::evaluate(follower.bodies.at(state.id), engine::Arithmetic::Double, list.at);
      ASSERT_EQ(mine, state.position) << "body " << state.id;
      ++compared;
    }
  }
  EXPECT_GT(compared, 10'000U);
  EXPECT_EQ(follower.gaps, 0U);
  EXPECT_EQ(follower.out_of_order, 0U);
  EXPECT_GT(follower.next_collision, 100U);

  const auto frame_topic = idl::make_topic(client.participant(), idl::kFrameTopic);
  auto frames = idl::make_reader(client.subscriber(), frame_topic, idl::kFrameTopic);
  std::map<std::uint64_t, std::size_t> rows;
  EXPECT_TRUE(WireClient::until(Seconds(10), [&] {
    frames.drain([&](const dds::Sample<wire::FrameChunk>& sample) {
      if (sample.valid()) rows[sample.data.tick] += sample.data.id._length;
    });
    return std::any_of(rows.begin(), rows.end(), [](auto& row) { return row.second == 10'000; });
  }));

  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

/// The rows of the latest frames, by body.
struct Frames {
  explicit Frames(WireClient& client)
      : topic(idl::make_topic(client.participant(), idl::kFrameTopic)),
        reader(idl::make_reader(client.subscriber(), topic, idl::kFrameTopic)) {}

  void take() {
    reader.drain([&](const dds::Sample<wire::FrameChunk>& sample) {
      if (!sample.valid()) return;
      const wire::FrameChunk& chunk = sample.data;
      for (std::size_t i = 0; i < chunk.id._length; ++i) {
        states[chunk.id._buffer[i]] = {.id = chunk.id._buffer[i],
                                       .instant = translate::to_engine(chunk.at),
                                       .position = {chunk.x._buffer[i], chunk.y._buffer[i]},
                                       .velocity = {chunk.vx._buffer[i], chunk.vy._buffer[i]},
                                       .angle = idl::at_or(chunk.angle, i, 0.0),
                                       .spin = idl::at_or(chunk.spin, i, 0.0)};
      }
    });
  }
  /// Waits until they tell what this one tells of each of its bodies.
  [[nodiscard]] bool come_to(const GotAnswer& list) {
    return WireClient::until(Seconds(10), [&] {
      take();
      return std::all_of(list.states.begin(), list.states.end(), [&](auto& state) {
        const engine::BodyState& mine = states[state.id];
        return mine.instant == list.at && mine.position == state.position &&
               mine.velocity == state.velocity && mine.angle == state.angle &&
               mine.spin == state.spin;
      });
    });
  }

  dds::Topic<wire::FrameChunk> topic;
  dds::Reader<wire::FrameChunk> reader;
  std::map<engine::Id, engine::BodyState> states;
};

TEST(DaemonPublishing, FramesTellWhatAListTells) {
  Process daemon(stossd(kDomain, {"--scene", scene("gas-10000"), "--paused"}));
  WireClient client(kDomain, "gas-10000", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  Frames frames(client);
  EXPECT_TRUE(frames.come_to(client.ask(Ask::kList)));
  // The last bodies, which are walls, take the places of those that go; one that comes turns.
  const engine::Vector2 place = frames.states[5].position;
  EXPECT_EQ(client.command(Op::kRemove, Targets({5, 500, 9000})).reject.code, Code::Ok);
  const GotReply spawned =
      client.command(Op::kSpawn, SpawnDisks({{.position = place, .radius = 0.5, .spin = 1}}));
  EXPECT_EQ(spawned.reject.code, Code::Ok) << spawned.reject.reason;
  EXPECT_EQ(client.command(Op::kRunTo,
                           [](auto& c) {
                             c.target = {1, 12345};
                           })
                .reject.code,
            Code::Ok);
  ASSERT_TRUE(WireClient::until(Seconds(20), [&] {
    const wire::Status status = client.status();
    return status.at.seconds == 1 && status.at.fraction == 12345;
  }));
  EXPECT_TRUE(frames.come_to(client.ask(Ask::kList)));
  // While the world stands still, too.
  EXPECT_EQ(client.command(Op::kSetVelocity, Targets({7}, {0.5}, {-0.25})).reject.code, Code::Ok);
  const GotAnswer changed = client.ask(Ask::kList);
  EXPECT_TRUE(frames.come_to(changed));
  EXPECT_EQ(frames.states[7].velocity, engine::Vector2(0.5, -0.25));
  EXPECT_EQ(changed.states.size(), 9998U);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

TEST(DaemonPublishing, ResetStartsANewEpochWithNumbersFromOne) {
  Process daemon(stossd(kDomain, {"--scene", scene("newtons-cradle"), "--speed", "20"}));
  WireClient client(kDomain, "newtons-cradle", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  Follower follower(client);
  ASSERT_TRUE(WireClient::until(Seconds(10), [&] { return follower.motion.writers() > 0; }));
  ASSERT_TRUE(WireClient::until(Seconds(10), [&] { return client.status().motion_number > 3; }));
  const GotReply reset = client.command(Op::kReset);
  ASSERT_EQ(reset.reject.code, Code::Ok);
  std::uint64_t first = 0;
  EXPECT_TRUE(WireClient::until(Seconds(10), [&] {
    follower.motion.drain([&](const dds::Sample<wire::MotionBatch>& sample) {
      if (sample.valid() && sample.data.epoch == reset.epoch && first == 0) {
        first = sample.data.number;
      }
    });
    return first != 0;
  }));
  EXPECT_EQ(first, 1U);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

TEST(DaemonPublishing, WatchedBodiesComeOneByOneUntilTheyAreGone) {
  Process daemon(stossd(kDomain, {"--scene", scene("tutorial"), "--paused"}));
  WireClient client(kDomain, "tutorial", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  const auto topic = idl::make_topic(client.participant(), idl::kBodyTopic);
  auto reader = idl::make_reader(client.subscriber(), topic, idl::kBodyTopic);
  ASSERT_TRUE(WireClient::until(Seconds(10), [&] { return reader.writers() > 0; }));
  EXPECT_EQ(client.command(Op::kWatch, Targets({1, 2})).reject.code, Code::Ok);
  std::set<engine::Id> seen;
  std::set<std::uint32_t> disposed;
  const auto look = [&] {
    reader.drain([&](const dds::Sample<wire::BodyState>& sample) {
      if (sample.valid()) seen.insert(sample.data.id);
      if (sample.disposed()) disposed.insert(sample.data.slot);
    });
  };
  EXPECT_TRUE(WireClient::until(Seconds(10), [&] {
    look();
    return seen.size() == 2;
  }));
  EXPECT_EQ(client.status().watched, 2U);
  client.command(Op::kRemove, Targets({1}));
  client.command(Op::kUnwatch, Targets({2}));
  EXPECT_TRUE(WireClient::until(Seconds(10), [&] {
    look();
    return disposed.size() == 2;
  }));
  EXPECT_EQ(client.status().watched, 0U);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

}  // namespace
}  // namespace stoss::tests

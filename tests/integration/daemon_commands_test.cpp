// SPDX-License-Identifier: Apache-2.0
// Every command and every refusal, through DDS, against a real daemon.
#include "daemon_client.hpp"
#include "daemon_process.hpp"

#include <cmath>
#include <limits>

namespace stoss::tests {
namespace {

using engine::Code;
using engine::Instant;
using idl::Ask;
using idl::Op;

constexpr unsigned kDomain = 60;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// One daemon with the tutorial's scene (disks 1 and 2, wall 3), paused.
class DaemonCommands : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(client.connect()) << daemon.log(); }
  void TearDown() override {
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0) << daemon.log();
  }

  std::uint64_t hash() { return client.status().state_hash; }

  struct Case {
    const char* what;
    Op op;
    WireClient::Fill fill;
    Code code;
    const char* field;
    engine::Id body = 0;
  };

  /// Each is refused with its code, field and body, and leaves the state's hash as it was.
  void refuses(const std::vector<Case>& cases) {
    const std::uint64_t before = hash();
    for (const Case& each : cases) {
      const GotReply reply = client.command(each.op, each.fill);
      EXPECT_EQ(reply.reject.code, each.code) << each.what << ": " << reply.reject.reason;
      EXPECT_EQ(reply.reject.field, each.field) << each.what;
      EXPECT_EQ(reply.reject.body, each.body) << each.what;
      EXPECT_FALSE(reply.reject.reason.empty()) << each.what;
    }
    EXPECT_EQ(hash(), before);
  }

  Process daemon{stossd(kDomain, {"--scene", scene("tutorial"), "--paused"})};
  WireClient client{kDomain, "tutorial", 1};
};

TEST_F(DaemonCommands, EachDoesWhatItSays) {
  const GotReply spawned =
      client.command(Op::kSpawn, SpawnDisks({{.position = {0, 5}, .radius = 0.25, .mass = 2}}));
  ASSERT_EQ(spawned.reject.code, Code::Ok) << spawned.reject.reason;
  ASSERT_EQ(spawned.ids.size(), 1U);
  const engine::Id id = spawned.ids[0];
  EXPECT_EQ(id, 4U);
  EXPECT_EQ(spawned.at, Instant{});

  EXPECT_EQ(client.command(Op::kSetVelocity, Targets({id}, {0.5}, {0})).reject.code, Code::Ok);
  EXPECT_EQ(client.command(Op::kApplyImpulse, Targets({id}, {0}, {4})).reject.code, Code::Ok);
  GotAnswer state = client.ask(Ask::kStates, Targets({id}));
  ASSERT_EQ(state.states.size(), 1U);
  EXPECT_EQ(state.states[0].velocity, engine::Vector2(0.5, 2));
  EXPECT_EQ(state.states[0].radius, 0.25);

  EXPECT_EQ(client.command(Op::kStep, [](auto& c) { c.count = 30; }).reject.code, Code::Ok);
  ASSERT_TRUE(client.until(WireClient::Seconds(10), [&] {
    const wire::Status status = client.status();
    return status.tick == 30 && status.state == stoss_v1_STATE_PAUSED;
  }));
  state = client.ask(Ask::kStates, Targets({id}));
  EXPECT_EQ(state.at, (Instant{0, std::uint64_t{1} << 63U}));
  EXPECT_EQ(state.states[0].position, engine::Vector2(0.25, 6));

  EXPECT_EQ(client.command(Op::kRunFor, [](auto& c) { c.value = 0.125; }).reject.code, Code::Ok);
  ASSERT_TRUE(client.until(WireClient::Seconds(10),
                           [&] { return client.status().at.fraction == std::uint64_t{5} << 61U; }));
  EXPECT_EQ(client.command(Op::kRunTo, [](auto& c) { c.target = {1, 0}; }).reject.code, Code::Ok);
  ASSERT_TRUE(
      client.until(WireClient::Seconds(10), [&] { return client.status().at.seconds == 1; }));

  EXPECT_EQ(client.command(Op::kSetSpeed, [](auto& c) { c.value = 2; }).reject.code, Code::Ok);
  EXPECT_EQ(client.status().speed_asked, 2);
  EXPECT_EQ(client.command(Op::kResume).reject.code, Code::Ok);
  EXPECT_EQ(client.status().state, stoss_v1_STATE_RUNNING);
  EXPECT_EQ(client.command(Op::kPause).reject.code, Code::Ok);
  EXPECT_EQ(client.status().state, stoss_v1_STATE_PAUSED);

  EXPECT_EQ(client.command(Op::kRemove, Targets({id})).reject.code, Code::Ok);
  EXPECT_EQ(client.ask(Ask::kStates, Targets({id})).reject.code, Code::NotFound);
  const std::uint64_t epoch = client.status().epoch;
  const GotReply reset = client.command(Op::kReset);
  EXPECT_EQ(reset.reject.code, Code::Ok);
  EXPECT_EQ(reset.epoch, epoch + 1);
  EXPECT_EQ(reset.at, Instant{});
}

SpawnDisks disk(const engine::DiskSpec& spec) { return SpawnDisks({spec}); }

TEST_F(DaemonCommands, RefuseBadDisks) {
  const auto placed = [](double x, double y) {
    engine::DiskSpec spec;
    spec.position = {x, y};
    spec.radius = 0.25;
    return spec;
  };
  engine::DiskSpec flat = placed(0, 9);
  flat.id = 9;
  flat.radius = 0;
  engine::DiskSpec light = placed(0, 9);
  light.mass = -1;
  engine::DiskSpec used = placed(0, 9);
  used.id = 2;
  refuses({
      {"x not finite", Op::kSpawn, disk(placed(kNan, 0)), Code::InvalidArgument, "disks.position"},
      {"radius 0", Op::kSpawn, disk(flat), Code::InvalidArgument, "disks.radius", 9},
      {"mass below 0", Op::kSpawn, disk(light), Code::InvalidArgument, "disks.mass"},
      {"id in use", Op::kSpawn, disk(used), Code::AlreadyExists, "disks.id", 2},
      {"overlap", Op::kSpawn, disk(placed(0.5, 0)), Code::Overlap, "disks"},
      {"nothing to make", Op::kSpawn, {}, Code::InvalidArgument, "disks"},
  });
}

TEST_F(DaemonCommands, RefuseBadTargets) {
  refuses({
      {"unknown id", Op::kRemove, Targets({77}), Code::NotFound, "ids", 77},
      {"a body twice", Op::kRemove, Targets({1, 1}), Code::InvalidArgument, "ids", 1},
      {"no body", Op::kRemove, {}, Code::InvalidArgument, "ids"},
      {"velocity not finite",
       Op::kSetVelocity,
       Targets({1}, {kNan}, {0}),
       Code::InvalidArgument,
       "velocities.value",
       1},
      {"impulse on a wall",
       Op::kApplyImpulse,
       Targets({3}, {1}, {0}),
       Code::FailedPrecondition,
       "impulses.id",
       3},
      {"arrays that differ",
       Op::kSetVelocity,
       Targets({1, 2}, {1}, {1, 2}),
       Code::InvalidArgument,
       "x"},
      {"watching nobody", Op::kWatch, Targets({5}), Code::NotFound, "ids", 5},
  });
}

TEST_F(DaemonCommands, RefuseMalformedBlocks) {
  static const std::vector<double> kZero = {0.0};
  static const std::vector<double> kOne = {1.0};
  static const std::vector<std::uint8_t> kBadKind = {7};
  const auto short_disk = [](wire::Command& c) {
    idl::lend(c.disks.x, kZero);
    idl::lend(c.disks.y, kZero);
  };
  const auto bad_kind = [=](wire::Command& c) {
    short_disk(c);
    idl::lend(c.disks.radius, kOne);
    idl::lend(c.disks.kind, kBadKind);
  };
  const auto point_wall = [](wire::Command& c) {
    idl::lend(c.walls.start_x, kOne);
    idl::lend(c.walls.start_y, kOne);
    idl::lend(c.walls.end_x, kOne);
    idl::lend(c.walls.end_y, kOne);
  };
  const auto short_zone = [](wire::Command& c) {
    idl::lend(c.zones.x, kOne);
    idl::lend(c.zones.y, kOne);
  };
  const auto point_zone = [=](wire::Command& c) {
    short_zone(c);
    idl::lend(c.zones.radius, kZero);
  };
  refuses({
      {"arrays that differ", Op::kSpawn, short_disk, Code::InvalidArgument, "disks.radius"},
      {"unknown kind", Op::kSpawn, bad_kind, Code::InvalidArgument, "disks.kind"},
      {"wall of no length", Op::kSpawn, point_wall, Code::InvalidArgument, "walls.end"},
      {"zone arrays that differ", Op::kSpawn, short_zone, Code::InvalidArgument, "zones.radius"},
      {"zone of no size", Op::kSpawn, point_zone, Code::InvalidArgument, "zones.radius"},
  });
}

TEST_F(DaemonCommands, RefuseWhatCannotBe) {
  const auto past = [](wire::Command& c) {
    c.timed = true;
    c.at = {-1, 0};
  };
  const auto other_protocol = [](wire::Command& c) { c.protocol = 2; };
  const auto back = [](wire::Command& c) { c.target = {-1, 0}; };
  refuses({
      {"in the past", Op::kPause, past, Code::DeadlinePassed, "at"},
      {"other protocol", Op::kPause, other_protocol, Code::Unimplemented, "protocol"},
      {"unknown operation", Op{999}, {}, Code::Unimplemented, "op"},
      {"snapshot", Op::kSnapshot, {}, Code::Unimplemented, "op"},
      {"restore", Op::kRestore, {}, Code::Unimplemented, "op"},
      {"speed 0", Op::kSetSpeed, {}, Code::InvalidArgument, "value"},
      {"no ticks", Op::kStep, {}, Code::InvalidArgument, "count"},
      {"no time", Op::kRunFor, {}, Code::InvalidArgument, "value"},
      {"back in time", Op::kRunTo, back, Code::DeadlinePassed, "target"},
  });
  client.send(Op::kPause, [](wire::Command& c) { c.request.number = 0; });
  const auto reply = client.reply(0);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->reject.code, Code::InvalidArgument);
  EXPECT_EQ(reply->reject.field, "request.number");
}

TEST_F(DaemonCommands, OverlapTellsWithWhomAndByHowMuch) {
  const GotReply reply =
      client.command(Op::kSpawn, SpawnDisks({{.position = {0.5, 0}, .radius = 0.25}}));
  EXPECT_EQ(reply.reject.code, Code::Overlap);
  EXPECT_EQ(reply.reject.other, 1U);
  EXPECT_NEAR(reply.reject.clearance, -0.25, 1e-15);
}

TEST_F(DaemonCommands, ACommandOnManyBodiesIsDoneInWholeOrNotAtAll) {
  const std::uint64_t before = hash();
  const GotReply reply = client.command(
      Op::kSpawn,
      SpawnDisks({{.position = {0, 9}, .radius = 0.5}, {.position = {0, 9.5}, .radius = 0.5}}));
  EXPECT_EQ(reply.reject.code, Code::Overlap);
  EXPECT_EQ(reply.reject.index, 1U);
  EXPECT_EQ(hash(), before);
}

TEST_F(DaemonCommands, ACommandOfTheLargestSizeWorksAndALargerOneIsNeverSent) {
  std::vector<engine::DiskSpec> disks;
  for (std::size_t i = 0; i < stoss_v1_MAX_COMMAND_BODIES; ++i) {
    disks.push_back({.position = {static_cast<double>(i), 100}, .radius = 0.25});
  }
  const GotReply reply = client.command(Op::kSpawn, SpawnDisks(disks));
  EXPECT_EQ(reply.reject.code, Code::Ok) << reply.reject.reason;
  EXPECT_EQ(reply.ids.size(), disks.size());
  disks.push_back({.position = {-5, 100}, .radius = 0.25});
  client.send(Op::kSpawn, SpawnDisks(disks));
  EXPECT_FALSE(client.sent()) << "DDS itself keeps to the bounds of the types";
}

TEST_F(DaemonCommands, DuplicatesGetTheSameReplyAgain) {
  const SpawnDisks spawn({{.position = {0, 9}, .radius = 0.5}});
  const GotReply first = client.command(Op::kSpawn, spawn);
  client.send(first.number, Op::kSpawn, spawn);
  ASSERT_TRUE(client.until(WireClient::Seconds(10),
                           [&] { return client.replies(first.number).size() == 2; }));
  const GotReply second = client.replies(first.number)[1];
  EXPECT_FALSE(first.duplicate);
  EXPECT_TRUE(second.duplicate);
  EXPECT_EQ(second.ids, first.ids);
  EXPECT_EQ(second.at, first.at);
  EXPECT_EQ(client.status().bodies, 3U);
  EXPECT_EQ(client.status().duplicates, 1U);
}

TEST_F(DaemonCommands, NamesReachTheScene) {
  std::vector<wire::Name> names(1);
  names[0].of = 0;
  idl::assign(names[0].text, "newcomer");
  const SpawnDisks spawn({{.position = {0, 9}, .radius = 0.5}});
  const GotReply reply = client.command(Op::kSpawn, [&](auto& c) {
    spawn(c);
    idl::lend(c.names, names);
  });
  ASSERT_EQ(reply.reject.code, Code::Ok);
  const auto topic = idl::make_topic(client.participant(), idl::kSceneTopic);
  auto reader = idl::make_reader(client.subscriber(), topic, idl::kSceneTopic);
  EXPECT_TRUE(WireClient::until(WireClient::Seconds(10), [&] {
    bool found = false;
    reader.drain([&](const dds::Sample<wire::SceneChunk>& sample) {
      if (!sample.valid()) return;
      for (const wire::Name& name : idl::view(sample.data.names)) {
        found = found || (name.of == reply.ids[0] && idl::text(name.text) == "newcomer");
      }
    });
    return found;
  }));
}

}  // namespace
}  // namespace stoss::tests

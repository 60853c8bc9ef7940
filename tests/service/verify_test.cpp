// SPDX-License-Identifier: Apache-2.0
// --verify in the daemon: the figures in the status, the line in the log, and the same bytes.
#include "fixture.hpp"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>

namespace stoss::service::testing {
namespace {

using engine::Id;

/// What the daemon logs, while this lives.
class LogCapture {
 public:
  LogCapture() : before_(spdlog::default_logger()) {
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(
        "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_, /*force_flush=*/true)));
  }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;
  ~LogCapture() { spdlog::set_default_logger(before_); }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> before_;
};

class Verify : public SimulationTest {
 protected:
  /// Five disks on a line between two walls, and a third that closes in slowly.
  static translate::SceneBodies shuttle() {
    translate::SceneBodies scene;
    for (int i = 0; i < 5; ++i) {
      scene.disks.push_back({.id = static_cast<Id>(i + 1),
                             .position = {2.0 * i, 0.01 * i},
                             .velocity = {i % 2 == 0 ? 5.0 : -3.0, 0.1},
                             .radius = 0.5,
                             .mass = 1.0 + i});
    }
    scene.walls.push_back({.id = 10, .start = {-2, -50}, .end = {-2, 50}});
    scene.walls.push_back({.id = 11, .start = {20, -50}, .end = {20, 50}, .velocity = {-0.1, 0}});
    scene.disk_names.resize(5);
    scene.wall_names.resize(2);
    return scene;
  }

  WorldStatus last_status() {
    translate::QuerySpec status;
    status.op = idl::wire_value(idl::Ask::kStatus);
    ask(9, ++asked_, status);
    settle();
    return told().statuses.back();
  }

 private:
  std::uint64_t asked_ = 0;
};

TEST_F(Verify, IsToldInTheStatusAndChangesNoByte) {
  begin({}, shuttle());
  run(3);
  const WorldStatus plain = last_status();
  EXPECT_EQ(plain.verify_period, 0U);
  EXPECT_EQ(plain.verified.checks, 0U);

  clock.set(Nanoseconds{1'000'000'000});
  begin({.verify = 7}, shuttle());
  run(3);
  const WorldStatus verified = last_status();
  EXPECT_EQ(verified.moment.tick, plain.moment.tick);
  EXPECT_EQ(verified.events, plain.events);
  EXPECT_EQ(verified.state_hash, plain.state_hash);
  EXPECT_EQ(verified.verify_period, 7U);
  EXPECT_EQ(verified.verified.checks, verified.events / 7);
  EXPECT_GT(verified.verified.checks, 2U);
  EXPECT_EQ(verified.verified.overlaps, 0U);
  EXPECT_EQ(verified.verified.missed, 0U);
  EXPECT_LT(verified.verified.energy_error, 1e-15) << "the wall's work is no drift";
}

TEST_F(Verify, CommandsAreNoDriftAndAResetForgetsNothing) {
  const LogCapture log;
  begin({.verify = 1}, shuttle());
  run(0.5);
  send(1, 1, set_velocity(1, 50, 1));
  send(1, 2, set_velocity(77, 1, 1));  // refused
  translate::CommandSpec kick = set_velocity(2, 30, 0);
  kick.op = idl::wire_value(idl::Op::kApplyImpulse);
  send(1, 3, kick);
  translate::CommandSpec remove = make(idl::Op::kRemove);
  remove.ids = {3};
  send(1, 4, remove);
  translate::CommandSpec anvil = spawn_at(4, 30, 1);
  anvil.disks[0].kind = engine::BodyKind::Static;
  send(1, 5, anvil);
  send(1, 6, spawn_at(0, 40));
  run(2);
  const WorldStatus before = last_status();
  EXPECT_GT(before.verified.checks, 10U);
  EXPECT_LT(before.verified.energy_error, 1e-14);
  EXPECT_LT(before.verified.momentum_error, 1e-14);
  send(1, 7, make(idl::Op::kReset));
  run(1);
  const WorldStatus after = last_status();
  EXPECT_EQ(after.moment.epoch, before.moment.epoch + 1);
  EXPECT_GT(after.verified.checks, before.verified.checks);
  EXPECT_LT(after.verified.energy_error, 1e-14);
  EXPECT_EQ(log.text().find("verification"), std::string::npos) << log.text();
}

/// The scene's world with disk 5 laid over disk 4: no command leads there, damaged bytes do.
engine::World damaged(const translate::SceneBodies& scene) {
  engine::World world = translate::make_world(scene, {}).value().world;
  std::vector<std::byte> bytes = world.serialise();
  // The end of 8.0 as a double; 2^-509 in its place brings the fifth disk to the first's place.
  const std::array<std::byte, 2> eight{std::byte{0x20}, std::byte{0x40}};
  const auto place = std::search(bytes.begin(), bytes.end(), eight.begin(), eight.end());
  *(place + 1) = std::byte{0x20};
  return engine::World::deserialise(bytes).value();
}

TEST_F(Verify, AFaultIsAnErrorInTheLogAndStaysInTheStatus) {
  const LogCapture log;
  translate::SceneBodies scene = shuttle();
  scene.disks[0].velocity = scene.disks[4].velocity = {0, 0};
  translate::SceneWorld world{damaged(scene), {1, 2, 3, 4, 5, 10, 11}};
  ASSERT_EQ(world.world.census().overlaps, 1U);
  const SimulationOptions options{.verify = 1};
  simulation = std::make_unique<Simulation>(
      scene, std::move(world), options, clock, inbox, outbox, forecaster);
  run(2);
  const WorldStatus status = last_status();
  EXPECT_GT(status.verified.overlaps, 0U);
  EXPECT_GT(status.verified.deepest, 0.5);
  EXPECT_NE(log.text().find("[error]"), std::string::npos) << log.text();
  EXPECT_NE(log.text().find("overlaps"), std::string::npos) << log.text();
}

}  // namespace
}  // namespace stoss::service::testing

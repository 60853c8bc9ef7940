// SPDX-License-Identifier: Apache-2.0
// The daemon as a process: its exit statuses, its signals, its neighbours.
#include "daemon_process.hpp"

#include "daemon_client.hpp"

namespace stoss::tests {
namespace {

using engine::Code;
using idl::Ask;
using idl::Op;
using Seconds = WireClient::Seconds;

constexpr unsigned kDomain = 63;

int exit_status(std::vector<std::string> options) {
  Process process(stossd(kDomain, std::move(options)));
  return process.wait().value_or(-1);
}

std::string temporary_file(const std::string& name, const std::string& content) {
  std::string path = ::testing::TempDir() + std::to_string(getpid()) + name;
  std::ofstream(path) << content;
  return path;
}

TEST(DaemonProcess, ExitStatusTellsWhatWasWrong) {
  EXPECT_EQ(exit_status({}), 64);
  EXPECT_EQ(exit_status({"--no-such-option"}), 64);
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--speed", "0"}), 64);
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--tick-rate", "-1"}), 64);
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--world", "a b"}), 64);
  EXPECT_EQ(exit_status({"--scene", "/no/such/scene.json"}), 65);
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--interface", "eth0"}), 78);
  EXPECT_EQ(exit_status({"--help"}), 0);
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--check-config"}), 0);
}

TEST(DaemonProcess, RefusesASceneByNameAndReason) {
  const std::string overlap = temporary_file(
      "overlap.json",
      R"({"disks": [{"position": {"x": 0}, "radius": 1}, {"position": {"x": 1}, "radius": 1}]})");
  Process overlapping(stossd(kDomain, {"--scene", overlap}));
  EXPECT_EQ(overlapping.wait(), 65);
  EXPECT_NE(overlapping.log().find("OVERLAP"), std::string::npos) << overlapping.log();

  const std::string curved =
      temporary_file("curved.json",
                     R"({"effects": {"gravity": {"acceleration": {"y": -1}}, )"
                     R"("floor_friction": {"deceleration": 1}}})");
  Process falling(stossd(kDomain, {"--scene", curved}));
  EXPECT_EQ(falling.wait(), 65);
  EXPECT_NE(falling.log().find("UNIMPLEMENTED: effects.floor_friction"), std::string::npos)
      << falling.log();
  unlink(overlap.c_str());
  unlink(curved.c_str());
}

TEST(DaemonProcess, TakesOptionsFromAFile) {
  const std::string good = temporary_file("good.conf", "tick-rate = 120\npaused = true\n");
  const std::string bad = temporary_file("bad.conf", "tick-rat = 120\n");
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--config", bad}), 78);
  EXPECT_EQ(exit_status({"--scene", scene("tutorial"), "--config", "/no/such/file"}), 78);
  EXPECT_EQ(exit_status({"--scene",
                         scene("tutorial"),
                         "--check-config",
                         "--config",
                         STOSS_SCENE_DIR "/../../deploy/stossd.conf"}),
            0);
  Process daemon(stossd(kDomain, {"--scene", scene("tutorial"), "--config", good}));
  WireClient client(kDomain, "tutorial", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  EXPECT_EQ(client.status().tick_rate, 120);
  EXPECT_EQ(client.status().state, stoss_v1_STATE_PAUSED);
  unlink(good.c_str());
  unlink(bad.c_str());
}

TEST(DaemonProcess, StopsOnSigtermAndAnswersWhatWaits) {
  Process daemon(stossd(kDomain, {"--scene", scene("tutorial")}));
  WireClient client(kDomain, "tutorial", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  const auto topic = idl::make_topic(client.participant(), idl::kStatusTopic);
  auto statuses = idl::make_reader(client.subscriber(), topic, idl::kStatusTopic);
  ASSERT_TRUE(WireClient::until(Seconds(10), [&] { return statuses.writers() > 0; }));
  const std::uint64_t waiting = client.send(Op::kPause, [](auto& c) {
    c.timed = true;
    c.at = {1'000'000, 0};
  });
  // A reply to a later request shows that this one has arrived.
  ASSERT_EQ(client.command(Op::kSetSpeed, [](auto& c) { c.value = 1; }).reject.code, Code::Ok);
  daemon.signal(SIGTERM);
  const auto reply = client.reply(waiting);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->reject.code, Code::Unavailable);
  EXPECT_EQ(daemon.wait(milliseconds(5000)), 0) << daemon.log();
  bool stopped = false;
  WireClient::until(Seconds(2), [&] {
    statuses.drain([&](const dds::Sample<wire::Status>& sample) {
      stopped = stopped || (sample.valid() && sample.data.state == stoss_v1_STATE_STOPPED);
    });
    return stopped;
  });
  EXPECT_TRUE(stopped);
}

TEST(DaemonProcess, ASecondWorldOfTheSameNameIsRefusedAndAnotherNameIsNot) {
  Process first(stossd(kDomain, {"--scene", scene("tutorial"), "--paused"}));
  WireClient client(kDomain, "tutorial", 1);
  ASSERT_TRUE(client.connect()) << first.log();
  Process same(stossd(kDomain, {"--scene", scene("newtons-cradle"), "--world", "tutorial"}));
  EXPECT_EQ(same.wait(), 75);
  EXPECT_NE(same.log().find("\"tutorial\""), std::string::npos) << same.log();

  Process second(stossd(kDomain, {"--scene", scene("newtons-cradle"), "--paused"}));
  WireClient other(kDomain, "newtons-cradle", 1);  // the same client id in another world
  ASSERT_TRUE(other.connect()) << second.log();
  EXPECT_EQ(client.status().bodies, 2U);
  EXPECT_EQ(other.status().bodies, 6U);
  client.command(Op::kRemove, Targets({1}));
  EXPECT_EQ(client.status().bodies, 1U);
  EXPECT_EQ(other.status().bodies, 6U);

  // The name is free again as soon as its daemon is gone, however it went.
  first.signal(SIGKILL);
  first.wait();
  Process next(stossd(kDomain, {"--scene", scene("tutorial"), "--paused"}));
  // The first questions may find nobody.
  EXPECT_TRUE(WireClient::until(Seconds(10), [&] {
    const GotAnswer got = client.ask(Ask::kStatus, {}, Seconds(0.5));
    return got.status && got.status->pid == static_cast<std::uint32_t>(next.pid());
  })) << next.log();
}

}  // namespace
}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// A daemon whose thread cannot go on: it says so, and every thread is joined, whoever asks.
#include <daemon.hpp>
#include <exit_codes.hpp>
#include <gtest/gtest.h>

#include <cfenv>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

namespace stoss::service {
namespace {

constexpr std::uint32_t kDomain = 68;

std::unique_ptr<Daemon> make_daemon() {
  DaemonOptions options;
  options.domain = kDomain;
  options.network.role = dds::Role::kDaemon;
  options.publication.world = "failing";
  translate::SceneBodies scene;
  scene.disks.push_back({.id = 1, .velocity = {1, 0}, .radius = 0.5});
  scene.disk_names.emplace_back("ball");
  auto world = translate::make_world(scene, options.simulation.choice);
  return std::make_unique<Daemon>(options, std::move(scene), std::move(world).value());
}

/// Threads inherit the rounding mode of who starts them, and the world's refuses this one.
class WrongRounding {
 public:
  WrongRounding() { std::fesetround(FE_UPWARD); }
  WrongRounding(const WrongRounding&) = delete;
  WrongRounding& operator=(const WrongRounding&) = delete;
  ~WrongRounding() { std::fesetround(FE_TONEAREST); }
};

bool fails_soon(const Daemon& daemon) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (daemon.failure() == 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return daemon.failure() != 0;
}

TEST(DaemonFailure, AThreadThatCannotGoOnIsToldAndAllAreJoined) {
  for (const bool stops_first : {true, false}) {
    const auto daemon = make_daemon();
    {
      const WrongRounding wrong;
      daemon->start();
    }
    ASSERT_TRUE(fails_soon(*daemon));
    EXPECT_EQ(daemon->failure(), kExitInvariant);
    if (stops_first) daemon->stop();  // otherwise its end has to do it
  }
}

TEST(DaemonFailure, OneThatNeverStartedOrIsStoppedTwiceEndsInPeace) {
  make_daemon();
  const auto daemon = make_daemon();
  daemon->start();
  daemon->stop();
  daemon->stop();
  EXPECT_EQ(daemon->failure(), 0);
}

TEST(DaemonFailure, AtOnceAfterTheStartEveryThreadIsStopped) {
  for (int i = 0; i < 20; ++i) make_daemon()->start();
}

}  // namespace
}  // namespace stoss::service

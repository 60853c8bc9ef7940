// SPDX-License-Identifier: Apache-2.0
// Clients that behave badly: they flood, stop reading, die. Nobody else notices.
#include "daemon_client.hpp"
#include "daemon_process.hpp"

#include <set>

namespace stoss::tests {
namespace {

using engine::Code;
using idl::Ask;
using idl::Op;
using Seconds = WireClient::Seconds;

constexpr unsigned kDomain = 64;

TEST(DaemonLoad, AFloodIsAnsweredInFullAndAppliedOnce) {
  Process daemon(stossd(kDomain, {"--world", "flooded"}));
  WireClient flood(kDomain, "flooded", 1);
  WireClient other(kDomain, "flooded", 2);
  ASSERT_TRUE(flood.connect()) << daemon.log();
  ASSERT_TRUE(other.connect());
  constexpr std::uint64_t kCommands = 20'000;
  const auto spawn = [](std::uint64_t number) {
    return SpawnDisks({{.position = {3.0 * static_cast<double>(number), 0}, .radius = 1}});
  };
  const auto began = std::chrono::steady_clock::now();
  for (std::uint64_t number = 1; number <= kCommands; ++number) {
    flood.send(number, Op::kSpawn, spawn(number));
    if (number % 2000 == 0) {
      const GotReply reply = other.command(Op::kSetSpeed, [](auto& c) { c.value = 1; });
      EXPECT_EQ(reply.reject.code, Code::Ok) << "the others are served during the flood";
    }
  }
  // What was not answered is asked for again, under its number, as clients do.
  for (int round = 0; round < 20 && flood.replied() < kCommands; ++round) {
    std::this_thread::sleep_for(milliseconds(300));
    for (std::uint64_t number = 1; number <= kCommands; ++number) {
      if (flood.replies(number).empty()) flood.send(number, Op::kSpawn, spawn(number));
    }
  }
  const Seconds took = std::chrono::steady_clock::now() - began;
  EXPECT_EQ(flood.replied(), kCommands);
  std::uint64_t done = 0;
  std::set<engine::Id> ids;
  for (std::uint64_t number = 1; number <= kCommands; ++number) {
    const std::vector<GotReply> replies = flood.replies(number);
    ASSERT_FALSE(replies.empty());
    for (const GotReply& reply : replies) {
      EXPECT_EQ(reply.reject.code, replies[0].reject.code) << "two replies that differ";
    }
    if (replies[0].reject.code == Code::Ok) {
      ++done;
      ids.insert(replies[0].ids.begin(), replies[0].ids.end());
    }
  }
  const wire::Status status = other.status();
  EXPECT_EQ(ids.size(), done);
  EXPECT_EQ(status.bodies, done);
  std::printf("flood: %llu of %llu done, %llu refused for want of room, %llu duplicates, %.2f s\n",
              static_cast<unsigned long long>(done),
              static_cast<unsigned long long>(kCommands),
              static_cast<unsigned long long>(status.queue_full),
              static_cast<unsigned long long>(status.duplicates),
              took.count());
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

TEST(DaemonLoad, StoppedAndKilledSubscribersChangeNothingForTheOthers) {
  Process daemon(stossd(kDomain, {"--scene", scene("gas-10000")}));
  WireClient client(kDomain, "gas-10000", 1);
  ASSERT_TRUE(client.connect()) << daemon.log();
  const auto topic = idl::make_topic(client.participant(), idl::kMotionTopic);
  auto motions = idl::make_reader(client.subscriber(), topic, idl::kMotionTopic);
  std::uint64_t last = 0;
  std::uint64_t gaps = 0;
  const auto look = [&] {
    motions.drain([&](const dds::Sample<wire::MotionBatch>& sample) {
      if (!sample.valid()) return;
      if (last != 0 && sample.data.number != last + 1) ++gaps;
      last = sample.data.number;
    });
  };
  const std::vector<std::string> command = {STOSS_SUBSCRIBER, std::to_string(kDomain), "gas-10000"};
  Process stopped(command);
  Process killed(command);
  const auto connected = [](const Process& process) {
    return process.log().find("connected") != std::string::npos;
  };
  ASSERT_TRUE(
      WireClient::until(Seconds(10), [&] { return connected(stopped) && connected(killed); }));
  ASSERT_TRUE(WireClient::until(Seconds(10), [&] {
    look();
    return last != 0;
  }));

  stopped.signal(SIGSTOP);
  killed.signal(SIGKILL);
  const wire::Status before = client.status();
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  while (std::chrono::steady_clock::now() < until) {
    look();
    std::this_thread::sleep_for(milliseconds(1));
  }
  const wire::Status after = client.status();
  std::printf("in %.2f s: %llu ticks, %llu late, %llu slipped, largest gap count %llu\n",
              after.uptime - before.uptime,
              static_cast<unsigned long long>(after.tick - before.tick),
              static_cast<unsigned long long>(after.ticks_late - before.ticks_late),
              static_cast<unsigned long long>(after.ticks_slipped - before.ticks_slipped),
              static_cast<unsigned long long>(gaps));
  EXPECT_EQ(gaps, 0U);
  EXPECT_EQ(after.dropped, before.dropped);
  // A tick that waited for a subscriber would wait for seconds; a busy machine costs a few.
  const double ticks = static_cast<double>(after.tick - before.tick);
  EXPECT_GT(ticks, 0.8 * 60 * (after.uptime - before.uptime));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(milliseconds(5000)), 0) << daemon.log();
}

}  // namespace
}  // namespace stoss::tests

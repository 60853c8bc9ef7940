// SPDX-License-Identifier: Apache-2.0
// The whole house at once: stossd on the gas of 10,000 disks at 60 Hz, and twenty clients, each a
// process, that spawn, command and ask, while one subscriber is stopped and one is killed.
#include "client_child.hpp"
#include "daemon_process.hpp"

#include <stoss/client/session.hpp>

#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

using client::Command;
using client::Milliseconds;
using client::Query;
using client::Session;
using client::Status;

constexpr unsigned kDomain = 82;
constexpr unsigned kClients = 20;
constexpr const char* kSeconds = "8";
constexpr Milliseconds kPatience{40'000};

struct Findings {
  std::map<std::string, std::uint64_t> value;
  std::map<std::uint64_t, std::uint64_t> blocks;  ///< digests of collisions, by thousands
  std::map<std::uint64_t, std::uint64_t> hashes;  ///< state hashes, by batch number
};

std::vector<std::string> mock(const std::string& index) {
  return {STOSS_MOCK_CLIENT, std::to_string(kDomain), "e2e", index, kSeconds};
}

/// True when the two tables agree wherever both have an entry; counts those.
bool agree(const std::map<std::uint64_t, std::uint64_t>& a,
           const std::map<std::uint64_t, std::uint64_t>& b,
           std::uint64_t& common) {
  for (const auto& [key, value] : a) {
    const auto found = b.find(key);
    if (found == b.end()) continue;
    if (found->second != value) return false;
    ++common;
  }
  return true;
}

class EndToEnd : public testing::Test {
 protected:
  void start_clients() {
    for (unsigned i = 0; i < kClients; ++i) {
      clients_.push_back(std::make_unique<Child>(mock(std::to_string(i))));
    }
    stopped_ = std::make_unique<Child>(mock("listener"));
    killed_ = std::make_unique<Child>(mock("listener"));
    for (const auto& client : clients_) {
      ASSERT_EQ(client->hear(kPatience).value_or("nothing"), "ready") << daemon_.log();
    }
    ASSERT_EQ(stopped_->hear(kPatience).value_or("nothing"), "ready");
    ASSERT_EQ(killed_->hear(kPatience).value_or("nothing"), "ready");
  }

  void run_load() {
    for (const auto& client : clients_) client->say("go");
    std::this_thread::sleep_for(milliseconds(1000));
    stopped_->signal(SIGSTOP);
    std::this_thread::sleep_for(milliseconds(1000));
    killed_->signal(SIGKILL);
    for (const auto& client : clients_) {
      ASSERT_EQ(client->hear(kPatience).value_or("nothing"), "loaded") << daemon_.log();
    }
  }

  Status pause_and_check(Session& session) {
    EXPECT_TRUE(session.command(Command::pause()).ok());
    // The pause's own record may follow its reply; two statuses that agree have seen it.
    Status status = *session.ask(Query::status()).value().status;
    for (Status next = status;; status = next) {
      std::this_thread::sleep_for(milliseconds(100));
      next = *session.ask(Query::status()).value().status;
      if (next.motion_number == status.motion_number && next.at == status.at) break;
    }
    for (const auto& client : clients_) {
      client->say("check " + std::to_string(status.epoch) + ' ' +
                  std::to_string(status.motion_number));
    }
    return status;
  }

  static Findings findings_of(Child& client) {
    Findings findings;
    for (;;) {
      const auto line = client.hear(kPatience);
      EXPECT_TRUE(line) << "a client has gone silent";
      if (!line || *line == "end") return findings;
      std::istringstream words(*line);
      std::string key;
      std::uint64_t first = 0;
      std::uint64_t second = 0;
      words >> key >> first >> second;
      if (key == "block") {
        findings.blocks[first] = second;
      } else if (key == "hash") {
        findings.hashes[first] = second;
      } else {
        findings.value[key] = first;
      }
    }
  }

  static void check(const Findings& findings, const Status& status) {
    const auto& value = findings.value;
    EXPECT_GT(value.at("sent"), 50U);
    EXPECT_EQ(value.at("answered"), value.at("sent")) << "every command, once";
    EXPECT_EQ(value.at("unanswered"), 0U);
    EXPECT_EQ(value.at("wrong_instant"), 0U);
    EXPECT_EQ(value.at("wrong_code"), 0U);
    EXPECT_EQ(value.at("questions_failed"), 0U);
    EXPECT_GT(value.at("collisions"), 1000U);
    EXPECT_EQ(value.at("collisions_out_of_order"), 0U);
    EXPECT_EQ(value.at("collisions_lost"), 0U);
    EXPECT_EQ(value.at("collision_last"), status.collision_number);
    EXPECT_EQ(value.at("final_differences"), 0U) << "replica, sent world and world itself";
    EXPECT_EQ(value.at("frames_different"), 0U);
    EXPECT_EQ(value.at("answers_different"), 0U);
    EXPECT_GT(value.at("answers_equal"), 5U);
    EXPECT_EQ(value.at("contradictions"), 0U);
    EXPECT_EQ(value.at("last_number"), status.motion_number);
  }

  static void report(const std::vector<Findings>& all) {
    std::map<std::string, std::uint64_t> sum;
    for (const Findings& findings : all) {
      for (const auto& [key, value] : findings.value) sum[key] += value;
    }
    for (const char* key : {"sent",
                            "ok",
                            "overlap",
                            "not_found",
                            "deadline_passed",
                            "retries",
                            "stray_replies",
                            "collisions",
                            "collision_gaps",
                            "frames_equal",
                            "answers_equal",
                            "ticks",
                            "loads",
                            "replica_gaps"}) {
      std::printf("  %-16s %llu\n", key, static_cast<unsigned long long>(sum[key]));
    }
  }

  Process daemon_{stossd(kDomain, {"--scene", scene("gas-10000"), "--world", "e2e"})};
  std::vector<std::unique_ptr<Child>> clients_;
  std::unique_ptr<Child> stopped_;
  std::unique_ptr<Child> killed_;
};

TEST_F(EndToEnd, TwentyClientsAndTheDaemonAgreeOnEveryBit) {
  Session session({.world = "e2e", .domain = kDomain, .timeout = kPatience, .network = {}});
  const std::uint64_t commands_before = session.first_status().commands;
  ASSERT_NO_FATAL_FAILURE(start_clients());
  const Status begun = *session.ask(Query::status()).value().status;
  ASSERT_NO_FATAL_FAILURE(run_load());
  const Status status = pause_and_check(session);
  std::vector<Findings> all;
  for (const auto& client : clients_) all.push_back(findings_of(*client));
  report(all);
  std::printf("  daemon: %.1f s, %llu ticks, %llu late, %llu slipped, speed %.3f\n",
              status.uptime - begun.uptime,
              static_cast<unsigned long long>(status.tick - begun.tick),
              static_cast<unsigned long long>(status.ticks_late - begun.ticks_late),
              static_cast<unsigned long long>(status.ticks_slipped - begun.ticks_slipped),
              engine::seconds_between(begun.at, status.at) / (status.uptime - begun.uptime));

  std::uint64_t sent = 1;  // the pause
  std::uint64_t frames = 0;
  for (const Findings& findings : all) {
    check(findings, status);
    sent += findings.value.at("sent");
    frames += findings.value.at("frames_equal");
    std::uint64_t common = 0;
    EXPECT_TRUE(agree(findings.hashes, all.front().hashes, common)) << "state hashes";
    EXPECT_GT(common, 100U);
    common = 0;
    EXPECT_TRUE(agree(findings.blocks, all.front().blocks, common)) << "collisions";
    EXPECT_GT(common, 5U);
  }
  EXPECT_GT(frames, 10U) << "whole frames compared";
  EXPECT_EQ(status.commands - commands_before, sent) << "every command was applied once";
  EXPECT_EQ(status.dropped, 0U);
  daemon_.signal(SIGTERM);
  EXPECT_EQ(daemon_.wait(), 0) << daemon_.log();
}

}  // namespace
}  // namespace stoss::tests

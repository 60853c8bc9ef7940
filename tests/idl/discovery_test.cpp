// SPDX-License-Identifier: Apache-2.0
// The discovery star, in separate processes: daemons on well-known ports, clients that ask them.
//
// The bounds are wide, since the machine may be busy; the times are printed.
#include "idl/child.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace stoss::tests {
namespace {

using namespace std::chrono_literals;

std::unique_ptr<Child> daemon(std::uint32_t domain, const std::string& world) {
  auto child = std::make_unique<Child>(
      std::vector<std::string>{STOSS_NODE, "daemon", std::to_string(domain), world});
  EXPECT_EQ(child->line(), "ready");
  return child;
}

std::unique_ptr<Child> client(std::uint32_t domain, int worlds, int seconds = 10) {
  return std::make_unique<Child>(std::vector<std::string>{STOSS_NODE,
                                                          "client",
                                                          std::to_string(domain),
                                                          std::to_string(worlds),
                                                          std::to_string(seconds)});
}

void expect_found(Child& child, double limit_ms, const char* what) {
  const std::string said = child.line();
  EXPECT_EQ(child.wait(), 0) << what << ": " << said;
  const std::size_t in = said.find(" in ");
  ASSERT_NE(in, std::string::npos) << said;
  const double took = std::stod(said.substr(in + 4));
  std::printf("%s: %s\n", what, said.c_str());
  EXPECT_LE(took, limit_ms) << what;
}

TEST(Discovery, ClientFindsAllDaemonsOfTheDomain) {
  constexpr std::uint32_t kDomain = 45;
  const auto a = daemon(kDomain, "a");
  const auto b = daemon(kDomain, "b");
  const auto c = daemon(kDomain, "c");
  for (int i = 0; i < 5; ++i) expect_found(*client(kDomain, 3), 2000, "one client, three daemons");
}

TEST(Discovery, ManyClientsAtOnce) {
  constexpr std::uint32_t kDomain = 46;
  const auto a = daemon(kDomain, "a");
  const auto b = daemon(kDomain, "b");
  std::vector<std::unique_ptr<Child>> clients;
  for (int i = 0; i < 25; ++i) clients.push_back(client(kDomain, 2));
  for (auto& one : clients) expect_found(*one, 5000, "one of 25 clients");
}

TEST(Discovery, ClientThatStartsFirstFindsTheDaemon) {
  constexpr std::uint32_t kDomain = 47;
  const auto early = client(kDomain, 1);
  std::this_thread::sleep_for(700ms);
  const auto late = daemon(kDomain, "late");
  expect_found(*early, 700 + 3000, "a client 0.7 s before its daemon");
}

TEST(Discovery, ClientFindsTheSuccessorOfAKilledDaemon) {
  constexpr std::uint32_t kDomain = 48;
  auto first = daemon(kDomain, "first");
  const auto watcher = client(kDomain, 2);
  std::this_thread::sleep_for(300ms);
  first->kill_now();
  const auto second = daemon(kDomain, "second");
  expect_found(*watcher, 300 + 3000, "a client whose daemon was killed and replaced");
}

TEST(Discovery, DomainsDoNotSeeEachOther) {
  const auto other = daemon(49, "other");
  const auto alone = client(50, 1, 1);
  EXPECT_EQ(alone->line().substr(0, 8), "0 worlds");
  EXPECT_EQ(alone->wait(), 1);
}

}  // namespace
}  // namespace stoss::tests

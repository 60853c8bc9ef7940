// SPDX-License-Identifier: Apache-2.0
// Requests and their mailboxes between processes: the first reply to a client that nobody knew
// before arrives, and so does every chunk of an answer that is larger than the socket buffers.
#include "idl/child.hpp"
#include "idl/sample_factory.hpp"

#include <stoss/dds/dds.hpp>
#include <stoss/idl/topics.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace wire = idl::wire;

constexpr std::uint32_t kDomain = 51;
constexpr const char* kWorld = "box";

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// A client as the library's users have it: writers in the world, readers in its mailbox.
class Client {
 public:
  explicit Client(std::uint8_t identity)
      : client_{identity},
        participant_(kDomain, dds::Network{}),
        publisher_(participant_, kWorld),
        mailbox_(participant_, idl::mailbox_of(kWorld, client_)),
        command_topic_(idl::make_topic(participant_, idl::kCommandTopic)),
        query_topic_(idl::make_topic(participant_, idl::kQueryTopic)),
        reply_topic_(idl::make_topic(participant_, idl::kReplyTopic)),
        answer_topic_(idl::make_topic(participant_, idl::kAnswerTopic)),
        replies_(idl::make_reader(mailbox_, reply_topic_, idl::kReplyTopic)),
        answers_(idl::make_reader(mailbox_, answer_topic_, idl::kAnswerTopic)),
        commands_(idl::make_writer(publisher_, command_topic_, idl::kCommandTopic)),
        queries_(idl::make_writer(publisher_, query_topic_, idl::kQueryTopic)),
        waitset_(participant_) {
    waitset_.attach(replies_, 1);
    waitset_.attach(answers_, 2);
  }

  [[nodiscard]] bool wait_for_daemon() {
    const auto begin = Clock::now();
    while (commands_.readers() == 0 || queries_.readers() == 0) {
      if (milliseconds_since(begin) > 10e3) return false;
      waitset_.wait(1ms, [](std::intptr_t) {});
    }
    return true;
  }

  // One command, sent once; the milliseconds until its reply, or nothing after five seconds.
  [[nodiscard]] std::optional<double> command(std::uint64_t number) { return send({}, number); }
  [[nodiscard]] std::optional<double> send(wire::Command command, std::uint64_t number) {
    const auto begin = Clock::now();
    std::copy(client_.begin(), client_.end(), command.request.client);
    command.request.number = number;
    if (!commands_.write(command)) return std::nullopt;
    bool replied = false;
    while (!replied && milliseconds_since(begin) < 5e3) {
      waitset_.wait(100ms, [](std::intptr_t) {});
      replies_.drain([&](const dds::Sample<wire::Reply>& sample) {
        if (sample.valid() && sample.data.request.number == number) replied = true;
      });
    }
    return replied ? std::optional(milliseconds_since(begin)) : std::nullopt;
  }

  // A query for `chunks` chunks; how often each came within the time.
  [[nodiscard]] std::vector<int> query(std::uint64_t number, std::size_t chunks) {
    const auto begin = Clock::now();
    wire::Query query{};
    std::copy(client_.begin(), client_.end(), query.request.client);
    query.request.number = number;
    query.count = chunks;
    std::vector<int> seen(chunks);
    EXPECT_TRUE(queries_.write(query));
    std::size_t missing = chunks;
    while (missing > 0 && milliseconds_since(begin) < 20e3) {
      waitset_.wait(100ms, [](std::intptr_t) {});
      answers_.drain([&](const dds::Sample<wire::Answer>& sample) {
        if (!sample.valid() || sample.data.request.number != number) return;
        if (sample.data.chunk < chunks && seen[sample.data.chunk]++ == 0) --missing;
      });
    }
    return seen;
  }

 private:
  std::array<std::uint8_t, 16> client_;
  dds::Participant participant_;
  dds::Publisher publisher_;
  dds::Subscriber mailbox_;
  dds::Topic<wire::Command> command_topic_;
  dds::Topic<wire::Query> query_topic_;
  dds::Topic<wire::Reply> reply_topic_;
  dds::Topic<wire::Answer> answer_topic_;
  dds::Reader<wire::Reply> replies_;
  dds::Reader<wire::Answer> answers_;
  dds::Writer<wire::Command> commands_;
  dds::Writer<wire::Query> queries_;
  dds::WaitSet waitset_;
};

class Mailbox : public ::testing::Test {
 protected:
  Mailbox() : service_({STOSS_NODE, "service", std::to_string(kDomain), kWorld}) {
    EXPECT_EQ(service_.line(), "ready");
  }
  Child service_;
};

TEST_F(Mailbox, FirstReplyToAFreshClientArrivesWithoutARetry) {
  std::vector<double> first;
  std::vector<double> next;
  for (std::uint8_t i = 0; i < 30; ++i) {
    Client client(i);
    ASSERT_TRUE(client.wait_for_daemon());
    const auto took = client.command(1);
    ASSERT_TRUE(took) << "client " << int{i};
    first.push_back(*took);
    for (std::uint64_t n = 2; n < 12; ++n) {
      const auto again = client.command(n);
      ASSERT_TRUE(again);
      next.push_back(*again);
    }
  }
  std::sort(first.begin(), first.end());
  std::sort(next.begin(), next.end());
  std::printf("first reply: median %.2f ms, worst %.2f ms; later: median %.3f ms, worst %.2f ms\n",
              first[first.size() / 2],
              first.back(),
              next[next.size() / 2],
              next.back());
}

// 100,000 bodies, as a late joiner gets them: each chunk once, none missing.
TEST_F(Mailbox, LargeAnswerArrivesWhole) {
  constexpr std::size_t kChunks = (100000 + stoss_v1_MAX_STATICS - 1) / stoss_v1_MAX_STATICS;
  Client client(200);
  ASSERT_TRUE(client.wait_for_daemon());
  ASSERT_TRUE(client.command(1));
  for (std::uint64_t round = 2; round < 5; ++round) {
    const auto begin = Clock::now();
    const std::vector<int> seen = client.query(round, kChunks);
    const double took = milliseconds_since(begin);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(kChunks));
    std::printf("%zu chunks in %.0f ms\n", kChunks, took);
  }
}

// The mailbox is made at the first request, whatever it is; a client may ask for the world at once.
TEST_F(Mailbox, LargeAnswerToTheFirstRequestArrivesWhole) {
  constexpr std::size_t kChunks = 447;
  for (std::uint8_t i = 0; i < 3; ++i) {
    Client client(static_cast<std::uint8_t>(210 + i));
    ASSERT_TRUE(client.wait_for_daemon());
    const auto begin = Clock::now();
    const std::vector<int> seen = client.query(1, kChunks);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(kChunks));
    std::printf("first request, %zu chunks in %.0f ms\n", kChunks, milliseconds_since(begin));
  }
}

// Some 270 kB, which travel in fragments.
TEST_F(Mailbox, CommandAtItsBoundsIsReplied) {
  SampleFactory make(1);
  wire::Command command{};
  make.command(command);
  Client client(3);
  ASSERT_TRUE(client.wait_for_daemon());
  EXPECT_TRUE(client.send(command, 1));
}

TEST_F(Mailbox, ForeignMailIsNotDelivered) {
  Client one(1);
  Client two(2);
  ASSERT_TRUE(one.wait_for_daemon());
  ASSERT_TRUE(two.wait_for_daemon());
  ASSERT_TRUE(one.command(7));
  ASSERT_TRUE(two.command(8));
  EXPECT_EQ(one.query(9, 3), std::vector<int>(3, 1));
}

}  // namespace
}  // namespace stoss::tests

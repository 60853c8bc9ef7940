// SPDX-License-Identifier: Apache-2.0
#include "bench/raw_dds.hpp"

#include <stoss/dds/dds.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/idl/topics.hpp>
#include <stoss/translate/command.hpp>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <span>
#include <thread>
#include <vector>

namespace stoss::bench {
namespace {

namespace wire = idl::wire;

dds::Participant daemon_like() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  return dds::Participant(kDomain, network);
}

}  // namespace

int raw_frames(std::size_t bodies) {
  constexpr std::size_t kChunk = stoss_v1_MAX_FRAME_BODIES;
  const dds::Participant participant = daemon_like();
  const dds::Publisher publisher(participant, idl::partition_of(kRawWorld));
  const auto topic = idl::make_topic(participant, idl::kFrameTopic);
  auto writer = idl::make_writer(publisher, topic, idl::kFrameTopic);
  std::vector<std::uint64_t> id(bodies);
  std::iota(id.begin(), id.end(), 1);
  std::vector<double> x(bodies, 0.1), y = x, vx = x, vy = x;
  auto next = std::chrono::steady_clock::now();
  for (std::uint64_t tick = 0;; ++tick) {
    for (std::size_t first = 0; first < bodies; first += kChunk) {
      const std::size_t count = std::min(kChunk, bodies - first);
      wire::FrameChunk sample{};
      sample.chunk = static_cast<std::uint32_t>(first / kChunk);
      sample.chunks = static_cast<std::uint32_t>((bodies + kChunk - 1) / kChunk);
      sample.tick = tick;
      idl::lend(sample.id, std::span(id).subspan(first, count));
      idl::lend(sample.x, std::span(x).subspan(first, count));
      idl::lend(sample.y, std::span(y).subspan(first, count));
      idl::lend(sample.vx, std::span(vx).subspan(first, count));
      idl::lend(sample.vy, std::span(vy).subspan(first, count));
      if (!writer.write(sample)) return 1;
    }
    next += std::chrono::nanoseconds(1'000'000'000 / kFramesPerSecond);
    std::this_thread::sleep_until(next);
  }
}

int raw_echo() {
  const dds::Participant participant = daemon_like();
  const dds::Subscriber subscriber(participant, idl::partition_of(kWorld));
  translate::ClientId client{};
  client.fill(1);
  const dds::Publisher publisher(participant, idl::mailbox_of(kWorld, client));
  const auto commands = idl::make_topic(participant, idl::kCommandTopic);
  const auto queries = idl::make_topic(participant, idl::kQueryTopic);
  const auto replies = idl::make_topic(participant, idl::kReplyTopic);
  auto reader = idl::make_reader(subscriber, commands, idl::kCommandTopic);
  auto unused = idl::make_reader(subscriber, queries, idl::kQueryTopic);
  auto writer = idl::make_writer(publisher, replies, idl::kReplyTopic);
  dds::WaitSet waitset(participant);
  waitset.attach(reader, 1);
  bool is_good = true;
  while (is_good) {
    waitset.wait(std::chrono::seconds(1), [](std::intptr_t) {});
    reader.drain([&](const dds::Sample<wire::Command>& sample) {
      if (!sample.valid()) return;
      wire::Reply reply{};
      reply.request = sample.data.request;
      is_good = is_good && writer.write(reply);
    });
  }
  return 1;
}

}  // namespace stoss::bench

// SPDX-License-Identifier: Apache-2.0
// What it costs the daemon to publish a body's state and to answer a command, beside raw Cyclone
// DDS doing the same with the same types in the same run. CPU time of whole processes, all threads.
//
//   publish_bench [SECONDS]     per measurement; 4 when not given
//
// Run as `publish_bench raw-frames` and `publish_bench raw-echo` it is the raw counterpart.
#include "integration/daemon_client.hpp"
#include "integration/daemon_process.hpp"

#include <dirent.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>

namespace stoss::tests {
namespace {

using engine::Code;
using idl::Ask;
using idl::Op;
using Seconds = WireClient::Seconds;

constexpr unsigned kDomain = 67;
constexpr const char* kWorld = "gas-10000";
constexpr std::size_t kBodies = 10'000;
constexpr std::size_t kChunkBodies = 1000;
constexpr int kFramesPerSecond = 60;
constexpr std::uint64_t kWindow = 64;  ///< commands under way at once

/// CPU time of a process in nanoseconds, as its scheduler counts it.
double cpu_ns(pid_t pid) {
  const std::string tasks = "/proc/" + std::to_string(pid) + "/task";
  double sum = 0;
  const std::unique_ptr<DIR, int (*)(DIR*)> directory(opendir(tasks.c_str()), &closedir);
  if (!directory) return sum;
  while (const dirent* entry = readdir(directory.get())) {
    double ns = 0;
    std::ifstream(tasks + "/" + entry->d_name + "/schedstat") >> ns;
    sum += ns;
  }
  return sum;
}

struct Cost {
  double sender_ns = 0;
  double receiver_ns = 0;
  double count = 0;
};

/// Runs `work` for a while; what both processes used, for each unit that it counts.
Cost measure(pid_t sender, const std::function<double()>& work) {
  const double sender_before = cpu_ns(sender);
  const double receiver_before = cpu_ns(getpid());
  const double count = work();
  return {(cpu_ns(sender) - sender_before) / count,
          (cpu_ns(getpid()) - receiver_before) / count,
          count};
}

struct FrameReader {
  explicit FrameReader(WireClient& client)
      : topic(idl::make_topic(client.participant(), idl::kFrameTopic)),
        reader(idl::make_reader(client.subscriber(), topic, idl::kFrameTopic)) {}

  /// Reads for so long; the states that came.
  double states_in(double seconds) {
    double states = 0;
    const auto until = std::chrono::steady_clock::now() + Seconds(seconds);
    while (std::chrono::steady_clock::now() < until) {
      reader.drain([&](const dds::Sample<wire::FrameChunk>& sample) {
        if (sample.valid()) states += sample.data.id._length;
      });
      std::this_thread::sleep_for(milliseconds(2));
    }
    return states;
  }

  dds::Topic<wire::FrameChunk> topic;
  dds::Reader<wire::FrameChunk> reader;
};

/// Windows of commands for so long; the replies that came.
double commands_in(WireClient& client, double seconds, engine::Id id) {
  const Targets velocity({id}, {0.0}, {0.0});
  const auto until = std::chrono::steady_clock::now() + Seconds(seconds);
  double count = 0;
  while (std::chrono::steady_clock::now() < until) {
    std::uint64_t last = 0;
    for (std::uint64_t i = 0; i < kWindow; ++i) last = client.send(Op::kSetVelocity, velocity);
    if (!client.reply(last)) break;
    count += kWindow;
  }
  return count;
}

[[noreturn]] void raw_frames() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  const dds::Participant participant(kDomain, network);
  const dds::Publisher publisher(participant, kWorld);
  const auto topic = idl::make_topic(participant, idl::kFrameTopic);
  auto writer = idl::make_writer(publisher, topic, idl::kFrameTopic);
  std::vector<std::uint64_t> id(kChunkBodies);
  std::iota(id.begin(), id.end(), 1);
  const std::vector<double> x(kChunkBodies, 0.1);
  auto next = std::chrono::steady_clock::now();
  for (std::uint64_t tick = 0;; ++tick) {
    for (std::uint32_t chunk = 0; chunk < kBodies / kChunkBodies; ++chunk) {
      wire::FrameChunk sample{};
      sample.chunk = chunk;
      sample.chunks = kBodies / kChunkBodies;
      sample.tick = tick;
      idl::lend(sample.id, id);
      for (auto* column : {&sample.x, &sample.y, &sample.vx, &sample.vy}) idl::lend(*column, x);
      if (!writer.write(sample)) std::exit(1);
    }
    next += std::chrono::nanoseconds(1'000'000'000 / kFramesPerSecond);
    std::this_thread::sleep_until(next);
  }
}

[[noreturn]] void raw_echo() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  const dds::Participant participant(kDomain, network);
  const dds::Subscriber subscriber(participant, kWorld);
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
  for (;;) {
    waitset.wait(std::chrono::seconds(1), [](std::intptr_t) {});
    reader.drain([&](const dds::Sample<wire::Command>& sample) {
      if (!sample.valid()) return;
      wire::Reply reply{};
      reply.request = sample.data.request;
      if (!writer.write(reply)) std::exit(1);
    });
  }
}

int run(const std::string& self, double seconds) {
  Cost raw_frame;
  Cost raw_command;
  {
    Process writer({self, "raw-frames"});
    WireClient client(kDomain, kWorld, 1);
    FrameReader frames(client);
    frames.states_in(1);
    raw_frame = measure(writer.pid(), [&] { return frames.states_in(seconds); });
  }
  {
    Process echo({self, "raw-echo"});
    WireClient client(kDomain, kWorld, 1);
    if (!client.connect() || !client.reply(client.send(Op::kPause))) return 1;
    raw_command = measure(echo.pid(), [&] { return commands_in(client, seconds, 1); });
  }
  Process daemon(stossd(
      kDomain, {"--scene", scene(kWorld), "--frame-rate", std::to_string(kFramesPerSecond)}));
  WireClient client(kDomain, kWorld, 1);
  if (!client.connect()) return 1;
  client.status();
  const auto idle = [&] {
    std::this_thread::sleep_for(Seconds(seconds));
    return seconds * kFramesPerSecond * static_cast<double>(kBodies);
  };
  const Cost without = measure(daemon.pid(), idle);
  Cost with_frames;
  {
    FrameReader frames(client);
    frames.states_in(1);
    with_frames = measure(daemon.pid(), [&] { return frames.states_in(seconds); });
  }
  client.command(Op::kPause);
  std::this_thread::sleep_for(milliseconds(500));
  const Cost command = measure(daemon.pid(), [&] { return commands_in(client, seconds, 1); });

  std::printf(
      "CPU ns, sending process         raw DDS     stossd    ratio   (receiver raw, stossd)\n");
  std::printf("%-28s %10.0f %10.0f %8.2f   %.0f, %.0f\n",
              "a body's state in a frame",
              raw_frame.sender_ns,
              with_frames.sender_ns - without.sender_ns,
              (with_frames.sender_ns - without.sender_ns) / raw_frame.sender_ns,
              raw_frame.receiver_ns,
              with_frames.receiver_ns);
  std::printf("%-28s %10.0f %10.0f %8.2f   %.0f, %.0f\n",
              "a command and its reply",
              raw_command.sender_ns,
              command.sender_ns,
              command.sender_ns / raw_command.sender_ns,
              raw_command.receiver_ns,
              command.receiver_ns);
  std::printf("states %.0f and %.0f, commands %.0f and %.0f; simulating alone %.1f %% of a core\n",
              raw_frame.count,
              with_frames.count,
              raw_command.count,
              command.count,
              without.sender_ns * without.count / seconds / 1e7);
  return 0;
}

}  // namespace
}  // namespace stoss::tests

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "raw-frames") == 0) stoss::tests::raw_frames();
  if (argc == 2 && std::strcmp(argv[1], "raw-echo") == 0) stoss::tests::raw_echo();
  constexpr double kDefaultSeconds = 4;
  const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : kDefaultSeconds;
  if (!(seconds > 0)) {
    std::fputs("usage: publish_bench [SECONDS]\n", stderr);
    return 2;
  }
  return stoss::tests::run("/proc/self/exe", seconds);
}

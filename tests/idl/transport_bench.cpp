// SPDX-License-Identifier: Apache-2.0
// What it costs to publish and to receive: CPU nanoseconds of the writing and of the reading
// process (all threads) per body, at 600,000 bodies a second, beside raw UDP datagrams of the same
// length.
//
//   idl_transport_bench [SECONDS]     2 when not given; one line per kind of sample
#include "idl/sample_factory.hpp"

#include <stoss/dds/dds.hpp>
#include <stoss/idl/topics.hpp>

#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace stoss::tests {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace wire = idl::wire;

constexpr std::uint32_t kDomain = 52;
constexpr double kBodiesPerSecond = 600000;
constexpr std::size_t kRawBytes = 60 * 1024;
constexpr std::uint16_t kRawPort = 25831;

// What one process used.
struct Usage {
  double cpu_ns = 0;
  std::uint64_t samples = 0;
};

double cpu_ns() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ns = [](const timeval& t) {
    return 1e9 * static_cast<double>(t.tv_sec) + 1e3 * static_cast<double>(t.tv_usec);
  };
  return ns(usage.ru_utime) + ns(usage.ru_stime);
}

// Calls send() at a steady rate until the time is over.
Usage paced(double seconds, double per_second, const std::function<bool()>& send) {
  Usage usage;
  const double before = cpu_ns();
  const auto begin = Clock::now();
  const auto step =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / per_second));
  const auto end =
      begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  // Ten to a burst, as the chunks of a tick are.
  constexpr int kBurst = 10;
  for (auto next = begin; next < end; next += kBurst * step) {
    std::this_thread::sleep_until(next);
    for (int i = 0; i < kBurst; ++i) usage.samples += send() ? 1U : 0U;
  }
  usage.cpu_ns = cpu_ns() - before;
  return usage;
}

template <class T>
Usage write_dds(const idl::TopicSpec<T>& spec, T& sample, double seconds, double per_second) {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  const dds::Participant participant(kDomain, network);
  const dds::Publisher publisher(participant, "bench");
  const auto topic = idl::make_topic(participant, spec);
  auto writer = idl::make_writer(publisher, topic, spec);
  const auto begin = Clock::now();
  while (writer.readers() == 0) {
    if (Clock::now() - begin > 10s) throw std::runtime_error("no reader");
    std::this_thread::sleep_for(1ms);
  }
  std::this_thread::sleep_for(50ms);
  const Usage usage = paced(seconds, per_second, [&] {
    if constexpr (requires { sample.chunk; }) sample.chunk = (sample.chunk + 1) % 10;
    return writer.write(sample);
  });
  static_cast<void>(writer.wait_for_acknowledgments(1s));
  return usage;
}

template <class T>
Usage read_dds(const idl::TopicSpec<T>& spec, double seconds) {
  const dds::Participant participant(kDomain, dds::Network{});
  const dds::Subscriber subscriber(participant, "bench");
  const auto topic = idl::make_topic(participant, spec);
  auto reader = idl::make_reader(subscriber, topic, spec);
  dds::WaitSet waitset(participant);
  waitset.attach(reader, 1);
  Usage usage;
  const double before = cpu_ns();
  const auto until = Clock::now() + std::chrono::duration<double>(seconds + 1);
  while (Clock::now() < until) {
    waitset.wait(100ms, [](std::intptr_t) {});
    reader.drain([&](const dds::Sample<T>& one) { usage.samples += one.valid() ? 1U : 0U; });
  }
  usage.cpu_ns = cpu_ns() - before;
  return usage;
}

sockaddr_in raw_address() {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(kRawPort);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

Usage write_raw(double seconds, double per_second) {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in to = raw_address();
  std::vector<char> bytes(kRawBytes, 'x');
  std::this_thread::sleep_for(100ms);
  const Usage usage = paced(seconds, per_second, [&] {
    return sendto(fd,
                  bytes.data(),
                  bytes.size(),
                  0,
                  reinterpret_cast<const sockaddr*>(&to),
                  sizeof to) == static_cast<ssize_t>(bytes.size());
  });
  close(fd);
  return usage;
}

Usage read_raw(double seconds) {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in at = raw_address();
  const int room = 4 << 20;
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
  const timeval patience{0, 100000};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0)
    throw std::runtime_error("bind");
  std::vector<char> bytes(kRawBytes);
  Usage usage;
  const double before = cpu_ns();
  const auto until = Clock::now() + std::chrono::duration<double>(seconds + 1);
  while (Clock::now() < until)
    usage.samples += recv(fd, bytes.data(), bytes.size(), 0) > 0 ? 1U : 0U;
  usage.cpu_ns = cpu_ns() - before;
  close(fd);
  return usage;
}

// Runs the reader in a child, since both in one process would hand samples over without the
// network.
int measure(const char* name,
            double bodies,
            const std::function<Usage()>& write,
            const std::function<Usage()>& read) {
  int result[2];
  if (pipe(result) != 0) return 1;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const Usage usage = read();
    const bool sent = ::write(result[1], &usage, sizeof usage) == sizeof usage;
    _exit(sent ? 0 : 1);
  }
  const Usage wrote = write();
  Usage got;
  const bool received = ::read(result[0], &got, sizeof got) == sizeof got;
  waitpid(child, nullptr, 0);
  close(result[0]);
  close(result[1]);
  if (!received || wrote.samples == 0 || got.samples == 0) return 1;
  const double sent = static_cast<double>(wrote.samples) * bodies;
  const double arrived = static_cast<double>(got.samples) * bodies;
  std::printf("%-10s %5.0f a sample: writer %6.1f ns, reader %6.1f ns each, %6.2f %% arrived\n",
              name,
              bodies,
              wrote.cpu_ns / sent,
              got.cpu_ns / arrived,
              100 * arrived / sent);
  return 0;
}

template <class T>
int measure_dds(const char* name,
                const idl::TopicSpec<T>& spec,
                std::size_t bodies,
                double seconds,
                T& sample) {
  const double per_second = kBodiesPerSecond / static_cast<double>(bodies);
  return measure(
      name,
      static_cast<double>(bodies),
      [&] { return write_dds(spec, sample, seconds, per_second); },
      [&] { return read_dds(spec, seconds); });
}

int run(double seconds) {
  SampleFactory make(1);
  wire::MotionBatch motions{};
  make.motions(motions.motions);
  // Worlds without spin leave these two empty.
  motions.motions.angle._length = 0;
  motions.motions.spin._length = 0;
  wire::FrameChunk frame{};
  make.frame(frame);
  frame.angle._length = 0;
  frame.spin._length = 0;
  wire::CollisionBatch collisions{};
  make.collisions(collisions.collisions);
  int failures = 0;
  failures += measure_dds("motion", idl::kMotionTopic, stoss_v1_MAX_MOTIONS, seconds, motions);
  failures += measure_dds("frame", idl::kFrameTopic, stoss_v1_MAX_FRAME_BODIES, seconds, frame);
  failures +=
      measure_dds("collision", idl::kCollisionTopic, stoss_v1_MAX_COLLISIONS, seconds, collisions);
  constexpr double kRawBodies = 1000;
  failures += measure(
      "raw UDP",
      kRawBodies,
      [&] { return write_raw(seconds, kBodiesPerSecond / kRawBodies); },
      [&] { return read_raw(seconds); });
  return failures;
}

}  // namespace
}  // namespace stoss::tests

int main(int argc, char** argv) {
  try {
    constexpr double kSeconds = 2;
    return stoss::tests::run(argc > 1 ? std::atof(argv[1]) : kSeconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

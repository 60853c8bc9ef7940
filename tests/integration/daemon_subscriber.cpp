// SPDX-License-Identifier: Apache-2.0
// A subscriber in a process of its own, for tests to stop and to kill: reads everything that the
// world DOMAIN WORLD publishes, until it is killed. Prints a line when it is connected.
#include <stoss/dds/dds.hpp>
#include <stoss/idl/topics.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

int main(int argc, char** argv) {
  using namespace stoss;
  if (argc != 3) return 2;
  const auto domain = static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10));
  dds::Participant participant(domain, dds::Network());
  dds::Subscriber subscriber(participant, idl::partition_of(argv[2]));
  const auto motion_topic = idl::make_topic(participant, idl::kMotionTopic);
  const auto collision_topic = idl::make_topic(participant, idl::kCollisionTopic);
  const auto frame_topic = idl::make_topic(participant, idl::kFrameTopic);
  auto motion = idl::make_reader(subscriber, motion_topic, idl::kMotionTopic);
  auto collision = idl::make_reader(subscriber, collision_topic, idl::kCollisionTopic);
  auto frame = idl::make_reader(subscriber, frame_topic, idl::kFrameTopic);
  bool told = false;
  for (;;) {
    std::size_t samples = motion.drain([](const auto&) {});
    samples += collision.drain([](const auto&) {});
    samples += frame.drain([](const auto&) {});
    if (samples > 0 && !told) {
      std::fputs("connected\n", stderr);
      told = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/discovery.hpp>
#include <stoss/dds/waitset.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/idl/topics.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace stoss::client {

std::vector<Status> worlds(std::uint32_t domain,
                           const dds::Network& network,
                           Milliseconds timeout,
                           Milliseconds settle) {
  using std::chrono::steady_clock;
  dds::Network as_client = network;
  as_client.role = dds::Role::kClient;
  const dds::Participant participant(domain, as_client);
  const dds::Subscriber everywhere(participant, "*");
  const auto topic = idl::make_topic(participant, idl::kStatusTopic);
  auto reader = idl::make_reader(everywhere, topic, idl::kStatusTopic);
  dds::WaitSet waitset(participant);
  waitset.attach(reader, 0);

  std::map<std::string, Status> found;
  const auto end = steady_clock::now() + timeout;
  auto until = end;
  bool settling = false;
  for (auto now = steady_clock::now(); now < until; now = steady_clock::now()) {
    waitset.wait(until - now, [](std::intptr_t) {});
    reader.drain([&found](const dds::Sample<idl::wire::Status>& sample) {
      const std::string world(idl::text(sample.data.world));
      const bool running = sample.valid() && !sample.disposed() && !sample.orphaned() &&
                           sample.data.state != stoss_v1_STATE_STOPPED;
      if (running) {
        found[world] = status_of(sample.data);
      } else {
        found.erase(world);
      }
    });
    if (found.empty() || settling) continue;
    settling = true;
    until = std::min(end, steady_clock::now() + settle);
  }
  std::vector<Status> result;
  result.reserve(found.size());
  for (auto& [name, status] : found) result.push_back(std::move(status));
  return result;
}

}  // namespace stoss::client

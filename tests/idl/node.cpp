// SPDX-License-Identifier: Apache-2.0
// One process of a discovery experiment.
//
//   idl_node daemon DOMAIN WORLD
//     writes a status and a reply; says "ready"; ends with its input
//
//   idl_node unguarded DOMAIN WORLD
//     the same without the loopback guard
//
//   idl_node service DOMAIN WORLD
//     replies and answers; says "ready"; ends when nothing came for ten seconds
//
//   idl_node client DOMAIN COUNT SECONDS
//     waits for COUNT statuses; prints the milliseconds it took
#include <stoss/dds/dds.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/idl/topics.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace dds = stoss::dds;
namespace idl = stoss::idl;

dds::Network daemon_network() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  return network;
}

int run_daemon(std::uint32_t domain, const std::string& world, bool guarded) {
  dds::Network network = daemon_network();
  network.allow_network = !guarded;
  const dds::Participant participant(domain, network);
  const dds::Publisher publisher(participant, world);
  const auto topic = idl::make_topic(participant, idl::kStatusTopic);
  auto writer = idl::make_writer(publisher, topic, idl::kStatusTopic);
  idl::wire::Status status{};
  idl::assign(status.world, world);
  if (!writer.write(status)) return 1;
  std::printf("ready\n");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  return 0;
}

// Replies and answers in mailboxes that are made at a client's first request, as a daemon does.
class Service {
 public:
  Service(std::uint32_t domain, std::string world)
      : world_(std::move(world)),
        participant_(domain, daemon_network()),
        subscriber_(participant_, world_),
        command_topic_(idl::make_topic(participant_, idl::kCommandTopic)),
        query_topic_(idl::make_topic(participant_, idl::kQueryTopic)),
        reply_topic_(idl::make_topic(participant_, idl::kReplyTopic)),
        answer_topic_(idl::make_topic(participant_, idl::kAnswerTopic)),
        commands_(idl::make_reader(subscriber_, command_topic_, idl::kCommandTopic)),
        queries_(idl::make_reader(subscriber_, query_topic_, idl::kQueryTopic)),
        numbers_(stoss_v1_MAX_MOTIONS, 0.5),
        ids_(stoss_v1_MAX_MOTIONS, 1) {}

  // Until nothing came in for ten seconds.
  void run() {
    dds::WaitSet waitset(participant_);
    waitset.attach(commands_, 1);
    waitset.attach(queries_, 2);
    while (waitset.wait(10s, [](std::intptr_t) {}) > 0) {
      commands_.drain([&](const dds::Sample<idl::wire::Command>& sample) {
        if (sample.valid()) reply(sample.data);
      });
      queries_.drain([&](const dds::Sample<idl::wire::Query>& sample) {
        if (sample.valid()) answer(sample.data);
      });
    }
  }

 private:
  struct Mailbox {
    dds::Publisher publisher;
    dds::Writer<idl::wire::Reply> replies;
    dds::Writer<idl::wire::Answer> answers;
  };

  Mailbox& mailbox(const idl::wire::RequestId& request) {
    const std::string partition = idl::mailbox_of(world_, request);
    const auto found = mailboxes_.find(partition);
    if (found != mailboxes_.end()) return found->second;
    dds::Publisher publisher(participant_, partition);
    auto replies = idl::make_writer(publisher, reply_topic_, idl::kReplyTopic);
    auto answers = idl::make_writer(publisher, answer_topic_, idl::kAnswerTopic);
    return mailboxes_
        .emplace(partition, Mailbox{std::move(publisher), std::move(replies), std::move(answers)})
        .first->second;
  }

  void reply(const idl::wire::Command& command) {
    idl::wire::Reply out{};
    out.request = command.request;
    if (!mailbox(command.request).replies.write(out)) std::fprintf(stderr, "reply not sent\n");
  }

  void answer(const idl::wire::Query& query) {
    idl::wire::Answer out{};
    out.request = query.request;
    out.chunks = static_cast<std::uint32_t>(query.count);
    auto& m = out.motions;
    for (auto* const array : {&m.x, &m.y, &m.x_low, &m.y_low, &m.vx, &m.vy, &m.vx_low, &m.vy_low}) {
      idl::lend(*array, std::span<const double>(numbers_));
    }
    idl::lend(m.id, std::span<const std::uint64_t>(ids_));
    if (out.chunks > idl::kAnswerReplay) wait_for_reader(mailbox(query.request).answers);
    for (out.chunk = 0; out.chunk < out.chunks; ++out.chunk) {
      if (!mailbox(query.request).answers.write(out)) std::fprintf(stderr, "answer not sent\n");
    }
  }

  // Few samples are kept for a reader that is yet to be found; more must wait for it.
  static void wait_for_reader(const dds::Writer<idl::wire::Answer>& writer) {
    const auto begin = Clock::now();
    while (writer.readers() == 0 && Clock::now() - begin < 10s) std::this_thread::sleep_for(1ms);
  }

  std::string world_;
  dds::Participant participant_;
  dds::Subscriber subscriber_;
  dds::Topic<idl::wire::Command> command_topic_;
  dds::Topic<idl::wire::Query> query_topic_;
  dds::Topic<idl::wire::Reply> reply_topic_;
  dds::Topic<idl::wire::Answer> answer_topic_;
  dds::Reader<idl::wire::Command> commands_;
  dds::Reader<idl::wire::Query> queries_;
  std::map<std::string, Mailbox> mailboxes_;
  std::vector<double> numbers_;
  std::vector<std::uint64_t> ids_;
};

int run_service(std::uint32_t domain, const std::string& world) {
  Service service(domain, world);
  std::printf("ready\n");
  std::fflush(stdout);
  service.run();
  return 0;
}

int run_client(std::uint32_t domain, std::size_t count, double seconds) {
  const auto begin = Clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  };
  dds::Network network;
  network.role = dds::Role::kClient;
  const dds::Participant participant(domain, network);
  const dds::Subscriber subscriber(participant, "*");
  const auto topic = idl::make_topic(participant, idl::kStatusTopic);
  auto reader = idl::make_reader(subscriber, topic, idl::kStatusTopic);
  dds::WaitSet waitset(participant);
  waitset.attach(reader, 1);
  std::set<std::string> worlds;
  while (worlds.size() < count && elapsed() < 1e3 * seconds) {
    waitset.wait(50ms, [&](std::intptr_t) {
      reader.drain([&](const dds::Sample<idl::wire::Status>& sample) {
        if (sample.valid()) worlds.emplace(idl::text(sample.data.world));
      });
    });
  }
  std::printf("%zu worlds in %.1f ms\n", worlds.size(), elapsed());
  return worlds.size() == count ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string role = argc > 1 ? argv[1] : "";
  try {
    const auto domain = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 0);
    if ((role == "daemon" || role == "unguarded") && argc == 4) {
      return run_daemon(domain, argv[3], role == "daemon");
    }
    if (role == "service" && argc == 4) return run_service(domain, argv[3]);
    if (role == "client" && argc == 5) {
      return run_client(domain, static_cast<std::size_t>(std::atoi(argv[3])), std::atof(argv[4]));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(
      stderr,
      "usage: idl_node daemon|unguarded|service DOMAIN WORLD | client DOMAIN COUNT SECONDS\n");
  return 2;
}

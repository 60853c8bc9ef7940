// SPDX-License-Identifier: Apache-2.0
// The RAII face of DDS: ownership, errors, waiting, the domain's configuration.
#include <stoss/dds/dds.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/idl/topics.hpp>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

namespace stoss::tests {
namespace {

using namespace std::chrono_literals;
namespace wire = idl::wire;

constexpr std::uint32_t kDomain = 42;

dds::Network daemon_network() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  return network;
}

std::string partition_of_this_test() {
  return ::testing::UnitTest::GetInstance()->current_test_info()->name();
}

// A topic of commands, both ways.
struct Commands {
  Commands()
      : participant(kDomain, daemon_network()),
        publisher(participant, partition_of_this_test()),
        subscriber(participant, partition_of_this_test()),
        topic(idl::make_topic(participant, idl::kCommandTopic)),
        reader(idl::make_reader(subscriber, topic, idl::kCommandTopic)),
        writer(idl::make_writer(publisher, topic, idl::kCommandTopic)) {}

  void send(std::uint64_t first, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      wire::Command command{};
      command.request.number = first + i;
      ASSERT_TRUE(writer.write(command));
    }
  }

  dds::Participant participant;
  dds::Publisher publisher;
  dds::Subscriber subscriber;
  dds::Topic<wire::Command> topic;
  dds::Reader<wire::Command> reader;
  dds::Writer<wire::Command> writer;
};

static_assert(!std::is_copy_constructible_v<dds::Entity>);
static_assert(!std::is_copy_constructible_v<dds::Reader<wire::Command>>);
static_assert(std::is_nothrow_move_constructible_v<dds::Participant>);
static_assert(std::is_nothrow_move_assignable_v<dds::Writer<wire::Command>>);
static_assert(!std::is_copy_constructible_v<dds::Samples<wire::Command>>);

TEST(Entity, MovedFromOwnsNothing) {
  Commands all;
  const dds_entity_t handle = all.writer.handle();
  dds::Writer<wire::Command> moved = std::move(all.writer);
  EXPECT_EQ(moved.handle(), handle);
  EXPECT_FALSE(all.writer.valid());
  EXPECT_EQ(all.reader.writers(), 1);
  all.writer = std::move(moved);
  EXPECT_EQ(all.writer.handle(), handle);
  EXPECT_TRUE(all.writer.write(wire::Command{}));
}

TEST(Entity, AssignmentDeletesWhatWasOwned) {
  Commands all;
  auto second = idl::make_writer(all.publisher, all.topic, idl::kCommandTopic);
  EXPECT_EQ(all.reader.writers(), 2);
  second = dds::Writer<wire::Command>(std::move(all.writer));
  EXPECT_EQ(all.reader.writers(), 1);
}

TEST(Entity, DestructionUnmatches) {
  Commands all;
  {
    const auto second = idl::make_reader(all.subscriber, all.topic, idl::kCommandTopic);
    EXPECT_EQ(all.writer.readers(), 2);
  }
  EXPECT_EQ(all.writer.readers(), 1);
}

TEST(Errors, SetUpThrowsWithCodeAndText) {
  const dds::Participant participant(kDomain, daemon_network());
  const auto topic = idl::make_topic(participant, idl::kCommandTopic);
  dds::Publisher gone(participant, "x");
  gone.reset();
  try {
    static_cast<void>(idl::make_writer(gone, topic, idl::kCommandTopic));
    FAIL() << "no exception";
  } catch (const dds::Error& error) {
    EXPECT_LT(error.code(), 0);
    EXPECT_NE(std::string(error.what()).find("create writer"), std::string::npos);
  }
}

TEST(Errors, FailedWriteIsCountedAndDoesNotThrow) {
  Commands all;
  all.writer.reset();
  EXPECT_FALSE(all.writer.write(wire::Command{}));
  EXPECT_EQ(all.writer.failures(), 1U);
  EXPECT_LT(all.writer.last_code(), 0);
  EXPECT_EQ(all.writer.readers(), 0);
}

TEST(Errors, TakeFromNothingIsNotOk) {
  Commands all;
  all.reader.reset();
  const auto samples = all.reader.take();
  EXPECT_FALSE(samples.ok());
  EXPECT_TRUE(samples.empty());
}

TEST(Errors, BadDomainIdIsRefused) {
  EXPECT_THROW(dds::Participant(dds::kMaxDomainId + 1, daemon_network()), std::invalid_argument);
}

TEST(Reader, TakesInBatchesAndInOrder) {
  Commands all;
  constexpr std::uint64_t kCount = 3 * dds::kTakeBatch + 5;
  all.send(0, kCount);
  EXPECT_EQ(all.reader.take(3).size(), 3U);
  std::uint64_t next = 3;
  const std::size_t drained = all.reader.drain([&](const dds::Sample<wire::Command>& sample) {
    EXPECT_EQ(sample.data.request.number, next++);
  });
  EXPECT_EQ(drained, kCount - 3);
  EXPECT_TRUE(all.reader.take().empty());
  EXPECT_TRUE(all.reader.take(0).empty());
}

TEST(Reader, DrainStopsInAFlood) {
  Commands all;
  all.send(0, 5 * dds::kTakeBatch);
  const auto ignore = [](const dds::Sample<wire::Command>&) {};
  EXPECT_EQ(all.reader.drain(ignore, 2 * dds::kTakeBatch), 2 * dds::kTakeBatch);
  EXPECT_EQ(all.reader.drain(ignore), 3 * dds::kTakeBatch);
}

TEST(Writer, WaitsForAcknowledgments) {
  Commands all;
  all.send(0, 10);
  EXPECT_TRUE(all.writer.wait_for_acknowledgments(1s));
}

TEST(WaitSet, StaysTriggeredWhileSamplesAreLeft) {
  Commands all;
  dds::WaitSet waitset(all.participant);
  waitset.attach(all.reader, 5);
  EXPECT_EQ(waitset.wait(1ms, [](std::intptr_t) { FAIL(); }), 0);
  all.send(0, 3);
  for (int left = 3; left > 0; --left) {
    std::vector<std::intptr_t> tags;
    EXPECT_EQ(waitset.wait(1s, [&](std::intptr_t tag) { tags.push_back(tag); }), 1);
    EXPECT_EQ(tags, std::vector<std::intptr_t>{5});
    EXPECT_EQ(all.reader.take(1).size(), 1U);
  }
  EXPECT_EQ(waitset.wait(1ms, [](std::intptr_t) { FAIL(); }), 0);
}

TEST(WaitSet, GuardWakesFromAnotherThread) {
  const dds::Participant participant(kDomain, daemon_network());
  dds::WaitSet waitset(participant);
  dds::Guard guard(participant);
  waitset.attach(guard, 1);
  std::thread other([&] {
    std::this_thread::sleep_for(20ms);
    guard.set();
  });
  EXPECT_EQ(waitset.wait(5s, [](std::intptr_t tag) { EXPECT_EQ(tag, 1); }), 1);
  other.join();
  EXPECT_TRUE(guard.clear());
  EXPECT_FALSE(guard.clear());
  EXPECT_EQ(waitset.wait(1ms, [](std::intptr_t) { FAIL(); }), 0);
}

TEST(WaitSet, DetachedReaderIsSilent) {
  Commands all;
  dds::WaitSet waitset(all.participant);
  waitset.attach(all.reader, 1);
  waitset.detach(1);
  all.send(0, 1);
  EXPECT_EQ(waitset.wait(5ms, [](std::intptr_t) { FAIL(); }), 0);
}

TEST(Domain, IsSharedWithinAProcessAndReopens) {
  {
    const auto first = dds::Domain::open(kDomain, daemon_network());
    const auto second = dds::Domain::open(kDomain, dds::Network{});
    EXPECT_EQ(first.get(), second.get());
    EXPECT_EQ(second->network().role, dds::Role::kDaemon);
  }
  const auto again = dds::Domain::open(kDomain, dds::Network{});
  EXPECT_EQ(again->network().role, dds::Role::kClient);
}

TEST(Domain, ManyThreadsOpenAndClose) {
  std::atomic<int> failures = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) {
        try {
          const dds::Participant participant(kDomain, daemon_network());
        } catch (const std::exception&) {
          ++failures;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failures, 0);
}

TEST(Domain, ParticipantMoves) {
  dds::Participant first(kDomain, daemon_network());
  dds::Participant second(kDomain + 1, daemon_network());
  second = std::move(first);
  EXPECT_FALSE(first.valid());
  EXPECT_TRUE(second.valid());
  EXPECT_EQ(second.domain().id(), kDomain);
  // The domain that was let go is closed, and can be opened with another role.
  EXPECT_EQ(dds::Domain::open(kDomain + 1, dds::Network{})->network().role, dds::Role::kClient);
}

TEST(Domain, EnvironmentHasNoSay) {
  ASSERT_EQ(setenv("CYCLONEDDS_URI", "<CycloneDDS><NoSuchElement/></CycloneDDS>", 1), 0);
  EXPECT_NO_THROW(dds::Participant(kDomain, daemon_network()));
  ASSERT_EQ(unsetenv("CYCLONEDDS_URI"), 0);
}

TEST(Config, LeavingTheMachineMustBeAllowed) {
  dds::Network network;
  network.interface = "eth0";
  EXPECT_THROW(static_cast<void>(dds::domain_config(network)), std::invalid_argument);
  network.allow_network = true;
  EXPECT_NE(dds::domain_config(network).find("name=\"eth0\""), std::string::npos);
  network = {};
  network.peer = "10.0.0.1";
  EXPECT_THROW(static_cast<void>(dds::domain_config(network)), std::invalid_argument);
}

TEST(Config, NamesCannotBreakOutOfTheXml) {
  dds::Network network;
  network.allow_network = true;
  network.interface = "lo\"/><x";
  EXPECT_THROW(static_cast<void>(dds::domain_config(network)), std::invalid_argument);
  network.interface = "";
  EXPECT_THROW(static_cast<void>(dds::domain_config(network)), std::invalid_argument);
}

TEST(Config, FaultyExtraXmlFailsAtOnce) {
  dds::set_log_sink(nullptr);
  dds::Network network = daemon_network();
  network.extra_xml = "<NoSuchElement/>";
  EXPECT_THROW(dds::Participant(kDomain, network), dds::Error);
  dds::reset_log_sink();
}

TEST(Config, ShippedProfileIsTheClientsOne) {
  std::ifstream in(STOSS_DEPLOY_DIR "/cyclonedds-loopback.xml");
  ASSERT_TRUE(in);
  std::stringstream content;
  content << in.rdbuf();
  const auto bare = [](const std::string& xml) {
    const std::string no_comments =
        std::regex_replace(xml, std::regex("<!--([^-]|-[^-])*-->|<\\?[^>]*\\?>"), "");
    return std::regex_replace(no_comments, std::regex(">\\s+<"), "><");
  };
  std::string shipped = bare(content.str());
  shipped.erase(0, shipped.find('<'));
  shipped.erase(shipped.rfind('>') + 1);
  EXPECT_EQ(shipped, bare(dds::loopback_config(dds::Role::kClient)));
}

TEST(Log, SinkGetsCyclonesMessages) {
  std::mutex mutex;
  std::vector<std::string> lines;
  dds::set_log_sink([&](dds::LogLevel level, std::string_view line) {
    const std::lock_guard lock(mutex);
    if (level == dds::LogLevel::kError || level == dds::LogLevel::kWarning)
      lines.emplace_back(line);
  });
  dds::Network network = daemon_network();
  network.extra_xml = "<NoSuchElement/>";
  EXPECT_THROW(dds::Participant(kDomain, network), dds::Error);
  dds::reset_log_sink();
  const std::lock_guard lock(mutex);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.front().find("NoSuchElement"), std::string::npos);
  EXPECT_NE(lines.front().back(), '\n');
}

TEST(LoopbackGuard, WatchesEverySocketOfCyclone) {
  const auto before = dds::udp_sockets();
  const dds::Participant participant(kDomain, daemon_network());
  const auto after = dds::udp_sockets();
  EXPECT_GE(after.size() - before.size(), 2U);
  EXPECT_EQ(participant.domain().guarded_sockets(), after.size() - before.size());
}

TEST(LoopbackGuard, LeavesOtherSocketsAlone) {
  const int other = socket(AF_INET, SOCK_DGRAM, 0);
  ASSERT_GE(other, 0);
  const auto before = dds::udp_sockets();
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(dds::guard_new_sockets(before, "lo"), 0U);
  close(other);
}

TEST(LoopbackGuard, UnknownInterfaceIsAnError) {
  EXPECT_THROW(static_cast<void>(dds::guard_new_sockets({}, "nosuchif0")), std::system_error);
}

TEST(Qos, CopiesAndCompares) {
  const dds::Qos a = dds::Qos().reliable(5ms).keep_last(3).transient_local(2).partition("p");
  dds::Qos b = a;
  EXPECT_TRUE(a == b);
  b.keep_all();
  EXPECT_FALSE(a == b);
  b = a;
  EXPECT_TRUE(a == b);
}

}  // namespace
}  // namespace stoss::tests

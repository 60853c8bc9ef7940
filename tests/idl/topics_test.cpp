// SPDX-License-Identifier: Apache-2.0
// The topic table: both sides of every topic match, every type is offered as XCDR1, and no policy
// that is known to stall Cyclone is used.
#include <stoss/dds/dds.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/idl/topics.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace stoss::tests {
namespace {

constexpr std::uint32_t kDomain = 41;

dds::Network daemon_network() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  return network;
}

// Calls each(spec) for all topics.
template <class F>
void for_each_topic(F each) {
  each(idl::kCommandTopic);
  each(idl::kReplyTopic);
  each(idl::kQueryTopic);
  each(idl::kAnswerTopic);
  each(idl::kMotionTopic);
  each(idl::kFrameTopic);
  each(idl::kBodyTopic);
  each(idl::kCollisionTopic);
  each(idl::kZoneTopic);
  each(idl::kSceneTopic);
  each(idl::kStatusTopic);
}

TEST(Topics, WriterAndReaderOfEveryTopicMatch) {
  const dds::Participant participant(kDomain, daemon_network());
  const dds::Publisher publisher(participant, "w");
  const dds::Subscriber subscriber(participant, "w");
  const dds::Subscriber everything(participant, "*");
  for_each_topic([&](const auto& spec) {
    const auto topic = idl::make_topic(participant, spec);
    const auto writer = idl::make_writer(publisher, topic, spec);
    const auto reader = idl::make_reader(subscriber, topic, spec);
    const auto wild = idl::make_reader(everything, topic, spec);
    EXPECT_EQ(writer.readers(), 2) << spec.name;
    EXPECT_EQ(reader.writers(), 1) << spec.name;
    EXPECT_EQ(wild.writers(), 1) << spec.name;
  });
}

TEST(Topics, NamesCarryTheVersionAndDiffer) {
  std::set<std::string> names;
  const std::string prefix = "stoss/" + std::to_string(idl::kProtocol) + "/";
  for_each_topic([&](const auto& spec) {
    EXPECT_EQ(std::string(spec.name).rfind(prefix, 0), 0U) << spec.name;
    names.insert(spec.name);
  });
  EXPECT_EQ(names.size(), idl::kTopicCount);
}

TEST(Topics, EveryTypeIsOfferedAsXcdr1) {
  const dds::Participant participant(kDomain, daemon_network());
  const dds::Publisher publisher(participant, "w");
  for_each_topic([&](const auto& spec) {
    const auto topic = idl::make_topic(participant, spec);
    const auto writer = idl::make_writer(publisher, topic, spec);
    dds_qos_t* const qos = dds_create_qos();
    ASSERT_EQ(dds_get_qos(writer.handle(), qos), DDS_RETCODE_OK);
    std::uint32_t count = 0;
    dds_data_representation_id_t* offered = nullptr;
    ASSERT_TRUE(dds_qget_data_representation(qos, &count, &offered)) << spec.name;
    ASSERT_GE(count, 1U) << spec.name;
    // A writer speaks the first that it offers.
    EXPECT_EQ(offered[0], DDS_DATA_REPRESENTATION_XCDR1) << spec.name;
    dds_free(offered);
    dds_delete_qos(qos);
  });
}

TEST(Topics, DaemonWritersNeverBlock) {
  for (const auto topic : {idl::TopicId::kReply,
                           idl::TopicId::kAnswer,
                           idl::TopicId::kMotion,
                           idl::TopicId::kFrame,
                           idl::TopicId::kBody,
                           idl::TopicId::kCollision,
                           idl::TopicId::kZone,
                           idl::TopicId::kScene,
                           idl::TopicId::kStatus}) {
    const dds::Qos qos = idl::writer_qos(topic);
    dds_history_kind_t history{};
    std::int32_t depth = 0;
    ASSERT_TRUE(dds_qget_history(qos.raw(), &history, &depth));
    EXPECT_EQ(history, DDS_HISTORY_KEEP_LAST);
    EXPECT_GE(depth, 1);
    dds_reliability_kind_t reliability{};
    dds_duration_t block = -1;
    ASSERT_TRUE(dds_qget_reliability(qos.raw(), &reliability, &block));
    EXPECT_EQ(block, 0);
  }
}

TEST(Topics, NoReaderHasResourceLimits) {
  for (std::size_t i = 0; i < idl::kTopicCount; ++i) {
    const dds::Qos qos = idl::reader_qos(static_cast<idl::TopicId>(i));
    EXPECT_FALSE(dds_qget_resource_limits(qos.raw(), nullptr, nullptr, nullptr)) << i;
  }
}

TEST(Topics, UnknownTopicIsRefused) {
  EXPECT_THROW(static_cast<void>(idl::writer_qos(static_cast<idl::TopicId>(99))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(idl::reader_qos(static_cast<idl::TopicId>(99))),
               std::invalid_argument);
}

TEST(Partitions, WorldNamesAreWordsWithoutWildcards) {
  EXPECT_TRUE(idl::valid_world_name("box-1.2_B"));
  EXPECT_EQ(idl::partition_of("lab"), "lab");
  const std::string longest(64, 'x');
  EXPECT_TRUE(idl::valid_world_name(longest));
  for (const std::string& bad : {std::string(),
                                 longest + "x",
                                 std::string("a*"),
                                 std::string("a b"),
                                 std::string("a/b"),
                                 std::string("a?"),
                                 std::string("\xC3\xA4")}) {
    EXPECT_FALSE(idl::valid_world_name(bad)) << bad;
    EXPECT_THROW(static_cast<void>(idl::partition_of(bad)), std::invalid_argument) << bad;
  }
}

TEST(Partitions, MailboxNamesWorldAndClient) {
  std::array<std::uint8_t, 16> client{};
  client[0] = 0xAB;
  client[15] = 0x01;
  const std::string expected = "lab/ab000000000000000000000000000001";
  EXPECT_EQ(idl::mailbox_of("lab", client), expected);
  idl::wire::RequestId request{};
  std::copy(client.begin(), client.end(), request.client);
  EXPECT_EQ(idl::mailbox_of("lab", request), expected);
  EXPECT_THROW(static_cast<void>(idl::mailbox_of("*", client)), std::invalid_argument);
}

TEST(Names, CodesHaveTheWordsOfTheProtocol) {
  EXPECT_EQ(idl::name_of(idl::Code::kOk), "OK");
  EXPECT_EQ(idl::name_of(idl::Code::kInternal), "INTERNAL");
  EXPECT_EQ(idl::name_of(idl::Code::kDeadlinePassed), "DEADLINE_PASSED");
  EXPECT_EQ(idl::name_of(static_cast<idl::Code>(999)), "UNKNOWN");
  EXPECT_EQ(idl::wire_value(idl::Code::kInternal), 10);
}

// Everything that would keep other vendors from reading a type, or let a sample grow without bound.
TEST(IdlText, TypesAreFinalWithoutOptionalMembersAndBounded) {
  std::ifstream in(STOSS_IDL_FILE);
  ASSERT_TRUE(in);
  std::stringstream content;
  content << in.rdbuf();
  const std::string text = std::regex_replace(content.str(), std::regex("//[^\n]*"), "");
  const auto count = [&](const char* pattern) {
    const std::regex regex(pattern);
    return std::distance(std::sregex_iterator(text.begin(), text.end(), regex),
                         std::sregex_iterator());
  };
  EXPECT_GT(count("\\bstruct\\b"), 20);
  EXPECT_EQ(count("\\bstruct\\b"), count("@final (@nested )?struct\\b"));
  EXPECT_EQ(count("@optional|@appendable|@mutable|@external|\\benum\\b|\\bunion\\b|wstring"), 0);
  EXPECT_EQ(count("sequence<[^,>]*>"), 0) << "a sequence without a bound";
  EXPECT_EQ(count("string [a-z_]+;"), 0) << "a string without a bound";
  EXPECT_EQ(count("\\bfloat\\b"), 0);
}

}  // namespace
}  // namespace stoss::tests

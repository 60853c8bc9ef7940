// SPDX-License-Identifier: Apache-2.0
// What goes through a real writer and a real reader comes out the same, and full published samples
// fit into one datagram.
#include "idl/sample_factory.hpp"

#include <stoss/dds/dds.hpp>
#include <stoss/idl/topics.hpp>

#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace stoss::tests {
namespace {

using namespace std::chrono_literals;
namespace wire = idl::wire;

constexpr std::uint32_t kDomain = 40;
constexpr std::uint64_t kSeed = 20240501;

dds::Network daemon_network() {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  return network;
}

std::string partition_of_this_test() {
  return ::testing::UnitTest::GetInstance()->current_test_info()->name();
}

// One writer and one reader of a topic in this process.
template <class T>
struct Loop {
  explicit Loop(const idl::TopicSpec<T>& spec)
      : participant(kDomain, daemon_network()),
        publisher(participant, partition_of_this_test()),
        subscriber(participant, partition_of_this_test()),
        topic(idl::make_topic(participant, spec)),
        reader(idl::make_reader(subscriber, topic, spec)),
        writer(idl::make_writer(publisher, topic, spec)) {}

  dds::Participant participant;
  dds::Publisher publisher;
  dds::Subscriber subscriber;
  dds::Topic<T> topic;
  dds::Reader<T> reader;
  dds::Writer<T> writer;
};

// The length of a sample as it goes over the wire, header of the encapsulation included.
template <class T>
std::size_t serialised_size(const idl::TopicSpec<T>& spec, const T& sample) {
  Loop<T> loop(spec);
  EXPECT_TRUE(loop.writer.write(sample));
  ddsi_serdata* serdata = nullptr;
  dds_sample_info_t info;
  EXPECT_EQ(dds_takecdr(loop.reader.handle(), &serdata, 1, &info, DDS_ANY_STATE), 1);
  if (serdata == nullptr) return 0;
  const std::size_t size = ddsi_serdata_size(serdata);
  ddsi_serdata_unref(serdata);
  return size;
}

// Below the limit, and close enough to it that the bound is not wasteful.
template <class T>
void expect_one_datagram(const idl::TopicSpec<T>& spec, const T& sample) {
  const std::size_t size = serialised_size(spec, sample);
  std::printf("%s: %zu bytes at its bounds\n", spec.name, size);
  EXPECT_GT(size, 0U);
  EXPECT_LE(size, idl::kMaxSampleBytes);
}

TEST(SampleSize, FullMotionBatchIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::MotionBatch batch{};
  make.motions(batch.motions);
  make.statics(batch.statics);
  expect_one_datagram(idl::kMotionTopic, batch);
}

TEST(SampleSize, FullFrameChunkIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::FrameChunk chunk{};
  make.frame(chunk);
  expect_one_datagram(idl::kFrameTopic, chunk);
}

TEST(SampleSize, FullCollisionBatchIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::CollisionBatch batch{};
  make.collisions(batch.collisions);
  expect_one_datagram(idl::kCollisionTopic, batch);
}

TEST(SampleSize, FullZoneBatchIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::ZoneBatch batch{};
  make.zone_events(batch.events);
  expect_one_datagram(idl::kZoneTopic, batch);
}

TEST(SampleSize, FullSceneChunkIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::SceneChunk chunk{};
  idl::assign(chunk.world, std::string(stoss_v1_MAX_NAME_LENGTH, 'w'));
  idl::assign(chunk.scene_name, std::string(stoss_v1_MAX_NAME_LENGTH, 's'));
  make.scene(chunk);
  expect_one_datagram(idl::kSceneTopic, chunk);
}

TEST(SampleSize, FullStatusIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::Status status{};
  make.fill(status.counters, stoss_v1_MAX_COUNTERS);
  for (unsigned i = 0; i < stoss_v1_MAX_COUNTERS; ++i) {
    idl::assign(status.counters._buffer[i].name, std::string(stoss_v1_MAX_NAME_LENGTH, 'c'));
  }
  expect_one_datagram(idl::kStatusTopic, status);
}

// An answer fills the blocks of its question only.
TEST(SampleSize, FullAnswersAreOneDatagramEach) {
  const auto answer_with = [](auto fill) {
    SampleFactory make(kSeed);
    wire::Answer answer{};
    idl::assign(answer.reason, std::string(stoss_v1_MAX_REASON_LENGTH, 'r'));
    idl::assign(answer.field, std::string(stoss_v1_MAX_FIELD_LENGTH, 'f'));
    fill(make, answer);
    expect_one_datagram(idl::kAnswerTopic, answer);
  };
  answer_with([](SampleFactory& make, wire::Answer& answer) { make.states(answer.states); });
  answer_with([](SampleFactory& make, wire::Answer& answer) { make.walls(answer.walls); });
  answer_with([](SampleFactory& make, wire::Answer& answer) { make.hits(answer.hits); });
  answer_with(
      [](SampleFactory& make, wire::Answer& answer) { make.collisions(answer.collisions); });
  answer_with(
      [](SampleFactory& make, wire::Answer& answer) { make.zone_events(answer.zone_events); });
  answer_with([](SampleFactory& make, wire::Answer& answer) {
    make.texts(answer.features, stoss_v1_MAX_FEATURES);
  });
  answer_with([](SampleFactory& make, wire::Answer& answer) {
    make.motions(answer.motions);
    make.statics(answer.statics);
  });
}

TEST(SampleSize, FullReplyIsOneDatagram) {
  SampleFactory make(kSeed);
  wire::Reply reply{};
  make.fill(reply.ids, stoss_v1_MAX_COMMAND_BODIES);
  expect_one_datagram(idl::kReplyTopic, reply);
}

TEST(RoundTrip, FullMotionBatchKeepsEveryBit) {
  SampleFactory make(kSeed);
  Loop loop(idl::kMotionTopic);
  wire::MotionBatch sent{};
  sent.epoch = 3;
  sent.number = UINT64_MAX;
  sent.at = {INT64_MIN, UINT64_MAX};
  sent.state_hash = 0x0123456789ABCDEFU;
  make.motions(sent.motions);
  make.statics(sent.statics);
  ASSERT_TRUE(loop.writer.write(sent));
  const auto samples = loop.reader.take();
  ASSERT_EQ(samples.size(), 1U);
  const wire::MotionBatch& got = samples[0].data;
  EXPECT_EQ(got.epoch, sent.epoch);
  EXPECT_EQ(got.number, sent.number);
  EXPECT_EQ(got.at.seconds, sent.at.seconds);
  EXPECT_EQ(got.at.fraction, sent.at.fraction);
  EXPECT_EQ(got.state_hash, sent.state_hash);
  EXPECT_TRUE(same(got.motions.id, sent.motions.id));
  EXPECT_TRUE(same(got.motions.change, sent.motions.change));
  EXPECT_TRUE(same(got.motions.x, sent.motions.x));
  EXPECT_TRUE(same(got.motions.y_low, sent.motions.y_low));
  EXPECT_TRUE(same(got.motions.vx, sent.motions.vx));
  EXPECT_TRUE(same(got.motions.vy_low, sent.motions.vy_low));
  EXPECT_TRUE(same(got.motions.seconds, sent.motions.seconds));
  EXPECT_TRUE(same(got.motions.fraction, sent.motions.fraction));
  EXPECT_TRUE(same(got.motions.spin, sent.motions.spin));
  EXPECT_TRUE(same(got.statics.radius, sent.statics.radius));
  EXPECT_TRUE(same(got.statics.edge_y_low, sent.statics.edge_y_low));
}

TEST(RoundTrip, FullCommandArrives) {
  SampleFactory make(kSeed);
  Loop loop(idl::kCommandTopic);
  wire::Command sent{};
  sent.op = idl::wire_value(idl::Op::kSpawn);
  sent.request.number = 77;
  make.command(sent);
  ASSERT_TRUE(loop.writer.write(sent));
  const auto samples = loop.reader.take();
  ASSERT_EQ(samples.size(), 1U);
  const wire::Command& got = samples[0].data;
  EXPECT_EQ(got.request.number, 77U);
  EXPECT_EQ(static_cast<idl::Op>(got.op), idl::Op::kSpawn);
  EXPECT_TRUE(same(got.disks.radius, sent.disks.radius));
  EXPECT_TRUE(same(got.walls.end_y, sent.walls.end_y));
  EXPECT_TRUE(same(got.zones.x, sent.zones.x));
  ASSERT_EQ(got.names._length, stoss_v1_MAX_COMMAND_BODIES);
  EXPECT_EQ(idl::text(got.names._buffer[9].text), std::string(stoss_v1_MAX_NAME_LENGTH, 'n'));
}

TEST(RoundTrip, OperationNewerThanTheReceiverArrives) {
  Loop loop(idl::kCommandTopic);
  wire::Command sent{};
  sent.op = 60000;
  ASSERT_TRUE(loop.writer.write(sent));
  const auto samples = loop.reader.take();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].data.op, 60000);
  EXPECT_EQ(idl::name_of(static_cast<idl::Op>(samples[0].data.op)), "UNKNOWN");
}

TEST(RoundTrip, KeyedSampleIsDisposedOf) {
  Loop loop(idl::kBodyTopic);
  wire::BodyState body{};
  body.slot = 7;
  body.id = 12;
  ASSERT_TRUE(loop.writer.write(body));
  ASSERT_EQ(loop.reader.take().size(), 1U);
  ASSERT_TRUE(loop.writer.dispose(body));
  const auto samples = loop.reader.take();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_FALSE(samples[0].valid());
  EXPECT_TRUE(samples[0].disposed());
  EXPECT_EQ(samples[0].data.slot, 7U);
}

TEST(Sequence, LentArrayIsReadInPlace) {
  const std::vector<double> numbers{1, 2, 3};
  dds_sequence_double sequence{};
  idl::lend(sequence, std::span<const double>(numbers));
  EXPECT_EQ(idl::view(sequence).data(), numbers.data());
  EXPECT_EQ(idl::view(sequence).size(), 3U);
  EXPECT_FALSE(sequence._release);
  EXPECT_EQ(idl::at_or(sequence, 1, 9), 2);
  EXPECT_EQ(idl::at_or(sequence, 3, 9), 9);
}

TEST(Sequence, TextIsCutBetweenCharacters) {
  char room[5];
  EXPECT_TRUE(idl::assign(room, "abcd"));
  EXPECT_EQ(idl::text(room), "abcd");
  EXPECT_FALSE(idl::assign(room, "abcde"));
  EXPECT_EQ(idl::text(room), "abcd");
  EXPECT_FALSE(idl::assign(room, "abc\xC3\xA4"));
  EXPECT_EQ(idl::text(room), "abc");
}

}  // namespace
}  // namespace stoss::tests

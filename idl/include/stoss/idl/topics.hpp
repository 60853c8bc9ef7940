// SPDX-License-Identifier: Apache-2.0
// Topic names, their types, their quality of service and their partitions: the one copy that both
// sides use. PROTOCOL.md explains the choices.
#pragma once

#include <stoss/dds/qos.hpp>
#include <stoss/dds/reader.hpp>
#include <stoss/dds/topic.hpp>
#include <stoss/dds/writer.hpp>
#include <stoss/idl/types.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stoss::idl {

/// The topics, in the order of kTopicNames.
enum class TopicId : std::uint8_t {
  kCommand,
  kReply,
  kQuery,
  kAnswer,
  kMotion,
  kFrame,
  kBody,
  kCollision,
  kZone,
  kScene,
  kStatus,
};
inline constexpr std::size_t kTopicCount = 11;

/// What ties a topic's name to its type.
template <class T>
struct TopicSpec {
  TopicId id;
  const char* name;
};

inline constexpr TopicSpec<wire::Command> kCommandTopic{TopicId::kCommand, "stoss/1/command"};
inline constexpr TopicSpec<wire::Reply> kReplyTopic{TopicId::kReply, "stoss/1/reply"};
inline constexpr TopicSpec<wire::Query> kQueryTopic{TopicId::kQuery, "stoss/1/query"};
inline constexpr TopicSpec<wire::Answer> kAnswerTopic{TopicId::kAnswer, "stoss/1/answer"};
inline constexpr TopicSpec<wire::MotionBatch> kMotionTopic{TopicId::kMotion, "stoss/1/motion"};
inline constexpr TopicSpec<wire::FrameChunk> kFrameTopic{TopicId::kFrame, "stoss/1/frame"};
inline constexpr TopicSpec<wire::BodyState> kBodyTopic{TopicId::kBody, "stoss/1/body"};
inline constexpr TopicSpec<wire::CollisionBatch> kCollisionTopic{TopicId::kCollision,
                                                                 "stoss/1/collision"};
inline constexpr TopicSpec<wire::ZoneBatch> kZoneTopic{TopicId::kZone, "stoss/1/zone"};
inline constexpr TopicSpec<wire::SceneChunk> kSceneTopic{TopicId::kScene, "stoss/1/scene"};
inline constexpr TopicSpec<wire::Status> kStatusTopic{TopicId::kStatus, "stoss/1/status"};

/// A published sample is at most this long when serialised, so that it travels as one datagram.
inline constexpr std::size_t kMaxSampleBytes = std::size_t{60} * 1024;

/// The samples that a writer of batches (motion, collision, zone) keeps for a reader that lags
/// behind.
inline constexpr std::int32_t kBatchDepth = 256;

/// The replies that a mailbox keeps for a client that lags behind, and those that it keeps for a
/// client that finds the mailbox after they were written.
inline constexpr std::int32_t kReplyDepth = 1024;
inline constexpr std::int32_t kReplyReplay = 64;

/// The same for chunks of answers.
inline constexpr std::int32_t kAnswerDepth = 4096;
inline constexpr std::int32_t kAnswerReplay = 8;

/// The quality of service of a topic's writers and readers. Partitions belong to the publisher and
/// the subscriber and are not in it.
[[nodiscard]] dds::Qos writer_qos(TopicId topic);
[[nodiscard]] dds::Qos reader_qos(TopicId topic);

/// A world's name is 1 to 64 characters of [A-Za-z0-9._-], so that it is a partition, a file name
/// and a word in a shell.
[[nodiscard]] bool valid_world_name(std::string_view world) noexcept;

/// The partition of a world's topics: its name. Throws std::invalid_argument for a bad name.
[[nodiscard]] std::string partition_of(std::string_view world);

/// The partition in which one client gets its replies and answers: "<world>/<client in hex>".
/// Throws std::invalid_argument for a bad name.
[[nodiscard]] std::string mailbox_of(std::string_view world,
                                     const std::array<std::uint8_t, 16>& client);
/// The same, for the client of a received request.
[[nodiscard]] std::string mailbox_of(std::string_view world, const wire::RequestId& request);

/// Makes the topic of a specification.
template <class T>
[[nodiscard]] dds::Topic<T> make_topic(const dds::Participant& participant,
                                       const TopicSpec<T>& spec) {
  return dds::Topic<T>(participant, spec.name);
}

/// Makes a writer with the topic's quality of service.
template <class T>
[[nodiscard]] dds::Writer<T> make_writer(const dds::Publisher& publisher,
                                         const dds::Topic<T>& topic,
                                         const TopicSpec<T>& spec) {
  return dds::Writer<T>(publisher, topic, writer_qos(spec.id));
}

/// Makes a reader with the topic's quality of service.
template <class T>
[[nodiscard]] dds::Reader<T> make_reader(const dds::Subscriber& subscriber,
                                         const dds::Topic<T>& topic,
                                         const TopicSpec<T>& spec) {
  return dds::Reader<T>(subscriber, topic, reader_qos(spec.id));
}

}  // namespace stoss::idl

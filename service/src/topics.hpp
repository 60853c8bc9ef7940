// SPDX-License-Identifier: Apache-2.0
// The DDS topics of a world, made once a participant.
#pragma once

#include <stoss/dds/dds.hpp>
#include <stoss/idl/topics.hpp>

namespace stoss::service {

namespace wire = idl::wire;

/// Must outlive the readers and writers made of it, and not its participant.
struct Topics {
  explicit Topics(const dds::Participant& participant)
      : command(idl::make_topic(participant, idl::kCommandTopic)),
        reply(idl::make_topic(participant, idl::kReplyTopic)),
        query(idl::make_topic(participant, idl::kQueryTopic)),
        answer(idl::make_topic(participant, idl::kAnswerTopic)),
        motion(idl::make_topic(participant, idl::kMotionTopic)),
        frame(idl::make_topic(participant, idl::kFrameTopic)),
        body(idl::make_topic(participant, idl::kBodyTopic)),
        collision(idl::make_topic(participant, idl::kCollisionTopic)),
        zone(idl::make_topic(participant, idl::kZoneTopic)),
        scene(idl::make_topic(participant, idl::kSceneTopic)),
        status(idl::make_topic(participant, idl::kStatusTopic)) {}

  dds::Topic<wire::Command> command;
  dds::Topic<wire::Reply> reply;
  dds::Topic<wire::Query> query;
  dds::Topic<wire::Answer> answer;
  dds::Topic<wire::MotionBatch> motion;
  dds::Topic<wire::FrameChunk> frame;
  dds::Topic<wire::BodyState> body;
  dds::Topic<wire::CollisionBatch> collision;
  dds::Topic<wire::ZoneBatch> zone;
  dds::Topic<wire::SceneChunk> scene;
  dds::Topic<wire::Status> status;
};

}  // namespace stoss::service

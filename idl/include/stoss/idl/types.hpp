// SPDX-License-Identifier: Apache-2.0
// The generated DDS types under short names, their descriptors, and typed forms of their choices.
#pragma once

#include <stoss/dds/topic.hpp>

#include <stoss.h>

#include <cstdint>
#include <string_view>
#include <type_traits>

namespace stoss::idl::wire {

using RequestId = stoss_v1_RequestId;
using Instant = stoss_v1_Instant;
using Name = stoss_v1_Name;
using DiskBlock = stoss_v1_DiskBlock;
using WallBlock = stoss_v1_WallBlock;
using ZoneBlock = stoss_v1_ZoneBlock;
using StateBlock = stoss_v1_StateBlock;
using MotionBlock = stoss_v1_MotionBlock;
using StaticBlock = stoss_v1_StaticBlock;
using CollisionBlock = stoss_v1_CollisionBlock;
using ZoneEventBlock = stoss_v1_ZoneEventBlock;
using HitBlock = stoss_v1_HitBlock;
using Counter = stoss_v1_Counter;

using Command = stoss_v1_Command;
using Reply = stoss_v1_Reply;
using Query = stoss_v1_Query;
using Answer = stoss_v1_Answer;
using MotionBatch = stoss_v1_MotionBatch;
using FrameChunk = stoss_v1_FrameChunk;
using BodyState = stoss_v1_BodyState;
using CollisionBatch = stoss_v1_CollisionBatch;
using ZoneBatch = stoss_v1_ZoneBatch;
using SceneChunk = stoss_v1_SceneChunk;
using Status = stoss_v1_Status;

}  // namespace stoss::idl::wire

namespace stoss::idl {

/// The protocol version that this code speaks.
inline constexpr std::uint16_t kProtocol = stoss_v1_PROTOCOL;

/// What a command does. Values on the wire may be newer than this list.
enum class Op : std::uint16_t {
  kSpawn = stoss_v1_OP_SPAWN,
  kRemove = stoss_v1_OP_REMOVE,
  kSetVelocity = stoss_v1_OP_SET_VELOCITY,
  kApplyImpulse = stoss_v1_OP_APPLY_IMPULSE,
  kSetEffects = stoss_v1_OP_SET_EFFECTS,
  kPause = stoss_v1_OP_PAUSE,
  kResume = stoss_v1_OP_RESUME,
  kStep = stoss_v1_OP_STEP,
  kRunFor = stoss_v1_OP_RUN_FOR,
  kRunTo = stoss_v1_OP_RUN_TO,
  kSetSpeed = stoss_v1_OP_SET_SPEED,
  kReset = stoss_v1_OP_RESET,
  kSnapshot = stoss_v1_OP_SNAPSHOT,
  kRestore = stoss_v1_OP_RESTORE,
  kWatch = stoss_v1_OP_WATCH,
  kUnwatch = stoss_v1_OP_UNWATCH,
};

/// What a query asks. Values on the wire may be newer than this list.
enum class Ask : std::uint16_t {
  kStates = stoss_v1_ASK_STATES,
  kList = stoss_v1_ASK_LIST,
  kRegion = stoss_v1_ASK_REGION,
  kNearest = stoss_v1_ASK_NEAREST,
  kRay = stoss_v1_ASK_RAY,
  kWorld = stoss_v1_ASK_WORLD,
  kCollisions = stoss_v1_ASK_COLLISIONS,
  kZoneEvents = stoss_v1_ASK_ZONE_EVENTS,
  kFeatures = stoss_v1_ASK_FEATURES,
  kStatus = stoss_v1_ASK_STATUS,
  kPredict = stoss_v1_ASK_PREDICT,
  kForecast = stoss_v1_ASK_FORECAST,
};

/// The result of a command or a query.
enum class Code : std::uint16_t {
  kOk = stoss_v1_CODE_OK,
  kInvalidArgument = stoss_v1_CODE_INVALID_ARGUMENT,
  kNotFound = stoss_v1_CODE_NOT_FOUND,
  kAlreadyExists = stoss_v1_CODE_ALREADY_EXISTS,
  kOverlap = stoss_v1_CODE_OVERLAP,
  kFailedPrecondition = stoss_v1_CODE_FAILED_PRECONDITION,
  kResourceExhausted = stoss_v1_CODE_RESOURCE_EXHAUSTED,
  kUnimplemented = stoss_v1_CODE_UNIMPLEMENTED,
  kUnavailable = stoss_v1_CODE_UNAVAILABLE,
  kDeadlinePassed = stoss_v1_CODE_DEADLINE_PASSED,
  kInternal = stoss_v1_CODE_INTERNAL,
};

enum class BodyKind : std::uint8_t {
  kDynamic = stoss_v1_KIND_DYNAMIC,
  kKinematic = stoss_v1_KIND_KINEMATIC,
  kStatic = stoss_v1_KIND_STATIC,
  kWall = stoss_v1_KIND_WALL,
};

enum class Change : std::uint8_t {
  kSpawned = stoss_v1_CHANGE_SPAWNED,
  kMoved = stoss_v1_CHANGE_MOVED,
  kRemoved = stoss_v1_CHANGE_REMOVED,
};

enum class Law : std::uint8_t {
  kUniform = stoss_v1_LAW_UNIFORM,
  kAccelerated = stoss_v1_LAW_ACCELERATED,
  kDragged = stoss_v1_LAW_DRAGGED,
  kGrowing = stoss_v1_LAW_GROWING,
};

enum class CollisionKind : std::uint8_t {
  kDiskDisk = stoss_v1_COLLISION_DISK_DISK,
  kDiskWall = stoss_v1_COLLISION_DISK_WALL,
  kDiskWallEnd = stoss_v1_COLLISION_DISK_WALL_END,
};

enum class Arithmetic : std::uint8_t {
  kFloat = stoss_v1_ARITHMETIC_FLOAT,
  kDouble = stoss_v1_ARITHMETIC_DOUBLE,
  kLongDouble = stoss_v1_ARITHMETIC_LONG_DOUBLE,
  kDoubleDouble = stoss_v1_ARITHMETIC_DOUBLE_DOUBLE,
  kFloat128 = stoss_v1_ARITHMETIC_FLOAT128,
};

enum class WorldState : std::uint8_t {
  kStopped = stoss_v1_STATE_STOPPED,
  kRunning = stoss_v1_STATE_RUNNING,
  kPaused = stoss_v1_STATE_PAUSED,
  kFailed = stoss_v1_STATE_FAILED,
};

/// Flags of a collision, added up in CollisionBlock.flags.
inline constexpr std::uint8_t kRegularised = stoss_v1_FLAG_REGULARISED;
inline constexpr std::uint8_t kOrderDependent = stoss_v1_FLAG_ORDER_DEPENDENT;

/// The number that stands for a choice on the wire.
template <class Choice>
[[nodiscard]] constexpr auto wire_value(Choice choice) noexcept {
  return static_cast<std::underlying_type_t<Choice>>(choice);
}

/// The choice's word in upper case, as "RESOURCE_EXHAUSTED"; "UNKNOWN" for a value not known here.
[[nodiscard]] std::string_view name_of(Op op) noexcept;
[[nodiscard]] std::string_view name_of(Ask ask) noexcept;
[[nodiscard]] std::string_view name_of(Code code) noexcept;
[[nodiscard]] std::string_view name_of(BodyKind kind) noexcept;
[[nodiscard]] std::string_view name_of(CollisionKind kind) noexcept;
[[nodiscard]] std::string_view name_of(Arithmetic arithmetic) noexcept;
[[nodiscard]] std::string_view name_of(WorldState state) noexcept;

}  // namespace stoss::idl

#define STOSS_TOPIC_TYPE(Name)                                                                    \
  template <>                                                                                     \
  struct stoss::dds::TopicType<stoss_v1_##Name> {                                                 \
    static const dds_topic_descriptor_t& descriptor() noexcept { return stoss_v1_##Name##_desc; } \
  }
STOSS_TOPIC_TYPE(Command);
STOSS_TOPIC_TYPE(Reply);
STOSS_TOPIC_TYPE(Query);
STOSS_TOPIC_TYPE(Answer);
STOSS_TOPIC_TYPE(MotionBatch);
STOSS_TOPIC_TYPE(FrameChunk);
STOSS_TOPIC_TYPE(BodyState);
STOSS_TOPIC_TYPE(CollisionBatch);
STOSS_TOPIC_TYPE(ZoneBatch);
STOSS_TOPIC_TYPE(SceneChunk);
STOSS_TOPIC_TYPE(Status);
#undef STOSS_TOPIC_TYPE

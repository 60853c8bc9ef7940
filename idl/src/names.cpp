// SPDX-License-Identifier: Apache-2.0
// The words for the choices on the wire. The switches are exhaustive: a new choice without a word
// does not compile.
#include <stoss/idl/types.hpp>

namespace stoss::idl {
namespace {
constexpr std::string_view kUnknown = "UNKNOWN";
}  // namespace

std::string_view name_of(Op op) noexcept {
  switch (op) {
    case Op::kSpawn:
      return "SPAWN";
    case Op::kRemove:
      return "REMOVE";
    case Op::kSetVelocity:
      return "SET_VELOCITY";
    case Op::kApplyImpulse:
      return "APPLY_IMPULSE";
    case Op::kSetEffects:
      return "SET_EFFECTS";
    case Op::kPause:
      return "PAUSE";
    case Op::kResume:
      return "RESUME";
    case Op::kStep:
      return "STEP";
    case Op::kRunFor:
      return "RUN_FOR";
    case Op::kRunTo:
      return "RUN_TO";
    case Op::kSetSpeed:
      return "SET_SPEED";
    case Op::kReset:
      return "RESET";
    case Op::kSnapshot:
      return "SNAPSHOT";
    case Op::kRestore:
      return "RESTORE";
    case Op::kWatch:
      return "WATCH";
    case Op::kUnwatch:
      return "UNWATCH";
  }
  return kUnknown;
}

std::string_view name_of(Ask ask) noexcept {
  switch (ask) {
    case Ask::kStates:
      return "STATES";
    case Ask::kList:
      return "LIST";
    case Ask::kRegion:
      return "REGION";
    case Ask::kNearest:
      return "NEAREST";
    case Ask::kRay:
      return "RAY";
    case Ask::kWorld:
      return "WORLD";
    case Ask::kCollisions:
      return "COLLISIONS";
    case Ask::kZoneEvents:
      return "ZONE_EVENTS";
    case Ask::kFeatures:
      return "FEATURES";
    case Ask::kStatus:
      return "STATUS";
    case Ask::kPredict:
      return "PREDICT";
    case Ask::kForecast:
      return "FORECAST";
  }
  return kUnknown;
}

std::string_view name_of(Code code) noexcept {
  switch (code) {
    case Code::kOk:
      return "OK";
    case Code::kInvalidArgument:
      return "INVALID_ARGUMENT";
    case Code::kNotFound:
      return "NOT_FOUND";
    case Code::kAlreadyExists:
      return "ALREADY_EXISTS";
    case Code::kOverlap:
      return "OVERLAP";
    case Code::kFailedPrecondition:
      return "FAILED_PRECONDITION";
    case Code::kResourceExhausted:
      return "RESOURCE_EXHAUSTED";
    case Code::kUnimplemented:
      return "UNIMPLEMENTED";
    case Code::kUnavailable:
      return "UNAVAILABLE";
    case Code::kDeadlinePassed:
      return "DEADLINE_PASSED";
    case Code::kInternal:
      return "INTERNAL";
  }
  return kUnknown;
}

std::string_view name_of(BodyKind kind) noexcept {
  switch (kind) {
    case BodyKind::kDynamic:
      return "DYNAMIC";
    case BodyKind::kKinematic:
      return "KINEMATIC";
    case BodyKind::kStatic:
      return "STATIC";
    case BodyKind::kWall:
      return "WALL";
  }
  return kUnknown;
}

std::string_view name_of(CollisionKind kind) noexcept {
  switch (kind) {
    case CollisionKind::kDiskDisk:
      return "DISK_DISK";
    case CollisionKind::kDiskWall:
      return "DISK_WALL";
    case CollisionKind::kDiskWallEnd:
      return "DISK_WALL_END";
  }
  return kUnknown;
}

std::string_view name_of(Arithmetic arithmetic) noexcept {
  switch (arithmetic) {
    case Arithmetic::kFloat:
      return "FLOAT";
    case Arithmetic::kDouble:
      return "DOUBLE";
    case Arithmetic::kLongDouble:
      return "LONG_DOUBLE";
    case Arithmetic::kDoubleDouble:
      return "DOUBLE_DOUBLE";
    case Arithmetic::kFloat128:
      return "FLOAT128";
  }
  return kUnknown;
}

std::string_view name_of(WorldState state) noexcept {
  switch (state) {
    case WorldState::kStopped:
      return "STOPPED";
    case WorldState::kRunning:
      return "RUNNING";
    case WorldState::kPaused:
      return "PAUSED";
    case WorldState::kFailed:
      return "FAILED";
  }
  return kUnknown;
}

}  // namespace stoss::idl

// SPDX-License-Identifier: Apache-2.0
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/basics.hpp>

#include <algorithm>

namespace stoss::translate {
namespace {

using engine::Code;

struct ArithmeticWord {
  engine::Arithmetic arithmetic;
  std::string_view word;
};
constexpr std::array kArithmeticWords{
    ArithmeticWord{engine::Arithmetic::Float, "float"},
    ArithmeticWord{engine::Arithmetic::Double, "double"},
    ArithmeticWord{engine::Arithmetic::LongDouble, "long-double"},
    ArithmeticWord{engine::Arithmetic::DoubleDouble, "double-double"},
    ArithmeticWord{engine::Arithmetic::Float128, "float128"},
};

// The part of a refusal that Reply and Answer have in common.
template <class Sample>
void put_common(Sample& sample, const engine::Reject& reject) {
  sample.code = idl::wire_value(to_wire(reject.code));
  idl::assign(sample.reason, reject.reason);
  idl::assign(sample.field, wire_field(reject.field));
  sample.body = reject.body;
}

template <class Sample>
engine::Reject common_reject_of(const Sample& sample) {
  return {.code = code_of(sample.code).value_or(Code::Internal),
          .field = std::string(idl::text(sample.field)),
          .body = sample.body,
          .reason = std::string(idl::text(sample.reason))};
}

}  // namespace

RequestId to_engine(const wire::RequestId& request) {
  return {std::to_array(request.client), request.number};
}

wire::RequestId to_wire(const RequestId& request) {
  wire::RequestId result{};
  std::copy(request.client.begin(), request.client.end(), result.client);
  result.number = request.number;
  return result;
}

engine::Instant to_engine(const wire::Instant& instant) {
  return {instant.seconds, instant.fraction};
}

wire::Instant to_wire(const engine::Instant& instant) {
  return {instant.seconds, instant.fraction};
}

idl::Code to_wire(Code code) {
  switch (code) {
    case Code::Ok:
      return idl::Code::kOk;
    case Code::InvalidArgument:
      return idl::Code::kInvalidArgument;
    case Code::NotFound:
      return idl::Code::kNotFound;
    case Code::AlreadyExists:
      return idl::Code::kAlreadyExists;
    case Code::Overlap:
      return idl::Code::kOverlap;
    case Code::FailedPrecondition:
      return idl::Code::kFailedPrecondition;
    case Code::ResourceExhausted:
      return idl::Code::kResourceExhausted;
    case Code::Unimplemented:
      return idl::Code::kUnimplemented;
    case Code::Unavailable:
      return idl::Code::kUnavailable;
    case Code::DeadlinePassed:
      return idl::Code::kDeadlinePassed;
    case Code::Internal:
      return idl::Code::kInternal;
  }
  return idl::Code::kInternal;
}

std::optional<Code> code_of(std::uint16_t value) {
  switch (static_cast<idl::Code>(value)) {
    case idl::Code::kOk:
      return Code::Ok;
    case idl::Code::kInvalidArgument:
      return Code::InvalidArgument;
    case idl::Code::kNotFound:
      return Code::NotFound;
    case idl::Code::kAlreadyExists:
      return Code::AlreadyExists;
    case idl::Code::kOverlap:
      return Code::Overlap;
    case idl::Code::kFailedPrecondition:
      return Code::FailedPrecondition;
    case idl::Code::kResourceExhausted:
      return Code::ResourceExhausted;
    case idl::Code::kUnimplemented:
      return Code::Unimplemented;
    case idl::Code::kUnavailable:
      return Code::Unavailable;
    case idl::Code::kDeadlinePassed:
      return Code::DeadlinePassed;
    case idl::Code::kInternal:
      return Code::Internal;
  }
  return std::nullopt;
}

idl::Arithmetic to_wire(engine::Arithmetic arithmetic) {
  switch (arithmetic) {
    case engine::Arithmetic::Float:
      return idl::Arithmetic::kFloat;
    case engine::Arithmetic::Double:
      return idl::Arithmetic::kDouble;
    case engine::Arithmetic::LongDouble:
      return idl::Arithmetic::kLongDouble;
    case engine::Arithmetic::DoubleDouble:
      return idl::Arithmetic::kDoubleDouble;
    case engine::Arithmetic::Float128:
      return idl::Arithmetic::kFloat128;
  }
  return idl::Arithmetic::kDouble;
}

std::optional<engine::Arithmetic> arithmetic_of(std::uint8_t value) {
  switch (static_cast<idl::Arithmetic>(value)) {
    case idl::Arithmetic::kFloat:
      return engine::Arithmetic::Float;
    case idl::Arithmetic::kDouble:
      return engine::Arithmetic::Double;
    case idl::Arithmetic::kLongDouble:
      return engine::Arithmetic::LongDouble;
    case idl::Arithmetic::kDoubleDouble:
      return engine::Arithmetic::DoubleDouble;
    case idl::Arithmetic::kFloat128:
      return engine::Arithmetic::Float128;
  }
  return std::nullopt;
}

idl::BodyKind to_wire(engine::BodyKind kind) {
  switch (kind) {
    case engine::BodyKind::Dynamic:
      return idl::BodyKind::kDynamic;
    case engine::BodyKind::Kinematic:
      return idl::BodyKind::kKinematic;
    case engine::BodyKind::Static:
      return idl::BodyKind::kStatic;
  }
  return idl::BodyKind::kDynamic;
}

std::optional<engine::BodyKind> body_kind_of(std::uint8_t value) {
  switch (static_cast<idl::BodyKind>(value)) {
    case idl::BodyKind::kDynamic:
      return engine::BodyKind::Dynamic;
    case idl::BodyKind::kKinematic:
      return engine::BodyKind::Kinematic;
    case idl::BodyKind::kStatic:
      return engine::BodyKind::Static;
    case idl::BodyKind::kWall:
      return std::nullopt;
  }
  return std::nullopt;
}

idl::Change to_wire(engine::ChangeKind change) {
  switch (change) {
    case engine::ChangeKind::Spawned:
      return idl::Change::kSpawned;
    case engine::ChangeKind::Moved:
      return idl::Change::kMoved;
    case engine::ChangeKind::Removed:
      return idl::Change::kRemoved;
  }
  return idl::Change::kMoved;
}

std::optional<engine::ChangeKind> change_of(std::uint8_t value) {
  switch (static_cast<idl::Change>(value)) {
    case idl::Change::kSpawned:
      return engine::ChangeKind::Spawned;
    case idl::Change::kMoved:
      return engine::ChangeKind::Moved;
    case idl::Change::kRemoved:
      return engine::ChangeKind::Removed;
  }
  return std::nullopt;
}

idl::CollisionKind to_wire(engine::ContactKind kind) {
  switch (kind) {
    case engine::ContactKind::DiskDisk:
      return idl::CollisionKind::kDiskDisk;
    case engine::ContactKind::DiskWall:
      return idl::CollisionKind::kDiskWall;
    case engine::ContactKind::DiskWallEnd:
      return idl::CollisionKind::kDiskWallEnd;
  }
  return idl::CollisionKind::kDiskDisk;
}

std::optional<engine::ContactKind> contact_kind_of(std::uint8_t value) {
  switch (static_cast<idl::CollisionKind>(value)) {
    case idl::CollisionKind::kDiskDisk:
      return engine::ContactKind::DiskDisk;
    case idl::CollisionKind::kDiskWall:
      return engine::ContactKind::DiskWall;
    case idl::CollisionKind::kDiskWallEnd:
      return engine::ContactKind::DiskWallEnd;
  }
  return std::nullopt;
}

std::string_view name_of(engine::BroadPhaseKind kind) {
  switch (kind) {
    case engine::BroadPhaseKind::Neighbours:
      return "neighbours";
    case engine::BroadPhaseKind::AllPairs:
      return "all-pairs";
  }
  return "neighbours";
}

std::optional<engine::BroadPhaseKind> broad_phase_of(std::string_view name) {
  for (const auto kind : {engine::BroadPhaseKind::Neighbours, engine::BroadPhaseKind::AllPairs}) {
    if (name_of(kind) == name) return kind;
  }
  return std::nullopt;
}

std::string_view name_of(engine::Arithmetic arithmetic) {
  for (const ArithmeticWord& entry : kArithmeticWords) {
    if (entry.arithmetic == arithmetic) return entry.word;
  }
  return "unknown";
}

std::optional<engine::Arithmetic> arithmetic_of(std::string_view name) {
  for (const ArithmeticWord& entry : kArithmeticWords) {
    if (entry.word == name) return entry.arithmetic;
  }
  return std::nullopt;
}

std::string wire_field(std::string_view field) {
  std::string result;
  bool in_brackets = false;
  for (const char c : field) {
    if (c == '[') in_brackets = true;
    if (!in_brackets) result += c;
    if (c == ']') in_brackets = false;
  }
  return result;
}

engine::Reject unknown_protocol(std::uint16_t asked) {
  return {.code = Code::Unimplemented,
          .field = "protocol",
          .reason = "this daemon speaks protocol " + std::to_string(idl::kProtocol) + ", not " +
                    std::to_string(asked)};
}

void put_reject(wire::Reply& reply, const engine::Reject& reject) {
  put_common(reply, reject);
  reply.index = static_cast<std::uint32_t>(reject.index);
  reply.other = reject.other;
  reply.clearance = reject.clearance;
}

void put_reject(wire::Answer& answer, const engine::Reject& reject) { put_common(answer, reject); }

engine::Reject reject_of(const wire::Reply& reply) {
  engine::Reject reject = common_reject_of(reply);
  reject.index = reply.index;
  reject.other = reply.other;
  reject.clearance = reply.clearance;
  return reject;
}

engine::Reject reject_of(const wire::Answer& answer) { return common_reject_of(answer); }

}  // namespace stoss::translate

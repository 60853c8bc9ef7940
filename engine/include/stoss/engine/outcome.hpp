// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a command comes back with: its result, or a refusal that names what was wrong.
// A refused command has changed nothing.

#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace stoss::engine {

/// One code per cause. The numbers are part of the protocol.
enum class Code : std::uint8_t {
  Ok = 0,
  InvalidArgument = 1,
  NotFound = 2,
  AlreadyExists = 3,
  Overlap = 4,
  FailedPrecondition = 5,
  ResourceExhausted = 6,
  Unimplemented = 7,
  Unavailable = 8,
  DeadlinePassed = 9,
  Internal = 10,
};

/// The code as the protocol spells it, as "INVALID_ARGUMENT".
const char* to_string(Code code);

/// Why a command was refused.
struct Reject {
  Code code = Code::Internal;
  std::string field;      ///< the offending field, as "disks[3].radius"
  std::size_t index = 0;  ///< which element of the command's list
  Id body = kNoId;        ///< the body that the field belongs to
  Id other = kNoId;       ///< the body in the way, for Overlap
  double clearance = 0;   ///< m between the two surfaces; negative: they overlap by that much
  std::string reason;     ///< a sentence for people
};

/// A value or a refusal.
template <class T>
class [[nodiscard]] Outcome {
 public:
  Outcome(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Outcome(Reject reject) : state_(std::in_place_index<1>, std::move(reject)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  /// REQUIRES: ok()
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  /// REQUIRES: !ok()
  const Reject& reject() const { return std::get<1>(state_); }

 private:
  std::variant<T, Reject> state_;
};

/// The value of an outcome that has none.
struct Done {};

}  // namespace stoss::engine

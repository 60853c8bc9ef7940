// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the command tells its caller, and the errors that lead there.

#include <stoss/engine/outcome.hpp>

#include <stdexcept>
#include <string>
#include <utility>

namespace stoss::client::cli {

enum class ExitCode : int {
  Done = 0,
  Refused = 1,   ///< by the world, or by the file that was to be read or written
  BadUsage = 2,  ///< the command line makes no sense
  NoAnswer = 3,  ///< no world answered in time
};

/// The command line makes no sense. Becomes ExitCode::BadUsage and its text.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Nobody answered in time. Becomes ExitCode::NoAnswer and its text.
class NoAnswerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A refusal. Becomes ExitCode::Refused and "CODE: reason (field, body)".
class RefusedError : public std::runtime_error {
 public:
  explicit RefusedError(engine::Reject reject);
  [[nodiscard]] const engine::Reject& reject() const { return reject_; }

 private:
  engine::Reject reject_;
};

/// "CODE: reason (field disks[3].radius, body 7, in the way: 5, clearance -0.25 m)".
[[nodiscard]] std::string describe(const engine::Reject& reject);

/// The value of an outcome, or a RefusedError.
template <class T>
[[nodiscard]] T value_or_refuse(engine::Outcome<T> outcome) {
  if (!outcome) throw RefusedError(outcome.reject());
  return std::move(outcome).value();
}

}  // namespace stoss::client::cli

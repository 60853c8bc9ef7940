// SPDX-License-Identifier: Apache-2.0
// What a request comes back with: a value, a refusal by the world, or silence.
#pragma once

#include <stoss/engine/instant.hpp>
#include <stoss/engine/outcome.hpp>

#include <cstddef>
#include <utility>
#include <variant>

namespace stoss::client {

/// Why a request has no value.
struct Failure {
  /// False: nobody answered in time. A command may have been applied all the same.
  bool answered = false;
  /// The world's refusal; for silence its code is Unavailable.
  engine::Reject reject{};
  /// When the world refused.
  engine::Instant at{};
};

/// A value or a failure.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Failure failure) : state_(std::in_place_index<1>, std::move(failure)) {}

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  /// REQUIRES: ok()
  [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
  /// REQUIRES: !ok()
  [[nodiscard]] const Failure& failure() const { return std::get<1>(state_); }

 private:
  std::variant<T, Failure> state_;
};

}  // namespace stoss::client

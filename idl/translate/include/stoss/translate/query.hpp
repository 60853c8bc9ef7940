// SPDX-License-Identifier: Apache-2.0
// A received Query in the engine's words.
#pragma once

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/translate/basics.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace stoss::translate {

/// A question as plain data; what its operation does not use is empty.
struct QuerySpec {
  RequestId request;
  std::uint16_t op = 0;  ///< idl::Ask, or a number that is newer than this program
  std::optional<engine::Instant> at;
  std::vector<engine::Id> ids;
  engine::Vector2 low = engine::Vector2::Zero();   ///< m; ASK_REGION
  engine::Vector2 high = engine::Vector2::Zero();  ///< m; ASK_REGION
  engine::Vector2 point = engine::Vector2::Zero();
  engine::Vector2 direction = engine::Vector2::Zero();
  double distance = 0;  ///< m for ASK_RAY, s for ASK_PREDICT and ASK_FORECAST
  std::uint64_t number = 0;
  std::uint64_t count = 0;
};

/// Errors: Unimplemented for another protocol version.
[[nodiscard]] engine::Outcome<QuerySpec> query_of(const wire::Query& query);

}  // namespace stoss::translate

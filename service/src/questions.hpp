// SPDX-License-Identifier: Apache-2.0
// Answers to questions about a world at its present instant, from the world itself.
#pragma once

#include "records.hpp"

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/world.hpp>

#include <string>
#include <vector>

namespace stoss::service {

/// The most bodies that a search by nearness yields.
inline constexpr std::size_t kNearestMax = 4096;

/// Answers ASK_STATES, ASK_LIST, ASK_REGION, ASK_NEAREST, ASK_RAY and ASK_FORECAST (as ASK_STATES,
/// or ASK_LIST without ids). Errors: InvalidArgument, NotFound; Unimplemented for anything else.
[[nodiscard]] engine::Outcome<Rows> answer(const engine::World& world,
                                           const translate::QuerySpec& query);

/// What this daemon can do: words of ROS 2's simulation_interfaces where there is one, then the
/// operations, arithmetics, effects and which do not go together; and the numbers of those on.
[[nodiscard]] std::vector<std::string> features(const engine::Effects& on);

}  // namespace stoss::service

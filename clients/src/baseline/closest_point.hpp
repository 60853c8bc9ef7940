// SPDX-License-Identifier: Apache-2.0
#pragma once

// The point of a segment from the origin to `edge` that is nearest to a point.

#include <stoss/engine/types.hpp>

#include <algorithm>

namespace stoss::client::baseline {

/// Lengths in m. REQUIRES: edge is not zero.
inline engine::Vector2 closest_point(const engine::Vector2& edge, const engine::Vector2& point) {
  return std::clamp(point.dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
}

}  // namespace stoss::client::baseline

// SPDX-License-Identifier: Apache-2.0
// Collisions, zone events and states as JSON Lines: the canonical Protobuf mapping of
// stoss.Collision, stoss.ZoneEvent and stoss.BodyState.
#pragma once

#include <stoss/engine/types.hpp>

#include <string>

namespace stoss::client {

/// Appends one object, without a line end.
void append_json(std::string& out, const engine::Collision& collision);
void append_json(std::string& out, const engine::ZoneEvent& event);
void append_json(std::string& out, const engine::BodyState& state);
/// A wall as a BodyState: that of its start point, with no radius.
void append_json(std::string& out, const engine::WallState& wall);

}  // namespace stoss::client

// SPDX-License-Identifier: Apache-2.0
// JSON Lines of collisions, zone events and states, written by hand because the library's printer
// takes microseconds a line. What is written is the canonical Protobuf JSON mapping of
// stoss.Collision, stoss.ZoneEvent and stoss.BodyState with proto field names: 64-bit integers are
// strings, doubles are in the shortest form that reads back to the same bits, and a field at its
// default is absent. (A message field that is always set, as a position, is printed even when it is
// zero: as {}.)
#pragma once

#include <stoss/idl/types.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stoss::idl {

/// A point, a velocity or a direction in a line.
struct Pair {
  double x = 0;
  double y = 0;
};

/// What one line of a collision log says; the fields are those of stoss.Collision.
struct CollisionLine {
  std::uint64_t sequence = 0;
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;
  CollisionKind kind = CollisionKind::kDiskDisk;
  std::uint64_t a = 0;
  std::uint64_t b = 0;
  Pair point;
  Pair normal;
  double impulse = 0;
  double approach_speed = 0;
  Pair velocity_a;
  Pair velocity_b;
  double spin_a = 0;
  double spin_b = 0;
  bool regularised = false;
  bool order_dependent = false;
};

/// What one line of a log of zone events says; the fields are those of stoss.ZoneEvent.
struct ZoneEventLine {
  std::uint64_t sequence = 0;
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;
  std::uint64_t zone = 0;
  std::uint64_t body = 0;
  bool entered = false;
  Pair position;
  Pair velocity;
};

/// What one line of a state log says; the fields are those of stoss.BodyState.
struct BodyStateLine {
  std::uint64_t id = 0;
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;
  Pair position;
  Pair velocity;
  double angle = 0;
  double spin = 0;
  double radius = 0;
};

/// Appends the object without a line end.
void append_collision(std::string& out, const CollisionLine& collision);
void append_zone_event(std::string& out, const ZoneEventLine& event);
void append_body_state(std::string& out, const BodyStateLine& state);

/// Appends a number as the lines have it: shortest form; "NaN", "Infinity", "-Infinity" in quotes.
void append_number(std::string& out, double value);
/// Appends text as a JSON string with its quotes; bytes that are not UTF-8 become U+FFFD.
void append_string(std::string& out, std::string_view text);

/// The i-th collision of a received batch. `first_number` is that of the block's first.
[[nodiscard]] CollisionLine collision_line(const wire::CollisionBlock& block,
                                           std::uint64_t first_number,
                                           std::size_t i);
/// The i-th state of a received block, which holds at `at`.
[[nodiscard]] BodyStateLine body_state_line(const wire::StateBlock& block,
                                            const wire::Instant& at,
                                            std::size_t i);

}  // namespace stoss::idl

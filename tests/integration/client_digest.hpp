// SPDX-License-Identifier: Apache-2.0
// States by their bits.
#pragma once

#include <stoss/client/feeds.hpp>
#include <stoss/engine/types.hpp>

#include <bit>
#include <cstdint>

namespace stoss::tests {

/// Mixes words; two series that differ in one bit give different digests, but for bad luck of
/// 2^-64.
class BitDigest {
 public:
  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15U;
    state_ ^= state_ >> 32U;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const engine::Vector2& v) {
    add(v.x());
    add(v.y());
  }
  void add(const engine::SplitNumber& n) {
    add(n.high);
    add(n.low);
  }
  void add(const engine::Instant& at) {
    add(static_cast<std::uint64_t>(at.seconds));
    add(at.fraction);
  }
  /// What a frame tells of a disk.
  void add(engine::Id id, const engine::Vector2& position, const engine::Vector2& velocity) {
    add(id);
    add(position);
    add(velocity);
  }
  void add(const engine::MotionRecord& m) {
    add(m.id);
    add(m.x);
    add(m.y);
    add(m.vx);
    add(m.vy);
    add(m.ax);
    add(m.ay);
    add(m.drag);
    add(m.radius);
    add(m.growth);
    add(m.since);
  }
  void add(const engine::BodyRecord& b) {
    add(b.id);
    add(std::uint64_t{b.is_wall});
    add(static_cast<std::uint64_t>(b.kind));
    add(b.radius);
    add(b.mass);
    add(b.edge_x);
    add(b.edge_y);
  }
  void add(const engine::Collision& c) {
    add(c.sequence);
    add(c.instant);
    add(static_cast<std::uint64_t>(c.kind));
    add(c.a);
    add(c.b);
    add(c.point);
    add(c.normal);
    add(c.impulse);
    add(c.approach_speed);
    add(c.velocity_a);
    add(c.velocity_b);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// Samples filled to their bounds with numbers that differ, and the memory behind them.
#pragma once

#include <stoss/idl/sequence.hpp>
#include <stoss/idl/types.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <random>
#include <type_traits>
#include <vector>

namespace stoss::tests {

/// Fills sequences; the samples made with it live as long as it does.
class SampleFactory {
 public:
  explicit SampleFactory(std::uint64_t seed) : generator_(seed) {}

  /// Gives the sequence `count` elements of random bits (for doubles: finite ones).
  template <class Sequence>
  void fill(Sequence& sequence, std::size_t count) {
    using Value = idl::Element<Sequence>;
    if constexpr (std::is_same_v<Value, bool>) {
      memory_.emplace_back(count, std::byte{1});
    } else {
      memory_.emplace_back(count * sizeof(Value));
    }
    auto* const values = reinterpret_cast<Value*>(memory_.back().data());
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (std::is_floating_point_v<Value>) {
        values[i] = std::normal_distribution<double>(0, 1e3)(generator_);
      } else if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
        values[i] = static_cast<Value>(generator_());
      }
    }
    idl::lend(sequence, std::span<const Value>(values, count));
  }
  template <class... Sequences>
  void fill_all(std::size_t count, Sequences&... sequences) {
    (fill(sequences, count), ...);
  }

  /// `count` names of the greatest length.
  void names(dds_sequence_stoss_v1_Name& sequence, std::size_t count) {
    fill(sequence, count);
    for (std::size_t i = 0; i < count; ++i) {
      sequence._buffer[i].of = i;
      idl::assign(sequence._buffer[i].text, std::string(stoss_v1_MAX_NAME_LENGTH, 'n'));
    }
  }
  void texts(dds_sequence_stoss_v1_ShortText& sequence, std::size_t count) {
    fill(sequence, count);
    for (std::size_t i = 0; i < count; ++i) {
      idl::assign(sequence._buffer[i], std::string(stoss_v1_MAX_NAME_LENGTH, 't'));
    }
  }

  void motions(idl::wire::MotionBlock& b, std::size_t n = stoss_v1_MAX_MOTIONS) {
    fill_all(n,
             b.id,
             b.change,
             b.law,
             b.x,
             b.y,
             b.x_low,
             b.y_low,
             b.vx,
             b.vy,
             b.vx_low,
             b.vy_low,
             b.seconds,
             b.fraction,
             b.angle,
             b.spin,
             b.ax,
             b.ay,
             b.ax_low,
             b.ay_low,
             b.rate);
  }
  void statics(idl::wire::StaticBlock& b, std::size_t n = stoss_v1_MAX_STATICS) {
    fill_all(n, b.id, b.kind, b.radius, b.mass, b.edge_x, b.edge_y, b.edge_x_low, b.edge_y_low);
  }
  void states(idl::wire::StateBlock& b, std::size_t n = stoss_v1_MAX_STATES) {
    fill_all(n, b.id, b.kind, b.x, b.y, b.vx, b.vy, b.angle, b.spin, b.radius, b.distance);
  }
  void collisions(idl::wire::CollisionBlock& b, std::size_t n = stoss_v1_MAX_COLLISIONS) {
    fill_all(n,
             b.seconds,
             b.fraction,
             b.kind,
             b.flags,
             b.a,
             b.b,
             b.point_x,
             b.point_y,
             b.normal_x,
             b.normal_y,
             b.impulse,
             b.approach_speed,
             b.velocity_a_x,
             b.velocity_a_y,
             b.velocity_b_x,
             b.velocity_b_y,
             b.spin_a,
             b.spin_b);
  }
  void zone_events(idl::wire::ZoneEventBlock& b, std::size_t n = stoss_v1_MAX_ZONE_EVENTS) {
    fill_all(n, b.seconds, b.fraction, b.zone, b.body, b.entered, b.x, b.y, b.vx, b.vy);
  }
  void hits(idl::wire::HitBlock& b, std::size_t n = stoss_v1_MAX_HITS) {
    fill_all(n, b.id, b.distance, b.x, b.y, b.normal_x, b.normal_y);
  }
  void walls(idl::wire::WallBlock& b, std::size_t n = stoss_v1_MAX_COMMAND_BODIES) {
    fill_all(n, b.id, b.start_x, b.start_y, b.end_x, b.end_y, b.vx, b.vy);
  }
  void disks(idl::wire::DiskBlock& b, std::size_t n = stoss_v1_MAX_COMMAND_BODIES) {
    fill_all(n, b.id, b.kind, b.x, b.y, b.vx, b.vy, b.radius, b.mass, b.angle, b.spin);
  }
  void zones(idl::wire::ZoneBlock& b, std::size_t n = stoss_v1_MAX_COMMAND_BODIES) {
    fill_all(n, b.id, b.x, b.y, b.radius);
  }
  void frame(idl::wire::FrameChunk& c, std::size_t n = stoss_v1_MAX_FRAME_BODIES) {
    fill_all(n, c.id, c.x, c.y, c.vx, c.vy, c.angle, c.spin, c.radius);
  }
  void scene(idl::wire::SceneChunk& c) {
    fill_all(stoss_v1_MAX_SCENE_DISKS, c.disk_id, c.disk_kind, c.disk_radius, c.disk_mass);
    fill_all(stoss_v1_MAX_SCENE_WALLS,
             c.wall_id,
             c.wall_start_x,
             c.wall_start_y,
             c.wall_end_x,
             c.wall_end_y,
             c.wall_vx,
             c.wall_vy);
    fill_all(stoss_v1_MAX_SCENE_ZONES, c.zone_id, c.zone_x, c.zone_y, c.zone_radius);
    texts(c.effects, stoss_v1_MAX_EFFECTS);
    names(c.names, stoss_v1_MAX_SCENE_NAMES);
  }
  void command(idl::wire::Command& c) {
    fill_all(stoss_v1_MAX_COMMAND_BODIES, c.ids, c.x, c.y);
    disks(c.disks);
    walls(c.walls);
    zones(c.zones);
    names(c.names, stoss_v1_MAX_COMMAND_BODIES);
  }

 private:
  std::mt19937_64 generator_;
  std::deque<std::vector<std::byte>> memory_;
};

/// True when both sequences hold the same bits.
template <class Sequence>
[[nodiscard]] bool same(const Sequence& a, const Sequence& b) {
  return a._length == b._length &&
         (a._length == 0 || std::memcmp(a._buffer, b._buffer, a._length * sizeof(*a._buffer)) == 0);
}

}  // namespace stoss::tests

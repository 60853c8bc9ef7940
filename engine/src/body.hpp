// SPDX-License-Identifier: Apache-2.0
#pragma once

// A body as the event loop sees it.

#include <stoss/engine/motion.hpp>
#include <stoss/engine/types.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace stoss::engine {

/// Where a body is held; says nothing about ids, may be used again after a removal.
using Slot = std::int32_t;

enum class BodyType : std::uint8_t { Dynamic = 0, Kinematic = 1, Static = 2, Wall = 3, Zone = 4 };

inline BodyType type_of(BodyKind kind) { return static_cast<BodyType>(kind); }
inline BodyKind kind_of(BodyType type) { return static_cast<BodyKind>(type); }

/// A body of any arithmetic and laws. `Laws`: one of laws.hpp, whose part of a body is empty unless
/// it needs one. Whole cache lines, for bodies are met in no order.
template <class S, class Laws>
struct alignas(64) Body : Laws::template BodyPart<S> {
  Id id = kNoId;              ///< kNoId: the slot is free
  std::uint32_t changes = 0;  ///< of the motion, or of what else predictions depend on
  BodyType type = BodyType::Dynamic;

  const Motion<S>& motion() const { return motion_; }  ///< of the centre; of a wall's start
  const Time<S>& since() const { return motion_.since; }
  const DoubleWord2<S>& position() const { return motion_.position; }  ///< m, at since()
  const DoubleWord2<S>& velocity() const { return motion_.velocity; }  ///< m/s
  S radius() const { return radius_; }                                 ///< m; 0 for a wall
  S mass() const { return mass_; }                                     ///< kg, of a disk
  std::int32_t wall() const { return wall_; }  ///< index of the wall's shape

  void set_since(const Time<S>& instant) { motion_.since = instant; }
  void set_position(const DoubleWord2<S>& position) { motion_.position = position; }
  void set_velocity(const DoubleWord2<S>& velocity) { motion_.velocity = velocity; }
  void set_radius(const S& radius) { radius_ = radius; }
  void set_mass(const S& mass) { mass_ = mass; }
  void set_wall(std::int32_t shape) { wall_ = shape; }

  bool is_wall() const { return type == BodyType::Wall; }
  bool is_disk() const { return type <= BodyType::Static; }
  bool is_dynamic() const { return type == BodyType::Dynamic; }

 private:
  Motion<S> motion_;
  S radius_{};
  S mass_{};
  std::int32_t wall_ = -1;
};

/// The turning of a disk that turns. In a world of smooth disks it is kept apart: no law reads it.
struct Rotation {
  double angle = 0;  ///< rad, at the motion's `since`
  double spin = 0;   ///< rad/s
};

/// One end of a wall.
struct WallEnd {
  Slot wall = -1;
  int end = 0;  ///< 0: start, 1: end
  friend bool operator==(const WallEnd&, const WallEnd&) = default;
};

template <class S>
struct WallShape {
  DoubleWord2<S> edge;                           ///< end - start, m
  std::array<std::vector<WallEnd>, 2> incident;  ///< ends of other walls at the same vertex
};

}  // namespace stoss::engine

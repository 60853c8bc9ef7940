// SPDX-License-Identifier: Apache-2.0
#pragma once

// The words of the engine's public face: bodies, contacts, states. SI units throughout: metres,
// seconds, kilograms, radians. All plain data.

#include <stoss/engine/instant.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace stoss::engine {

using Vector2 = Eigen::Matrix<double, 2, 1>;

/// Unique in its world for ever, never used again after a removal. 0 asks the world to assign one.
using Id = std::uint64_t;
inline constexpr Id kNoId = 0;

/// How a disk answers to a contact: by its mass; not at all but moving; not at all and at rest.
enum class BodyKind : std::uint8_t { Dynamic = 0, Kinematic = 1, Static = 2 };

/// A disk as it is asked for; `position` holds at the world's present instant.
struct DiskSpec {
  Id id = kNoId;
  BodyKind kind = BodyKind::Dynamic;
  Vector2 position = Vector2::Zero();  ///< m
  Vector2 velocity = Vector2::Zero();  ///< m/s; zero for a static disk
  double radius = 0;                   ///< m, > 0
  double mass = 1;                     ///< kg, > 0; without meaning unless dynamic
  double angle = 0;                    ///< rad
  double spin = 0;                     ///< rad/s; no contact of frictionless disks changes it
};

/// A wall: a segment with two faces and two ends, at rest or in uniform motion.
struct WallSpec {
  Id id = kNoId;
  Vector2 start = Vector2::Zero();     ///< m
  Vector2 end = Vector2::Zero();       ///< m, different from start
  Vector2 velocity = Vector2::Zero();  ///< m/s
};

/// A zone: a fixed circle that pushes nothing and reports who enters and who leaves. A disk is
/// inside when its centre is.
struct ZoneSpec {
  Id id = kNoId;
  Vector2 center = Vector2::Zero();  ///< m
  double radius = 0;                 ///< m, > 0
};

/// Bodies and zones that come into the world together or not at all.
struct SpawnRequest {
  std::span<const DiskSpec> disks;
  std::span<const WallSpec> walls;
  std::span<const ZoneSpec> zones{};
};

/// A body's velocity to set (m/s), or an impulse to give it (kg m/s).
struct VectorFor {
  Id id = kNoId;
  Vector2 value = Vector2::Zero();
};

enum class ContactKind : std::uint8_t { DiskDisk = 0, DiskWall = 1, DiskWallEnd = 2 };

/// One collision, with what both bodies do after it.
struct Collision {
  std::uint64_t sequence = 0;  ///< 1, 2, 3, ... in the world's order, without gaps
  Instant instant;
  ContactKind kind = ContactKind::DiskDisk;
  bool regularised = false;      ///< a collapse guard changed the contact
  bool order_dependent = false;  ///< another contact of the same instant shares a body, and the
                                 ///< outcome depends on which is resolved first
  Id a = kNoId;                  ///< the lower id of two disks, or the disk of a disk and a wall
  Id b = kNoId;
  Vector2 point = Vector2::Zero();       ///< m; in a periodic world in [0, period)
  Vector2 normal = Vector2::Zero();      ///< unit vector from a to b
  double impulse = 0;                    ///< kg m/s, >= 0
  double approach_speed = 0;             ///< m/s, >= 0
  Vector2 velocity_a = Vector2::Zero();  ///< after
  Vector2 velocity_b = Vector2::Zero();  ///< after
  double spin_a = 0;
  double spin_b = 0;
};

/// A disk's centre has crossed the rim of a zone. A touch without crossing is none.
struct ZoneEvent {
  std::uint64_t sequence = 0;  ///< 1, 2, 3, ... in the world's order, without gaps
  Instant instant;
  Id zone = kNoId;
  Id body = kNoId;
  bool entered = false;                ///< false: it has left
  Vector2 position = Vector2::Zero();  ///< of the disk's centre, m
  Vector2 velocity = Vector2::Zero();  ///< m/s
};

/// Takes what happens in the order in which the world processes it.
class CollisionSink {
 public:
  virtual ~CollisionSink() = default;
  virtual void on_collision(const Collision& collision) = 0;
  virtual void on_zone_event(const ZoneEvent&) {}
};

/// A disk evaluated at an instant; in a periodic world the image in [0, period).
struct BodyState {
  Id id = kNoId;
  BodyKind kind = BodyKind::Dynamic;
  Instant instant;
  Vector2 position = Vector2::Zero();
  Vector2 velocity = Vector2::Zero();
  double angle = 0;
  double spin = 0;
  double radius = 0;
};

/// A wall evaluated at an instant; in a periodic world the image whose start is in [0, period).
struct WallState {
  Id id = kNoId;
  Instant instant;
  Vector2 start = Vector2::Zero();
  Vector2 end = Vector2::Zero();
  Vector2 velocity = Vector2::Zero();
};

/// A zone as it stands.
struct ZoneState {
  Id id = kNoId;
  Vector2 center = Vector2::Zero();
  double radius = 0;
  friend bool operator==(const ZoneState&, const ZoneState&) = default;
};

/// A number held as the exact sum of two doubles; `low` is at most half an ulp of `high`.
struct SplitNumber {
  double high = 0;
  double low = 0;
};

/// A stored motion in a form that every arithmetic up to double-double maps onto exactly: where the
/// body (a disk's centre, a wall's start) was at `since`, its velocity then, and its acceleration.
struct MotionRecord {
  Id id = kNoId;
  SplitNumber x, y;    ///< m
  SplitNumber vx, vy;  ///< m/s
  Instant since;
  double angle = 0;        ///< rad, at `since`
  double spin = 0;         ///< rad/s
  SplitNumber ax{}, ay{};  ///< m/s^2; zero in uniform motion; under drag what pulls besides
  double drag = 0;         ///< rate of the drag, 1/s; 0: none
  SplitNumber radius{};    ///< m, at `since`, of a growing disk; else zero: see BodyRecord
  double growth = 0;       ///< of the radius, m/s
};

/// What of a body changes rarely: everything but its motion. `radius` is that of the present where
/// disks grow.
struct BodyRecord {
  Id id = kNoId;
  bool is_wall = false;
  BodyKind kind = BodyKind::Dynamic;
  double radius = 0;           ///< m; 0 for a wall
  double mass = 0;             ///< kg; 0 for a wall
  SplitNumber edge_x, edge_y;  ///< end - start of a wall, m
};

/// What has happened to a body since the changes were last drained.
enum class ChangeKind : std::uint8_t { Spawned = 0, Moved = 1, Removed = 2 };
struct Change {
  Id id = kNoId;
  ChangeKind kind = ChangeKind::Moved;
};

/// Sums over the dynamic disks, rounded once each.
struct Conserved {
  double kinetic_energy = 0;    ///< J
  double potential_energy = 0;  ///< J; 0 without gravity; by the way flown in a periodic world
  Vector2 momentum = Vector2::Zero();  ///< kg m/s
};

/// What a check of the whole world found. Zero is the only good figure for overlaps and missed.
struct Census {
  std::uint64_t pairs = 0;     ///< that were near enough to be looked at
  std::uint64_t overlaps = 0;  ///< deeper than kOverlapTolerance
  std::uint64_t missed = 0;    ///< contacts that lie in the past and were not processed
  double deepest = 0;          ///< overlap of any pair, as a part of its contact distance
};

/// The first body along a ray.
struct RayHit {
  Id id = kNoId;
  double distance = 0;  ///< m along the ray
  Vector2 point = Vector2::Zero();
  Vector2 normal = Vector2::Zero();  ///< unit vector out of the body, against the ray
};

/// A body and how far its surface is from a point (negative: the point is inside).
struct Near {
  Id id = kNoId;
  double distance = 0;
};

/// The number format that a world computes in.
enum class Arithmetic : std::uint8_t { Float, Double, LongDouble, DoubleDouble, Float128 };

enum class BroadPhaseKind : std::uint8_t { Neighbours, AllPairs };

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// The whole public surface of the engine: a world of disks and walls, advanced from event to event.
//
// Thread safety: none; a world belongs to one thread at a time. A world is a value: copying it
// forks it, and both run on alike.
//
// Invariants:
//  1. A body's stored motion is written only by a physical event of that body: a collision or a
//     command. Advancing, asking, copying and serialising evaluate motions and never re-base them.
//  2. The instant of a predicted contact is a pure function of the two stored motions.
//  3. Events are processed by (instant, kind, lower id, higher id).
//  4. A refused command leaves every byte as it was.

#include <stoss/engine/effects.hpp>
#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace stoss::engine {

class WorldCore;

struct WorldOptions {
  Instant start;
  Arithmetic arithmetic = Arithmetic::Double;
  BroadPhaseKind broad_phase = BroadPhaseKind::Neighbours;  ///< never changes a byte of output
  Effects effects{};                                        ///< that check_effects() accepts
  /// m; above 0 the world repeats itself along that axis, 0 leaves it open. check_period().
  Vector2 period = Vector2::Zero();
};

/// Why an advance stopped short of the instant asked for.
enum class Stop : std::uint8_t {
  Reached,      ///< it did not: every event up to and at the instant is processed
  EventBudget,  ///< the limit of events was used up; call again to go on
  Stalled,      ///< events crowd into one instant without end, or a body of a periodic world has
                ///< flown 2^32 periods (2^24 in float) or grown to a period; `stalled` names it
};

struct AdvanceReport {
  Stop stop = Stop::Reached;
  std::uint64_t collisions = 0;  ///< processed by this call
  std::uint64_t events = 0;      ///< collisions and the broad phase's own events
  Id stalled = kNoId;
};

struct Counters {
  std::uint64_t collisions = 0;   ///< since the world began
  std::uint64_t regularised = 0;  ///< contacts that a collapse guard changed
  std::uint64_t kicks = 0;        ///< of the thermostat, since it came on
  std::uint64_t zone_events = 0;  ///< crossings of zones' rims
  std::uint64_t renewals = 0;     ///< broad-phase events of this object; not part of its state
};

/// Limits on what a world takes in. Beyond them squares and sums could leave the range of a double.
inline constexpr double kLengthMaxM = 1e150;  ///< |coordinates|, radii
inline constexpr double kSpeedMaxMps = 1e150;
/// A spawned disk may overlap another body by rounding: at most this part of the contact distance.
/// Deeper is refused. Ten thousand times the deepest overlap seen in healthy runs (3e-14).
inline constexpr double kOverlapTolerance = 1e-9;

class World {
 public:
  /// A world without bodies. REQUIRES: options.arithmetic is Float, Double or LongDouble; wider
  /// ones come from stoss::wide. Throws std::invalid_argument for effects that check_effects()
  /// and for periods that check_period() refuses.
  explicit World(const WorldOptions& options = {});
  explicit World(std::unique_ptr<WorldCore> core);
  World(const World& other);
  World& operator=(const World& other);
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  Instant now() const;
  Arithmetic arithmetic() const;
  BroadPhaseKind broad_phase() const;
  Effects effects() const;
  Vector2 period() const;
  std::size_t disk_count() const;
  std::size_t wall_count() const;
  std::size_t zone_count() const;
  Counters counters() const;
  Conserved conserved() const;

  // Commands. Each takes effect at now(); all of it or nothing.

  /// Brings bodies in. Returns their ids in the order of the request: disks, walls, zones. Who is
  /// inside a zone as it or they come in, strictly within the rim, is so without an event.
  /// Errors: InvalidArgument (not finite, radius or mass <= 0, a wall of no length, a moving static
  /// disk), AlreadyExists (id in use or used before), Overlap (with whom, by how much).
  Outcome<std::vector<Id>> spawn(const SpawnRequest& request);
  /// Removes bodies and zones; a zone goes, and whoever is inside one goes, without an event.
  /// Errors: NotFound; InvalidArgument when an id is named twice.
  Outcome<Done> remove(std::span<const Id> ids);
  /// Sets velocities (m/s) of disks or walls. Errors: NotFound, InvalidArgument (not finite, named
  /// twice), FailedPrecondition (a static disk, a zone).
  Outcome<Done> set_velocity(std::span<const VectorFor> velocities);
  /// Adds impulse / mass to the velocities of dynamic disks. Errors as set_velocity;
  /// FailedPrecondition for whatever is not a dynamic disk.
  Outcome<Done> apply_impulse(std::span<const VectorFor> impulses);

  /// From now on the world has these effects, and no others. A physical event for each body whose
  /// law of motion becomes another: its motion is based at now(), and one at rest is let go. Other
  /// bodies' motions are not touched. Errors: those of check_effects(); FailedPrecondition if a
  /// contact is due at this very instant.
  Outcome<Done> set_effects(const Effects& effects);

  /// Moves every dynamic disk, and its velocity, by one unit in the last place of the world's
  /// arithmetic, with signs that `seed` picks: the smallest error that a run can start from.
  void nudge(std::uint64_t seed);

  /// Processes every event up to and at `until`, and makes it the present. At most `max_events`
  /// events; the present is then the last one's instant. `sink` may be null.
  /// Throws InvariantBroken (check.hpp) if the engine finds itself broken.
  /// Errors: DeadlinePassed when `until` is before now(); InvalidArgument beyond the end of time.
  Outcome<AdvanceReport> advance_to(const Instant& until,
                                    CollisionSink* sink = nullptr,
                                    std::uint64_t max_events = ~std::uint64_t{0});

  // Questions, at now().

  bool contains(Id id) const;
  // In a periodic world a place is shown in [0, period) along each periodic axis: a disk's
  // position, the start of a wall (its end follows from there), the point of a collision or of a
  // ray's hit. Regions, nearest bodies and rays take every image into account.

  /// Errors: NotFound (also for a wall).
  Outcome<BodyState> state(Id id) const;
  Outcome<WallState> wall(Id id) const;
  /// Every disk / wall in the order of ids.
  void for_each_disk(const std::function<void(const BodyState&)>& visit) const;
  void for_each_wall(const std::function<void(const WallState&)>& visit) const;
  /// Errors: NotFound (also for what is no zone).
  Outcome<ZoneState> zone(Id id) const;
  /// Every zone in the order of ids.
  void for_each_zone(const std::function<void(const ZoneState&)>& visit) const;
  /// Ids, in order, of the disks inside a zone. Errors: NotFound (also for what is no zone).
  Outcome<std::vector<Id>> inside(Id zone) const;
  /// Ids, in order, of the disks and walls that touch the box [low, high].
  std::vector<Id> region(const Vector2& low, const Vector2& high) const;
  /// The `count` disks and walls nearest to a point, nearest first, ties by id.
  std::vector<Near> nearest(const Vector2& point, std::size_t count) const;
  /// The first disk or wall that a ray meets within `length_max`, ties by id. `direction` need not
  /// be a unit vector. Nothing when it meets none, or the direction is zero. In a periodic world it
  /// goes as far as 1024 (smallest) periods.
  std::optional<RayHit> ray(const Vector2& origin,
                            const Vector2& direction,
                            double length_max) const;

  /// Checks every pair that could have met since its last events, from the stored motions alone.
  /// Takes a sort and about a microsecond a near pair.
  Census census() const;

  // The stored motions, for replicas.

  /// Errors: NotFound.
  Outcome<MotionRecord> motion(Id id) const;
  Outcome<BodyRecord> body(Id id) const;
  /// Ids of all bodies in order; zones are none.
  std::vector<Id> ids() const;
  /// What changed since the last call, in the order of ids, once per body (a body that came and
  /// went in between does not appear).
  std::vector<Change> drain_changes();

  // Identity.

  /// The world's state in canonical bytes: equal states give equal bytes whatever their history of
  /// ticks, copies and broad phases.
  std::vector<std::byte> serialise() const;
  /// The world that the bytes hold. Errors: InvalidArgument for damaged or foreign bytes.
  static Outcome<World> deserialise(std::span<const std::byte> bytes,
                                    BroadPhaseKind broad_phase = BroadPhaseKind::Neighbours);
  /// A 64-bit digest of the stored motions and counters; it does not depend on now(), and changes
  /// only with physical events.
  std::uint64_t state_hash() const;

  WorldCore& core() { return *core_; }
  const WorldCore& core() const { return *core_; }

 private:
  std::unique_ptr<WorldCore> core_;
};

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What stands behind a World: one virtual face over the arithmetics, called once a command or tick
// and never inside the event loop. See world.hpp for what each call promises.

#include "change_log.hpp"

#include <stoss/engine/world.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace stoss::engine {

class WorldCore {
 public:
  virtual ~WorldCore() = default;
  virtual std::unique_ptr<WorldCore> clone() const = 0;

  virtual Instant now() const = 0;
  virtual Arithmetic arithmetic() const = 0;
  virtual BroadPhaseKind broad_phase() const = 0;
  virtual Effects effects() const = 0;
  virtual Vector2 period() const = 0;
  virtual std::size_t disk_count() const = 0;
  virtual std::size_t wall_count() const = 0;
  virtual std::size_t zone_count() const = 0;
  virtual Counters counters() const = 0;
  virtual Conserved conserved() const = 0;

  virtual Outcome<std::vector<Id>> spawn(const SpawnRequest& request) = 0;
  virtual Outcome<Done> remove(std::span<const Id> ids) = 0;
  virtual Outcome<Done> set_velocity(std::span<const VectorFor> velocities) = 0;
  virtual Outcome<Done> apply_impulse(std::span<const VectorFor> impulses) = 0;
  virtual void nudge(std::uint64_t seed) = 0;
  virtual Outcome<AdvanceReport> advance_to(const Instant& until,
                                            CollisionSink* sink,
                                            std::uint64_t max_events) = 0;

  virtual bool contains(Id id) const = 0;
  virtual Outcome<BodyState> state(Id id) const = 0;
  virtual Outcome<WallState> wall(Id id) const = 0;
  virtual void for_each_disk(const std::function<void(const BodyState&)>& visit) const = 0;
  virtual void for_each_wall(const std::function<void(const WallState&)>& visit) const = 0;
  virtual Outcome<ZoneState> zone(Id id) const = 0;
  virtual void for_each_zone(const std::function<void(const ZoneState&)>& visit) const = 0;
  virtual Outcome<std::vector<Id>> inside(Id zone) const = 0;
  virtual std::vector<Id> region(const Vector2& low, const Vector2& high) const = 0;
  virtual std::vector<Near> nearest(const Vector2& point, std::size_t count) const = 0;
  virtual std::optional<RayHit> ray(const Vector2& origin,
                                    const Vector2& direction,
                                    double length_max) const = 0;

  virtual Census census() const = 0;
  virtual Outcome<MotionRecord> motion(Id id) const = 0;
  virtual Outcome<BodyRecord> body(Id id) const = 0;
  virtual std::vector<Id> ids() const = 0;
  virtual std::vector<Change> drain_changes() = 0;

  virtual std::vector<std::byte> serialise() const = 0;
  virtual Outcome<Done> restore(std::span<const std::byte> bytes) = 0;
  virtual std::uint64_t state_hash() const = 0;

  /// This world from now on with other effects, which check_effects() accepts.
  virtual Outcome<std::unique_ptr<WorldCore>> with_effects(const Effects& wanted) const = 0;
  void take_changes_of(const WorldCore& other) { changes_ = other.changes_; }

 protected:
  ChangeLog changes_;
};

/// The core of one arithmetic: a plain one, or one for the effects or periods asked for. Each is a
/// translation unit of its own (world_<arithmetic>.cpp and world_<arithmetic>_effects.cpp).
template <class S>
std::unique_ptr<WorldCore> make_plain_core(const WorldOptions& options);
template <class S>
std::unique_ptr<WorldCore> make_effects_core(const WorldOptions& options);

template <class S>
std::unique_ptr<WorldCore> make_core_in(const WorldOptions& options) {
  const bool is_plain = options.effects == Effects{} && options.period == Vector2::Zero();
  return is_plain ? make_plain_core<S>(options) : make_effects_core<S>(options);
}

/// A core for Float, Double or LongDouble; null for an arithmetic that this library has not.
std::unique_ptr<WorldCore> make_core(const WorldOptions& options);

}  // namespace stoss::engine

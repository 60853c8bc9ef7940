// SPDX-License-Identifier: Apache-2.0
#include "effects_bytes.hpp"
#include "motion_law/accelerated.hpp"
#include "motion_law/drag.hpp"
#include "motion_law/growth.hpp"
#include "periodic.hpp"
#include "world_core.hpp"

#include <stoss/engine/motion.hpp>
#include <stoss/engine/world.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace stoss::engine {

World::World(const WorldOptions& options) {
  if (const auto reject = check_effects(options.effects)) {
    throw std::invalid_argument(reject->field + " " + reject->reason);
  }
  if (const auto reject = check_period(options.period)) {
    throw std::invalid_argument(reject->field + " " + reject->reason);
  }
  core_ = make_core(options);
}
World::World(std::unique_ptr<WorldCore> core) : core_(std::move(core)) {}
World::World(const World& other) : core_(other.core_->clone()) {}
World& World::operator=(const World& other) {
  if (this != &other) core_ = other.core_->clone();
  return *this;
}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Instant World::now() const { return core_->now(); }
Arithmetic World::arithmetic() const { return core_->arithmetic(); }
BroadPhaseKind World::broad_phase() const { return core_->broad_phase(); }
Effects World::effects() const { return core_->effects(); }
Vector2 World::period() const { return core_->period(); }
std::size_t World::disk_count() const { return core_->disk_count(); }
std::size_t World::wall_count() const { return core_->wall_count(); }
std::size_t World::zone_count() const { return core_->zone_count(); }
Counters World::counters() const { return core_->counters(); }
Conserved World::conserved() const { return core_->conserved(); }

Outcome<std::vector<Id>> World::spawn(const SpawnRequest& request) {
  if (request.zones.empty() || core_->effects() != Effects{}) return core_->spawn(request);
  // A plain world knows no zones. The kind that does takes the bodies over bit for bit.
  Effects with_zones;
  with_zones.zones = true;
  auto switched = core_->with_effects(with_zones);
  if (!switched) return switched.reject();
  auto made = switched.value()->spawn(request);
  if (made) core_ = std::move(switched).value();
  return made;
}
Outcome<Done> World::remove(std::span<const Id> ids) { return core_->remove(ids); }
Outcome<Done> World::set_velocity(std::span<const VectorFor> velocities) {
  return core_->set_velocity(velocities);
}
Outcome<Done> World::apply_impulse(std::span<const VectorFor> impulses) {
  return core_->apply_impulse(impulses);
}
Outcome<Done> World::set_effects(const Effects& effects) {
  if (auto reject = check_effects(effects)) return *std::move(reject);
  Effects wanted = effects;
  wanted.zones = core_->zone_count() > 0;
  if (wanted == core_->effects()) return Done{};
  auto switched = core_->with_effects(wanted);
  if (!switched) return switched.reject();
  core_ = std::move(switched).value();
  return Done{};
}
void World::nudge(std::uint64_t seed) { core_->nudge(seed); }
Outcome<AdvanceReport> World::advance_to(const Instant& until,
                                         CollisionSink* sink,
                                         std::uint64_t max_events) {
  return core_->advance_to(until, sink, max_events);
}

bool World::contains(Id id) const { return core_->contains(id); }
Outcome<BodyState> World::state(Id id) const { return core_->state(id); }
Outcome<WallState> World::wall(Id id) const { return core_->wall(id); }
void World::for_each_disk(const std::function<void(const BodyState&)>& visit) const {
  core_->for_each_disk(visit);
}
void World::for_each_wall(const std::function<void(const WallState&)>& visit) const {
  core_->for_each_wall(visit);
}
Outcome<ZoneState> World::zone(Id id) const { return core_->zone(id); }
void World::for_each_zone(const std::function<void(const ZoneState&)>& visit) const {
  core_->for_each_zone(visit);
}
Outcome<std::vector<Id>> World::inside(Id zone) const { return core_->inside(zone); }
std::vector<Id> World::region(const Vector2& low, const Vector2& high) const {
  return core_->region(low, high);
}
std::vector<Near> World::nearest(const Vector2& point, std::size_t count) const {
  return core_->nearest(point, count);
}
std::optional<RayHit> World::ray(const Vector2& origin,
                                 const Vector2& direction,
                                 double length_max) const {
  return core_->ray(origin, direction, length_max);
}

Census World::census() const { return core_->census(); }

Outcome<MotionRecord> World::motion(Id id) const { return core_->motion(id); }
Outcome<BodyRecord> World::body(Id id) const { return core_->body(id); }
std::vector<Id> World::ids() const { return core_->ids(); }
std::vector<Change> World::drain_changes() { return core_->drain_changes(); }

std::vector<std::byte> World::serialise() const { return core_->serialise(); }
std::uint64_t World::state_hash() const { return core_->state_hash(); }

Outcome<World> World::deserialise(std::span<const std::byte> bytes, BroadPhaseKind broad_phase) {
  ByteSource source(bytes);
  source.word();  // magic and format are checked by restore()
  source.word();
  const auto identity = read_identity(source);
  if (!identity || identity->arithmetic > Arithmetic::LongDouble) {
    return Reject{.code = Code::InvalidArgument,
                  .field = "bytes",
                  .reason = "these are not a world's bytes, or of an arithmetic not built in"};
  }
  World world(WorldOptions{.start = {},
                           .arithmetic = identity->arithmetic,
                           .broad_phase = broad_phase,
                           .effects = identity->effects,
                           .period = identity->period});
  if (const auto restored = world.core_->restore(bytes); !restored) return restored.reject();
  return world;
}

const char* to_string(Code code) {
  switch (code) {
    case Code::Ok:
      return "OK";
    case Code::InvalidArgument:
      return "INVALID_ARGUMENT";
    case Code::NotFound:
      return "NOT_FOUND";
    case Code::AlreadyExists:
      return "ALREADY_EXISTS";
    case Code::Overlap:
      return "OVERLAP";
    case Code::FailedPrecondition:
      return "FAILED_PRECONDITION";
    case Code::ResourceExhausted:
      return "RESOURCE_EXHAUSTED";
    case Code::Unimplemented:
      return "UNIMPLEMENTED";
    case Code::Unavailable:
      return "UNAVAILABLE";
    case Code::DeadlinePassed:
      return "DEADLINE_PASSED";
    case Code::Internal:
      return "INTERNAL";
  }
  return "INTERNAL";
}

std::optional<Instant> offset_by(const Instant& from, double seconds) {
  if (!std::isfinite(seconds)) return std::nullopt;
  if (seconds >= 0) return later_by<double>(from, seconds, 0.0);
  const auto mirrored = later_by<double>(instant_from_ticks(-ticks(from)), -seconds, 0.0);
  if (!mirrored) return std::nullopt;
  return instant_from_ticks(-ticks(*mirrored));
}

double seconds_between(const Instant& earlier, const Instant& later) {
  return difference<double>(later, earlier).hi;
}

namespace {

template <class S>
DoubleWord2<S> acceleration_of(const MotionRecord& record) {
  return {from_split<S>(record.ax), from_split<S>(record.ay)};
}

template <class S>
Flight<S> flight_in(const MotionRecord& record, const Instant& instant) {
  return flight_at(from_record<S>(record),
                   acceleration_of<S>(record),
                   static_cast<S>(record.drag),
                   from_instant<Time<S>>(instant));
}

template <class S>
Vector2 position_in(const MotionRecord& record, const Instant& instant) {
  if (record.drag > 0) return detail::rounded(flight_in<S>(record, instant).position);
  return detail::rounded(position_at(from_record<S>(record), acceleration_of<S>(record), instant));
}

template <class S>
Vector2 shown_position_in(const MotionRecord& record,
                          const Instant& instant,
                          const Vector2& period) {
  const DoubleWord2<S> position =
      record.drag > 0 ? flight_in<S>(record, instant).position
                      : position_at(from_record<S>(record), acceleration_of<S>(record), instant);
  return detail::shown(position, detail::stored<S>(period));
}

template <class S>
WallState wall_in(const MotionRecord& record,
                  const BodyRecord& body,
                  const Instant& instant,
                  const Vector2& period) {
  const Motion<S> motion = from_record<S>(record);
  return detail::shown_wall(record.id,
                            instant,
                            position_at(motion, from_instant<Time<S>>(instant)),
                            {from_split<S>(body.edge_x), from_split<S>(body.edge_y)},
                            motion.velocity,
                            detail::stored<S>(period));
}

template <class S>
Vector2 velocity_in(const MotionRecord& record, const Instant& instant) {
  if (record.drag > 0) return detail::rounded(flight_in<S>(record, instant).velocity);
  return detail::rounded(velocity_at(from_record<S>(record), acceleration_of<S>(record), instant));
}

template <class S>
double radius_in(const MotionRecord& record, const Instant& instant) {
  return static_cast<double>(to_scalar(grown_by(from_split<S>(record.radius),
                                                static_cast<S>(record.growth),
                                                from_instant<Time<S>>(record.since),
                                                from_instant<Time<S>>(instant))));
}

}  // namespace

// A record holds double-words, so double's evaluation is the best of all wider worlds, too, and the
// same on every machine.
Vector2 evaluate(const MotionRecord& motion, Arithmetic arithmetic, const Instant& instant) {
  return arithmetic == Arithmetic::Float ? position_in<float>(motion, instant)
                                         : position_in<double>(motion, instant);
}

Vector2 evaluate_velocity(const MotionRecord& motion,
                          Arithmetic arithmetic,
                          const Instant& instant) {
  return arithmetic == Arithmetic::Float ? velocity_in<float>(motion, instant)
                                         : velocity_in<double>(motion, instant);
}

double evaluate_radius(const MotionRecord& motion,
                       const BodyRecord& body,
                       Arithmetic arithmetic,
                       const Instant& instant) {
  if (motion.radius.high == 0) return body.radius;
  return arithmetic == Arithmetic::Float ? radius_in<float>(motion, instant)
                                         : radius_in<double>(motion, instant);
}

Vector2 evaluate(const MotionRecord& motion,
                 Arithmetic arithmetic,
                 const Instant& instant,
                 const Vector2& period) {
  return arithmetic == Arithmetic::Float ? shown_position_in<float>(motion, instant, period)
                                         : shown_position_in<double>(motion, instant, period);
}

WallState evaluate_wall(const MotionRecord& motion,
                        const BodyRecord& body,
                        Arithmetic arithmetic,
                        const Instant& instant,
                        const Vector2& period) {
  return arithmetic == Arithmetic::Float ? wall_in<float>(motion, body, instant, period)
                                         : wall_in<double>(motion, body, instant, period);
}

double turned(double angle, double spin, const Instant& since, const Instant& instant) {
  return angle + spin * difference<double>(instant, since).hi;
}

}  // namespace stoss::engine

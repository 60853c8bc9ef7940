// SPDX-License-Identifier: Apache-2.0
// What each command does to the world, at its present.
#include "simulation.hpp"

#include <stoss/engine/features.hpp>
#include <stoss/engine/motion.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stoss::service {
namespace {

using engine::Code;
using engine::Reject;
using idl::Op;

using Made = engine::Outcome<std::vector<engine::Id>>;

Reject invalid(std::string field, std::string reason) {
  return {.code = Code::InvalidArgument, .field = std::move(field), .reason = std::move(reason)};
}

Made done(const engine::Outcome<engine::Done>& outcome) {
  if (!outcome) return outcome.reject();
  return std::vector<engine::Id>{};
}

Made done() { return std::vector<engine::Id>{}; }

Made unimplemented(std::uint16_t op) {
  return Reject{.code = Code::Unimplemented,
                .field = "op",
                .reason = "operation " + std::to_string(op) + " is not in this version"};
}

}  // namespace

void Simulation::apply(CommandItem command) {
  const bool was_running = running();
  const double speed_before = pacer_.speed();
  Made made = execute(command.spec);
  if (running() != was_running || pacer_.speed() != speed_before) started();
  reply(std::move(command), std::move(made));
}

Simulation::Made Simulation::execute(const translate::CommandSpec& spec) {
  const auto op = static_cast<Op>(spec.op);
  if (failed() && op != Op::kReset && op != Op::kUnwatch) {
    return Reject{.code = Code::FailedPrecondition,
                  .field = "",
                  .reason = "the world has failed: " + failure_};
  }
  switch (op) {
    case Op::kSpawn:
      return change_bodies({}, [&] { return spawn(spec); });
    case Op::kRemove:
      return change_bodies(spec.ids, [&] { return remove(spec); });
    case Op::kSetVelocity:
      if (spec.vectors.empty()) return invalid("ids", "names no body");
      return change_bodies(spec.ids, [&] { return done(world_.set_velocity(spec.vectors)); });
    case Op::kApplyImpulse:
      if (spec.vectors.empty()) return invalid("ids", "names no body");
      return change_bodies(spec.ids, [&] { return done(world_.apply_impulse(spec.vectors)); });
    case Op::kSetEffects:
      return set_effects(spec);
    case Op::kPause:
      run_.pause();
      return done();
    case Op::kResume:
      run_.resume();
      return done();
    case Op::kStep:
      return step(spec);
    case Op::kRunFor:
      return run_for(spec);
    case Op::kRunTo:
      return run_to(spec);
    case Op::kSetSpeed:
      return set_speed(spec);
    case Op::kReset:
      return reset();
    case Op::kWatch:
      return watch(spec);
    case Op::kUnwatch: {
      std::vector<WatchRecord> news;
      watches_.unwatch(spec.request.client, spec.ids, news);
      hand_over(std::move(news));
      return done();
    }
    case Op::kSnapshot:
    case Op::kRestore:
      break;
  }
  return unimplemented(spec.op);
}

// What a command does to energy and momentum is no drift.
Simulation::Made Simulation::change_bodies(std::span<const engine::Id> ids,
                                           const std::function<Made()>& change) {
  if (!verifier_) return change();
  verifier_->take_out(world_, ids);
  Made made = change();
  verifier_->put_in(world_, ids);
  if (made) verifier_->put_in(world_, made.value());
  return made;
}

Simulation::Made Simulation::spawn(const translate::CommandSpec& spec) {
  const std::size_t asked = spec.disks.size() + spec.walls.size() + spec.zones.size();
  if (asked == 0) return invalid("disks", "there is no body to make");
  if (world_.disk_count() + world_.wall_count() + world_.zone_count() + asked >
      options_.bodies_max) {
    return Reject{
        .code = Code::ResourceExhausted,
        .field = "disks",
        .reason = "this world takes at most " + std::to_string(options_.bodies_max) + " bodies"};
  }
  auto made = world_.spawn({spec.disks, spec.walls, spec.zones});
  if (!made) return made.reject();
  if (!spec.zones.empty()) zones_changed_ = true;
  for (const translate::NamedPart& name : spec.names) {
    names_.emplace_back(made.value()[name.of], name.text);
  }
  return made;
}

Simulation::Made Simulation::remove(const translate::CommandSpec& spec) {
  if (spec.ids.empty()) return invalid("ids", "names no body");
  std::vector<engine::MotionRecord> last;
  for (const engine::Id id : spec.ids) {
    if (auto motion = world_.motion(id)) last.push_back(std::move(motion).value());
  }
  const std::size_t zones_before = world_.zone_count();
  auto outcome = world_.remove(spec.ids);
  if (!outcome) return outcome.reject();
  if (world_.zone_count() != zones_before) zones_changed_ = true;
  for (engine::MotionRecord& motion : last) {
    const engine::Vector2 place = engine::evaluate(motion, world_.arithmetic(), world_.now());
    motion.angle = engine::turned(motion.angle, motion.spin, motion.since, world_.now());
    motion.x = {place.x(), 0};
    motion.y = {place.y(), 0};
    motion.since = world_.now();
    removed_[motion.id] = motion;
  }
  std::vector<WatchRecord> news;
  watches_.drop_bodies(spec.ids, news);
  hand_over(std::move(news));
  return done();
}

Simulation::Made Simulation::step(const translate::CommandSpec& spec) {
  if (spec.count == 0) return invalid("count", "must be at least 1");
  const std::uint64_t tick = run_.tick() + spec.count;
  const engine::Instant end = run_.clock().instant_of(tick);
  if (tick < spec.count || end == engine::Instant::never()) {
    return invalid("count", "leads beyond the end of time");
  }
  run_.run_to(end);
  return done();
}

Simulation::Made Simulation::run_for(const translate::CommandSpec& spec) {
  if (!(spec.value > 0)) return invalid("value", "must be a number of seconds above 0");
  const auto end = engine::offset_by(world_.now(), spec.value);
  if (!end) return invalid("value", "leads beyond the end of time");
  run_.run_to(*end);
  return done();
}

Simulation::Made Simulation::run_to(const translate::CommandSpec& spec) {
  if (spec.target < world_.now()) {
    return Reject{
        .code = Code::DeadlinePassed, .field = "target", .reason = "that instant is in the past"};
  }
  if (!engine::in_range(spec.target)) return invalid("target", "is beyond the end of time");
  run_.run_to(spec.target);
  run_.stop_if_due(world_.now());
  return done();
}

Simulation::Made Simulation::set_speed(const translate::CommandSpec& spec) {
  if (!(spec.value > 0))
    return invalid("value", "must be above 0; infinity is as fast as possible");
  pacer_.set_speed(spec.value);
  return done();
}

// The scene was taken in once, so it is taken in again.
Simulation::Made Simulation::reset() {
  auto fresh = translate::make_world(scene_, options_.choice);
  if (!fresh) return fresh.reject();
  publish(/*at_any_rate=*/true);
  std::vector<NamedBody> names = scene_names(fresh.value().ids);
  world_ = std::move(fresh).value().world;
  if (failed()) run_.pause();
  failure_.clear();
  run_.restart();
  refuse_scheduled(Code::Unavailable, "the world was reset before that instant");
  std::vector<engine::Id> gone = watches_.ids();
  std::erase_if(gone, [this](engine::Id id) { return world_.contains(id); });
  std::vector<WatchRecord> news;
  watches_.drop_bodies(gone, news);
  ++epoch_;
  begin_epoch(std::move(names));
  hand_over(std::move(news));
  started();
  return done();
}

Simulation::Made Simulation::set_effects(const translate::CommandSpec& spec) {
  if (spec.effects_off.empty() && spec.settings.empty()) {
    return invalid("names", "names no effect");
  }
  const engine::Effects before = world_.effects();
  auto wanted = engine::changed_effects(before, spec.effects_off, spec.settings);
  if (!wanted) return wanted.reject();
  engine::Effects effects = std::move(wanted).value();
  const bool has_seed = std::any_of(spec.settings.begin(), spec.settings.end(), [](const auto& s) {
    return s.name == "thermostat.seed";
  });
  if (effects.thermostat && !before.thermostat && !has_seed) {
    effects.thermostat->seed = scene_.seed;
  }
  if (auto switched = world_.set_effects(effects); !switched) return switched.reject();
  effects_changed_ = true;
  if (verifier_) verifier_->begin(world_);  // which books it keeps depends on the effects
  return done();
}

Simulation::Made Simulation::watch(const translate::CommandSpec& spec) {
  if (spec.ids.empty()) return invalid("ids", "names no body");
  for (std::size_t i = 0; i < spec.ids.size(); ++i) {
    if (world_.body(spec.ids[i]).ok()) continue;  // a zone is none
    return Reject{.code = Code::NotFound,
                  .field = "ids",
                  .index = i,
                  .body = spec.ids[i],
                  .reason = "no such body"};
  }
  std::vector<WatchRecord> news;
  if (!watches_.watch(spec.request.client, spec.ids, news)) {
    return Reject{.code = Code::ResourceExhausted,
                  .field = "ids",
                  .reason = "at most " + std::to_string(WatchTable::kSlots) +
                            " bodies can be watched at once"};
  }
  hand_over(std::move(news));
  return done();
}

// A watch must not overtake the record that brings its body in.
void Simulation::hand_over(std::vector<WatchRecord> news) {
  if (news.empty()) return;
  publish(/*at_any_rate=*/true);
  for (const WatchRecord& record : news) outbox_.push(record);
}

}  // namespace stoss::service

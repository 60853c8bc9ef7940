// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate.hpp"

#include "baseline/fixed_step.hpp"
#include "cli/exit_code.hpp"
#include "cli/log_file.hpp"
#include "cli/save_scene.hpp"
#include "cli/scene_bodies.hpp"
#include "cli/simulate_log.hpp"
#include "cli/simulate_report.hpp"

#include <stoss/client/json.hpp>
#include <stoss/engine/tick_clock.hpp>
#include <stoss/engine/world.hpp>
#include <stoss/translate/scene.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

namespace stoss::client::cli {
namespace {

using engine::Instant;

constexpr Instant kEndOfTime = {engine::kSecondsMax - 1, 0};

Instant end_of(const SimulateOptions& options, const Instant& start) {
  if (!options.until) return kEndOfTime;
  const Instant end =
      engine::instant_from_ticks(engine::ticks(start) + engine::ticks(*options.until));
  if (!engine::in_range(end)) throw UsageError("--until: beyond the end of time");
  return end;
}

/// Goes on to `until`, but stops right after the collision that uses up `limit` (counted since the
/// world began). Events that are no collisions use up the budget of a call too, hence the loop.
void advance(engine::World& world, const Instant& until, CollisionLog* log, std::uint64_t limit) {
  while (world.counters().collisions < limit) {
    std::uint64_t budget = limit - world.counters().collisions;
    if (log != nullptr && log->verifier()) {
      budget = std::min(budget, log->verifier()->events_left());
    }
    const engine::AdvanceReport report = value_or_refuse(world.advance_to(until, log, budget));
    if (log != nullptr) log->count_events(world, report.events);
    if (report.stop == engine::Stop::Reached) return;
    if (report.stop == engine::Stop::Stalled) {
      throw RefusedError({.code = engine::Code::FailedPrecondition,
                          .field = {},
                          .body = report.stalled,
                          .reason = "collisions crowd into one instant without end"});
    }
  }
}

/// In ticks, when a rate is given; they change nothing but how often the world returns. A world
/// that stalls on the way stays where it is, and says why.
std::optional<RefusedError> advance_in_ticks(engine::World& world,
                                             const SimulateOptions& options,
                                             const Instant& end,
                                             CollisionLog& log) try {
  if (options.tick_rate) {
    const auto clock = engine::TickClock::from_rate(world.now(), *options.tick_rate);
    if (!clock) throw UsageError("--tick-rate: must be a positive number of hertz");
    for (std::uint64_t tick = 1;; ++tick) {
      const Instant target = clock->instant_of(tick);
      if (target >= end || world.counters().collisions >= options.max_collisions) break;
      advance(world, target, &log, options.max_collisions);
      log.flush_if_full();
    }
  }
  if (world.counters().collisions < options.max_collisions) {
    advance(world, end, &log, options.max_collisions);
  }
  return std::nullopt;
} catch (const RefusedError& stall) {
  return stall;
}

void write_states(const SimulateOptions& options,
                  const std::function<void(const std::function<void(const engine::BodyState&)>&)>&
                      for_each_disk) {
  if (!options.states) return;
  LogFile file(*options.states);
  for_each_disk([&file](const engine::BodyState& state) {
    append_json(file.buffer(), state);
    file.buffer() += '\n';
    file.flush_if_full();
  });
  file.flush();
}

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void simulate_exactly(const SimulateOptions& options,
                      const translate::SceneBodies& bodies,
                      CollisionLog& log) {
  translate::SceneWorld made =
      value_or_refuse(translate::make_world(bodies, {options.arithmetic, options.broad_phase}));
  engine::World& world = made.world;
  const Instant end = end_of(options, world.now());
  SimulateReport report{.at_start = world.conserved()};
  if (log.verifier()) log.verifier()->begin(world);
  // Without --until the number of collisions ends the run, and there may be fewer.
  std::optional<engine::World> beginning;
  if (!options.until) beginning = world;
  const Stopwatch stopwatch;
  const std::optional<RefusedError> stall = advance_in_ticks(world, options, end, log);
  log.finish();
  report.wall_seconds = stopwatch.seconds();
  if (log.verifier()) log.verifier()->check(world);  // a short run is checked, too
  if (beginning && !stall && world.counters().collisions < options.max_collisions) {
    // Back to the last collision there was: the end of time is no place to tell states of.
    const std::uint64_t last = world.counters().collisions;
    world = std::move(*beginning);
    advance(world, end, nullptr, last);
  }
  report.end = world.now();
  report.at_end = world.conserved();
  report.disks = world.disk_count();
  report.walls = world.wall_count();
  report.zone_events = world.counters().zone_events;
  report.events = log.events();
  report.state_hash = world.state_hash();
  write_states(options, [&world](const auto& visit) { world.for_each_disk(visit); });
  if (options.save_scene) save_scene(options.scene, *options.save_scene, world, made.ids);
  print_report(options, report, log);
  if (stall) throw RefusedError(*stall);
  if (log.verifier() && !engine::is_healthy(log.verifier()->found(), options.arithmetic)) {
    throw RefusedError({.code = engine::Code::Internal,
                        .field = {},
                        .reason = "the verification found a fault in the world"});
  }
}

void simulate_in_steps(const SimulateOptions& options,
                       translate::SceneBodies bodies,
                       CollisionLog& log) {
  // The exact world judges the scene and gives out ids, so that both methods take the same scenes.
  translate::adopt_ids(
      bodies,
      value_or_refuse(translate::make_world(bodies, {options.arithmetic, options.broad_phase}))
          .ids);
  if (!options.until) throw UsageError("--method fixed-step needs --until");
  refuse_effects(bodies, "the stepped method");
  baseline::FixedStep world(bodies.disks, bodies.walls, bodies.start, *options.step);
  SimulateReport report{.at_start = world.conserved()};
  const Stopwatch stopwatch;
  world.advance_to(end_of(options, bodies.start), &log, options.max_collisions);
  log.finish();
  report.wall_seconds = stopwatch.seconds();
  report.end = world.now();
  report.at_end = world.conserved();
  report.disks = bodies.disks.size();
  report.walls = bodies.walls.size();
  report.events = world.collisions() + world.steps();
  write_states(options, [&world](const auto& visit) { world.for_each_disk(visit); });
  print_report(options, report, log);
}

}  // namespace

void simulate(const SimulateOptions& options) {
  if (!options.until && options.max_collisions == ~std::uint64_t{0}) {
    throw UsageError("simulate: needs --until or --max-collisions");
  }
  translate::SceneBodies bodies = scene_bodies(options.scene);
  CollisionLog log(options.collisions, options.hash, options.verify);
  if (options.zones) log.write_zone_events_to(*options.zones);
  if (options.step) {
    simulate_in_steps(options, std::move(bodies), log);
  } else {
    simulate_exactly(options, bodies, log);
  }
}

}  // namespace stoss::client::cli

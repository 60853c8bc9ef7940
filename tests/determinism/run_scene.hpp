// SPDX-License-Identifier: Apache-2.0
#pragma once

// A scene run under some circumstances, and what is left of it: digests that are the same under
// all.

#include "determinism/scene_reader.hpp"
#include "support/collision_log.hpp"

#include <stoss/engine/tick_clock.hpp>
#include <stoss/engine/world.hpp>

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace stoss::determinism {

struct Circumstances {
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours;
  std::uint64_t tick_rate_hz = 0;  ///< 0: one leap
  std::int64_t later_by = 0;       ///< s; shifts the start
};

struct Digests {
  std::uint64_t collisions = 0;
  std::uint64_t log = 0;      ///< of every collision, instants counted from the start
  std::uint64_t motions = 0;  ///< of every stored motion, likewise
  std::uint64_t state = 0;    ///< the engine's own hash, which knows absolute instants
  friend bool operator==(const Digests&, const Digests&) = default;
};

inline std::uint64_t digest_of_motions(const engine::World& world, const engine::Instant& start) {
  test::WordDigest digest;
  const auto number = [&](double x) { digest.add(std::bit_cast<std::uint64_t>(x)); };
  for (const engine::Id id : world.ids()) {
    const engine::MotionRecord m = world.motion(id).value();
    digest.add(m.id);
    for (const engine::SplitNumber& part : {m.x, m.y, m.vx, m.vy}) {
      number(part.high);
      number(part.low);
    }
    const engine::Int128 since = engine::ticks(m.since) - engine::ticks(start);
    digest.add(static_cast<std::uint64_t>(since));
    digest.add(static_cast<std::uint64_t>(since >> 64));
    number(m.angle);
    number(m.spin);
  }
  return digest.value();
}

/// Runs for `until` seconds. Throws when the world refuses the bodies or stalls.
inline Digests run_scene(const Bodies& bodies, double until, const Circumstances& how = {}) {
  engine::Instant start = bodies.start;
  start.seconds += how.later_by;
  engine::World world(engine::WorldOptions{
      .start = start, .arithmetic = how.arithmetic, .broad_phase = how.broad_phase});
  const auto made = world.spawn({bodies.disks, bodies.walls});
  if (!made) throw std::runtime_error("refused: " + made.reject().field + made.reject().reason);

  const engine::Instant end = engine::offset_by(start, until).value();
  test::DigestLog log(start);
  const auto advance = [&](const engine::Instant& to) {
    const auto report = world.advance_to(to, &log);
    if (!report || report.value().stop != engine::Stop::Reached) {
      throw std::runtime_error("the world stopped short");
    }
  };
  if (how.tick_rate_hz > 0) {
    const engine::TickClock clock(start, how.tick_rate_hz, 1);
    for (std::uint64_t tick = 1; clock.instant_of(tick) < end; ++tick) {
      advance(clock.instant_of(tick));
    }
  }
  advance(end);
  return {log.count(), log.digest(), digest_of_motions(world, start), world.state_hash()};
}

}  // namespace stoss::determinism

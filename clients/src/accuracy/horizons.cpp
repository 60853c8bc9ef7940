// SPDX-License-Identifier: Apache-2.0
#include "accuracy/horizons.hpp"

#include "accuracy/cpu_clock.hpp"
#include "accuracy/exact_run.hpp"
#include "accuracy/story.hpp"

#include <stoss/engine/horizon.hpp>

#include <algorithm>
#include <stdexcept>

namespace stoss::client::accuracy {
namespace {

constexpr engine::Instant kEndOfTime = {engine::kSecondsMax - 1, 0};

/// Collisions to look for a horizon in, however cheap: a scene that has kept its trust for so long
/// is not chaotic.
constexpr std::uint64_t kCollisionsMin = 20'000;
constexpr std::uint64_t kCollisionsPerDiskMax = 500;

}  // namespace

Probe probe(const Method& method, const engine::Instant& start, double cpu_s) {
  const auto run = method.start(false);
  Story story;
  const CpuClock clock;
  Probe result;
  while (!result.ended && clock.seconds() < cpu_s) {
    result.ended = run->advance(kEndOfTime, &story, method.work);
  }
  const double cpu = clock.seconds();
  result.collisions = story.count();
  result.cpu_s_per_collision = cpu / static_cast<double>(std::max<std::uint64_t>(1, story.count()));
  if (!story.meetings().empty()) {
    result.last_collision_s = engine::seconds_between(start, story.meetings().back().instant);
  }
  result.reached_s =
      result.ended ? result.last_collision_s : engine::seconds_between(start, run->now());
  return result;
}

HorizonFigures horizon_of(const Method& method,
                          const translate::SceneBodies& bodies,
                          std::size_t disks,
                          double cpu_s) {
  constexpr double kProbePart = 1.0 / 16;
  const Probe cost = probe(method, bodies.start, cpu_s * kProbePart);
  // Twice for the twins, and the search may stop just short of its limit and double once more.
  const double affordable = cpu_s / (2 * cost.cpu_s_per_collision);
  const std::uint64_t interesting =
      std::max(kCollisionsMin, kCollisionsPerDiskMax * static_cast<std::uint64_t>(disks));
  const auto limit =
      static_cast<std::uint64_t>(std::clamp(affordable, 1.0, static_cast<double>(interesting)));
  const auto world = exact_world(bodies, *method.arithmetic);
  if (!world) throw std::runtime_error(world.reject().reason);
  const auto horizon = engine::measure_horizon(world.value(), kEndOfTime, limit);
  if (!horizon) throw std::runtime_error(horizon.reject().reason);
  const engine::Horizon& found = horizon.value();
  HorizonFigures figures{.time_s = engine::seconds_between(bodies.start, found.instant),
                         .collisions = found.collisions,
                         .collisions_per_disk = found.collisions_per_disk,
                         .at_least = found.reached_end};
  if (found.reached_end && found.instant == kEndOfTime) {
    figures.time_s = std::numeric_limits<double>::infinity();
    figures.at_least = false;
  }
  return figures;
}

}  // namespace stoss::client::accuracy

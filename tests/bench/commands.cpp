// SPDX-License-Identifier: Apache-2.0
#include "bench/commands.hpp"

#include "bench/scenes.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace stoss::bench {
namespace {

using engine::World;

constexpr double kFraction = 0.3;

/// A gas that has been asked for its changes, as the daemon's is; made once for all commands.
World& world_of(std::size_t disks) {
  static std::unique_ptr<World> world;
  if (!world || world->disk_count() != disks) {
    world = std::make_unique<World>(make_world(gas(disks, kFraction)));
    melt(*world, disks / 10);
    static_cast<void>(world->drain_changes());
    static_cast<void>(world->state_hash());
  }
  return *world;
}

/// A command and what the daemon does after it.
template <class Command>
void run(benchmark::State& state, std::size_t disks, Command&& command) {
  World& world = world_of(disks);
  engine::Id body = 0;
  for (auto _ : state) {
    body = body % disks + 1;
    command(world, body);
    benchmark::DoNotOptimize(world.drain_changes());
    benchmark::DoNotOptimize(world.state_hash());
  }
}

void set_velocity(World& world, engine::Id body) {
  const engine::VectorFor target{body, {0.5, -0.25}};
  static_cast<void>(world.set_velocity({&target, 1}));
}

// A small disk far outside, so that it always has room.
void spawn_and_remove(World& world, engine::Id) {
  engine::DiskSpec disk;
  disk.position = {-1000, -1000};
  disk.radius = kRadius;
  const auto made = world.spawn({.disks = {&disk, 1}, .walls = {}});
  if (!made) throw std::runtime_error("no room for a disk");
  static_cast<void>(world.remove(made.value()));
}

}  // namespace

void register_commands(std::size_t disks) {
  const auto name = [&](const char* what) {
    return "command/stoss/" + std::to_string(disks) + "/" + what;
  };
  benchmark::RegisterBenchmark(name("set-velocity").c_str(), [disks](benchmark::State& state) {
    run(state, disks, set_velocity);
  });
  benchmark::RegisterBenchmark(name("spawn-and-remove").c_str(), [disks](benchmark::State& state) {
    run(state, disks, spawn_and_remove);
  });
}

}  // namespace stoss::bench

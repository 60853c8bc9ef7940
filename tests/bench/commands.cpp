// SPDX-License-Identifier: Apache-2.0
#include "bench/commands.hpp"

#include "bench/processor_time.hpp"
#include "bench/scenes.hpp"

#include <stoss/idl/scene_file.hpp>
#include <stoss/translate/scene.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

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

/// A scene in a file that is gone with it.
class SceneFile {
 public:
  explicit SceneFile(const BenchScene& scene)
      : path_(std::filesystem::temp_directory_path() /
              ("stoss-bench-" + std::to_string(getpid()) + ".binpb")) {
    Scene message;
    for (const engine::DiskSpec& spec : scene.disks) {
      Disk& disk = *message.add_disks();
      disk.set_id(spec.id);
      disk.mutable_position()->set_x(spec.position.x());
      disk.mutable_position()->set_y(spec.position.y());
      disk.mutable_velocity()->set_x(spec.velocity.x());
      disk.mutable_velocity()->set_y(spec.velocity.y());
      disk.set_radius(spec.radius);
      disk.set_mass(spec.mass);
    }
    if (idl::save_scene(message, path_)) throw std::runtime_error("the scene is not written");
  }
  ~SceneFile() { std::filesystem::remove(path_); }
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void load(benchmark::State& state, std::size_t disks) {
  const SceneFile file(gas(disks, kFraction));
  for (auto _ : state) {
    const double begun = processor_seconds();
    auto scene = idl::load_scene(file.path());
    const double read = processor_seconds();
    const auto bodies = translate::bodies_of(std::get<Scene>(scene));
    const double translated = processor_seconds();
    const auto world = translate::make_world(bodies.value(), {});
    const double made = processor_seconds();
    if (!world) throw std::runtime_error("the scene is refused");
    state.counters["read_s"] = read - begun;
    state.counters["translate_s"] = translated - read;
    state.counters["make_s"] = made - translated;
    state.SetIterationTime(made - begun);
  }
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
  benchmark::RegisterBenchmark(("load/stoss/" + std::to_string(disks)).c_str(),
                               [disks](benchmark::State& state) { load(state, disks); })
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace stoss::bench

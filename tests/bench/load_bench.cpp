// SPDX-License-Identifier: Apache-2.0
// What it takes to load a scene from a file: reading and checking, translating, and making the
// world, with its overlap check and the first event of every body.
//
//   load_bench [--quick] [Google Benchmark's own options]
//
// --quick: a tenth of the million disks.

#include "bench/options.hpp"
#include "bench/processor_time.hpp"
#include "bench/scenes.hpp"

#include <stoss/idl/scene_file.hpp>
#include <stoss/translate/scene.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <variant>

namespace stoss::bench {
namespace {

constexpr double kFraction = 0.3;

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
}  // namespace stoss::bench

int main(int argc, char** argv) {
  const bool quick = stoss::bench::take(argc, argv, "--quick");
  const std::size_t disks = quick ? 100'000 : 1'000'000;
  benchmark::RegisterBenchmark(
      ("load/stoss/" + std::to_string(disks)).c_str(),
      [disks](benchmark::State& state) { stoss::bench::load(state, disks); })
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

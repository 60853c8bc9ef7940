// SPDX-License-Identifier: Apache-2.0
// What a collision costs in the engine alone: equal disks in a box, by number and area fraction,
// and a mixture of sizes. The rate that counts is `collisions`, disk with disk and disk with wall.

#include <stoss/engine/world.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using namespace stoss::engine;

/// A gas of disks at temperature 1 in a square box of four walls. One disk in a hundred has radius
/// 0.5 m; the others are `ratio` times smaller, with their masses in proportion to their areas.
World make_gas(int count, double area_fraction, double ratio) {
  constexpr double kLargeRadius = 0.5;
  constexpr int kLargeEvery = 100;
  const auto radius = [&](int i) {
    return i % kLargeEvery == 0 ? kLargeRadius : kLargeRadius / ratio;
  };
  double area = 0;
  for (int i = 0; i < count; ++i) area += std::numbers::pi * radius(i) * radius(i);
  const double side = std::sqrt(area / area_fraction);
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  // Large disks stand on a coarse lattice of their own first, small ones where there is room.
  std::mt19937_64 random(20);
  std::normal_distribution<double> component;
  World world;
  const double pitch = side / columns;
  const auto spawn = [&](Vector2 position, int i) {
    DiskSpec disk;
    disk.position = position;
    disk.radius = radius(i);
    disk.mass = std::pow(disk.radius / kLargeRadius, 2);
    const double speed = 1 / std::sqrt(disk.mass);
    disk.velocity = {speed * component(random), speed * component(random)};
    return world.spawn({.disks = {&disk, 1}, .walls = {}}).ok();
  };
  if (ratio == 1) {
    for (int i = 0; i < count; ++i) {
      if (!spawn({(i % columns + 0.5) * pitch, (i / columns + 0.5) * pitch}, i)) {
        throw std::runtime_error("the lattice overlaps");
      }
    }
  } else {
    std::uniform_real_distribution<double> place(0, 1);
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count; ++i) {
        if ((i % kLargeEvery == 0) != (pass == 0)) continue;
        const double room = side - 2 * radius(i);
        while (!spawn({radius(i) + place(random) * room, radius(i) + place(random) * room}, i)) {
        }
      }
    }
  }
  const Vector2 corners[] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  std::vector<WallSpec> walls(4);
  for (std::size_t i = 0; i < 4; ++i) {
    walls[i].start = corners[i];
    walls[i].end = corners[(i + 1) % 4];
  }
  if (!world.spawn({.disks = {}, .walls = walls})) throw std::runtime_error("the box overlaps");
  return world;
}

void BM_Gas(benchmark::State& state) {
  World world = make_gas(static_cast<int>(state.range(0)),
                         static_cast<double>(state.range(1)) / 100,
                         static_cast<double>(state.range(2)));
  const auto advance = [&world](std::uint64_t events) {
    const auto report = world.advance_to({.seconds = 1'000'000}, nullptr, events);
    return report.value().collisions;
  };
  const auto bodies = static_cast<std::uint64_t>(state.range(0));
  advance(4 * bodies);  // off the lattice, and margins settled
  std::uint64_t collisions = 0;
  for (auto _ : state) collisions += advance(2 * bodies);
  state.counters["collisions"] =
      benchmark::Counter(static_cast<double>(collisions), benchmark::Counter::kIsRate);
  state.counters["ns_per_collision"] =
      benchmark::Counter(static_cast<double>(collisions) / 1e9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// Arguments: disks, area fraction in percent, ratio of radii.
BENCHMARK(BM_Gas)
    ->ArgsProduct({{1'000, 10'000}, {10, 30, 50, 70}, {1}})
    ->Args({100'000, 30, 1})
    ->Args({10'000, 30, 10})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

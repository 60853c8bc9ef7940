// SPDX-License-Identifier: Apache-2.0
#pragma once

// A gas of equal disks in a box that runs in slices, whichever build of the engine it is in.

#include "support/random.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace stoss::bench {

/// Processes so many events and returns how many of them were collisions.
using Advance = std::function<std::uint64_t(std::uint64_t events)>;

/// Begins a run at the same state every time: a gas that cools is as warm in the last as in the
/// first.
using Start = std::function<Advance()>;

inline constexpr double kGasRadius = 0.4375;  // m

/// Of the box of columns^2 disks, m.
inline double side_of_box(int columns, double area_fraction) {
  return columns * kGasRadius * std::sqrt(std::numbers::pi / area_fraction);
}

/// Throws when nothing happens any more.
template <class World>
Advance advance_of(std::shared_ptr<World> world) {
  return [world = std::move(world)](std::uint64_t events) {
    const auto report = world->advance_to({1'000'000, 0}, nullptr, events).value();
    if (report.events < events) throw std::runtime_error("the gas has stalled");
    return report.collisions;
  };
}

/// columns^2 disks of 0.4375 m in the world that `make` makes, off their lattice already. Throws
/// when the world refuses them or stalls.
template <class World, class Disk, class Wall>
std::shared_ptr<World> make_gas(int columns,
                                double area_fraction,
                                const std::function<World()>& make) {
  const double side = side_of_box(columns, area_fraction);
  const double pitch = side / columns;
  test::Random random(7);
  std::vector<Disk> disks(static_cast<std::size_t>(columns * columns));
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const auto n = static_cast<int>(i);
    disks[i].position = {pitch * (n % columns + 0.5), pitch * (n / columns + 0.5)};
    disks[i].velocity = {random.uniform(-1.7, 1.7), random.uniform(-1.7, 1.7)};
    disks[i].radius = kGasRadius;
  }
  const double corners[5][2] = {{0, 0}, {side, 0}, {side, side}, {0, side}, {0, 0}};
  std::vector<Wall> walls(4);
  for (std::size_t i = 0; i < 4; ++i) {
    walls[i].start = {corners[i][0], corners[i][1]};
    walls[i].end = {corners[i + 1][0], corners[i + 1][1]};
  }
  auto world = std::make_shared<World>(make());
  if (!world->spawn({disks, walls}).ok()) throw std::runtime_error("the gas is refused");
  advance_of(world)(8 * disks.size());
  return world;
}

/// One run of it that goes on from call to call.
template <class World, class Disk, class Wall>
Advance make_run(int columns, double area_fraction) {
  return advance_of(make_gas<World, Disk, Wall>(columns, area_fraction, [] { return World(); }));
}

/// Runs that each begin an event a disk after a copy was made of it, when the copy is at home in
/// the caches.
template <class World, class Disk, class Wall>
Start make_start(
    int columns, double area_fraction, const std::function<World()>& make = [] {
      return World();
    }) {
  const auto gas = make_gas<World, Disk, Wall>(columns, area_fraction, make);
  return [gas, columns] {
    Advance advance = advance_of(std::make_shared<World>(*gas));
    advance(static_cast<std::uint64_t>(columns * columns));
    return advance;
  };
}

}  // namespace stoss::bench

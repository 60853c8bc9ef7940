// SPDX-License-Identifier: Apache-2.0
#pragma once

// The worlds of the bench, as any engine can take them. The smallest disk of each has a radius of
// 0.5 m and moves at about 1 m/s: the sizes and speeds that time-stepping engines are made for.

#include <stoss/engine/world.hpp>

#include <cstdint>
#include <vector>

namespace stoss::bench {

/// Of the smallest disks, m.
inline constexpr double kRadius = 0.5;

struct BenchScene {
  std::vector<engine::DiskSpec> disks;  ///< with ids from 1 on, in their order
  std::vector<engine::WallSpec> walls;  ///< with the ids that follow
  bool is_at_rest = false;              ///< all but the first disk: engines may let them sleep
};

/// Equal disks at temperature 1 in a box, on a square lattice.
BenchScene gas(std::size_t count, double area_fraction);
/// A gas of which one disk in a hundred is `ratio` times larger than the others, with masses in
/// proportion to areas, put down at random.
BenchScene mixture(std::size_t count, double area_fraction, double ratio);
/// A gas among `walls` short walls of all directions.
BenchScene maze(std::size_t count, std::size_t walls, double area_fraction);
/// A gas without a box, from one crowded place into open space.
BenchScene burst(std::size_t count, double area_fraction);
/// Disks at rest without a box, and one, the first, that flies into them.
BenchScene bullet(std::size_t count, double area_fraction);

/// A world of the scene. Throws when it is refused.
engine::World make_world(const BenchScene& scene);

/// Lets the world run until it has had `collisions`, so that it forgets its lattice.
void melt(engine::World& world, std::uint64_t collisions);

/// The scene as the world stands now.
BenchScene scene_at_present(const BenchScene& start, const engine::World& world);

/// J, of the disks that the velocities are given for.
double kinetic_energy(const std::vector<engine::DiskSpec>& disks);

/// The deepest overlap of two disks, as a part of the distance at which they touch; 0 for none.
double deepest_overlap(const std::vector<engine::DiskSpec>& disks);

}  // namespace stoss::bench

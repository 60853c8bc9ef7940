// SPDX-License-Identifier: Apache-2.0
#include "bench/scenes.hpp"

#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace stoss::bench {
namespace {

using engine::DiskSpec;
using engine::Vector2;
using engine::WallSpec;
using engine::World;

constexpr std::uint64_t kSeed = 20;
/// Of the box of a gas: one disk in so many is a large one in a mixture.
constexpr std::size_t kLargeEvery = 100;

/// A component of the velocity of a disk of mass 1 at temperature 1 (Box and Muller), m/s.
double thermal(test::Random& random) {
  const double radial = std::sqrt(-2 * std::log(1 - random.uniform(0, 1)));
  return radial * std::cos(2 * std::numbers::pi * random.uniform(0, 1));
}

DiskSpec disk_at(const Vector2& position, double radius, test::Random& random) {
  DiskSpec disk;
  disk.position = position;
  disk.radius = radius;
  disk.mass = std::pow(radius / kRadius, 2);
  const double speed = 1 / std::sqrt(disk.mass);
  const double vx = speed * thermal(random);
  disk.velocity = {vx, speed * thermal(random)};
  return disk;
}

double side_for(double area, double area_fraction) { return std::sqrt(area / area_fraction); }

double disk_area(double radius) { return std::numbers::pi * radius * radius; }

/// `count` places of a square lattice with room for them in a box of this side.
std::vector<Vector2> lattice(std::size_t count, double side) {
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double pitch = side / static_cast<double>(columns);
  std::vector<Vector2> places(count);
  for (std::size_t i = 0; i < count; ++i) {
    places[i] = {(static_cast<double>(i % columns) + 0.5) * pitch,
                 (static_cast<double>(i / columns) + 0.5) * pitch};
  }
  return places;
}

void add_box(BenchScene& scene, double side) {
  const Vector2 corners[] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  for (std::size_t i = 0; i < 4; ++i) {
    scene.walls.push_back({.start = corners[i], .end = corners[(i + 1) % 4]});
  }
}

void number(BenchScene& scene) {
  engine::Id next = 1;
  for (DiskSpec& disk : scene.disks) disk.id = next++;
  for (WallSpec& wall : scene.walls) wall.id = next++;
}

BenchScene on_lattice(std::size_t count, double side) {
  test::Random random(kSeed);
  BenchScene scene;
  scene.disks.reserve(count);
  for (const Vector2& place : lattice(count, side)) {
    scene.disks.push_back(disk_at(place, kRadius, random));
  }
  return scene;
}

double side_of_gas(std::size_t count, double area_fraction) {
  return side_for(static_cast<double>(count) * disk_area(kRadius), area_fraction);
}

/// Whether the trial world had room for the disk.
bool fits(World& trial, const DiskSpec& disk) {
  return trial.spawn({.disks = {&disk, 1}, .walls = {}}).ok();
}

}  // namespace

BenchScene gas(std::size_t count, double area_fraction) {
  const double side = side_of_gas(count, area_fraction);
  BenchScene scene = on_lattice(count, side);
  add_box(scene, side);
  number(scene);
  return scene;
}

BenchScene mixture(std::size_t count, double area_fraction, double ratio) {
  const std::size_t large = count / kLargeEvery;
  const auto radius = [&](std::size_t i) { return i < large ? ratio * kRadius : kRadius; };
  double area = 0;
  for (std::size_t i = 0; i < count; ++i) area += disk_area(radius(i));
  const double side = side_for(area, area_fraction);
  test::Random random(kSeed);
  BenchScene scene;
  World trial;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = radius(i);
    DiskSpec disk = disk_at(Vector2::Zero(), r, random);
    do {
      const double x = random.uniform(r, side - r);
      disk.position = {x, random.uniform(r, side - r)};
    } while (!fits(trial, disk));
    scene.disks.push_back(disk);
  }
  add_box(scene, side);
  number(scene);
  return scene;
}

BenchScene maze(std::size_t count, std::size_t walls, double area_fraction) {
  constexpr double kWallLength = 4 * kRadius;
  constexpr double kSpare = 1.3;  // places of which some are taken by walls
  const double side = side_of_gas(count, area_fraction);
  test::Random random(kSeed);
  BenchScene scene;
  World trial;
  for (const Vector2& middle : lattice(walls, side)) {
    const double angle = random.uniform(0, std::numbers::pi);
    const Vector2 half = 0.5 * kWallLength * Vector2(std::cos(angle), std::sin(angle));
    scene.walls.push_back({.start = middle - half, .end = middle + half});
  }
  if (!trial.spawn({.disks = {}, .walls = scene.walls})) throw std::runtime_error("the maze");
  for (const Vector2& place :
       lattice(static_cast<std::size_t>(kSpare * static_cast<double>(count)), side)) {
    if (scene.disks.size() == count) break;
    const DiskSpec disk = disk_at(place, kRadius, random);
    if (fits(trial, disk)) scene.disks.push_back(disk);
  }
  if (scene.disks.size() != count) throw std::runtime_error("the maze is too full");
  add_box(scene, side);
  number(scene);
  return scene;
}

BenchScene burst(std::size_t count, double area_fraction) {
  BenchScene scene = on_lattice(count, side_of_gas(count, area_fraction));
  number(scene);
  return scene;
}

BenchScene bullet(std::size_t count, double area_fraction) {
  constexpr double kSpeed = 10;       // m/s
  constexpr double kDistance = 3;     // m, before the first disk
  constexpr double kOffCentre = 0.3;  // m, so that it does not run along a row
  const double side = side_of_gas(count, area_fraction);
  const std::vector<Vector2> places = lattice(count, side);
  const double height = places[count / 2].y() + kOffCentre;
  BenchScene scene;
  scene.disks.push_back(
      {.position = {-kDistance, height}, .velocity = {kSpeed, 0}, .radius = kRadius});
  for (const Vector2& place : places) {
    scene.disks.push_back({.position = place, .radius = kRadius});
  }
  scene.is_at_rest = true;
  number(scene);
  return scene;
}

World make_world(const BenchScene& scene) {
  World world;
  if (const auto made = world.spawn({scene.disks, scene.walls}); !made) {
    throw std::runtime_error("the scene is refused: " + made.reject().reason);
  }
  return world;
}

void melt(World& world, std::uint64_t collisions) {
  const std::uint64_t until = world.counters().collisions + collisions;
  while (world.counters().collisions < until) {
    const std::uint64_t left = until - world.counters().collisions;
    const auto report = world.advance_to({.seconds = 1'000'000'000}, nullptr, left).value();
    if (report.events < left) throw std::runtime_error("the world has stalled or emptied");
  }
}

BenchScene scene_at_present(const BenchScene& start, const World& world) {
  BenchScene scene = start;
  std::size_t i = 0;
  world.for_each_disk([&](const engine::BodyState& state) {
    scene.disks[i].position = state.position;
    scene.disks[i].velocity = state.velocity;
    ++i;
  });
  return scene;
}

double kinetic_energy(const std::vector<DiskSpec>& disks) {
  double energy = 0;
  for (const DiskSpec& disk : disks) energy += 0.5 * disk.mass * disk.velocity.squaredNorm();
  return energy;
}

// A sweep along x: each disk beside those whose left edge is left of its right one.
double deepest_overlap(const std::vector<DiskSpec>& disks) {
  std::vector<const DiskSpec*> order;
  for (const DiskSpec& disk : disks) order.push_back(&disk);
  const auto left = [](const DiskSpec* disk) { return disk->position.x() - disk->radius; };
  std::sort(order.begin(), order.end(), [&](const DiskSpec* a, const DiskSpec* b) {
    return std::pair(left(a), a->id) < std::pair(left(b), b->id);
  });
  double deepest = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const DiskSpec& a = *order[i];
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const DiskSpec& b = *order[k];
      if (left(&b) > a.position.x() + a.radius) break;
      const double reach = a.radius + b.radius;
      if (std::abs(b.position.y() - a.position.y()) > reach) continue;
      deepest = std::max(deepest, 1 - (b.position - a.position).norm() / reach);
    }
  }
  return deepest;
}

}  // namespace stoss::bench

// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/disk_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stoss::engine {
namespace {

/// What it costs to bring a disk to another cell, in looks at a neighbour. Measured; within a
/// factor of two it hardly matters.
constexpr double kCrossing = 14;

/// About the cube root of a ratio of works; from 1/2 to 4.
double balanced_by(double ratio) {
  double longer = 0.5;
  while (longer * longer * longer < ratio && longer < 4) longer *= 1.05;
  return longer;
}

}  // namespace

std::optional<DiskCells::Cage> DiskCells::enter(
    std::int32_t disk, double x, double y, double radius, double least) {
  Level* const level = level_for(radius);
  if (level == nullptr) return std::nullopt;
  const auto cage = cage_at(*level, x, y);
  if (!cage || !(least < kBeyond * level->side)) {
    if (level->items == 0) std::erase_if(levels_, [](const Level& l) { return l.items == 0; });
    return std::nullopt;
  }
  store_.insert(disk, cage->cell);
  ++level->items;
  return cage;
}

std::optional<DiskCells::Cage> DiskCells::move(std::int32_t disk, double x, double y) {
  Level& level = level_of(store_.cell_of(disk).level);
  if (level.is_retired) return std::nullopt;
  const auto cage = cage_at(level, x, y);
  if (!cage) return std::nullopt;
  store_.remove(disk);
  store_.insert(disk, cage->cell);
  ++level.crossings;
  look_after(level);
  return cage;
}

std::optional<DiskCells::Cage> DiskCells::cage_at(const Level& level, double x, double y) {
  const double number_x = x * level.inverse;
  const double number_y = y * level.inverse;
  if (!(std::abs(number_x) < kNumberMax && std::abs(number_y) < kNumberMax)) return std::nullopt;
  const Cell cell{CellStore::floor_of(number_x), CellStore::floor_of(number_y), level.id};
  return cage_in(level, cell);
}

void DiskCells::leave(std::int32_t disk) {
  const std::int32_t id = store_.cell_of(disk).level;
  store_.remove(disk);
  if (--level_of(id).items > 0) return;
  std::erase_if(levels_, [id](const Level& level) { return level.id == id; });
}

DiskCells::Level& DiskCells::level_of(std::int32_t id) {
  return *std::find_if(
      levels_.begin(), levels_.end(), [id](const Level& level) { return level.id == id; });
}

DiskCells::Level& DiskCells::make_level(double radius_max, double side) {
  Level level;
  level.id = next_id_++;
  level.side = side;
  level.inverse = 1 / side;
  level.radius_max = radius_max;
  levels_.push_back(level);
  return levels_.back();
}

// The level of the largest disks among which one of this radius may stand; a new one, if there is
// none. None for a disk that is much larger than most: a box with a margin of its own, which
// follows its work, suits it better.
DiskCells::Level* DiskCells::level_for(double radius) {
  constexpr double kAlike = 1.5;   // with larger ones its cells would be too full
  constexpr double kLarger = 2.2;  // by much
  Level* best = nullptr;
  std::int32_t smaller = 0;
  for (Level& level : levels_) {
    if (kLarger * level.radius_max < radius) smaller += level.items;
    if (level.is_retired || level.radius_max < radius || level.radius_max > kAlike * radius) {
      continue;
    }
    if (best == nullptr || best->radius_max < level.radius_max) best = &level;
  }
  if (smaller > 2 * (best == nullptr ? 0 : best->items)) return nullptr;
  if (best != nullptr) return best;
  constexpr double kRoom = 1.001;  // for disks that differ by rounding alone
  return &make_level(kRoom * radius, least_side(kRoom * radius));
}

// Are the cells of a level too small or too large? With sides f times as long there are 1 / f times
// as many crossings and f^2 times as many looks: together they cost least where the crossings' part
// is twice the other.
void DiskCells::look_after(Level& level) {
  constexpr std::uint64_t kOften = 2;  // crossings a disk
  if (level.is_retired ||
      level.crossings < 256 + kOften * static_cast<std::uint64_t>(level.items)) {
    return;
  }
  const auto crossings = static_cast<double>(std::exchange(level.crossings, 0));
  const auto looks = static_cast<double>(store_.take_looks(level.id));
  for (const Level& other : levels_) {  // most have not come over yet: too soon to tell
    if (other.is_retired && other.items > level.items / 8) return;
  }
  const double side = std::max(level.side * balanced_by(kCrossing * crossings / (2 * (looks + 1))),
                               least_side(level.radius_max));
  constexpr double kEnough = 1.25;
  if (side < kEnough * level.side && level.side < kEnough * side) return;
  level.is_retired = true;
  make_level(level.radius_max, side);  // `level` is no longer valid
}

}  // namespace stoss::engine

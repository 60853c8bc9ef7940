// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/disk_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stoss::engine {

bool DiskCells::enter(std::int32_t disk, double x, double y, double radius, double least) {
  Level* const level = level_for(radius);
  if (level == nullptr) return false;
  const auto cell = cell_at(*level, x, y);
  if (!cell || !(least < level->cage_half - level->side / 2)) {
    if (level->items == 0) std::erase_if(levels_, [](const Level& l) { return l.items == 0; });
    return false;
  }
  store_.insert(disk, *cell);
  ++level->items;
  return true;
}

std::optional<DiskCells::Step> DiskCells::move(std::int32_t disk, double x, double y) {
  const Cell from = store_.cell_of(disk);
  Level& level = level_of(from.level);
  if (is_given_up(level)) return std::nullopt;
  const auto to = cell_at(level, x, y);
  if (!to) return std::nullopt;
  const Step step{to->x - from.x, to->y - from.y};
  store_.move(disk, step.dx, step.dy);
  ++level.crossings;
  look_after(level);
  return step;
}

void DiskCells::leave(std::int32_t disk) {
  const std::int32_t id = store_.cell_of(disk).level;
  store_.remove(disk);
  if (store_.is_mostly_free()) store_.pack([this](PooledList& list) { lists_.release(list); });
  if (--level_of(id).items > 0) return;
  std::erase_if(levels_, [id](const Level& level) { return level.id == id; });
}

DiskCells::Level& DiskCells::make_level(double radius_max, double side) {
  Level level;
  level.id = next_id_++;
  level.side = side;
  level.inverse = 1 / side;
  level.radius_max = radius_max;
  const double beyond = beyond_cell(radius_max, side) * side;
  level.cage_half = side / 2 + beyond;
  level.reach = beyond + radius_max;
  levels_.push_back(level);
  return levels_.back();
}

// The level of the largest disks among which one of this radius may stand; a new one, if there is
// none. None for a disk that is much larger than most: a box with a margin of its own, which
// follows its work, suits it better.
DiskCells::Level* DiskCells::level_for(double radius) {
  constexpr double kAlike = 1.5;  // with larger ones its cells would be too full
  Level* best = nullptr;
  for (Level& level : levels_) {
    if (level.is_retired || level.radius_max < radius || level.radius_max > kAlike * radius) {
      continue;
    }
    if (best == nullptr || best->radius_max < level.radius_max) best = &level;
  }
  if (best != nullptr) {
    return are_few_beside_smaller(best->radius_max, best->items) ? nullptr : best;
  }
  if (are_few_beside_smaller(radius, 0)) return nullptr;
  constexpr double kRoom = 1.001;  // for disks that differ by rounding alone
  return &make_level(kRoom * radius, least_side(kRoom * radius));
}

/// Are `items` disks of this radius few beside those in cells that are much smaller?
bool DiskCells::are_few_beside_smaller(double radius, std::int32_t items) const {
  constexpr double kMuch = 2.2;
  std::int32_t smaller = 0;
  for (const Level& level : levels_) {
    if (kMuch * level.radius_max < radius) smaller += level.items;
  }
  return smaller > 2 * items;
}

std::int32_t DiskCells::straggler_of_some_level() {
  for (const Level& level : levels_) {
    if (is_given_up(level)) return store_.some_item_of(level.id);
  }
  return CellStore::kNone;
}

void DiskCells::note_bystander(const Aabb& box) {
  for (const Level& level : levels_) {
    if (!store_.forget_notes(cells_beside(level, box, 2 * kCellRounding), level.id)) {
      ++changes_;
      return;
    }
  }
}

// Are the cells of a level too small or too large?
void DiskCells::look_after(Level& level) {
  constexpr std::uint64_t kOften = 1;  // crossings a disk
  if (level.is_retired ||
      level.crossings < 256 + kOften * static_cast<std::uint64_t>(level.items)) {
    return;
  }
  CellWork work = store_.take_work(level.id);
  work.crossings = static_cast<double>(std::exchange(level.crossings, 0));
  for (const Level& other : levels_) {  // most have not come over yet: too soon to tell
    if (other.is_retired && other.items > level.items / 8) return;
  }
  const double side = best_side(level.radius_max, level.side, work);
  constexpr double kEnough = 1.25;
  if (side < kEnough * level.side && level.side < kEnough * side) return;
  level.is_retired = true;
  make_level(level.radius_max, side);  // `level` is no longer valid
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/box_grid.hpp"

#include <algorithm>
#include <cmath>

namespace stoss::engine {

std::span<const std::int32_t> BoxGrid::find(const Aabb& box) const {
  const Extent extent(box);
  found_.clear();
  for (const Level& level : levels_) find_on(level, extent);
  return found_;
}

void BoxGrid::find_on(const Level& level, const Extent& box) const {
  const double reach_x = box.half_x + level.cell;  // no item there is larger than a cell
  const double reach_y = box.half_y + level.cell;
  const double left = (box.x - reach_x) * level.inverse;
  const double low = (box.y - reach_y) * level.inverse;
  const double right = (box.x + reach_x) * level.inverse;
  const double high = (box.y + reach_y) * level.inverse;
  const auto look_at = [&](std::int32_t line) {
    const Place& place = places_.of(line);
    if (overlaps(place, box)) found_.push_back(place.body);
  };
  // Where it would look at more cells than there are, it looks at all. So it does for NaN.
  if (!((right - left) * (high - low) <= 64 + store_.cells_max())) {
    return store_.for_each(level.level, look_at);
  }
  store_.for_each({CellStore::floor_of(left),
                   CellStore::floor_of(low),
                   CellStore::floor_of(right),
                   CellStore::floor_of(high)},
                  level.level,
                  look_at);
}

BoxGrid::Level& BoxGrid::level_of(std::int32_t level) {
  for (Level& here : levels_) {
    if (here.level == level) return here;
  }
  levels_.push_back({level, 0, std::ldexp(1.0, level), std::ldexp(1.0, -level)});
  return levels_.back();
}

// Its own, or the most crowded of the two above that: every level costs each search, and where all
// sizes are about the same, one is enough.
BoxGrid::Level& BoxGrid::level_for(double half) {
  const int own = std::ilogb(half) + 1;  // its cells are larger than half
  Level* best = nullptr;
  for (Level& here : levels_) {
    if (here.level < own || here.level > own + 2) continue;
    if (best == nullptr || here.items > best->items) best = &here;
  }
  return best != nullptr ? *best : level_of(own);
}

std::int32_t BoxGrid::insert(std::int32_t body, const Aabb& tight, double margin) {
  const Extent extent(tight);
  const double half = std::max(extent.half_x, extent.half_y) + margin;
  const std::int32_t line = places_.make(body);
  Place& entering = places_.of(line);
  entering.x = extent.x;
  entering.y = extent.y;
  entering.margin = margin;
  entering.half = Extent::padded(half, std::max(std::abs(extent.x), std::abs(extent.y)));
  Level& level = level_for(entering.half);
  ++level.items;
  store_.insert(line,
                {CellStore::floor_of(entering.x * level.inverse),
                 CellStore::floor_of(entering.y * level.inverse),
                 level.level});
  return line;
}

void BoxGrid::remove(std::int32_t line) {
  Level& level = level_of(store_.cell_of(line).level);
  store_.remove(line);
  if (store_.is_mostly_free()) store_.pack([](PooledList&) {});
  places_.drop(line);
  if (--level.items > 0) return;
  level = levels_.back();
  levels_.pop_back();
}

}  // namespace stoss::engine

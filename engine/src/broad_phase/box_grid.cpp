// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/box_grid.hpp"

#include "prefetch.hpp"

#include <algorithm>
#include <utility>

namespace stoss::engine {

std::span<const std::int32_t> BoxGrid::find(const Aabb& box) const {
  if (found_.size() <= places_.size()) {
    found_.resize(2 * places_.size() + 1);
    first_.resize(2 * places_.size() + 1);
  }
  const Extent extent(box);
  std::int32_t* end = found_.data();
  for (const Level& level : levels_) end = find_on(level, extent, end);
  return {found_.data(), end};
}

std::int32_t* BoxGrid::find_on(const Level& level, const Extent& box, std::int32_t* to) const {
  const double reach_x = box.half_x + level.cell;  // no item there is larger than a cell
  const double reach_y = box.half_y + level.cell;
  const double left = (box.x - reach_x) * level.inverse;
  const double low = (box.y - reach_y) * level.inverse;
  const double right = (box.x + reach_x) * level.inverse;
  const double high = (box.y + reach_y) * level.inverse;
  // Where it would look at more cells than there are items, it looks at the items.
  if (!((right - left) * (high - low) <= 64 + static_cast<double>(places_.size()))) {
    return find_slowly(level, box, to);
  }
  const CellRange cells{floor_of(left), floor_of(low), floor_of(right), floor_of(high)};
  const std::int32_t* const end = first_items(cells, level.level, first_.data());
  for (const std::int32_t* first = first_.data(); first != end; ++first) {
    std::int32_t item = *first;
    do {
      const Place& here = places_[index(item)];
      *to = item;
      to += overlaps(here, box) ? 1 : 0;
      item = here.next;
    } while (item != kNull);
  }
  return to;
}

std::int32_t* BoxGrid::find_slowly(const Level& level, const Extent& box, std::int32_t* to) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& here = places_[i];
    if (here.cell == kNull || !overlaps(here, box)) continue;
    if (keys_[index(here.cell) / kBlockCells].level != level.level) continue;
    *to++ = static_cast<std::int32_t>(i);
  }
  return to;
}

// The first items of the cells that have any; all are asked for before any is looked at.
std::int32_t* BoxGrid::first_items(const CellRange& cells,
                                   std::int32_t level,
                                   std::int32_t* to) const {
  const auto within = [](std::int64_t x) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(x, 0, kBlockSide - 1));
  };
  for (std::int64_t by = cells.y0 >> 2; by <= cells.y1 >> 2; ++by) {
    const std::size_t y0 = within(cells.y0 - by * kBlockSide);
    const std::size_t y1 = within(cells.y1 - by * kBlockSide);
    for (std::int64_t bx = cells.x0 >> 2; bx <= cells.x1 >> 2; ++bx) {
      const std::int32_t block = find_block(bx, by, level);
      if (block == kNull) continue;
      const std::size_t x0 = within(cells.x0 - bx * kBlockSide);
      const std::size_t x1 = within(cells.x1 - bx * kBlockSide);
      const std::int32_t* row = blocks_[index(block)].first.data() + y0 * kBlockSide;
      for (std::size_t y = y0; y <= y1; ++y, row += kBlockSide) {
        for (std::size_t x = x0; x <= x1; ++x) {
          if (row[x] == kNull) continue;
          prefetch(&places_[index(row[x])]);
          *to++ = row[x];
        }
      }
    }
  }
  return to;
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

void BoxGrid::insert(std::int32_t item, const Aabb& tight, double margin) {
  const Extent extent(tight);
  const double half = std::max(extent.half_x, extent.half_y) + margin;
  Place& entering = place(item);
  entering.x = extent.x;
  entering.y = extent.y;
  entering.margin = margin;
  entering.half = Extent::padded(half, std::max(std::abs(extent.x), std::abs(extent.y)));
  Level& level = level_for(entering.half);
  ++level.items;
  const std::int64_t x = floor_of(entering.x * level.inverse);
  const std::int64_t y = floor_of(entering.y * level.inverse);
  std::int32_t block = find_block(x >> 2, y >> 2, level.level);
  if (block == kNull) block = make_block(x >> 2, y >> 2, level.level);
  ++keys_[index(block)].items;
  const std::size_t at = place_in_block(x, y);
  std::int32_t& first = blocks_[index(block)].first[at];
  if (first != kNull) place(first).previous = item;
  entering.next = first;
  entering.previous = kNull;
  entering.cell = block * static_cast<std::int32_t>(kBlockCells) + static_cast<std::int32_t>(at);
  first = item;
}

void BoxGrid::remove(std::int32_t item) {
  Place& here = place(item);
  const std::size_t block = index(here.cell) / kBlockCells;
  if (here.next != kNull) place(here.next).previous = here.previous;
  if (here.previous != kNull) {
    place(here.previous).next = here.next;
  } else {
    blocks_[block].first[index(here.cell) % kBlockCells] = here.next;
  }
  here.cell = kNull;
  BlockKey& key = keys_[block];
  Level& level = level_of(key.level);
  if (--key.items == 0) drop_block(static_cast<std::int32_t>(block));
  if (--level.items == 0) {
    level = levels_.back();
    levels_.pop_back();
  }
}

std::int32_t BoxGrid::make_block(std::int64_t x, std::int64_t y, std::int32_t level) {
  std::int32_t block;
  if (free_blocks_.empty()) {
    block = static_cast<std::int32_t>(blocks_.size());
    blocks_.emplace_back();
    keys_.emplace_back();
    if (2 * blocks_.size() > table_.size()) grow_table();
  } else {
    block = free_blocks_.back();
    free_blocks_.pop_back();
  }
  blocks_[index(block)].first.fill(kNull);
  keys_[index(block)] = {x, y, level, 0};
  file_block(block);
  return block;
}

void BoxGrid::file_block(std::int32_t block) {
  const BlockKey& key = keys_[index(block)];
  std::size_t i = hash_of(key.x, key.y, key.level) >> table_shift_;
  while (table_[i] != kNull) i = (i + 1) & (table_.size() - 1);
  table_[i] = block;
}

void BoxGrid::grow_table() {
  const std::vector<std::int32_t> old =
      std::exchange(table_, std::vector<std::int32_t>(2 * table_.size(), kNull));
  --table_shift_;
  for (const std::int32_t block : old) {
    if (block != kNull) file_block(block);
  }
}

// Closes the gap in its run of the table, so that no search stops too early.
void BoxGrid::drop_block(std::int32_t block) {
  const std::size_t mask = table_.size() - 1;
  const auto home_of = [&](std::int32_t b) {
    const BlockKey& key = keys_[index(b)];
    return static_cast<std::size_t>(hash_of(key.x, key.y, key.level) >> table_shift_);
  };
  std::size_t hole = home_of(block);
  while (table_[hole] != block) hole = (hole + 1) & mask;
  for (std::size_t i = (hole + 1) & mask; table_[i] != kNull; i = (i + 1) & mask) {
    if (((i - home_of(table_[i])) & mask) < ((i - hole) & mask)) continue;
    table_[hole] = table_[i];
    hole = i;
  }
  table_[hole] = kNull;
  free_blocks_.push_back(block);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/box_grid.hpp"

#include <algorithm>
#include <utility>

namespace stoss::engine {

BoxGrid::Level& BoxGrid::level_of(std::int32_t level) {
  for (Level& here : levels_) {
    if (here.level == level) return here;
  }
  levels_.push_back({level, 0, std::ldexp(1.0, level), std::ldexp(1.0, -level)});
  return levels_.back();
}

void BoxGrid::insert(std::int32_t item, const Aabb& box) {
  if (index(item) >= items_.size()) items_.resize(index(item) + 1);
  int exponent = 0;
  std::frexp(std::max(box.high_x - box.low_x, box.high_y - box.low_y), &exponent);
  Level& level = level_of(exponent);  // 2^exponent is above the extent
  ++level.items;
  const std::int64_t x = floor_of((0.5 * box.low_x + 0.5 * box.high_x) * level.inverse);
  const std::int64_t y = floor_of((0.5 * box.low_y + 0.5 * box.high_y) * level.inverse);
  std::int32_t block = find_block(x >> 2, y >> 2, level.level);
  if (block == kNull) block = make_block(x >> 2, y >> 2, level.level);
  ++keys_[index(block)].items;
  const std::size_t place = place_in_block(x, y);
  std::int32_t& first = blocks_[index(block)].first[place];
  if (first != kNull) items_[index(first)].previous = item;
  items_[index(item)] = {
      box,
      first,
      kNull,
      block * static_cast<std::int32_t>(kBlockCells) + static_cast<std::int32_t>(place),
      level.level};
  first = item;
}

void BoxGrid::remove(std::int32_t item) {
  Item& here = items_[index(item)];
  const std::int32_t block = here.cell / static_cast<std::int32_t>(kBlockCells);
  if (here.next != kNull) items_[index(here.next)].previous = here.previous;
  if (here.previous != kNull) {
    items_[index(here.previous)].next = here.next;
  } else {
    blocks_[index(block)].first[index(here.cell) % kBlockCells] = here.next;
  }
  here.cell = kNull;
  if (--keys_[index(block)].items == 0) drop_block(block);
  Level& level = level_of(here.level);
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

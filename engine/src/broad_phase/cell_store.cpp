// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/cell_store.hpp"

#include "grow.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace stoss::engine {

void CellStore::insert(std::int32_t item, const Cell& cell) {
  make_line_of(index(item), links_);
  ++items_;
  const std::int32_t block = block_for({cell.x >> kBlockShift, cell.y >> kBlockShift, cell.level});
  items_max_ = std::max(items_max_, ++heads_[index(block)].items);
  put_in(item, block, in_block(cell.x, cell.y));
}

void CellStore::keep_for(std::int32_t item, std::int32_t number) {
  make_line_of(index(item), links_);
  links_[index(item)].cell = kBelowNone - number;
}

void CellStore::remove(std::int32_t item) {
  const std::int32_t block = links_[index(item)].cell / static_cast<std::int32_t>(kBlockCells);
  take_out(item);
  --items_;
  if (--heads_[index(block)].items == 0) drop_block(block);
}

// To another block: most often one beside, which the own one knows.
void CellStore::move_far(std::int32_t item, std::int64_t dx, std::int64_t dy) {
  const Cell from = cell_of(item);
  const std::int32_t own = links_[index(item)].cell / static_cast<std::int32_t>(kBlockCells);
  const std::int64_t x = (from.x & (kBlockSide - 1)) + dx, y = (from.y & (kBlockSide - 1)) + dy;
  const auto is_near = [](std::int64_t i) { return i >= -kBlockSide && i < 2 * kBlockSide; };
  const std::int32_t block =
      is_near(x) && is_near(y)
          ? heads_[index(own)].beside[beside(x >> kBlockShift, y >> kBlockShift)]
          : kNoBlock;
  if (block == kNoBlock) {
    remove(item);
    return insert(item, {from.x + dx, from.y + dy, from.level});
  }
  take_out(item);
  put_in(item, block, in_block(x, y));
  items_max_ = std::max(items_max_, ++heads_[index(block)].items);
  if (--heads_[index(own)].items == 0) drop_block(own);
}

void CellStore::put_in(std::int32_t item, std::int32_t block, std::size_t at) {
  links_[index(item)] = {
      block * static_cast<std::int32_t>(kBlockCells) + static_cast<std::int32_t>(at), kNone};
  std::int32_t* const places = &blocks_[index(block)].items[2 * at];
  if (places[0] == kNone) {
    places[0] = item;
  } else if (places[1] == kNone) {
    places[1] = item;
  } else {
    links_[index(item)].next = std::exchange(links_[index(places[1])].next, item);
    heads_[index(block)].crowded |= std::uint64_t{1} << at;
  }
}

void CellStore::take_out(std::int32_t item) {
  const Link link = std::exchange(links_[index(item)], Link{});
  const std::size_t block = index(link.cell) / kBlockCells;
  const std::size_t at = index(link.cell) % kBlockCells;
  std::int32_t* const places = &blocks_[block].items[2 * at];
  const std::uint64_t bit = std::uint64_t{1} << at;
  if ((heads_[block].crowded & bit) == 0) {  // the links of others, which are far, are not asked
    if (places[0] == item) places[0] = places[1];
    places[1] = kNone;
    return;
  }
  if (places[0] == item) {  // the second takes its place, and the next of those behind the second's
    places[0] = places[1];
    places[1] = std::exchange(links_[index(places[0])].next, kNone);
  } else if (places[1] == item) {
    places[1] = link.next;
  } else {
    std::int32_t before = places[1];
    while (links_[index(before)].next != item) before = links_[index(before)].next;
    links_[index(before)].next = link.next;
  }
  if (links_[index(places[1])].next == kNone) heads_[block].crowded &= ~bit;
}

bool CellStore::forget_notes(const Range& cells, std::int32_t level) {
  constexpr std::int64_t kMany = 8;  // along an axis
  const Range blocks{cells.x0 >> kBlockShift,
                     cells.y0 >> kBlockShift,
                     cells.x1 >> kBlockShift,
                     cells.y1 >> kBlockShift};
  if (blocks.x1 - blocks.x0 >= kMany || blocks.y1 - blocks.y0 >= kMany) return false;
  for (std::int64_t y = blocks.y0; y <= blocks.y1; ++y) {
    for (std::int64_t x = blocks.x0; x <= blocks.x1; ++x) {
      const std::int32_t block = table_[entry_of({x, y, level})];
      if (block != kNone) heads_[index(block)].note.as_of = 0;
    }
  }
  return true;
}

std::int32_t* CellStore::collect_hanging(std::size_t block,
                                         std::uint64_t cells,
                                         std::int32_t but_for,
                                         std::int32_t* to) const {
  for_each_hanging(static_cast<std::int32_t>(block), cells, [&](std::int32_t item) {
    if (item != but_for) *to++ = item;
  });
  return to;
}

std::int32_t* CellStore::collect_hanging_around(
    std::int32_t item, const Head& head, std::size_t x, std::size_t y, std::int32_t* to) const {
  for_each_crowded_around(head, x, y, [&](std::size_t block, std::uint64_t cells) {
    to = collect_hanging(block, cells, item, to);
  });
  return to;
}

std::int32_t CellStore::some_item_of(std::int32_t level) {
  constexpr int kFew = 16;
  for (int i = 0; i < kFew; ++i, ++looked_at_) {
    if (looked_at_ >= blocks_.size()) looked_at_ = 0;
    const Head& head = heads_[looked_at_];
    if (head.level != level || head.items == 0) continue;
    for (const std::int32_t item : blocks_[looked_at_].items) {
      if (item != kNone) return item;
    }
  }
  return kNone;
}

CellWork CellStore::take_work(std::int32_t level) {
  CellWork work;
  for (const std::int32_t block : table_) {
    if (block == kNone || heads_[index(block)].level != level) continue;
    const std::uint64_t looks = std::exchange(heads_[index(block)].looks, 0U);
    work.searches += static_cast<double>(looks / kOneSearch);
    work.looks += static_cast<double>(looks % kOneSearch);
  }
  return work;
}

std::int32_t CellStore::make_block(const Cell& key) {
  std::int32_t block;
  if (free_blocks_.empty()) {
    block = static_cast<std::int32_t>(blocks_.size());
    if (blocks_.size() == blocks_.capacity()) grow_blocks();
    blocks_.emplace_back();
    heads_.emplace_back();
  } else {
    block = free_blocks_.back();
    free_blocks_.pop_back();
  }
  const PooledList inherited = heads_[index(block)].note.list;
  heads_[index(block)] = {key.x, key.y, key.level, 0, 0, 0, {}, {0, inherited}};
  if (2 * ++entries_ > table_.size()) resize_table(2 * table_.size());
  table_[entry_of(key)] = block;
  link(block, block);
  return block;
}

void CellStore::drop_block(std::int32_t block) {
  link(block, kNoBlock);
  free_blocks_.push_back(block);
  drop_entry(entry_of(heads_[index(block)].key()));
}

// Makes a block known to those around it as `as`, and those to it.
void CellStore::link(std::int32_t block, std::int32_t as) {
  const Cell key = heads_[index(block)].key();
  for (std::int64_t dy = -1; dy <= 1; ++dy) {
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      const std::int32_t other = table_[entry_of({key.x + dx, key.y + dy, key.level})];
      heads_[index(block)].beside[beside(dx, dy)] = other != kNone ? other : kNoBlock;
      if (other != kNone) heads_[index(other)].beside[beside(-dx, -dy)] = as;
    }
  }
}

// To a power of two.
void CellStore::resize_table(std::size_t size) {
  const std::vector<std::int32_t> old =
      std::exchange(table_, std::vector<std::int32_t>(size, kNone));
  table_shift_ = 64 - std::countr_zero(size);
  for (const std::int32_t block : old) {
    if (block != kNone) table_[entry_of(heads_[index(block)].key())] = block;
  }
}

// By an eighth; where some of the items that were announced are yet to come, but no more than are
// here, to as many blocks as there will be if those come to stand as these do.
void CellStore::grow_blocks() {
  constexpr double kStep = 1.125;
  constexpr double kRoom = 1.04;  // they spread into blocks beside those
  constexpr std::size_t kFew = 8;
  const double yet = static_cast<double>(items_to_be_) / static_cast<double>(items_);
  const double by = yet < 2 ? std::max(kStep, kRoom * yet) : kStep;
  blocks_.reserve(static_cast<std::size_t>(by * static_cast<double>(blocks_.size())) + kFew);
  heads_.reserve(blocks_.capacity());
}

// Moves all blocks together, each to its place among those that are in use.
void CellStore::pack_blocks() {
  std::vector<std::int32_t> numbers(blocks_.size(), kNone);
  std::size_t in_use = 0;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (heads_[block].items == 0 && block != kNoBlock) continue;
    numbers[block] = static_cast<std::int32_t>(in_use);
    blocks_[in_use] = blocks_[block];
    heads_[in_use] = heads_[block];
    ++in_use;
  }
  blocks_.resize(in_use);
  blocks_.shrink_to_fit();
  heads_.resize(in_use);
  heads_.shrink_to_fit();
  free_blocks_ = std::vector<std::int32_t>();
  renumber(numbers);
}

// Tells everybody the new numbers of the blocks.
void CellStore::renumber(const std::vector<std::int32_t>& numbers) {
  for (std::int32_t& block : table_) {
    if (block != kNone) block = numbers[index(block)];
  }
  resize_table(std::max(kTableLeast, std::bit_ceil(2 * entries_)));
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (std::int32_t& other : heads_[block].beside) other = numbers[index(other)];
    const auto number = static_cast<std::int32_t>(block);
    for_each_in(number, {0, 0, kBlockSide - 1, kBlockSide - 1}, [&](std::int32_t item) {
      constexpr auto kCells = static_cast<std::int32_t>(kBlockCells);
      std::int32_t& cell = links_[index(item)].cell;
      cell = number * kCells + cell % kCells;
    });
  }
}

// Closes the gap in its run of the table, so that no search stops too early.
void CellStore::drop_entry(std::size_t hole) {
  --entries_;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = (hole + 1) & mask; table_[i] != kNone; i = (i + 1) & mask) {
    const std::size_t home = hash_of(heads_[index(table_[i])].key()) >> table_shift_;
    if (((i - home) & mask) < ((i - hole) & mask)) continue;
    table_[hole] = table_[i];
    hole = i;
  }
  table_[hole] = kNone;
}

}  // namespace stoss::engine

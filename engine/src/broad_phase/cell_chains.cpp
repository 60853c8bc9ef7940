// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/cell_chains.hpp"

#include <utility>

namespace stoss::engine {

void CellChains::insert(std::int32_t item, const Cell& cell) {
  if (index(item) >= links_.size()) links_.resize(index(item) + 1);
  const Cell key{cell.x >> kBlockShift, cell.y >> kBlockShift, cell.level};
  std::int32_t block = table_[entry_of(key)].block;
  if (block == kNone) block = make_block(key);
  const auto at = static_cast<std::int32_t>((cell.y & (kBlockSide - 1)) * kBlockSide +
                                            (cell.x & (kBlockSide - 1)));
  std::int32_t& first = blocks_[index(block)].first[index(at)];
  if (first != kNone) links_[index(first)].previous = item;
  links_[index(item)] = {first, kNone, block * static_cast<std::int32_t>(kBlockCells) + at};
  first = item;
  heads_[index(block)].occupied |= std::uint64_t{1} << at;
}

void CellChains::remove(std::int32_t item) {
  const Link link = std::exchange(links_[index(item)], Link{});
  const std::size_t block = index(link.cell) / kBlockCells;
  if (link.next != kNone) links_[index(link.next)].previous = link.previous;
  if (link.previous != kNone) {
    links_[index(link.previous)].next = link.next;
    return;
  }
  const std::size_t at = index(link.cell) % kBlockCells;
  blocks_[block].first[at] = link.next;
  if (link.next != kNone) return;
  Head& head = heads_[block];
  head.occupied &= ~(std::uint64_t{1} << at);
  if (head.occupied != 0) return;
  free_blocks_.push_back(static_cast<std::int32_t>(block));
  drop_entry(entry_of(head.key));
}

std::int32_t CellChains::make_block(const Cell& key) {
  std::int32_t block;
  if (free_blocks_.empty()) {
    block = static_cast<std::int32_t>(blocks_.size());
    blocks_.emplace_back();
    heads_.emplace_back();
  } else {
    block = free_blocks_.back();
    free_blocks_.pop_back();
  }
  blocks_[index(block)].first.fill(kNone);
  heads_[index(block)] = {key, 0};
  if (2 * ++entries_ > table_.size()) grow_table();
  table_[entry_of(key)] = {key, block};
  return block;
}

void CellChains::grow_table() {
  const std::vector<Entry> old = std::exchange(table_, std::vector<Entry>(2 * table_.size()));
  --table_shift_;
  for (const Entry& entry : old) {
    if (entry.block != kNone) table_[entry_of(entry.key)] = entry;
  }
}

// Closes the gap in its run of the table, so that no search stops too early.
void CellChains::drop_entry(std::size_t hole) {
  --entries_;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = (hole + 1) & mask; table_[i].block != kNone; i = (i + 1) & mask) {
    const auto home = static_cast<std::size_t>(hash_of(table_[i].key) >> table_shift_);
    if (((i - home) & mask) < ((i - hole) & mask)) continue;
    table_[hole] = table_[i];
    hole = i;
  }
  table_[hole].block = kNone;
}

}  // namespace stoss::engine

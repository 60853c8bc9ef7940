// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/neighbours.hpp"

#include <algorithm>

namespace stoss::engine {

void ListPool::grow(PooledList& list, std::size_t wanted) {
  PooledList larger{0, list.size, std::max(list.room_class, 0)};
  while (room(larger) < wanted) ++larger.room_class;
  auto& free = free_[index(larger.room_class)];
  if (free.empty()) {
    larger.offset = static_cast<std::uint32_t>(memory_.size());
    memory_.resize(memory_.size() + room(larger));
  } else {
    larger.offset = free.back();
    free.pop_back();
  }
  std::copy_n(memory_.begin() + list.offset, list.size, memory_.begin() + larger.offset);
  release(list);
  list = larger;
}

// Marks come in pairs of numbers that were never used before.
std::uint32_t Neighbours::next_stamp() {
  stamp_ += 2;
  if (stamp_ < 2) {  // wrapped: old marks must not look new
    for (Entry& e : entries_) e.mark = 0;
    stamp_ = 2;
  }
  return stamp_;
}

// Makes found_ the neighbours of `slot` in place of before_, in all lists.
void Neighbours::replace_neighbours(Slot slot) {
  Entry& entry = entries_[index(slot)];
  const std::uint32_t was_neighbour = next_stamp();
  const std::uint32_t still_neighbour = was_neighbour + 1;
  for (const Slot old : before_) entries_[index(old)].mark = was_neighbour;
  for (const Slot other : found_) {
    Entry& e = entries_[index(other)];
    if (e.keeps_list()) {
      // Of a body without a list, before_ may hold more than its neighbours.
      if (e.mark == was_neighbour && !entry.keeps_list()) pool_.erase(e.list, slot);
      if (e.mark != was_neighbour || !entry.keeps_list()) pool_.push(e.list, slot);
    }
    e.mark = still_neighbour;
  }
  for (const Slot old : before_) {
    Entry& e = entries_[index(old)];
    if (e.mark == was_neighbour && e.keeps_list()) pool_.erase(e.list, slot);
  }
  if (entry.keeps_list()) pool_.assign(entry.list, found_);
}

// Takes a body whose box is out from all lists.
void Neighbours::forget(Slot slot) {
  found_.clear();
  replace_neighbours(slot);
  pool_.release(entries_[index(slot)].list);
}

}  // namespace stoss::engine

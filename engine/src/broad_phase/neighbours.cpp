// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/neighbours.hpp"

#include <algorithm>

namespace stoss::engine {

// Makes found_ the list of `slot` and keeps the lists of its old and new neighbours symmetric.
void Neighbours::replace_list(Slot slot) {
  Entry& entry = entries_[index(slot)];
  stamp_ += 2;
  if (stamp_ < 2) {  // wrapped: old marks must not look new
    for (Entry& e : entries_) e.mark = 0;
    stamp_ = 2;
  }
  const std::uint32_t was_neighbour = stamp_;
  const std::uint32_t still_neighbour = stamp_ + 1;
  for (const Slot old : entry.list) entries_[index(old)].mark = was_neighbour;
  for (const Slot other : found_) {
    Entry& e = entries_[index(other)];
    if (e.mark != was_neighbour) e.list.push_back(slot);
    e.mark = still_neighbour;
  }
  for (const Slot old : entry.list) {
    Entry& e = entries_[index(old)];
    if (e.mark != was_neighbour) continue;
    const auto place = std::find(e.list.begin(), e.list.end(), slot);
    *place = e.list.back();
    e.list.pop_back();
  }
  entry.list.assign(found_.begin(), found_.end());
}

}  // namespace stoss::engine

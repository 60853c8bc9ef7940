// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/neighbours.hpp"

#include <algorithm>

namespace stoss::engine {

void ListPool::grow(PooledList& list, std::size_t wanted) {
  PooledList larger{0, list.size, list.room_class};
  while (room(larger) < wanted) larger.room_class = (larger.room_class + 1) & 31;
  auto& free = free_[larger.room_class];
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

double Neighbours::next_margin(Slot slot) const {
  constexpr double kGrow = 1.6;
  constexpr double kShrink = 0.8;
  // A search costs about as much as this many looks at a neighbour. Chosen; within a factor of two
  // it hardly matters. Of many neighbours most stay whatever the margin is, as those of a disk
  // among far smaller ones, and each costs a search as much as two looks.
  constexpr double kSearchWork = 40;
  constexpr double kFew = 32;
  constexpr double kFoundWork = 2;
  const Place& place = grid_.place(slot);
  const double beyond = std::max(0.0, static_cast<double>(place.list.size) - kFew);
  const double search = kSearchWork + kFoundWork * beyond;
  constexpr double kWorkMax = 0xffff;  // that is kept
  if (place.work < std::min(0.5 * search, kWorkMax)) return place.margin * kGrow;
  if (place.work > 2.0 * search) return place.margin * kShrink;
  return place.margin;
}

namespace {

// Beyond 10^54 m the low words of a place are beyond a float. There the padding of the box, 8e-16
// (of a wall's 4e-16) of its coordinates, stands for them: twice what was dropped joins the margin,
// so that a body does not seem to have left its box when it has just been made.
void drop_low_words_beyond_float(Place& place) {
  if (std::isfinite(place.x_low) && std::isfinite(place.y_low)) return;
  const double part = place.role == Role::Wall ? 2.5e-16 : 5e-16;
  place.x_low = 0;
  place.y_low = 0;
  place.margin += part * std::max(std::abs(place.x), std::abs(place.y));
}

}  // namespace

// Makes found_ the neighbours of `slot` in place of before_, in all lists. No mark is left.
void Neighbours::replace_neighbours(Slot slot) {
  Place& own = grid_.place(slot);
  drop_low_words_beyond_float(own);
  for (const Slot old : before_) grid_.place(old).is_marked = true;
  for (const Slot other : found_) {
    Place& place = grid_.place(other);
    if (place.keeps_list()) {
      // Of a body without a list, before_ may hold more than its neighbours.
      if (place.is_marked && !own.keeps_list()) pool_.erase(place.list, slot);
      if (!place.is_marked || !own.keeps_list()) pool_.push(place.list, slot);
    }
    place.is_marked = false;
  }
  for (const Slot old : before_) {
    Place& place = grid_.place(old);
    if (!place.is_marked) continue;
    place.is_marked = false;
    if (place.keeps_list()) pool_.erase(place.list, slot);
  }
  if (own.keeps_list()) pool_.assign(own.list, found_);
}

// Takes a body whose box is out from all lists.
void Neighbours::forget(Slot slot) {
  found_.clear();
  replace_neighbours(slot);
  pool_.release(grid_.place(slot).list);
}

}  // namespace stoss::engine

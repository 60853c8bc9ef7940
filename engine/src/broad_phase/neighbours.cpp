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
  const double beyond = std::max(0.0, static_cast<double>(lists_[index(slot)].size) - kFew);
  const double search = kSearchWork + kFoundWork * beyond;
  constexpr double kWorkMax = 0xffff;  // that is kept
  if (place.work < std::min(0.5 * search, kWorkMax)) return place.margin * kGrow;
  if (place.work > 2.0 * search) return place.margin * kShrink;
  return place.margin;
}

Aabb Neighbours::put_in(Slot slot,
                        Role role,
                        const Aabb& tight,
                        const Glance& here,
                        const Margin& margin,
                        bool in_cells) {
  Tag& tag = tags_[index(slot)];
  tag.role = role;
  grid_.place(slot).work = 0;
  if (role == Role::Wall) return stand_in_tree(slot, tight, here, margin.wanted);
  if (in_cells) {
    if (const auto box = stand_in_cell(slot, tight, margin.least)) return *box;
  }
  tag.flown = kFar;
  return stand_in_grid(slot, tight, here, margin.wanted);
}

Aabb Neighbours::stand_in_tree(Slot slot, const Aabb& tight, const Glance& here, double margin) {
  Place& place = grid_.place(slot);
  place.x = here.x + here.x_low;
  place.y = here.y + here.y_low;
  place.margin = margin;
  place.half = Extent::padded(margin, std::max(std::abs(place.x), std::abs(place.y)));
  place.set_low((here.x - place.x) + here.x_low, (here.y - place.y) + here.y_low);
  const Aabb box = grown(tight, margin);
  tree_.insert(slot, box);
  return box;
}

Aabb Neighbours::stand_in_grid(Slot slot, const Aabb& tight, const Glance& here, double margin) {
  Place& place = grid_.place(slot);
  grid_.insert(slot, tight, margin);
  place.set_low((here.x - place.x) + here.x_low, (here.y - place.y) + here.y_low);
  return grown(tight, margin);
}

std::optional<Aabb> Neighbours::stand_in_cell(Slot slot, const Aabb& tight, double least) {
  const Extent extent(tight);
  const double radius = std::max(extent.half_x, extent.half_y);
  const auto cage = cells_.enter(slot, extent.x, extent.y, radius, least);
  if (!cage) return std::nullopt;
  return box_in(*cage, slot, extent);
}

// Where the disk may be while it stays in its cage.
Aabb Neighbours::box_in(const DiskCells::Cage& cage, Slot slot, const Extent& tight) {
  Place& place = grid_.place(slot);
  place.x = cage.x;
  place.y = cage.y;
  place.margin = cage.half;
  const double half = cage.half + std::max(tight.half_x, tight.half_y);
  place.half = Extent::padded(half, std::max(std::abs(place.x), std::abs(place.y)));
  place.set_low(0, 0);
  return {place.x - half, place.y - half, place.x + half, place.y + half};
}

void Neighbours::take_out(Slot slot) {
  if (cells_.contains(slot)) {
    cells_.leave(slot);
  } else if (grid_.contains(slot)) {
    grid_.remove(slot);
  } else {
    tree_.remove(slot);
  }
}

// Makes found_ the neighbours of `slot` in place of before_, in all lists. What has not changed is
// not looked at. No mark is left.
void Neighbours::replace_neighbours(Slot slot) {
  const bool keeps = keeps_list(slot);
  for (const Slot old : before_) tags_[index(old)].is_marked = true;
  for (const Slot other : found_) {
    const bool was_there = std::exchange(tags_[index(other)].is_marked, false);
    if (!keeps_list(other) || (was_there && keeps)) continue;
    PooledList& list = lists_[index(other)];
    // Of a body without a list, before_ may hold more than its neighbours.
    if (was_there) pool_.erase(list, slot);
    pool_.push(list, slot);
  }
  for (const Slot old : before_) {
    if (!std::exchange(tags_[index(old)].is_marked, false)) continue;
    if (keeps_list(old)) pool_.erase(lists_[index(old)], slot);
  }
  if (keeps) pool_.assign(lists_[index(slot)], found_);
}

// Takes a body whose box is out from all lists.
void Neighbours::forget(Slot slot) {
  found_.clear();
  replace_neighbours(slot);
  pool_.release(lists_[index(slot)]);
}

}  // namespace stoss::engine

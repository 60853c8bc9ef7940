// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/neighbours.hpp"

#include <algorithm>

namespace stoss::engine {

double Neighbours::next_margin(Slot slot) const {
  constexpr double kGrow = 1.6;
  constexpr double kShrink = 0.8;
  if (cells_.contains_known(slot)) return kGrow * cells_.cage_of(slot).half;
  const Place& here = place(slot);
  const double search = work_of_search(slot);
  const double spent = spent_on_margin(here);
  if (spent < 0.5 * search && here.work < kWorkMax) return here.margin * kGrow;
  if (spent > kTooMuch * search) return here.margin * kShrink;
  return here.margin;
}

void Neighbours::put_in(Slot slot,
                        Role role,
                        const Aabb& tight,
                        const Glance& here,
                        const Margin& margin,
                        bool in_cells) {
  Standing& standing = standing_[index(slot)];
  standing.role = role;
  if (in_cells) {
    const Extent extent(tight);
    const double radius = std::max(extent.half_x, extent.half_y);
    if (cells_.enter(slot, extent.x, extent.y, radius, margin.least)) return;
  }
  if (role == Role::Wall) {
    stand_in_tree(slot, tight, here, margin.wanted);
  } else {
    standing.flown = kFar;
    stand_in_grid(slot, tight, here, margin.wanted);
  }
  cells_.note_bystander(box_of(slot));
}

void Neighbours::stand_in_tree(Slot slot, const Aabb& tight, const Glance& here, double margin) {
  const std::int32_t line = grid_.places().make(slot);
  cells_.keep_for(slot, line);
  Place& entering = grid_.places().of(line);
  entering.x = here.x + here.x_low;
  entering.y = here.y + here.y_low;
  entering.margin = margin;
  entering.half = Extent::padded(margin, std::max(std::abs(entering.x), std::abs(entering.y)));
  entering.set_low((here.x - entering.x) + here.x_low, (here.y - entering.y) + here.y_low);
  entering.leaf = tree_.insert(slot, grown(tight, margin));
}

void Neighbours::stand_in_grid(Slot slot, const Aabb& tight, const Glance& here, double margin) {
  cells_.keep_for(slot, grid_.insert(slot, tight, margin));
  Place& entered = place(slot);
  entered.set_low((here.x - entered.x) + here.x_low, (here.y - entered.y) + here.y_low);
}

void Neighbours::take_out(Slot slot) {
  if (cells_.contains_known(slot)) {
    cells_.leave(slot);
    return;
  }
  cells_.note_bystander(box_of(slot));
  const std::int32_t line = cells_.kept_for(slot);
  const std::int32_t leaf = place(slot).leaf;
  if (leaf == kNone) {
    grid_.remove(line);
  } else {
    tree_.remove(leaf);
    grid_.places().drop(line);
  }
  cells_.keep_for(slot, kNone);
}

// Makes found_ the neighbours of `slot` in place of before_, in all lists. What has not changed is
// not looked at. No mark is left.
void Neighbours::replace_neighbours(Slot slot) {
  const bool keeps = keeps_list(slot);
  for (const Slot old : before_) standing_[index(old)].is_marked = true;
  for (const Slot other : found_) {
    const bool was_there = std::exchange(standing_[index(other)].is_marked, false);
    if (!keeps_list(other) || (was_there && keeps)) continue;
    PooledList& list = standing_[index(other)].list;
    // Of a body without a list, before_ may hold more than its neighbours.
    if (was_there) pool_.erase(list, slot);
    pool_.push(list, slot);
  }
  for (const Slot old : before_) {
    if (!std::exchange(standing_[index(old)].is_marked, false)) continue;
    if (keeps_list(old)) pool_.erase(standing_[index(old)].list, slot);
  }
  if (keeps) pool_.assign(standing_[index(slot)].list, found_);
}

void Neighbours::pack_lists() {
  pool_.pack([this](const auto& visit) {
    for (Standing& standing : standing_) visit(standing.list);
  });
}

// Takes a body whose box is out from all lists.
void Neighbours::forget(Slot slot) {
  found_.clear();
  replace_neighbours(slot);
  pool_.release(standing_[index(slot)].list);
}

}  // namespace stoss::engine

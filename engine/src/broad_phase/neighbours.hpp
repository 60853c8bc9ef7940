// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which bodies may meet before one of them leaves its box.
//
// Every body has a box around where it was when the box was made, larger by a margin. Two bodies
// whose boxes overlap are neighbours. A box stays valid, whatever the body does inside it, until
// the body's displacement reaches the margin; then the body renews it. So collisions cost no
// search.
//
// The margin follows the work: a body that renews more often than it predicts gets a larger one, so
// that a lone flyer's renewals become geometric in distance; a crowded one gets a smaller one.
//
// Disks stand in a grid, walls, which may be a thousand times longer than any of them, in a tree.
// Bodies that are no dynamic disks keep no lists: a wall may have thousands of neighbours and is
// asked for them only when it is commanded. They are searched for then.
//
// Source: near-neighbour lists with per-body updates, Donev, Torquato, Stillinger, J. Comput. Phys.
// 202 (2005) 737. Deviation: boxes in a hierarchical grid, adaptive margins.
//
// Invariant: a body that keeps a list has every neighbour in it. No bit of a result depends on
// boxes, margins or the order of lists.

#include "body.hpp"
#include "broad_phase/aabb_tree.hpp"
#include "broad_phase/box_grid.hpp"
#include "broad_phase/list_pool.hpp"
#include "broad_phase/place.hpp"
#include "prefetch.hpp"
#include "screen.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace stoss::engine {

/// The copies of a box to look for: in open space itself.
struct NoCopies {
  template <class Visit>
  void operator()(const Aabb& box, const Visit& visit) const {
    visit(box);
  }
};

class Neighbours {
 public:
  /// A place in two words along each axis, m: far from the origin the difference of two needs it.
  struct Anchor {
    double x = 0;
    double y = 0;
    double x_low = 0;
    double y_low = 0;
  };

  /// REQUIRES: of a dynamic disk.
  std::span<const Slot> of(Slot slot) const { return pool_.items(grid_.place(slot).list); }
  /// Asks for what of() and anchor() will read.
  void prefetch_place(Slot slot) const { prefetch(&grid_.place(slot)); }
  /// Asks for the list itself; its place should have come.
  void prefetch_list(Slot slot) const { prefetch(of(slot).data()); }
  double margin(Slot slot) const { return grid_.place(slot).margin; }
  /// Where the body was when its box was made; in a periodic world, its image in the box.
  Anchor anchor(Slot slot) const {
    const Place& place = grid_.place(slot);
    return {place.x, place.y, static_cast<double>(place.x_low), static_cast<double>(place.y_low)};
  }
  Aabb box_of(Slot slot) const {
    const Place& place = grid_.place(slot);
    return place.role == Role::Wall ? tree_.box_of(slot) : place.box();
  }

  /// Makes the box of a body afresh: `tight` is its extent and `here` its place now.
  /// `interacts(slot)` says whether the body can meet another whose box overlaps.
  /// `copies(box, visit)` calls visit for the box and for its images in a periodic world.
  template <class Interacts, class Copies = NoCopies>
  void renew(Slot slot,
             Role role,
             const Aabb& tight,
             const Glance& here,
             double margin,
             const Interacts& interacts,
             const Copies& copies = {}) {
    grid_.reserve(slot);
    take_out(slot, copies);
    Place& place = grid_.place(slot);
    place.role = role;
    place.work = 0;
    const Aabb box = grown(tight, margin);
    if (role == Role::Wall) {
      place.x = here.x + here.x_low;
      place.y = here.y + here.y_low;
      place.margin = margin;
      tree_.insert(slot, box);
    } else {
      grid_.insert(slot, tight, margin);
    }
    place.x_low = static_cast<float>((here.x - place.x) + here.x_low);
    place.y_low = static_cast<float>((here.y - place.y) + here.y_low);
    find(slot, box, interacts, copies);
    replace_neighbours(slot);
  }

  template <class Copies = NoCopies>
  void remove(Slot slot, const Copies& copies = {}) {
    take_out(slot, copies);
    forget(slot);
  }

  /// Notes predictions made for a body since its last renewal.
  void note_work(Slot slot) {
    Place& place = grid_.place(slot);
    const std::uint32_t work = place.work + place.list.size;
    place.work = static_cast<std::uint16_t>(std::min(work, std::uint32_t{0xffff}));
  }

  /// The margin to renew with, m, so that searching and predicting cost about the same.
  double next_margin(Slot slot) const;

  /// Calls visit(slot) for every body whose box overlaps `box`. `visit` may search itself.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    std::vector<Slot> found = std::exchange(spare_, {});
    const auto in_grid = grid_.find(box);
    found.assign(in_grid.begin(), in_grid.end());
    for (const Slot slot : found) visit(slot);
    spare_ = std::move(found);
    tree_.query(box, visit);
  }

 private:
  static void keep_each_once(std::vector<Slot>& slots) {
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  }

  // Whom the body has as neighbours with the box that it has now: found_.
  template <class Interacts, class Copies>
  void find(Slot slot, const Aabb& box, const Interacts& interacts, const Copies& copies) {
    const Place& own = grid_.place(slot);
    found_.clear();
    copies(box, [&](const Aabb& copy) {
      for (const Slot other : grid_.find(copy)) {
        const bool are_dynamic = own.keeps_list() && grid_.place(other).keeps_list();
        if (are_dynamic ? other != slot : interacts(other)) found_.push_back(other);
      }
      tree_.query(copy, [&](Slot other) {
        if (interacts(other)) found_.push_back(other);
      });
    });
    if constexpr (!std::is_same_v<Copies, NoCopies>) keep_each_once(found_);
  }

  // Takes the box of a body out, if it has one, and remembers in before_ whom it has as neighbours.
  template <class Copies>
  void take_out(Slot slot, const Copies& copies) {
    before_.clear();
    const bool in_grid = grid_.contains(slot);
    if (!in_grid && !tree_.contains(slot)) return;
    if (grid_.place(slot).keeps_list()) {
      before_.assign(of(slot).begin(), of(slot).end());
    } else {
      copies(box_of(slot), [this](const Aabb& copy) {
        for (const Slot other : grid_.find(copy)) {
          if (grid_.place(other).keeps_list()) before_.push_back(other);
        }
      });
      if constexpr (!std::is_same_v<Copies, NoCopies>) keep_each_once(before_);
    }
    if (in_grid) {
      grid_.remove(slot);
    } else {
      tree_.remove(slot);
    }
  }
  void forget(Slot slot);
  void replace_neighbours(Slot slot);

  BoxGrid grid_;  // of disks, and the places of all bodies
  AabbTree tree_;
  ListPool pool_;
  std::vector<Slot> before_;  // whom a body without a list had as neighbours, and a few more
  std::vector<Slot> found_;
  mutable std::vector<Slot> spare_;  // its memory is used again
};

}  // namespace stoss::engine

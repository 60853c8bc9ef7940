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
#include "prefetch.hpp"
#include "screen.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace stoss::engine {

/// What a body is to the broad phase.
enum class Role : std::uint8_t { Wall, FixedDisk, DynamicDisk };
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
  std::span<const Slot> of(Slot slot) const { return pool_.items(entries_[index(slot)].list); }
  /// Asks for what of() and anchor() will read.
  void prefetch_entry(Slot slot) const { prefetch(&entries_[index(slot)]); }
  double margin(Slot slot) const { return entries_[index(slot)].margin; }
  /// Where the body was when its box was made.
  const Anchor& anchor(Slot slot) const { return entries_[index(slot)].anchor; }
  const Aabb& box_of(Slot slot) const {
    return entries_[index(slot)].role == Role::Wall ? tree_.box_of(slot) : grid_.box_of(slot);
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
    reserve(slot);
    Entry& entry = entries_[index(slot)];
    take_out(slot, copies);
    entry.role = role;
    entry.margin = margin;
    entry.anchor = {here.x, here.y, here.x_low, here.y_low};
    entry.work = 0;
    const Aabb box = grown(tight, margin);
    if (role == Role::Wall) {
      tree_.insert(slot, box);
    } else {
      grid_.insert(slot, box);
    }
    found_.clear();
    copies(box, [&](const Aabb& copy) {
      query(copy, [&](Slot other) {
        if (!interacts(other)) return;
        prefetch(&entries_[index(other)]);
        found_.push_back(other);
      });
    });
    if constexpr (!std::is_same_v<Copies, NoCopies>) keep_each_once(found_);
    replace_neighbours(slot);
  }

  template <class Copies = NoCopies>
  void remove(Slot slot, const Copies& copies = {}) {
    take_out(slot, copies);
    forget(slot);
  }

  /// Notes predictions made for a body since its last renewal.
  void note_work(Slot slot) {
    Entry& entry = entries_[index(slot)];
    entry.work += entry.list.size;
  }

  /// The margin to renew with, so that searching and predicting cost about the same.
  double next_margin(Slot slot) const {
    constexpr double kGrow = 1.6;
    constexpr double kShrink = 0.8;
    // A search costs about as much as this many predictions, and more for every neighbour found.
    constexpr double kSearchWork = 24;
    constexpr double kFoundWork = 2;
    const Entry& entry = entries_[index(slot)];
    const double search = kSearchWork + kFoundWork * static_cast<double>(entry.list.size);
    if (entry.work < 0.5 * search) return entry.margin * kGrow;
    if (entry.work > 2.0 * search) return entry.margin * kShrink;
    return entry.margin;
  }

  /// Calls visit(slot) for every body whose box overlaps `box`.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    grid_.query(box, visit);
    tree_.query(box, visit);
  }

 private:
  struct alignas(64) Entry {
    Anchor anchor;
    double margin = 0;
    PooledList list;
    std::uint32_t work = 0;
    std::uint32_t mark = 0;
    Role role = Role::DynamicDisk;
    bool keeps_list() const { return role == Role::DynamicDisk; }
  };

  static std::size_t index(Slot slot) { return static_cast<std::size_t>(slot); }
  void reserve(Slot slot) {
    if (index(slot) >= entries_.size()) entries_.resize(index(slot) + 1);
  }
  static void keep_each_once(std::vector<Slot>& slots) {
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  }

  // Takes the box of a body out, if it has one, and remembers in before_ whom it has as neighbours.
  template <class Copies>
  void take_out(Slot slot, const Copies& copies) {
    const Entry& entry = entries_[index(slot)];
    before_.clear();
    const bool in_tree = tree_.contains(slot);
    if (!in_tree && !grid_.contains(slot)) return;
    if (entry.keeps_list()) {
      before_.assign(of(slot).begin(), of(slot).end());
    } else {
      copies(box_of(slot), [this](const Aabb& copy) {
        query(copy, [this](Slot other) {
          if (entries_[index(other)].keeps_list()) before_.push_back(other);
        });
      });
      if constexpr (!std::is_same_v<Copies, NoCopies>) keep_each_once(before_);
    }
    if (in_tree) {
      tree_.remove(slot);
    } else {
      grid_.remove(slot);
    }
  }
  void forget(Slot slot);
  void replace_neighbours(Slot slot);
  std::uint32_t next_stamp();

  BoxGrid grid_;
  AabbTree tree_;
  std::vector<Entry> entries_;
  ListPool pool_;
  std::vector<Slot> before_;  // whom a body without a list had as neighbours, and a few more
  std::vector<Slot> found_;
  std::uint32_t stamp_ = 0;
};

}  // namespace stoss::engine

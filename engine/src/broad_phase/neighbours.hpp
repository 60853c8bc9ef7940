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
// Source: near-neighbour lists with per-body updates, Donev, Torquato, Stillinger, J. Comput. Phys.
// 202 (2005) 737. Deviation: boxes in a dynamic tree instead of cells, adaptive margins.
//
// Invariant: lists are symmetric. No bit of a result depends on boxes, margins or the order of
// lists.

#include "body.hpp"
#include "broad_phase/aabb_tree.hpp"
#include "screen.hpp"

#include <cstdint>
#include <vector>

namespace stoss::engine {

class Neighbours {
 public:
  const std::vector<Slot>& of(Slot slot) const { return entries_[index(slot)].list; }
  double margin(Slot slot) const { return entries_[index(slot)].margin; }

  /// Makes the box of a body afresh: `tight` is its extent and `here` its place now.
  /// `interacts(slot)` says whether the body can meet another whose box overlaps.
  template <class Interacts>
  void renew(
      Slot slot, const Aabb& tight, const Glance& here, double margin, const Interacts& interacts) {
    reserve(slot);
    Entry& entry = entries_[index(slot)];
    if (tree_.contains(slot)) tree_.remove(slot);
    entry.margin = margin;
    entry.anchor = here;
    entry.work = 0;
    const Aabb box = grown(tight, margin);
    found_.clear();
    tree_.query(box, [&](Slot other) {
      if (interacts(other)) found_.push_back(other);
    });
    tree_.insert(slot, box);
    replace_list(slot);
  }

  void remove(Slot slot) {
    tree_.remove(slot);
    found_.clear();
    replace_list(slot);
  }

  /// Notes predictions made for a body since its last renewal.
  void note_work(Slot slot) {
    Entry& entry = entries_[index(slot)];
    entry.work += static_cast<std::uint32_t>(entry.list.size());
  }

  /// The margin to renew with, so that searching and predicting cost about the same.
  double next_margin(Slot slot) const {
    constexpr double kGrow = 1.6;
    constexpr double kShrink = 0.8;
    // A search costs about as much as this many predictions, and more for every neighbour found.
    constexpr double kSearchWork = 24;
    constexpr double kFoundWork = 2;
    const Entry& entry = entries_[index(slot)];
    const double search = kSearchWork + kFoundWork * static_cast<double>(entry.list.size());
    if (entry.work < 0.5 * search) return entry.margin * kGrow;
    if (entry.work > 2.0 * search) return entry.margin * kShrink;
    return entry.margin;
  }

  /// Where the body was when its box was made.
  const Glance& anchor(Slot slot) const { return entries_[index(slot)].anchor; }

  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    tree_.query(box, visit);
  }

 private:
  struct Entry {
    std::vector<Slot> list;
    Glance anchor;
    double margin = 0;
    std::uint32_t work = 0;
    std::uint32_t mark = 0;
  };

  static std::size_t index(Slot slot) { return static_cast<std::size_t>(slot); }
  void reserve(Slot slot) {
    if (index(slot) >= entries_.size()) entries_.resize(index(slot) + 1);
  }
  void replace_list(Slot slot);

  AabbTree tree_;
  std::vector<Entry> entries_;
  std::vector<Slot> found_;
  std::uint32_t stamp_ = 0;
};

}  // namespace stoss::engine

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
// Most moving disks stand in cells with others of their size, and know each other from there
// (disk_cells.hpp); their boxes are what their cages reach. The lists hold all other neighbours:
// walls, fixed disks, and disks of another size. A disk that flies far undisturbed leaves the cells
// for a box with a margin.
//
// Other disks stand in a grid, walls, which may be a thousand times longer than any, in a tree.
// Bodies that are no dynamic disks keep no lists: a wall may have thousands of neighbours and is
// asked for them only when it is commanded. They are searched for then.
//
// Source: near-neighbour lists with per-body updates, Donev, Torquato, Stillinger, J. Comput. Phys.
// 202 (2005) 737. Deviation: boxes in a hierarchical grid, adaptive margins.
//
// Invariant: a body that keeps a list has every neighbour in it that it does not know from cells.
// No bit of a result depends on boxes, margins or the order of lists.

#include "body.hpp"
#include "broad_phase/aabb_tree.hpp"
#include "broad_phase/box_grid.hpp"
#include "broad_phase/disk_cells.hpp"
#include "broad_phase/list_pool.hpp"
#include "broad_phase/place.hpp"
#include "grow.hpp"
#include "prefetch.hpp"
#include "screen.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
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

/// How much larger a box shall be than its body, m.
struct Margin {
  double wanted = 0;
  double least = 0;                 ///< that leaves the body time to cross it
  bool may_stand_in_cells = false;  ///< of a dynamic disk whose radius stays: wanted or not
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

  /// So many slots are to come.
  void make_room(std::size_t slots) {
    standing_.reserve(slots);
    cells_.make_room(slots);
  }

  /// All neighbours of a dynamic disk, followed in memory by three or more slots, whichever. Valid
  /// until it was called for two others, or a box is renewed.
  std::span<const Slot> of(Slot slot) const {
    for (const Gathered& gathered : gathered_) {
      if (gathered.slot == slot && gathered.renewals == renewals_) return gathered.span();
    }
    Gathered& oldest = gathered_[next_gathered_];
    next_gathered_ = 1 - next_gathered_;
    const auto list = list_of(slot);
    Slot* to = std::copy(list.begin(), list.end(), room_in(oldest, list.size()));
    if (cells_.contains_known(slot)) to = cells_.collect_around(slot, to);
    oldest.renewals = renewals_;
    return ended(oldest, slot, to);
  }
  /// Calls visit(other) for each of them; `visit` may ask for neighbours itself, but renews none.
  template <class Visit>
  void for_each(Slot slot, const Visit& visit) const {
    std::vector<Slot> found = std::exchange(spare_, {});
    const auto all = of(slot);
    found.assign(all.begin(), all.end());
    for (const Slot other : found) visit(other);
    spare_ = std::move(found);
  }
  /// As of(): whom a disk that was brought to another cell by the last call of cross() has as
  /// neighbours now and had not before. Valid until the next call.
  std::span<const Slot> newcomers(Slot slot) const {
    Slot* to = cells_.collect_new_around(slot, last_step_, room_in(newcomers_, found_.size()));
    for (const Slot found : found_) {
      if (std::find(before_.begin(), before_.end(), found) == before_.end()) *to++ = found;
    }
    return ended(newcomers_, slot, to);
  }
  /// Asks for what the next two functions will read.
  void prefetch_standing(Slot slot) const {
    prefetch(&standing_[index(slot)]);
    cells_.prefetch_link(slot);
  }
  /// Asks for what leeway() will read, and of() of the place.
  void prefetch_place(Slot slot) const {
    if (cells_.contains_known(slot)) {
      cells_.prefetch_block(slot);
    } else {
      prefetch(&place(slot));
    }
  }
  /// Asks for the list itself; its place should have come.
  void prefetch_list(Slot slot) const {
    if (cells_.contains_known(slot)) cells_.prefetch_around(slot);
    pool_.prefetch_items(standing_[index(slot)].list);
  }
  /// And for what newcomers() will read, of a disk that is about to cross.
  void prefetch_beyond(Slot slot) const {
    if (cells_.contains_known(slot)) cells_.prefetch_beyond(slot);
  }
  /// A square of half side `margin`, m, that the body's place may leave before its box is renewed.
  struct Leeway {
    Anchor anchor;
    double margin = 0;
  };
  /// Around where the body was when its box was made (in a periodic world, its image in the box),
  /// or around the middle of its cell.
  Leeway leeway(Slot slot) const {
    if (cells_.contains_known(slot)) {
      const DiskCells::Cage cage = cells_.cage_of(slot);
      return {{cage.x, cage.y, 0, 0}, cage.half};
    }
    const Place& here = place(slot);
    return {{here.x, here.y, here.x_low(), here.y_low()}, here.margin};
  }
  Aabb box_of(Slot slot) const {
    if (cells_.contains_known(slot)) return cells_.box_of(slot);
    return box_of_place(place(slot));
  }

  /// Brings a disk that has come to the side of its cage, at (x, y) [m] by now, to the next cell.
  /// False, and nothing is done, where it should be renewed in another way. `interacts` as below.
  template <class Interacts>
  bool cross(Slot slot, double x, double y, const Interacts& interacts) {
    Standing& standing = standing_[index(slot)];
    if (!cells_.contains_known(slot) || standing.flown >= kFar) return false;
    const auto step = cells_.move(slot, x, y);
    // Where it stands still it is too fast for cells: it would have crossed at this very instant.
    if (!step || (step->dx == 0 && step->dy == 0)) return false;
    ++standing.flown;
    last_step_ = *step;
    ++renewals_;
    found_.clear();
    before_.clear();
    const auto list = list_of(slot);
    if (cells_.has_bystanders(slot, list)) return true;
    before_.assign(list.begin(), list.end());
    find_from_cell(slot, interacts);
    if (!found_.empty() || !before_.empty()) replace_neighbours(slot);
    return true;
  }

  /// Makes the box of a body afresh: `tight` is its extent and `here` its place now.
  /// `interacts(other, box)` says whether the body, somewhere in the box, can meet another whose
  /// box overlaps that.
  /// `copies(box, visit)` calls visit for the box and for its images in a periodic world.
  template <class Interacts, class Copies = NoCopies>
  void renew(Slot slot,
             Role role,
             const Aabb& tight,
             const Glance& here,
             const Margin& margin,
             const Interacts& interacts,
             const Copies& copies = {}) {
    make_line_of(index(slot), standing_);
    const bool was_known = remember_neighbours(slot, copies);
    const bool in_cells = role == Role::DynamicDisk && margin.may_stand_in_cells &&
                          (!was_known || suits_cells(slot, margin.wanted));
    if (was_known) take_out(slot);
    put_in(slot, role, tight, here, margin, in_cells);
    if (cells_.contains_known(slot)) {
      find_from_cell(slot, interacts);
    } else {
      find(slot, box_of(slot), interacts, copies);
    }
    replace_neighbours(slot);
    ++renewals_;
    if (pool_.is_mostly_free(standing_.size())) pack_lists();
  }

  /// A disk whose box had better be renewed now, to spare others work; -1: none.
  Slot straggler() { return cells_.straggler(); }

  template <class Copies = NoCopies>
  void remove(Slot slot, const Copies& copies = {}) {
    if (remember_neighbours(slot, copies)) take_out(slot);
    forget(slot);
    ++renewals_;
    if (pool_.is_mostly_free(standing_.size())) pack_lists();
  }

  /// Notes that a body's motion has changed.
  void note_event(Slot slot) { standing_[index(slot)].flown = 0; }
  /// Notes predictions made for a body since its last renewal.
  void note_work(Slot slot) {
    if (cells_.contains_known(slot)) return;
    Place& here = place(slot);
    here.work = std::min(here.work + pool_.size(standing_[index(slot)].list), kWorkMax);
  }

  /// Has a body without a cell so many neighbours because of its margin that its box had better be
  /// renewed at once?
  bool is_overworked(Slot slot) const {
    return !cells_.contains_known(slot) &&
           spent_on_margin(place(slot)) > kTooMuch * work_of_search(slot);
  }
  /// The margin to renew with, m, so that searching and predicting cost about the same.
  double next_margin(Slot slot) const;

  /// Calls visit(slot) for every body whose box overlaps `box`. `visit` may search itself.
  template <class Visit>
  void query(const Aabb& box, Visit&& visit) const {
    std::vector<Slot> found = std::exchange(spare_, {});
    const auto in_grid = grid_.find(box);
    found.assign(in_grid.begin(), in_grid.end());
    cells_.find(box, DiskCells::kNoLevel, [&](Slot slot) { found.push_back(slot); });
    for (const Slot slot : found) visit(slot);
    spare_ = std::move(found);
    tree_.query(box, visit);
  }

 private:
  /// Of each body.
  struct Standing {
    PooledList list;
    Role role = Role::Wall;
    bool is_marked = false;
    std::uint8_t flown = 0;  ///< cells that it has crossed to since it last had an event, or kFar
  };
  static_assert(sizeof(Standing) == 8);

  /// Cells; chosen: a disk that flies farther without an event is in nobody's way.
  static constexpr std::uint8_t kFar = 24;
  static constexpr std::int32_t kNone = CellStore::kNone;
  static constexpr std::uint32_t kWorkMax = 1U << 30;
  /// Of the work of a search: as much for a margin is too much.
  static constexpr double kTooMuch = 2;

  /// A search in looks at a neighbour: so many, and for each that it finds this part of one.
  /// Measured; within a factor of two it hardly matters.
  double work_of_search(Slot slot) const {
    constexpr double kSearchWork = 30;
    constexpr double kFoundWork = 0.5;
    return kSearchWork + kFoundWork * pool_.size(standing_[index(slot)].list);
  }
  /// The looks at neighbours that are some because of the margin: the part by which the box grows
  /// with it. A disk among far smaller ones has most of its neighbours anyway.
  static double spent_on_margin(const Place& place) {
    return std::min(1.0, 2 * place.margin / place.half) * place.work;
  }

  static std::size_t index(Slot slot) { return static_cast<std::size_t>(slot); }
  bool keeps_list(Slot slot) const { return standing_[index(slot)].role == Role::DynamicDisk; }
  static void keep_each_once(std::vector<Slot>& slots) {
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  }

  [[gnu::always_inline]] std::span<const Slot> list_of(Slot slot) const {
    return pool_.items(standing_[index(slot)].list);
  }
  std::optional<DiskCells::Cell> cell_of(Slot slot) const {
    if (!cells_.contains_known(slot)) return std::nullopt;
    return cells_.cell_of(slot);
  }
  /// Neighbours in one piece of memory.
  struct Gathered {
    Slot slot = -1;  ///< whose; -1: nobody's
    std::uint64_t renewals = 0;
    std::size_t size = 0;
    std::vector<Slot> slots;
    std::span<const Slot> span() const { return {slots.data(), size}; }
  };
  // Memory for so many bodies, those of the cells around one, and a little more.
  Slot* room_in(Gathered& gathered, std::size_t listed) const {
    const std::size_t wanted = listed + cells_.around_max() + 4;
    if (gathered.slots.size() < wanted) gathered.slots.resize(2 * wanted);
    return gathered.slots.data();
  }
  // What was written there, ended with some slots.
  static std::span<const Slot> ended(Gathered& gathered, Slot slot, Slot* to) {
    std::fill_n(to, 3, slot);
    gathered.slot = slot;
    gathered.size = static_cast<std::size_t>(to - gathered.slots.data());
    return gathered.span();
  }
  // Whoever flies far without an event gets a box that grows, so that it is brought on the less
  // often the farther it flies; until it has had one again, or too many to look at.
  bool suits_cells(Slot slot, double wanted) {
    const Standing& standing = standing_[index(slot)];
    if (cells_.contains_known(slot)) return standing.flown < kFar;
    return standing.flown == 0 || wanted < place(slot).margin;
  }
  void put_in(Slot slot,
              Role role,
              const Aabb& tight,
              const Glance& here,
              const Margin& margin,
              bool in_cells);
  void stand_in_tree(Slot slot, const Aabb& tight, const Glance& here, double margin);
  void stand_in_grid(Slot slot, const Aabb& tight, const Glance& here, double margin);
  /// Of a body in no cell.
  Place& place(Slot slot) { return grid_.places().of(cells_.kept_for(slot)); }
  const Place& place(Slot slot) const { return grid_.places().of(cells_.kept_for(slot)); }

  Aabb box_of_place(const Place& place) const {
    return place.leaf != kNone ? tree_.box_of(place.leaf) : place.box();
  }

  /// Bodies that stand in no cell, to the cells.
  template <class Interacts>
  struct InNoCell {
    const Neighbours& all;
    const Interacts& interacts;
    void find(const Aabb& area, std::vector<Slot>& found) const {
      for (const Slot other : all.grid_.find(area)) found.push_back(other);
      all.tree_.query(area, [&](Slot other) { found.push_back(other); });
    }
    Aabb box_of(Slot body) const { return all.box_of_place(all.place(body)); }
    /// A wall's box may be wide where the wall is not; that of a disk says all.
    bool may_come_to(Slot body, const Aabb& box) const {
      return all.standing_[index(body)].role != Role::Wall || interacts(body, box);
    }
  };

  // Whom a disk in a cell has as neighbours, but for those whom it knows from the cells: found_.
  template <class Interacts>
  void find_from_cell(Slot slot, const Interacts& interacts) {
    found_.clear();
    const bool is_told = cells_.for_each_bystander(slot,
                                                   InNoCell<Interacts>{*this, interacts},
                                                   [this](Slot other) { found_.push_back(other); });
    if (!is_told) return find(slot, cells_.box_of(slot), interacts, NoCopies{});
    if (!cells_.has_other_levels()) return;
    cells_.find(cells_.box_of(slot), cells_.cell_of(slot).level, [this](Slot other) {
      found_.push_back(other);
    });
  }

  // Whom the body has as neighbours with the box that it has now, but for those whom it knows from
  // the cells: found_.
  template <class Interacts, class Copies>
  void find(Slot slot, const Aabb& box, const Interacts& interacts, const Copies& copies) {
    const bool is_dynamic = keeps_list(slot);
    const auto own_cell = cell_of(slot);
    found_.clear();
    const auto consider = [&](Slot other) {
      const bool both_dynamic = is_dynamic && keeps_list(other);
      if (both_dynamic ? other != slot : interacts(other, box)) found_.push_back(other);
    };
    copies(box, [&](const Aabb& copy) {
      for (const Slot other : grid_.find(copy)) consider(other);
      cells_.find(copy, own_cell ? own_cell->level : DiskCells::kNoLevel, consider);
      tree_.query(copy, [&](Slot other) {
        if (interacts(other, box)) found_.push_back(other);
      });
    });
    if constexpr (!std::is_same_v<Copies, NoCopies>) keep_each_once(found_);
  }

  // Remembers in before_ whom the body has in lists as neighbours. False if it has no box.
  template <class Copies>
  bool remember_neighbours(Slot slot, const Copies& copies) {
    before_.clear();
    if (!cells_.knows(slot)) return false;
    if (keeps_list(slot)) {
      before_.assign(list_of(slot).begin(), list_of(slot).end());
      return true;
    }
    const auto remember = [this](Slot other) {
      if (keeps_list(other)) before_.push_back(other);
    };
    copies(box_of(slot), [&](const Aabb& copy) {
      for (const Slot other : grid_.find(copy)) remember(other);
      cells_.find(copy, DiskCells::kNoLevel, remember);
    });
    if constexpr (!std::is_same_v<Copies, NoCopies>) keep_each_once(before_);
    return true;
  }
  void take_out(Slot slot);
  void forget(Slot slot);
  void replace_neighbours(Slot slot);
  void pack_lists();

  BoxGrid grid_;     // of disks; and the places of walls
  DiskCells cells_;  // of disks that are not in the grid; for others the lines of their places
  AabbTree tree_;
  std::vector<Standing> standing_;
  ListPool pool_;             // of the lists
  std::vector<Slot> before_;  // whom a body without a list had as neighbours, and a few more
  std::vector<Slot> found_;
  DiskCells::Step last_step_;        // of the disk that crossed last
  mutable std::vector<Slot> spare_;  // its memory is used again
  std::uint64_t renewals_ = 0;
  mutable std::array<Gathered, 2> gathered_;  // by the last calls of of()
  mutable std::size_t next_gathered_ = 0;
  mutable Gathered newcomers_;
};

}  // namespace stoss::engine

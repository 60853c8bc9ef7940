// SPDX-License-Identifier: Apache-2.0
#pragma once

// Slots whose events come much later, by stretches of time, in the order in which they were filed:
// whoever files one writes where somebody has just written, and nothing far away.
//
// Nothing is taken from the middle. Who is filed elsewhere leaves an entry behind that is out of
// date: the owner knows each slot's place, and an entry in any other place counts for nothing.
//
// Invariants: 1. but for a stretch's first page, all its pages are full; 2. a page is in one
// stretch, or free.

#include "grow.hpp"
#include "prefetch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stoss::engine {

class LaterEvents {
 public:
  /// From now on there are so many stretches. REQUIRES: all are empty.
  void set_stretches(std::size_t count) { stretches_.assign(count, {}); }
  std::size_t stretches() const { return stretches_.size(); }
  bool is_empty(std::size_t stretch) const { return stretches_[stretch].page == kNone; }

  /// Returns the slot's place.
  std::int32_t add(std::size_t stretch, std::int32_t slot) {
    Stretch& into = stretches_[stretch];
    if (into.used == kPerPage) begin_page(into);
    const std::int32_t at = into.used++;
    pages_[index(into.page)].slots[index(at)] = slot;
    return place_of(into.page, at);
  }

  /// Calls visit(slot, place) for all entries of a stretch, also those out of date. `visit` changes
  /// nothing here.
  template <class Visit>
  void for_each(std::size_t stretch, const Visit& visit) const {
    std::int32_t used = stretches_[stretch].used;
    for (std::int32_t page = stretches_[stretch].page; page != kNone; used = kPerPage) {
      for_each_of(pages_[index(page)], page, used, visit);
      page = pages_[index(page)].next;
    }
  }

  /// The same, and leaves the stretch empty; `visit` may add. announce(slot) is called a little
  /// before for each.
  template <class Announce, class Visit>
  void take_all(std::size_t stretch, const Announce& announce, const Visit& visit) {
    auto [page, used] = std::exchange(stretches_[stretch], {});
    announce_page(page, used, announce);
    for (; page != kNone; used = kPerPage) {
      const Page taken = pages_[index(page)];
      pages_[index(page)].next = std::exchange(free_, page);
      --pages_in_use_;
      announce_page(taken.next, kPerPage, announce);
      for_each_of(taken, page, used, visit);
      page = taken.next;
    }
  }

  void clear() {
    for (std::size_t stretch = 0; stretch < stretches_.size(); ++stretch) {
      take_all(
          stretch, [](std::int32_t) {}, [](std::int32_t, std::int32_t) {});
    }
  }

  /// Is the place the first of a page? The only ones for which more memory is in use than before.
  static bool begins_page(std::int32_t place) { return place % (kPerPage + 1) == 0; }
  /// Is there so much memory in use that most entries must be out of date, where so many slots have
  /// one that is not?
  bool is_wasteful(std::size_t slots) const {
    return pages_in_use_ > 2 * (slots / kPerPage) + 2 * stretches_.size();
  }
  /// At most, in memory that is in use.
  std::size_t entries_kept() const { return pages_in_use_ * kPerPage; }

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr std::int32_t kPerPage = 15;
  struct alignas(64) Page {
    std::int32_t next = kNone;  ///< of its stretch; of free ones
    std::array<std::int32_t, kPerPage> slots{};
  };
  struct Stretch {
    std::int32_t page = kNone;     ///< the first, which is being filled
    std::int32_t used = kPerPage;  ///< of that one
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::int32_t place_of(std::int32_t page, std::int32_t at) {
    return page * (kPerPage + 1) + at;
  }

  template <class Visit>
  static void for_each_of(const Page& page,
                          std::int32_t number,
                          std::int32_t used,
                          const Visit& visit) {
    for (std::int32_t at = 0; at < used; ++at) visit(page.slots[index(at)], place_of(number, at));
  }
  template <class Announce>
  void announce_page(std::int32_t page, std::int32_t used, const Announce& announce) const {
    if (page == kNone) return;
    const Page& next = pages_[index(page)];
    if (next.next != kNone) prefetch(&pages_[index(next.next)]);
    for (std::int32_t at = 0; at < used; ++at) announce(next.slots[index(at)]);
  }

  [[gnu::noinline]] void begin_page(Stretch& stretch) {
    std::int32_t page = free_;
    if (page == kNone) {
      page = static_cast<std::int32_t>(pages_.size());
      make_line_of(pages_.size(), pages_);
    } else {
      free_ = pages_[index(page)].next;
    }
    ++pages_in_use_;
    pages_[index(page)].next = stretch.page;
    stretch = {page, 0};
  }

  std::vector<Page> pages_;
  std::vector<Stretch> stretches_;
  std::int32_t free_ = kNone;  // the first that is
  std::size_t pages_in_use_ = 0;
};

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// How disks stand with zones: the physical state that a crossing flips. A place does not tell it,
// for on the rim rounding would tell it differently from one event to the next; nor does a disk's
// motion, for a crossing writes none. So each pair keeps which side the disk is on, and since when:
// its next crossing is looked for from there on.
//
// Invariants: 1. a pair without an entry is outside, and has been so since the later of the two
// motions began; 2. a disk's entries are in the order of zones; 3. entries are looked up by disk,
// never iterated over disks.

#include "body.hpp"
#include "periodic.hpp"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace stoss::engine {

/// A disk and a zone after a crossing, or inside from the beginning.
template <class S>
struct Passage {
  Id zone = kNoId;
  bool is_inside = false;
  Image image;  ///< of the zone, that the disk is inside of; else none
  Time<S> since;
};

template <class S>
class ZonePassages {
 public:
  /// In the order of zones.
  const std::vector<Passage<S>>& of(Slot disk) const {
    static const std::vector<Passage<S>> none;
    const auto found = of_disk_.find(disk);
    return found == of_disk_.end() ? none : found->second;
  }

  /// Null if there is none.
  const Passage<S>* find(Slot disk, Id zone) const {
    const std::vector<Passage<S>>& all = of(disk);
    const auto place = std::lower_bound(all.begin(), all.end(), zone, before);
    return place == all.end() || place->zone != zone ? nullptr : &*place;
  }

  void set(Slot disk, const Passage<S>& passage) {
    std::vector<Passage<S>>& all = of_disk_[disk];
    const auto place = std::lower_bound(all.begin(), all.end(), passage.zone, before);
    if (place == all.end() || place->zone != passage.zone) {
      all.insert(place, passage);
    } else {
      *place = passage;
    }
  }

  /// The disk's motion is written: where it is outside there is nothing left to know.
  void begin_motion(Slot disk, const Time<S>& instant) {
    if (of_disk_.empty()) return;
    const auto found = of_disk_.find(disk);
    if (found == of_disk_.end()) return;
    std::erase_if(found->second, [](const Passage<S>& p) { return !p.is_inside; });
    for (Passage<S>& passage : found->second) passage.since = instant;
    if (found->second.empty()) of_disk_.erase(found);
  }

  void forget_disk(Slot disk) { of_disk_.erase(disk); }

  /// False if the disk has nothing to do with the zone.
  bool forget_zone(Slot disk, Id zone) {
    const auto found = of_disk_.find(disk);
    if (found == of_disk_.end()) return false;
    const auto is_of_it = [zone](const Passage<S>& p) { return p.zone == zone; };
    const bool was_known = std::erase_if(found->second, is_of_it) > 0;
    if (found->second.empty()) of_disk_.erase(found);
    return was_known;
  }

 private:
  static bool before(const Passage<S>& passage, Id zone) { return passage.zone < zone; }

  std::unordered_map<Slot, std::vector<Passage<S>>> of_disk_;
};

/// Of a plain world, which knows no zones.
struct NoZonePassages {};

}  // namespace stoss::engine

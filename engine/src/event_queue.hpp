// SPDX-License-Identifier: Apache-2.0
#pragma once

// The future events, one a body: the earliest that the body knows of.
//
// A 4-ary heap of body slots. Events are ordered by (instant, kind, lower id, higher id); instants
// differ almost always, so ids are looked up on ties alone.
//
// Invariants: 1. place_[slot] is where the slot stands in heap_, or kAbsent; 2. no event stands
// above an earlier one.

#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stoss::engine {

/// What a body is scheduled for. Neighbours first: a renewal at an instant precedes its contacts.
enum class EventKind : std::uint8_t {
  NeighbourRenewal = 0,
  DiskDisk = 1,
  DiskWall = 2,
  DiskWallEnd = 3,
  LawChange = 4,  ///< of one body by itself: its stop, or the end of its slide
  Kick = 6,       ///< of one body by the thermostat
};

template <class S>
struct Event {
  Time<S> at = Time<S>::never();
  std::int32_t partner = -1;          ///< slot of the other body; -1: an event of one body alone
  std::uint32_t partner_changes = 0;  ///< the partner's count when this was predicted
  EventKind kind = EventKind::NeighbourRenewal;
  Id partner_id = kNoId;  ///< kept here: a slot may be given to another body while the event waits
};

/// The ids of an event's bodies, lower first.
struct IdPair {
  Id low = kNoId;
  Id high = kNoId;
  friend auto operator<=>(const IdPair&, const IdPair&) = default;
};

/// REQUIRES of Ids: `IdPair operator()(slot, const Event&) const`.
template <class S, class Ids>
bool earlier(const Event<S>& a,
             std::int32_t slot_a,
             const Event<S>& b,
             std::int32_t slot_b,
             const Ids& ids) {
  if (a.at != b.at) return a.at < b.at;
  if (a.kind != b.kind) return a.kind < b.kind;
  return ids(slot_a, a) < ids(slot_b, b);
}

template <class S>
class EventQueue {
 public:
  bool empty() const { return heap_.empty(); }
  /// REQUIRES: !empty()
  std::int32_t top() const { return heap_.front(); }
  const Event<S>& event_of(std::int32_t slot) const { return events_[index(slot)]; }

  /// Makes room for a slot, without an event.
  void admit(std::int32_t slot) {
    if (index(slot) < events_.size()) return;
    events_.resize(index(slot) + 1);
    place_.resize(index(slot) + 1, kAbsent);
  }

  /// Sets the event of a slot; one that never comes leaves the queue. REQUIRES: admitted.
  template <class Ids>
  void set(std::int32_t slot, const Event<S>& event, const Ids& ids) {
    if (event.at == Time<S>::never()) {
      erase(slot, ids);
      return;
    }
    std::int32_t place = place_[index(slot)];
    events_[index(slot)] = event;
    if (place == kAbsent) {
      place = static_cast<std::int32_t>(heap_.size());
      heap_.push_back(slot);
      place_[index(slot)] = place;
    }
    sift_down(sift_up(place, ids), ids);
  }

  template <class Ids>
  void erase(std::int32_t slot, const Ids& ids) {
    if (place_[index(slot)] == kAbsent) return;
    const std::int32_t hole = place_[index(slot)];
    place_[index(slot)] = kAbsent;
    events_[index(slot)] = Event<S>{};
    const std::int32_t last = heap_.back();
    heap_.pop_back();
    if (last == slot) return;
    heap_[index(hole)] = last;
    place_[index(last)] = hole;
    sift_down(sift_up(hole, ids), ids);
  }

 private:
  static constexpr std::int32_t kAbsent = -1;
  static constexpr std::int32_t kArity = 4;
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  template <class Ids>
  bool before(std::int32_t a, std::int32_t b, const Ids& ids) const {
    return earlier(events_[index(a)], a, events_[index(b)], b, ids);
  }

  void put(std::int32_t place, std::int32_t slot) {
    heap_[index(place)] = slot;
    place_[index(slot)] = place;
  }

  template <class Ids>
  std::int32_t sift_up(std::int32_t place, const Ids& ids) {
    const std::int32_t slot = heap_[index(place)];
    while (place > 0) {
      const std::int32_t parent = (place - 1) / kArity;
      if (!before(slot, heap_[index(parent)], ids)) break;
      put(place, heap_[index(parent)]);
      place = parent;
    }
    put(place, slot);
    return place;
  }

  template <class Ids>
  void sift_down(std::int32_t place, const Ids& ids) {
    const auto size = static_cast<std::int32_t>(heap_.size());
    const std::int32_t slot = heap_[index(place)];
    for (;;) {
      const std::int32_t first = kArity * place + 1;
      if (first >= size) break;
      const std::int32_t last = std::min(first + kArity, size);
      std::int32_t best = first;
      for (std::int32_t i = first + 1; i < last; ++i) {
        if (before(heap_[index(i)], heap_[index(best)], ids)) best = i;
      }
      if (!before(heap_[index(best)], slot, ids)) break;
      put(place, heap_[index(best)]);
      place = best;
    }
    put(place, slot);
  }

  std::vector<std::int32_t> heap_;
  std::vector<std::int32_t> place_;
  std::vector<Event<S>> events_;
};

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Collisions, or zone events, in their order without gaps, out of batches that may come late, twice
// or not at all.
//
// Thread safety: none. Invariant: what take() yields continues what it yielded before, by number,
// within an epoch, but for what give_up() declared lost.

#include <cstdint>
#include <deque>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace stoss::client {

/// Events by number, from `first` on.
struct EventRange {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// REQUIRES of Event: a `sequence`.
template <class Event>
class EventOrder {
 public:
  /// Starts with the event of this number, or with the first that is offered.
  explicit EventOrder(std::optional<std::uint64_t> first) : next_(first) {}

  /// Takes in events of consecutive numbers. A higher epoch begins anew at number 1, a lower one is
  /// ignored.
  void offer(std::uint64_t epoch, std::vector<Event> events);

  /// What has to be offered before take() can go on.
  [[nodiscard]] std::optional<EventRange> missing() const;
  /// What is missing is not to be had any more: goes on behind it.
  void give_up();

  /// The events whose turn it is.
  [[nodiscard]] std::vector<Event> take();

  [[nodiscard]] std::uint64_t epoch() const { return epoch_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] std::uint64_t gaps() const { return gaps_; }

 private:
  std::deque<std::vector<Event>> held_;  ///< sorted by number, none empty
  std::optional<std::uint64_t> next_;
  std::uint64_t epoch_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t gaps_ = 0;
  std::optional<std::uint64_t> counted_;  ///< the beginning of the gap counted last
  bool any_ = false;                      ///< an epoch is known
};

template <class Event>
void EventOrder<Event>::offer(std::uint64_t epoch, std::vector<Event> events) {
  if (events.empty() || (any_ && epoch < epoch_)) return;
  if (any_ && epoch > epoch_) {
    held_.clear();
    next_ = 1;
  }
  any_ = true;
  epoch_ = epoch;
  const std::uint64_t first = events.front().sequence;
  if (!next_) next_ = first;
  if (events.back().sequence < *next_) return;
  auto place = held_.end();
  while (place != held_.begin() && std::prev(place)->front().sequence > first) --place;
  held_.insert(place, std::move(events));
}

template <class Event>
std::optional<EventRange> EventOrder<Event>::missing() const {
  if (held_.empty() || !next_) return std::nullopt;
  const std::uint64_t first = held_.front().front().sequence;
  if (first <= *next_) return std::nullopt;
  return EventRange{*next_, first - *next_};
}

template <class Event>
void EventOrder<Event>::give_up() {
  const std::optional<EventRange> range = missing();
  if (!range) return;
  lost_ += range->count;
  next_ = range->first + range->count;
}

template <class Event>
std::vector<Event> EventOrder<Event>::take() {
  std::vector<Event> result;
  while (!held_.empty() && !missing()) {
    for (Event& event : held_.front()) {
      if (event.sequence != *next_) continue;  // delivered before
      result.push_back(event);
      ++*next_;
    }
    held_.pop_front();
  }
  if (missing() && counted_ != next_) {
    counted_ = next_;
    ++gaps_;
  }
  return result;
}

}  // namespace stoss::client

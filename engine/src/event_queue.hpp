// SPDX-License-Identifier: Apache-2.0
#pragma once

// The future events, one a body: the earliest that the body knows of.
//
// Events are ordered by (instant, kind, lower id, higher id); instants differ almost always, so ids
// are looked up on ties alone. A calendar sorts them only as far as it must: a ring of buckets of
// equal width, a heap for the bucket that is open, stretches of half a ring each beyond the ring
// (later_events.hpp), and an unsorted rest beyond those. A body at rest for ever is in none.
//
// Source: the calendar of Paul, J. Comput. Phys. 221 (2007) 615. Deviations: bucket numbers are
// shifted instants, exact integers, so no order is ever decided by rounding; the open bucket is a
// heap, so that a million events at one instant cost a logarithm each and not a scan; the ring is
// so short that the memory of its events is at hand, and most events are filed far beyond it, where
// that takes no other line; a bucket that was opened is at once the last of the ring, a stretch
// that was filed the last of those, so that there is no moment at which all events must be filed
// anew; width and number of buckets are taken from the events themselves, and again where they no
// longer suit.
//
// Invariants: 1. the heap holds every event that is due before the open bucket ends, the ring all
// others before the first stretch begins, which is half a ring from there or more; those of the
// rest are due after all stretches as they were when the rest was looked through last; 2. a bit of
// occupied_ is set where its bucket holds something; 3. who is in a stretch has an entry there, in
// its place.

#include "event_heap.hpp"
#include "later_events.hpp"
#include "prefetch.hpp"

#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace stoss::engine {

/// What a body is scheduled for. Neighbours first: a renewal at an instant precedes its contacts.
enum class EventKind : std::uint8_t {
  NeighbourRenewal = 0,
  DiskDisk = 1,
  DiskWall = 2,
  DiskWallEnd = 3,
  LawChange = 4,     ///< of one body by itself: its stop, or the end of its slide
  ZoneCrossing = 5,  ///< of a zone's rim, by a disk's centre
  Kick = 6,          ///< of one body by the thermostat
  /// Some contact, no earlier than this: a kernel is asked when it comes up. Before all others, so
  /// that it is known when its turn is.
  Guess = 255,
};

template <class S>
struct Event {
  Time<S> at = Time<S>::never();
  std::int32_t partner = -1;          ///< slot of the other body; -1: an event of one body alone
  std::uint32_t partner_changes = 0;  ///< the partner's count when this was predicted
  EventKind kind = EventKind::NeighbourRenewal;
  /// Kept here: a slot may be given to another body while the event waits. Of contacts and the
  /// like.
  Id partner_id = kNoId;
  float clear_for = 0;     ///< s; of a guess: the body has no other event so soon after it
  float until_guess = -1;  ///< s; of a renewal: the guess of `partner` that then stands; < 0: none
};

/// The ids of an event's bodies, lower first.
struct IdPair {
  Id low = kNoId;
  Id high = kNoId;
  friend auto operator<=>(const IdPair&, const IdPair&) = default;
};

/// The order of kinds at one instant.
inline int rank(EventKind kind) { return kind == EventKind::Guess ? -1 : static_cast<int>(kind); }

/// REQUIRES of Ids: `IdPair operator()(slot, const Event&) const`.
template <class S, class Ids>
bool earlier(const Event<S>& a,
             std::int32_t slot_a,
             const Event<S>& b,
             std::int32_t slot_b,
             const Ids& ids) {
  if (a.at != b.at) return a.at < b.at;
  if (a.kind != b.kind) return rank(a.kind) < rank(b.kind);
  return ids(slot_a, a) < ids(slot_b, b);
}

namespace detail {

/// The 64.64 number that buckets are cut from; monotone in the order of instants.
inline Int128 bucket_ticks(const Instant& t) { return ticks(t); }
inline Int128 bucket_ticks(const WideInstant& t) { return ticks(t.coarse); }

}  // namespace detail

/// `kRingMax`: buckets of the ring at most, a power of two from 64 on.
template <class S, std::size_t kRingMax = 2048>
class EventQueue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  const Event<S>& event_of(std::int32_t slot) const { return lines_[index(slot)].event; }

  /// The slot of the first event. REQUIRES: !empty()
  template <class Ids>
  std::int32_t top(const Ids& ids) {
    while (heap_.empty()) open_next_bucket(ids);
    return heap_.slot_at(0);
  }

  // For asking for memory ahead.

  /// Will top() open a bucket? REQUIRES: !empty()
  bool is_between_buckets() const { return heap_.empty(); }
  /// Calls visit(slot) for some of those in the open bucket and one in the next, whose events are
  /// at hand.
  template <class Visit>
  void for_each_soon_due(const Visit& visit) const {
    constexpr std::int32_t kSome = 8;
    for (std::int32_t i = 0; i < std::min(heap_.size(), kSome); ++i) visit(heap_.slot_at(i));
    if (upcoming_ != kNull) visit(upcoming_);
  }
  /// The slot whose turn most likely comes after the first's; -1: none is known.
  std::int32_t second() const {
    return heap_.size() < 2 ? upcoming_ : heap_.slot_at(heap_.second());
  }

  /// Asks for what the queue knows of a slot; once that has come, for what set() will read of
  /// others.
  void prefetch_line(std::int32_t slot) const { prefetch(&lines_[index(slot)]); }
  void prefetch_beside(std::int32_t slot) const {
    const Line& line = lines_[index(slot)];
    if (line.home < 0) return;
    prefetch(lines_.data() + line.place);
    prefetch(lines_.data() + line.previous);
  }

  /// Calls visit(slot) for all that have an event, in no order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for_each_filed(visit);
    for (const std::int32_t slot : rest_) visit(slot);
  }

  /// For how many slots it has memory in use, besides that which each has of its own.
  std::size_t entries_kept() const { return later_.entries_kept() + rest_.size() + heap_.room(); }

  /// Makes room for a slot, without an event.
  void admit(std::int32_t slot) {
    if (index(slot) >= lines_.size()) lines_.resize(index(slot) + 1);
  }

  /// Sets the event of a slot; one that never comes leaves the queue. REQUIRES: admitted.
  template <class Ids>
  [[gnu::always_inline]] inline void set(std::int32_t slot, const Event<S>& event, const Ids& ids) {
    line(slot).event = event;
    refile(slot, ids);
  }

  /// Changes what goes with the event of a slot. REQUIRES: not when, nor its kind and bodies'
  /// order.
  void amend(std::int32_t slot, const Event<S>& event) { line(slot).event = event; }

  template <class Ids>
  void erase(std::int32_t slot, const Ids& ids) {
    set(slot, Event<S>{}, ids);
  }

 private:
  // Where a slot is: in a bucket (its number), in one of these, or in a stretch (kFirstStretch less
  // its number).
  static constexpr std::int32_t kAbsent = -1;
  static constexpr std::int32_t kHeap = -2;
  static constexpr std::int32_t kRest = -3;
  static constexpr std::int32_t kFirstStretch = -4;

  static constexpr std::int32_t kNull = -1;
  static constexpr std::size_t kBucketsMin = 64;
  static constexpr std::size_t kBucketsMax = std::size_t{1} << 22;  // in ring and stretches
  static constexpr std::size_t kStretchesMin = 4;
  /// A bucket with more events than this, where buckets were cut for one each: time to cut anew.
  static constexpr std::size_t kCrowd = 24;
  /// The same where so many buckets one after the other have more than this each. Chosen.
  static constexpr std::size_t kCrowded = 8;
  /// Events that the width of buckets is estimated from.
  static constexpr std::size_t kSample = 128;

  /// All that the queue knows of a slot.
  struct alignas(64) Line {
    Event<S> event;
    std::int32_t home = kAbsent;
    /// In the heap, the rest or a stretch; in a bucket: the next slot.
    std::int32_t place = kNull;
    std::int32_t previous = kNull;
  };

  /// Where an event belongs.
  struct Filing {
    std::int32_t home;
    /// In the heap (EventHeap::Entry): how long after the open bucket begins, in 2^-64 s, or in the
    /// finest units with which a bucket fits in 64 bits; 0 for what is due before.
    std::uint64_t after;
  };

  /// What the heap asks for.
  template <class Ids>
  struct Heaped {
    std::vector<Line>& lines;
    const Ids& ids;
    bool is_before(std::int32_t a, std::int32_t b) const {
      return earlier(lines[index(a)].event, a, lines[index(b)].event, b, ids);
    }
    void note_place(std::int32_t slot, std::int32_t place) const {
      lines[index(slot)].place = place;
    }
  };
  template <class Ids>
  Heaped<Ids> heaped(const Ids& ids) {
    return {lines_, ids};
  }

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  Line& line(std::int32_t slot) { return lines_[index(slot)]; }

  [[gnu::always_inline]] inline Filing filing_of(const Time<S>& at) const {
    if (at == Time<S>::never()) return {kAbsent, 0};
    const Int128 after = detail::bucket_ticks(at) - open_start_;
    if (after < width_) {
      return {kHeap, after < 0 ? 0 : static_cast<std::uint64_t>(after >> coarseness_)};
    }
    if (after < ring_) return {beyond_open(static_cast<std::size_t>(after >> shift_)), 0};
    const Int128 beyond = after - ring_;
    if (beyond >= reach_) return {kRest, 0};
    return {home_of(stretch_after(static_cast<std::size_t>(beyond >> stretch_shift_))), 0};
  }

  static std::int32_t home_of(std::size_t stretch) {
    return kFirstStretch - static_cast<std::int32_t>(stretch);
  }
  /// The stretch so many after the first.
  std::size_t stretch_after(std::size_t stretches) const {
    return (first_stretch_ + stretches) & (later_.stretches() - 1);
  }

  /// The bucket so many after the open one. REQUIRES: less than a ring.
  std::int32_t beyond_open(std::size_t buckets) const {
    return static_cast<std::int32_t>((index(open_bucket_) + buckets) & last_bucket_);
  }

  // After the event of a slot has changed. Whatever calls a function is the last to be done, so
  // that nothing has to be kept meanwhile.
  template <class Ids>
  [[gnu::noinline]] void refile(std::int32_t slot, const Ids& ids) {
    Line& line = lines_[index(slot)];
    const std::int32_t from = line.home;
    const std::int32_t place = line.place;
    const Filing to = filing_of(line.event.at);
    if (from >= 0) {
      unlink(line);
    } else if (from == to.home && from <= kFirstStretch) {
      return;
    } else if (from == kRest) {
      close_gap_in_rest(place);
    } else if (from == kAbsent) {
      ++size_;
    }
    if (from == kHeap && to.home == kHeap) {
      return heap_.find_place(place, {to.after, slot}, heaped(ids));
    }
    file(slot, to, ids);
    if (from == kHeap) heap_.close_gap(place, heaped(ids));
  }

  // One that is out of wherever it was.
  template <class Ids>
  [[gnu::always_inline]] inline void file(std::int32_t slot, const Filing& to, const Ids& ids) {
    Line& entering = line(slot);
    entering.home = to.home;
    if (to.home == kHeap) {
      heap_.push({to.after, slot}, heaped(ids));
    } else if (to.home <= kFirstStretch) {
      entering.place = later_.add(index(kFirstStretch - to.home), slot);
      if (LaterEvents::begins_page(entering.place) && later_.is_wasteful(size_)) tidy_up();
    } else if (to.home == kRest) {
      add_to_rest(slot);
    } else if (to.home == kAbsent) {
      --size_;
    } else {
      link(slot);
    }
  }

  /// Is what a stretch has for a slot up to date?
  bool is_in(std::int32_t slot, std::size_t stretch, std::int32_t place) const {
    const Line& there = lines_[index(slot)];
    return there.home == home_of(stretch) && there.place == place;
  }

  // Leaves what is up to date in the stretches, and nothing else.
  [[gnu::noinline, gnu::cold]] void tidy_up() {
    for (std::size_t stretch = 0; stretch < later_.stretches(); ++stretch) {
      later_.take_all(
          stretch,
          [](std::int32_t) {},
          [&](std::int32_t slot, std::int32_t place) {
            if (is_in(slot, stretch, place)) line(slot).place = later_.add(stretch, slot);
          });
    }
  }

  // Of the bucket that is its home.
  [[gnu::always_inline]] inline void link(std::int32_t slot) {
    Line& entering = line(slot);
    const std::size_t home = index(entering.home);
    std::int32_t& head = buckets_[home];
    entering.place = head;
    entering.previous = kNull;
    if (head != kNull) line(head).previous = slot;
    head = slot;
    occupied_[home / 64] |= std::uint64_t{1} << (home % 64);
  }

  [[gnu::always_inline]] inline void unlink(const Line& leaving) {
    if (leaving.place != kNull) line(leaving.place).previous = leaving.previous;
    if (leaving.previous != kNull) {
      line(leaving.previous).place = leaving.place;
      return;
    }
    const std::size_t home = index(leaving.home);
    buckets_[home] = leaving.place;
    if (leaving.place == kNull) occupied_[home / 64] &= ~(std::uint64_t{1} << (home % 64));
  }

  [[gnu::noinline]] void add_to_rest(std::int32_t slot) {
    line(slot).home = kRest;
    line(slot).place = static_cast<std::int32_t>(rest_.size());
    rest_.push_back(slot);
  }

  void close_gap_in_rest(std::int32_t place) {
    const std::int32_t last = rest_.back();
    rest_[index(place)] = last;
    line(last).place = place;
    rest_.pop_back();
  }

  // Some events come into the heap, or closer to it. REQUIRES: the heap is empty, the queue is not.
  template <class Ids>
  void open_next_bucket(const Ids& ids) {
    if (passed_ > later_.stretches() / 2) return look_through_rest(ids);  // before it could come up
    const std::size_t ahead = next_occupied(1);
    if (ahead == 0) return open_next_stretch(ids);
    open(ahead);
    std::int32_t slot = std::exchange(buckets_[index(open_bucket_)], kNull);
    occupied_[index(open_bucket_) / 64] &= ~(std::uint64_t{1} << (open_bucket_ % 64));
    while (slot != kNull) {
      Line& entering = line(slot);
      const std::int32_t next = entering.place;
      entering.home = kHeap;
      heap_.push({filing_of(entering.event.at).after, slot}, heaped(ids));
      slot = next;
    }
    const std::size_t released = index(heap_.size());
    released_ += released;
    if (released > kCrowd && 2 * released_ > size_) {
      gather_all();
      return cut(ids);
    }
    if (ring_ <= half_ring()) file_stretch(ids);
    look_ahead();
  }

  void open(std::size_t ahead) {
    open_bucket_ = beyond_open(ahead);
    open_start_ += static_cast<Int128>(ahead) << shift_;
    ring_ -= static_cast<Int128>(ahead) << shift_;
    slid_ += ahead;
  }

  Int128 half_ring() const { return static_cast<Int128>(1) << stretch_shift_; }

  // The ring goes on where the first stretch with an entry begins. REQUIRES: the ring is empty.
  template <class Ids>
  [[gnu::noinline]] void open_next_stretch(const Ids& ids) {
    std::size_t ahead = 0;
    while (ahead < later_.stretches() && later_.is_empty(stretch_after(ahead))) ++ahead;
    if (ahead == later_.stretches()) return cut(ids);
    if (passed_ > 0 && passed_ + ahead > later_.stretches() / 2) return look_through_rest(ids);
    open_start_ += ring_ + (static_cast<Int128>(ahead) << stretch_shift_);
    slid_ += static_cast<std::size_t>(ring_ >> shift_) + ahead * (buckets_.size() / 2);
    ring_ = 0;
    first_stretch_ = stretch_after(ahead);
    passed_ += ahead;
    file_stretch(ids);
    file_stretch(ids);
  }

  // The ring becomes longer by the first stretch.
  template <class Ids>
  [[gnu::noinline]] void file_stretch(const Ids& ids) {
    const std::size_t stretch = first_stretch_;
    first_stretch_ = stretch_after(1);
    ++passed_;
    ring_ += half_ring();
    later_.take_all(
        stretch,
        [this](std::int32_t slot) { prefetch_line(slot); },
        [&](std::int32_t slot, std::int32_t place) {
          if (is_in(slot, stretch, place)) file_anew(slot, ids);
        });
  }

  template <class Ids>
  [[gnu::noinline]] void file_anew(std::int32_t slot, const Ids& ids) {
    file(slot, filing_of(event_of(slot).at), ids);
  }

  /// How many buckets after the open one the next that holds something is, from the given one on;
  /// 0: there is none.
  std::size_t next_occupied(std::size_t from) const {
    const std::size_t first = index(beyond_open(from));
    std::size_t word = first / 64;
    std::uint64_t bits = occupied_[word] & (~std::uint64_t{0} << (first % 64));
    for (std::size_t looked_at = 0; bits == 0; ++looked_at) {
      if (looked_at == occupied_.size()) return 0;
      word = (word + 1) & (occupied_.size() - 1);
      bits = occupied_[word];
    }
    const std::size_t found = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
    const std::size_t ahead = (found - index(open_bucket_)) & last_bucket_;
    return ahead < from ? 0 : ahead;
  }

  // Of the next two buckets: the nearer one's first slot is known by now, the other's is asked for.
  void look_ahead() {
    upcoming_ = kNull;
    const std::size_t ahead = next_occupied(1);
    if (ahead == 0) return;
    upcoming_ = buckets_[index(beyond_open(ahead))];
    const std::size_t then = next_occupied(ahead + 1);
    if (then != 0) prefetch_line(buckets_[index(beyond_open(then))]);
  }

  // What is due soon enough by now leaves the rest. REQUIRES: the heap is empty.
  template <class Ids>
  [[gnu::noinline]] void look_through_rest(const Ids& ids) {
    const bool are_too_wide = released_ > kCrowded * slid_;
    if (are_too_wide || 2 * rest_.size() > size_ || are_too_few_or_many()) {
      gather_all();
      return cut(ids);
    }
    file_rest(ids);
  }

  // The world has become faster, slower or fuller than the buckets were cut for.
  void gather_all() {
    for_each_filed([this](std::int32_t slot) { add_to_rest(slot); });
    heap_.clear();
    std::fill(buckets_.begin(), buckets_.end(), kNull);
    std::fill(occupied_.begin(), occupied_.end(), 0);
    later_.clear();
  }

  // All but those of the rest; `visit` may make them some of it.
  template <class Visit>
  void for_each_filed(const Visit& visit) const {
    for (std::int32_t place = 0; place < heap_.size(); ++place) visit(heap_.slot_at(place));
    for (std::size_t word = 0; word < occupied_.size(); ++word) {
      for (std::uint64_t bits = occupied_[word]; bits != 0; bits &= bits - 1) {
        const std::size_t bucket = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
        for (std::int32_t slot = buckets_[bucket]; slot != kNull;) {
          const std::int32_t next = lines_[index(slot)].place;
          visit(slot);
          slot = next;
        }
      }
    }
    for (std::size_t stretch = 0; stretch < later_.stretches(); ++stretch) {
      later_.for_each(stretch, [&](std::int32_t slot, std::int32_t place) {
        if (is_in(slot, stretch, place)) visit(slot);
      });
    }
  }

  std::size_t buckets_wanted() const {
    return std::clamp(2 * std::bit_ceil(size_), kBucketsMin, kBucketsMax);
  }
  bool are_too_few_or_many() const {
    return cut_for_ < buckets_wanted() || cut_for_ > 4 * buckets_wanted();
  }
  void make_buckets() {
    cut_for_ = buckets_wanted();
    buckets_.assign(std::min(cut_for_, kRingMax), kNull);
    buckets_.shrink_to_fit();
    occupied_.assign(buckets_.size() / 64, 0);
    last_bucket_ = buckets_.size() - 1;
    later_.set_stretches(std::max(kStretchesMin, cut_for_ / (buckets_.size() / 2)));
  }

  // All events are in the rest: cuts buckets for them and files them.
  template <class Ids>
  [[gnu::noinline]] void cut(const Ids& ids) {
    Int128 first = detail::bucket_ticks(event_of(rest_.front()).at);
    for (const std::int32_t slot : rest_) {
      first = std::min(first, detail::bucket_ticks(event_of(slot).at));
    }
    if (are_too_few_or_many()) make_buckets();
    shift_ = shift_for(first);
    coarseness_ = std::max(shift_ - 64, 0);
    width_ = static_cast<Int128>(1) << shift_;
    stretch_shift_ = shift_ + std::countr_zero(buckets_.size() / 2);
    ring_ = 2 * half_ring();
    reach_ = half_ring() * static_cast<Int128>(later_.stretches());
    open_start_ = first;
    open_bucket_ = 0;
    first_stretch_ = 0;
    file_rest(ids);
    refiled_.shrink_to_fit();  // that was for all events; the next is for a few
  }

  template <class Ids>
  void file_rest(const Ids& ids) {
    slid_ = 0;
    passed_ = 0;
    released_ = 0;
    refiled_.swap(rest_);
    rest_.clear();
    for (const std::int32_t slot : refiled_) file_anew(slot, ids);
    refiled_.clear();
  }

  // Buckets for about one event each while the nearer half of all is due, by their median.
  int shift_for(Int128 first) {
    std::array<Int128, kSample> after{};
    const std::size_t count = std::min(kSample, rest_.size());
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t slot = rest_[i * rest_.size() / count];
      after[i] = detail::bucket_ticks(event_of(slot).at) - first;
    }
    const auto middle = after.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(after.begin(), middle, after.begin() + static_cast<std::ptrdiff_t>(count));
    constexpr int kShiftMax = 96;  // no width beyond 2^32 s, so that 2^22 fit in 128 bits
    const auto half = static_cast<Int128>((rest_.size() + 1) / 2);
    const Int128 gap = *middle / half;
    int shift = 0;
    while (shift < kShiftMax && (static_cast<Int128>(1) << shift) < gap) ++shift;
    return shift;
  }

  std::vector<Line> lines_;  // of every slot
  std::size_t size_ = 0;

  EventHeap heap_;  // of the open bucket
  // The ring: the first slot of each bucket; as many as some power of two.
  std::vector<std::int32_t> buckets_ = std::vector<std::int32_t>(kBucketsMin, kNull);
  std::vector<std::uint64_t> occupied_ = std::vector<std::uint64_t>(kBucketsMin / 64);
  LaterEvents later_;  // a power of two of stretches
  std::vector<std::int32_t> rest_;
  std::vector<std::int32_t> refiled_;  // kept for its memory

  // In 2^-64 s. At first all events are in the rest.
  Int128 open_start_ = -(static_cast<Int128>(1) << 126);
  Int128 width_ = 0;       // of a bucket
  Int128 ring_ = 0;        // from the open bucket's start to the first stretch
  Int128 reach_ = 0;       // of all stretches
  int shift_ = 0;          // the logarithm of the width
  int stretch_shift_ = 0;  // of a stretch
  int coarseness_ = 0;     // of Filing::after
  std::int32_t open_bucket_ = 0;
  std::size_t last_bucket_ = kBucketsMin - 1;  // told from buckets_, but asked for at every filing
  std::size_t first_stretch_ = 0;
  std::size_t cut_for_ = 0;        // so many buckets, in ring and stretches
  std::size_t slid_ = 0;           // buckets, since the rest was looked through
  std::size_t passed_ = 0;         // stretches, likewise
  std::size_t released_ = 0;       // events from buckets, likewise
  std::int32_t upcoming_ = kNull;  // the first slot of the bucket that is opened next, as known
};

}  // namespace stoss::engine

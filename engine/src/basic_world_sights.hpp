// SPDX-License-Identifier: Apache-2.0
#pragma once

// Predictions by sights (sight.hpp): what a body has before it is told by lower bounds, and kernels
// are asked for what comes first when it is due.
//
// Alike are all dynamic disks that nothing but the world's law moves. Whatever else there is,
// walls, zones, disks that rest or slide or keep their velocity against gravity or drag, is looked
// at by screens and kernels.

#include "basic_world.hpp"
#include "prefetch.hpp"
#include "screen.hpp"
#include "sight_frames.hpp"
#include "wall_sight.hpp"

#include <utility>

namespace stoss::engine {

/// Is this a world that predicts by sights? Floor friction slows every disk in a way of its own.
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_sights() const {
  if constexpr (Laws::kCurved) {
    if (laws_.deceleration > S(0)) return false;
  }
  return !all_pairs();
}

// By sights: of what the body has before it, the soonest becomes its event as a guess, and a kernel
// is asked when it is due; most guesses are overtaken by other contacts before. What is due at
// once, and walls, are predicted closely.
template <class S, class Laws>
void BasicWorld<S, Laws>::foresee(Slot slot, bool changed) {
  if (changed && neighbours_.is_overworked(slot)) renew_box(slot, next_margin(slot));
  const SightClock clock = read_sight_clock();
  Foresight ahead;
  const double renewal = look_ahead(slot, changed, clock, ahead);
  schedule(slot, ahead, renewal);
}

// The same for two that have both changed: nothing is scheduled until both have looked, so that the
// processor need not wait for what one will find before it looks for the other.
template <class S, class Laws>
void BasicWorld<S, Laws>::foresee_both(Slot a, Slot b) {
  for (const Slot slot : {a, b}) {
    if (neighbours_.is_overworked(slot)) renew_box(slot, next_margin(slot));
  }
  const SightClock clock = read_sight_clock();
  Foresight ahead_of_a;
  Foresight ahead_of_b;
  const double renewal_of_a = look_ahead(a, /*changed=*/true, clock, ahead_of_a);
  const double renewal_of_b = look_ahead(b, /*changed=*/true, clock, ahead_of_b);
  schedule(a, ahead_of_a, renewal_of_a);
  schedule(b, ahead_of_b, renewal_of_b);
}

// What the body has before it; returns its renewal, s from now.
template <class S, class Laws>
double BasicWorld<S, Laws>::look_ahead(Slot slot,
                                       bool changed,
                                       const SightClock& clock,
                                       Foresight& ahead) {
  ++sights_.uses;
  const double renewal = time_to_renewal(slot, bodies_.sight(slot), clock);
  if constexpr (!Laws::kPlain) ahead.exact = own_event(slot);
  if (at(slot).is_dynamic()) {
    look_at_listed(slot, neighbours_.of(slot), changed, clock, renewal, ahead);
  } else {
    for_each_neighbour(slot, [&](Slot other) {
      bool holds = false;
      if constexpr (!Laws::kPlain) holds = is_zone(other);  // a kinematic disk: its crossings
      if (changed || holds) look_at_unlike(slot, other, changed, clock, renewal, ahead);
    });
  }
  neighbours_.note_work(slot);
  return renewal;
}

// A disk has crossed to another cell: what it had before it stands, and newcomers join. False if
// that is not all, and it must be predicted from the beginning.
template <class S, class Laws>
bool BasicWorld<S, Laws>::foresee_newcomers(Slot slot, const Event<S>& crossing) {
  if (!(crossing.until_guess >= 0) || !has_sights()) return false;
  ++sights_.uses;
  const SightClock clock = read_sight_clock();
  const double renewal = time_to_renewal(slot, bodies_.sight(slot), clock);
  const auto newcomers = neighbours_.newcomers(slot);
  Foresight ahead;
  look_at_listed(slot, newcomers, /*changed=*/true, clock, renewal, ahead);
  if (ahead.has_unseen) return false;
  ahead.standing = &crossing;
  const auto first = static_cast<double>(crossing.until_guess);
  ahead.note(crossing.partner, first);
  ahead.note(crossing.partner, first + static_cast<double>(crossing.clear_for));
  schedule(slot, ahead, renewal);
  return true;
}

// Neighbours of a dynamic disk.
template <class S, class Laws>
void BasicWorld<S, Laws>::look_at_listed(Slot slot,
                                         std::span<const Slot> list,
                                         bool changed,
                                         const SightClock& clock,
                                         double renewal,
                                         Foresight& ahead) {
  const Seen& own = bodies_.sight(slot);
  if constexpr (!Laws::kPlain) {
    if (!is_like(own)) {
      ahead.has_unseen = true;
      for (const Slot other : list) look_at_unlike(slot, other, changed, clock, renewal, ahead);
      return;
    }
  }
  const double smallest_held = own.size * (1.0 / kHolderRatioMax);
  look_at_all(slot, list, smallest_held, clock, ahead);
  if (ahead.passed_over > 0) look_at_others(slot, changed, clock, renewal, ahead);
}

// Of those that were passed over: whoever is not like the rest, and the much smaller, which hold
// their pairs.
template <class S, class Laws>
[[gnu::noinline]] void BasicWorld<S, Laws>::look_at_others(
    Slot slot, bool changed, const SightClock& clock, double renewal, Foresight& ahead) {
  const std::span<const PassedOver> others(sights_.others.data(),
                                           static_cast<std::size_t>(ahead.passed_over));
  for (const PassedOver& other : others) queue_.prefetch_line(other.slot);
  for (const PassedOver& other : others) {
    if (other.soonest < 0) {
      look_at_unlike(slot, other.slot, changed, clock, renewal, ahead);
    } else if (changed) {
      offer(other.slot, slot, seconds_of(other.soonest, clock));
    }
  }
}

// Of a disk that is like the rest: all others like it of at least a size.
template <class S, class Laws>
void BasicWorld<S, Laws>::look_at_all(Slot slot,
                                      std::span<const Slot> list,
                                      double smallest,
                                      const SightClock& clock,
                                      Foresight& ahead) const {
  static_cast<SoonestTwo&>(ahead) = soonest_of(slot, list, smallest, clock);
  if constexpr (Laws::kCurved) {
    ahead.first = seconds_of(ahead.first, clock);
    ahead.second = seconds_of(ahead.second, clock);
  }
}

/// Asks for all that a prediction of the body will look at: one wait instead of a dozen.
template <class S, class Laws>
void BasicWorld<S, Laws>::prefetch_sights(Slot slot) const {
  const auto all = neighbours_.of(slot);
  for (const Slot other : all) bodies_.prefetch_sight(other);
}

// A neighbour that is a wall, a zone, fixed or at rest; whoever is one that rests or is fixed. The
// kernel is asked at once for what no sight shows, and for a wall that is touched or all but.
template <class S, class Laws>
void BasicWorld<S, Laws>::look_at_unlike(Slot slot,
                                         Slot other,
                                         bool changed,
                                         const SightClock& clock,
                                         double renewal,
                                         Foresight& ahead) {
  const bool is_held = holds_prediction(slot, other);
  if (!is_held && !changed) return;
  if (see_each_other(slot, other)) {
    const double soonest = seconds_of(soonest_seen(slot, other, clock), clock);
    if (!is_held) return offer(other, slot, soonest);
    if (!(soonest < kNear) || !at(other).is_wall()) return ahead.note(other, soonest);
  }
  if (!is_held) return offer(other, slot, 0);
  ahead.has_unseen = true;
  // Rather more than the bound of a guess: the guess may come later, but hardly so much.
  constexpr double kBeyond = 1.25;
  double horizon = std::min(renewal, kBeyond * ahead.first);
  if (ahead.exact) horizon = std::min(horizon, horizon_of(*ahead.exact));
  if (!may_meet(slot, glance_of(slot), other, horizon)) {
    ahead.second = std::min(ahead.second, horizon);
    return;
  }
  const auto event = event_with(slot, other);
  if (event && (!ahead.exact || earlier(*event, slot, *ahead.exact, slot, id_lookup()))) {
    ahead.exact = event;
  }
}

/// Two whose sights say when they meet: where motions are curved or go around a period, disks that
/// are like the rest; where disks grow, any; else walls, too.
template <class S, class Laws>
bool BasicWorld<S, Laws>::see_each_other(Slot a, Slot b) const {
  if (Laws::kCurved || is_periodic()) {
    return is_like(bodies_.sight(a)) && is_like(bodies_.sight(b));
  }
  constexpr BodyType kLast = Laws::kGrows ? BodyType::Static : BodyType::Wall;
  return at(a).type <= kLast && at(b).type <= kLast;
}

template <class S, class Laws>
SoonestTwo BasicWorld<S, Laws>::soonest_of(Slot slot,
                                           std::span<const Slot> list,
                                           double smallest,
                                           const SightClock& clock) const {
  if (sights_.others.size() < list.size()) sights_.others.resize(2 * list.size());
  const auto soonest = [&](const auto& common) {
    return soonest_contacts(slot,
                            list,
                            bodies_.sights(),
                            smallest,
                            clock.now,
                            kScreenSlack<S>,
                            common,
                            sights_.others.data());
  };
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      return soonest(Repeating<Common>{common_to_sights(clock), space_.length_x, space_.length_y});
    }
  }
  return soonest(common_to_sights(clock));
}

/// By the clock of sights from now on. REQUIRES: they see each other.
template <class S, class Laws>
double BasicWorld<S, Laws>::soonest_seen(Slot a, Slot b, const SightClock& clock) const {
  if constexpr (!Laws::kCurved && !Laws::kGrows) {
    if (at(b).is_wall()) return soonest_at_wall(a, b, clock);
    if (at(a).is_wall()) return soonest_at_wall(b, a, clock);
  }
  const auto soonest = [&](const auto& common) {
    return soonest_contact(bodies_.sight(a), bodies_.sight(b), clock.now, kScreenSlack<S>, common);
  };
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      return soonest(Repeating<Common>{common_to_sights(clock), space_.length_x, space_.length_y});
    }
  }
  return soonest(common_to_sights(clock));
}

template <class S, class Laws>
double BasicWorld<S, Laws>::soonest_at_wall(Slot disk, Slot wall, const SightClock& clock) const {
  const DoubleWord2<S>& edge = shape(wall).edge;
  const WallView view(present_of(bodies_.sight(disk), clock.now),
                      present_of(bodies_.sight(wall), clock.now),
                      static_cast<double>(edge.x.hi),
                      static_cast<double>(edge.y.hi),
                      kScreenSlack<S>);
  return view.soonest_contact();
}

/// An event with the partner of what lies ahead, and nothing else. A guess that stood before may be
/// out of date, and stays so.
template <class S, class Laws>
Event<S> BasicWorld<S, Laws>::guess_of(const Foresight& ahead) const {
  Event<S> event;
  if (ahead.standing != nullptr && ahead.standing->partner == ahead.partner) {
    event.partner = ahead.partner;
    event.partner_changes = ahead.standing->partner_changes;
  } else {
    name_partner(event, ahead.partner);
  }
  return event;
}

/// With its count of changes as it is now. Not with its id, which lies far from the sight: it is
/// asked for where two events come at one instant, and there guesses and renewals may come in any
/// order.
template <class S, class Laws>
void BasicWorld<S, Laws>::name_partner(Event<S>& event, Slot partner) const {
  event.partner = partner;
  event.partner_changes = at(partner).changes;
}

/// Makes a contact with the partner of `next`, `first` s from now or later, the body's event, which
/// has no other before `second`.
template <class S, class Laws>
[[gnu::always_inline]] inline void BasicWorld<S, Laws>::set_guess(Slot slot,
                                                                  Event<S> next,
                                                                  double first,
                                                                  double second) {
  next.at = roughly_later(now_, first);
  next.kind = EventKind::Guess;
  next.clear_for = safe_difference(second, first);
  queue_.set(slot, next, id_lookup());
}

// Makes the first of what lies ahead the body's event.
template <class S, class Laws>
void BasicWorld<S, Laws>::schedule(Slot slot, const Foresight& ahead, double renewal) {
  if (ahead.first < kNear) return predict_closely(slot, /*changed=*/false);
  double limit = renewal;
  if (ahead.exact) limit = std::min(limit, rough_seconds(ahead.exact->at, now_));
  if (ahead.first < limit) {
    set_guess(slot, guess_of(ahead), ahead.first, std::min(ahead.second, limit));
  } else if (limit == renewal) {
    Event<S> next;
    if (!ahead.exact && !ahead.has_unseen) next = guess_after(renewal, ahead);
    next.at = roughly_later(now_, renewal);
    queue_.set(slot, next, id_lookup());
  } else {
    queue_.set(slot, *ahead.exact, id_lookup());
  }
}

/// A renewal that keeps what comes after it.
template <class S, class Laws>
Event<S> BasicWorld<S, Laws>::guess_after(double renewal, const Foresight& ahead) const {
  const bool is_none = ahead.first == std::numeric_limits<double>::infinity();
  if (ahead.partner < 0 && !is_none) return {};
  Event<S> event;
  if (ahead.partner >= 0) event = guess_of(ahead);
  event.until_guess = safe_difference(ahead.first, renewal);
  event.clear_for = safe_difference(ahead.second, ahead.first);
  return event;
}

/// Seconds until the body leaves its box, or what its sight shows of the others ends, a little
/// less; infinity if it never does.
template <class S, class Laws>
double BasicWorld<S, Laws>::time_to_renewal(Slot slot,
                                            const Seen& own,
                                            const SightClock& clock) const {
  constexpr double kEarly = 1 - 1e-6;
  if (Laws::kCurved || is_periodic()) {
    const double within = time_in_box(slot, glance_of(slot)) * kEarly;
    return Laws::kCurved && is_like(own) ? std::min(within, clock.holds_for) : within;
  }
  const Neighbours::Leeway leeway = neighbours_.leeway(slot);
  const Neighbours::Anchor& anchor = leeway.anchor;
  double margin = leeway.margin * kEarly;
  if (!(own.off < 1e-6 * margin)) [[unlikely]]
    return time_to_renewal_far_out(slot);
  const double elapsed = clock.now - own.since;
  const double growth = growth_of(slot);
  if constexpr (Laws::kGrows) margin -= own.radius + growth * clock.now - at(slot).boxed_radius;
  const double moved_x = (own.x + own.vx * elapsed) - (anchor.x + anchor.x_low);
  const double moved_y = (own.y + own.vy * elapsed) - (anchor.y + anchor.y_low);
  // Where a component is zero, so is its share: margin / 0 is infinite.
  const auto after = [&](double moved, double v) {
    const double way = margin - std::copysign(moved, moved * v);
    if constexpr (Laws::kGrows) return way / (std::abs(v) + growth);
    return way / std::abs(v);
  };
  const double soonest = std::min(after(moved_x, own.vx), after(moved_y, own.vy));
  if (!(soonest < kLongestWait)) [[unlikely]]
    return own.vx == 0 && own.vy == 0 ? soonest : kLongestWait;
  return std::max(0.0, soonest);
}

/// The same far from the origin, where a sight is too coarse.
template <class S, class Laws>
[[gnu::noinline, gnu::cold]] double BasicWorld<S, Laws>::time_to_renewal_far_out(Slot slot) const {
  const Event<S> event = renewal_event(slot, glance_of(slot));
  return event.at == Time<S>::never() ? std::numeric_limits<double>::infinity()
                                      : rough_seconds(event.at, now_);
}

/// Where the body is now, off by far less than the size of its cage: what its sight shows, if that
/// is fine enough, in a frame at rest.
template <class S, class Laws>
Vector2 BasicWorld<S, Laws>::rough_place_of(Slot slot) const {
  const Seen& own = bodies_.sight(slot);
  if (Laws::kCurved || !has_sights() || !(own.off < 1e-6 * own.reach())) {
    const Glance here = glance_of(slot);
    return {here.x + here.x_low, here.y + here.y_low};
  }
  const double elapsed = rough_seconds(now_, sights_.epoch.begin) - own.since;
  return {own.x + own.vx * elapsed, own.y + own.vy * elapsed};
}

// A pair that `holder` holds has changed; it does not meet before `soonest`, s from now.
template <class S, class Laws>
void BasicWorld<S, Laws>::offer(Slot holder, Slot changed, double soonest) {
  if (soonest == std::numeric_limits<double>::infinity()) return;
  if (guess_again(holder, changed, soonest)) return;
  const Event<S>& standing = queue_.event_of(holder);
  const double horizon = horizon_of(standing);
  const bool may_be_first =
      soonest < horizon && may_meet(changed, glance_of(changed), holder, horizon);
  if (may_be_first) {
    const auto event = event_with(holder, changed);
    if (!event) return;
    if (earlier(*event, holder, standing, holder, id_lookup())) {
      queue_.set(holder, *event, id_lookup());
      return;
    }
    soonest = std::max(soonest, rough_seconds(event->at, now_));
  }
  join(holder, changed, safe_difference(soonest, horizon));
}

// The same without a kernel, where the pair becomes the first that `holder` has before it, or was.
// False, and nothing is done, where that is not so, or is not told at once.
template <class S, class Laws>
bool BasicWorld<S, Laws>::guess_again(Slot holder, Slot changed, double soonest) {
  const Event<S>& standing = queue_.event_of(holder);
  const bool was_first = standing.partner == changed && standing.kind == EventKind::Guess;
  double others = rough_seconds(standing.at, now_);  // before that, nothing else
  if (was_first) others += static_cast<double>(standing.clear_for);
  if (!(soonest > kNear && soonest < others)) return false;
  Event<S> next;
  name_partner(next, changed);
  set_guess(holder, next, soonest, others);
  return true;
}

// A contact with `changed` that comes so many seconds after the event of `holder`, or later, joins
// what is known of the time after it.
template <class S, class Laws>
void BasicWorld<S, Laws>::join(Slot holder, Slot changed, float later) {
  Event<S> theirs = queue_.event_of(holder);
  if (theirs.kind == EventKind::NeighbourRenewal) {
    const bool is_anything_known = theirs.until_guess >= 0;
    if (!is_anything_known || !(later < theirs.until_guess + theirs.clear_for)) return;
    if (!see_each_other(holder, changed)) {
      theirs.until_guess = -1;  // nothing is known by sight
    } else if (theirs.partner == changed) {
      const double others =
          static_cast<double>(theirs.until_guess) + static_cast<double>(theirs.clear_for);
      theirs.clear_for = safe_difference(others, later);
      theirs.until_guess = later;
      name_partner(theirs, changed);
    } else if (later < theirs.until_guess) {
      theirs.clear_for = safe_difference(theirs.until_guess, later);
      theirs.until_guess = later;
      name_partner(theirs, changed);
    } else {
      theirs.clear_for = safe_difference(later, theirs.until_guess);
    }
  } else {
    if (theirs.kind != EventKind::Guess || !(later < theirs.clear_for)) return;
    theirs.clear_for = later;
  }
  queue_.amend(holder, theirs);
}

// The guess of a body has come up: asks the kernel.
template <class S, class Laws>
void BasicWorld<S, Laws>::sharpen(Slot slot) {
  const Event<S>& guess = queue_.event_of(slot);
  const auto ask_for = [this](Slot own) {
    bodies_.prefetch_body(own);
    neighbours_.prefetch_place(own);
  };
  const bool asks_ahead = is_worth_asking_ahead(kAskAheadFrom);
  if (asks_ahead) {
    ask_for(slot);
    ask_for(guess.partner);
  }
  if (is_stale(guess)) return predict(slot, /*changed=*/false);
  const std::optional<Contact> contact = contact_of(slot, guess.partner);
  const auto event = contact ? event_of(*contact, guess.partner) : std::nullopt;
  if (!event || !(rough_seconds(event->at, guess.at) < static_cast<double>(guess.clear_for))) {
    return predict_closely(slot, /*changed=*/false);
  }
  if (asks_ahead) {
    neighbours_.prefetch_list(slot);
    neighbours_.prefetch_list(guess.partner);
  }
  due_ = *contact;
  due_slot_ = slot;
  queue_.set(slot, *event, id_lookup());
}

/// The present as sights count it.
template <class S, class Laws>
[[gnu::always_inline]] inline auto BasicWorld<S, Laws>::read_sight_clock() const -> SightClock {
  const double now = rough_seconds(now_, sights_.epoch.begin);
  SightClock clock;
  clock.now = now;
  if constexpr (Laws::kDragged) {
    const auto drag = detail::rough_drag_clock(now, static_cast<double>(laws_.drag));
    clock.now = drag.run;
    clock.left = drag.left;
  }
  if constexpr (Laws::kCurved) {
    const bool is_pulled = !detail::is_zero(laws_.gravity);
    if (is_pulled) clock.holds_for = kEpochsAhead * sights_.epoch.length - now;
  }
  return clock;
}

// Takes all sights anew that say otherwise in another epoch. Where motions are uniform those of
// bodies that stand still say the same in all, and whoever moves has an event (kLongestWait): so
// nothing is done for a million bodies at rest.
template <class S, class Laws>
[[gnu::noinline]] void BasicWorld<S, Laws>::begin_epoch() {
  if (!has_sights()) {
    sights_.epoch.end = Time<S>::never();
    return;
  }
  const std::uint64_t uses = std::exchange(sights_.uses, 0);
  if constexpr (Laws::kCurved) {
    double radii = 0;
    std::size_t disks = 0;
    for (const Seen& sight : bodies_.sights()) {
      if (!is_like(sight)) continue;
      radii += sight.radius;
      ++disks;
    }
    const double mean = radii / static_cast<double>(std::max<std::size_t>(disks, 1));
    sights_.epoch.renew(now_, uses, slots_.size(), fine_epoch(common_pull(), mean));
  } else {
    sights_.epoch.renew(now_, uses, slots_.size());
  }
  constexpr auto kLate =
      static_cast<std::int64_t>(kLongestWait);  // s; later, who moves may have none
  constexpr std::size_t kFew = 8;  // so many times fewer: in the order of events it takes longer
  const bool may_ask_queue = !Laws::kCurved && !Laws::kGrows && to_instant(now_).seconds < kLate;
  if (may_ask_queue && kFew * queue_.size() < bodies_.size()) {
    queue_.for_each([this](Slot slot) { renew_sight(slot); });
  } else {
    for (Slot slot = 0; index(slot) < bodies_.size(); ++slot) renew_sight(slot);
  }
}

/// `run` as the clock of sights shows it from now on, or less, in seconds.
template <class S, class Laws>
double BasicWorld<S, Laws>::seconds_of(double run, [[maybe_unused]] const SightClock& clock) const {
  if constexpr (Laws::kDragged) {
    run = least_time_of_run(run / clock.left, static_cast<double>(laws_.drag));
  }
  if constexpr (Laws::kCurved) run = std::min(run, clock.holds_for);
  return run;
}

template <class S, class Laws>
auto BasicWorld<S, Laws>::common_to_sights([[maybe_unused]] const SightClock& clock) const
    -> Common {
  if constexpr (Laws::kGrows) {
    const double rate = 2 * static_cast<double>(laws_.growth);
    return {rate * clock.now, rate};
  } else {
    return {};
  }
}

/// What moves the disks that fall freely.
template <class S, class Laws>
CommonPull BasicWorld<S, Laws>::common_pull() const {
  CommonPull pull;
  if constexpr (Laws::kCurved) {
    pull.x = detail::rough(laws_.gravity.x);
    pull.y = detail::rough(laws_.gravity.y);
  }
  if constexpr (Laws::kDragged) pull.drag = static_cast<double>(laws_.drag);
  return pull;
}

template <class S, class Laws>
void BasicWorld<S, Laws>::renew_sight(Slot slot) {
  const auto& body = at(slot);
  Seen& sight = bodies_.sight(slot);
  if constexpr (std::is_same_v<Seen, PlainSight>) {
    date(sight, body.since(), sights_.epoch);
  } else if constexpr (Laws::kCurved) {
    sight = has_sights() && falls_freely(slot) ? sight_of_falling(slot) : Sight{};
  } else if constexpr (Laws::kGrows) {
    sight = growing_sight_of(
        body.motion(), body.radius(), body.grown, growth_of(slot), body.type, sights_.epoch);
  } else {
    sight = sight_of(body.motion(), body.radius(), body.type, sights_.epoch);
  }
  if (!has_small_cage(slot)) sight.size = -1;
}

/// A dynamic disk that rests on nothing: gravity and drag alone move it.
template <class S, class Laws>
bool BasicWorld<S, Laws>::falls_freely(Slot slot) const {
  if constexpr (Laws::kCurved) {
    return at(slot).id != kNoId && at(slot).is_dynamic() && at(slot).support == kNoId;
  } else {
    return true;
  }
}

/// Of a motion from before the epoch what is left of it at the beginning.
template <class S, class Laws>
Sight BasicWorld<S, Laws>::sight_of_falling(Slot slot) const {
  const Time<S>& begin = sights_.epoch.begin;
  const auto& body = at(slot);
  const CommonPull pull = common_pull();
  if (!(body.since() < begin))
    return falling_sight_of<S>(body.motion(), body.radius(), pull, {}, sights_.epoch);
  const Motion<S> motion{position_of(slot, begin), velocity_of(slot, begin), begin};
  const FlownBefore before =
      flown_before(body.velocity(), pull, rough_seconds(begin, body.since()));
  return falling_sight_of<S>(motion, body.radius(), pull, before, sights_.epoch);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// The event loop and the resolution of contacts.

#include "basic_world.hpp"
#include "prefetch.hpp"
#include "simultaneous.hpp"
#include "squeeze.hpp"

#include <stoss/engine/check.hpp>

#include <utility>

namespace stoss::engine {

template <class S, class Laws>
Outcome<AdvanceReport> BasicWorld<S, Laws>::advance_to(const Instant& until,
                                                       CollisionSink* sink,
                                                       std::uint64_t max_events) {
  if (!in_range(until)) {
    return Reject{.code = Code::InvalidArgument,
                  .field = "instant",
                  .reason = "the instant is beyond the end of time (2^61 s)"};
  }
  if (until < now()) {
    return Reject{.code = Code::DeadlinePassed,
                  .field = "instant",
                  .reason = "the instant is in the past: the world has moved on"};
  }
  AdvanceReport report;
  due_slot_ = -1;
  const std::uint64_t collisions_before = counters_.collisions;
  const Time<S> end = std::max(now_, from_instant<Time<S>>(until));
  for (Slot slot = next_slot(); slot >= 0 && queue_.event_of(slot).at <= end; slot = next_slot()) {
    if (report.events == max_events) {
      report.stop = Stop::EventBudget;
      break;
    }
    go_on_to(queue_.event_of(slot).at);
    if (!process(slot, sink)) {
      report.stop = Stop::Stalled;
      report.stalled = at(slot).id;
      break;
    }
    ++report.events;
    validate(report.events);
  }
  if (report.stop == Stop::Reached) go_on_to(end);
  report.collisions = counters_.collisions - collisions_before;
  return report;
}

/// The present is then, or later.
template <class S, class Laws>
[[gnu::always_inline]] inline void BasicWorld<S, Laws>::go_on_to(const Time<S>& instant) {
  now_ = std::max(now_, instant);
  if (now_ > sights_.epoch.end) [[unlikely]]
    begin_epoch();
}

/// The slot of the next event, which is known exactly; -1 if there is none.
template <class S, class Laws>
Slot BasicWorld<S, Laws>::next_slot() {
  const auto ids = id_lookup();
  while (!queue_.empty()) {
    const bool opens_bucket = queue_.is_between_buckets();
    const Slot slot = queue_.top(ids);
    if (opens_bucket && is_worth_asking_ahead(kAskAheadFrom)) {
      queue_.for_each_soon_due([this](Slot soon) { prefetch_event(soon); });
    }
    if (!has_guess(slot)) return slot;
    sharpen(slot);
  }
  return -1;
}

/// Are there so many bodies, and so much memory, that asking for it ahead pays?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_worth_asking_ahead(std::size_t bodies_least) const {
  return bodies_.size() >= bodies_least && !all_pairs();
}

/// Asks for what an event that comes up soon will read.
template <class S, class Laws>
void BasicWorld<S, Laws>::prefetch_event(Slot slot) const {
  prefetch_body(slot);
  const Slot partner = queue_.event_of(slot).partner;
  if (partner >= 0) prefetch_body(partner);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::prefetch_body(Slot slot) const {
  bodies_.prefetch_body(slot);
  queue_.prefetch_line(slot);
  neighbours_.prefetch_standing(slot);
}

/// The same for the event after the first, of what can be told once that has come.
template <class S, class Laws>
void BasicWorld<S, Laws>::prefetch_cells_of_second_event() const {
  if (!is_worth_asking_ahead(kAskFurtherFrom)) return;
  const Slot slot = queue_.second();
  if (slot < 0) return;
  const Event<S>& event = queue_.event_of(slot);
  if (event.kind == EventKind::NeighbourRenewal) neighbours_.prefetch_beyond(slot);
  prefetch_cells(slot);
  if (event.partner >= 0) prefetch_cells(event.partner);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::prefetch_cells(Slot slot) const {
  neighbours_.prefetch_place(slot);
  neighbours_.prefetch_list(slot);
  queue_.prefetch_beside(slot);
}

// With STOSS_VALIDATE every so many events the whole world is looked at.
template <class S, class Laws>
void BasicWorld<S, Laws>::validate([[maybe_unused]] std::uint64_t events) const {
#ifdef STOSS_VALIDATE
  constexpr std::uint64_t kEvery = 1024;
  if (events % kEvery != 0) return;
  const Census found = census();
  check(found.overlaps == 0, "two bodies overlap");
  check(found.missed == 0, "a contact was missed");
#endif
}

template <class S, class Laws>
void BasicWorld<S, Laws>::count_towards_stall() {
  if (now_ != crowded_instant_) {
    crowded_instant_ = now_;
    crowd_ = 0;
  }
  ++crowd_;
}

// Told from collisions alone, so that every run stalls at the same one.
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_stalled(const Time<S>& instant) const {
  return crowd_ >= kStallCollisions + 64 * slots_.size() && instant == crowded_instant_;
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::is_stale(const Event<S>& event) const {
  return at(event.partner).changes != event.partner_changes;
}

// False if the event cannot be processed: the world stops before it.
template <class S, class Laws>
bool BasicWorld<S, Laws>::process(Slot slot, CollisionSink* sink) {
  const Event<S>& event = queue_.event_of(slot);  // until the slot is given another
  const Time<S> instant = event.at;
  const bool is_due = std::exchange(due_slot_, -1) == slot;
  if (event.kind == EventKind::NeighbourRenewal) {
    ++counters_.renewals;
    if (has_no_place(slot)) return false;
    bring_on(slot, event);
    return true;
  }
  if constexpr (!Laws::kPlain) {
    if (event.kind == EventKind::Kick) {
      kick(slot, instant);
      return true;
    }
  }
  if constexpr (Laws::kCurved) {
    if (event.partner < 0) {
      process_own_event(slot, instant);
      return true;
    }
  }
  if (is_stale(event)) {
    predict(slot, /*changed=*/false);
    return true;
  }
  if constexpr (!Laws::kPlain) {
    if (is_zone(event.partner)) {
      process_crossing(slot, Event<S>(event), sink);
      return true;
    }
  }
  if (!is_due) {
    const std::optional<Contact> found = contact_of(slot, event.partner);
    check(found.has_value(), "a scheduled contact is no contact of the stored motions");
    due_ = *found;
  }
  check(instant >= now_, "a contact was scheduled in the past");
  const bool both_give_way = at(due_.a).is_dynamic() && at(due_.b).is_dynamic();
  if (has_stalled(instant) || (!both_give_way && is_squeezed(due_))) return false;
  count_towards_stall();
  if (has_sights() && is_worth_asking_ahead(kAskAheadFrom)) {
    for (const Slot own : {due_.a, due_.b}) {
      if (at(own).is_dynamic()) prefetch_sights(own);
    }
  }
  resolve(due_, instant, sink);
  if (!at(slot).is_dynamic()) predict(slot, /*changed=*/false);
  return true;
}

// The body has come to the side of its box.
template <class S, class Laws>
void BasicWorld<S, Laws>::bring_on(Slot slot, const Event<S>& renewal) {
  if (!cross(slot)) {
    renew_box(slot, next_margin(slot));
    return predict(slot, /*changed=*/true);
  }
  prefetch_cells_of_second_event();
  if (!foresee_newcomers(slot, renewal)) predict(slot, /*changed=*/true);
  bring_stragglers_on();
}

// A few with each crossing, so that what is not over yet costs no search for long, and no event
// much.
template <class S, class Laws>
void BasicWorld<S, Laws>::bring_stragglers_on() {
  constexpr int kFew = 4;  // measured: with one it takes three times as long, at the same cost
  for (int i = 0; i < kFew; ++i) {
    const Slot straggler = neighbours_.straggler();
    if (straggler < 0) return;
    renew_box(straggler, next_margin(straggler));
    predict(straggler, /*changed=*/true);
  }
}

/// How far the body flies between two instants, m.
template <class S, class Laws>
double BasicWorld<S, Laws>::hop(Slot slot, const Time<S>& from, const Time<S>& to) const {
  const DoubleWord2<S> v = velocity_of(slot, from);
  const double speed =
      std::abs(static_cast<double>(v.x.hi)) + std::abs(static_cast<double>(v.y.hi));
  const double elapsed = rough_seconds(to, from);
  if constexpr (Laws::kCurved) return (speed + 0.5 * elapsed * pull_of(slot)) * elapsed;
  return speed * elapsed;
}

/// Unit vector from a body to the nearest point of another's image, at now().
template <class S, class Laws>
Vector2 BasicWorld<S, Laws>::normal_towards(Slot from, Slot to, const Which& image) const {
  if (at(from).is_wall()) return -normal_towards(to, from, -image);
  if (at(to).is_wall()) {
    if constexpr (!Laws::kPlain) {
      if (is_periodic()) return normal_to_image(from, to, image);
    }
    const Vector2 centre = detail::rounded(position_of(from, now_));
    const WallState wall = wall_of(to);
    return (detail::nearest_on_segment(wall.start, wall.end, centre) - centre).normalized();
  }
  const Relative r = relative_motion(to, from, now_, image);
  return detail::rounded(r.position).normalized();
}

// A disk between immovable bodies that close in on it bounces without end as the room goes to zero.
// Told from the stored motions alone: a tiny hop, and neighbours that leave it no way out.
// REQUIRES: one of the two is immovable.
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_squeezed(const Contact& contact) const {
  constexpr double kRoom = 1e-4;  // of the radius; chosen: ten thousand hits into the squeeze
  const Slot disk = at(contact.a).is_dynamic() ? contact.a : contact.b;
  const Slot anvil = disk == contact.a ? contact.b : contact.a;
  const double room = kRoom * static_cast<double>(at(disk).radius());
  if (hop(disk, at(disk).since(), now_) > room) return false;
  const auto jaw = [&](Slot other, const Which& image) {
    const Vector2 normal = normal_towards(disk, other, image);
    const double closing = growth_of(disk) + growth_of(other);
    return Jaw{normal, detail::rounded(at(other).velocity()).dot(normal) - closing};
  };
  const Which image_of_anvil = disk == contact.a ? contact.image : -contact.image;
  const Jaw first = jaw(anvil, image_of_anvil);
  std::vector<Jaw> others;
  for_each_neighbour_image(disk, [&](Slot other, const Which& image) {
    if ((other == anvil && image == image_of_anvil) || at(other).is_dynamic()) return;
    if (clearance(disk, other, image) > room) return;
    others.push_back(jaw(other, image));
  });
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (close_in(first, others[i])) return true;
    for (std::size_t j = i + 1; j < others.size(); ++j) {
      if (close_in(first, others[i], others[j])) return true;
    }
  }
  return false;
}

// Another body touches `shared` in such a way that it matters which contact comes first.
template <class S, class Laws>
bool BasicWorld<S, Laws>::depends_on_order(Slot shared,
                                           Slot other,
                                           const Which& image,
                                           const Vector2& normal) const {
  const auto weight = [this](Slot slot) {
    return at(slot).is_dynamic() ? 1 / static_cast<double>(at(slot).mass()) : 0.0;
  };
  if (!at(shared).is_dynamic()) return false;
  bool depends = false;
  for_each_neighbour_image(shared, [&](Slot third, const Which& thirds) {
    if (depends || (third == other && thirds == image)) return;
    if (clearance(shared, third, thirds) > kSimultaneousHop * reach_of(shared, third)) return;
    const Vector2 other_normal = normal_towards(shared, third, thirds);
    depends =
        order_matters_between(normal, other_normal, weight(shared), weight(other), weight(third));
  });
  return depends;
}

/// Is the next event of a disk, but for zones, a contact with hardly a way to go?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_about_to_meet(Slot slot) const {
  const Event<S>& next = queue_.event_of(slot);
  const double tiny = kSimultaneousHop * static_cast<double>(at(slot).radius());
  if (next.partner < 0 || next.kind == EventKind::NeighbourRenewal ||
      hop(slot, now_, next.at) > tiny)
    return false;
  if constexpr (!Laws::kPlain) {
    if (is_zone(next.partner)) {
      const Event<S> meeting = next_but_for_zones(slot);
      return meeting.partner >= 0 && hop(slot, now_, meeting.at) <= tiny;
    }
  }
  return true;
}

// Called after the contact is resolved and its bodies predicted: has one of them just come from
// another contact, or is it just about to enter one? If so, do the two depend on their order?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_simultaneous(const Contact& contact,
                                          const Time<S>& before_a,
                                          const Time<S>& before_b) const {
  const auto crowded = [this](Slot slot, const Time<S>& before) {
    if (!at(slot).is_dynamic()) return false;
    const double tiny = kSimultaneousHop * static_cast<double>(at(slot).radius());
    if (hop(slot, before, now_) <= tiny) return true;
    return is_about_to_meet(slot);
  };
  if (!crowded(contact.a, before_a) && !crowded(contact.b, before_b)) return false;
  const Vector2 normal = normal_towards(contact.a, contact.b, contact.image);
  return depends_on_order(contact.a, contact.b, contact.image, normal) ||
         depends_on_order(contact.b, contact.a, -contact.image, -normal);
}

// From a to b; only its direction matters to the contact law.
template <class S, class Laws>
[[gnu::always_inline]] inline DoubleWord2<S> BasicWorld<S, Laws>::contact_vector(
    const Contact& contact) const {
  if (contact.kind == EventKind::DiskWall) {
    const DoubleWord2<S>& edge = shape(contact.b).edge;
    const DoubleWord2<S> q = Laws::kCurved
                                 ? displacement_at<S>(contact.relative, contact.after_reference)
                                 : contact.relative.position;
    const DoubleWord<S> side = edge.x * q.y - edge.y * q.x;
    return side.hi > S(0) ? DoubleWord2<S>{edge.y, -edge.x} : DoubleWord2<S>{-edge.y, edge.x};
  }
  const DoubleWord2<S> apart = displacement_at<S>(contact.relative, contact.after_reference);
  return contact.kind == EventKind::DiskDisk ? apart : DoubleWord2<S>{-apart.x, -apart.y};
}

template <class S, class Laws>
void BasicWorld<S, Laws>::rebase(Slot slot, const Time<S>& instant) {
  auto&& body = at(slot);
  turn(slot, instant);
  const DoubleWord2<S> position = position_of(slot, instant);
  if constexpr (Laws::kGrows) body.grown = radius_of(slot, instant);
  if constexpr (Laws::kCurved) body.set_velocity(velocity_of(slot, instant));
  body.set_position(position);
  body.set_since(instant);
  ++body.changes;
  if (!all_pairs()) neighbours_.note_event(slot);
  begin_motion(slot, instant);
  note_digest_stale(slot);
  note_change(slot, ChangeKind::Moved);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::resolve(const Contact& contact,
                                  const Time<S>& instant,
                                  CollisionSink* sink) {
  const Time<S> before_a = at(contact.a).since();
  const Time<S> before_b = at(contact.b).since();
  const ContactOutcome outcome = impulse_of(contact, instant);
  const auto kick = [&](Slot slot, const DoubleWord2<S>& delta, const DoubleWord<S>& spin) {
    auto&& body = at(slot);
    if (!body.is_dynamic()) return;
    rebase(slot, instant);
    let_go(slot);
    note_contact(slot, spin, instant);
    body.set_velocity(body.velocity() + delta);
    renew_law(slot);
  };
  kick(contact.a, outcome.impulse.delta_a, outcome.spins.a);
  kick(contact.b, outcome.impulse.delta_b, outcome.spins.b);
  if constexpr (Laws::kCurved) {
    if (outcome.is_last_bounce) settle_down(contact);
  }
  ++counters_.collisions;
  if (outcome.regularised) ++counters_.regularised;
  prefetch_cells_of_second_event();
  predict_both(contact.a, contact.b);
  if (sink == nullptr) return;
  Collision collision = describe(contact, instant, outcome);
  for (const Slot slot : {contact.a, contact.b}) {
    if (has_guess(slot) && is_about_to_meet(slot)) predict_closely(slot, /*changed=*/false);
  }
  collision.order_dependent = is_simultaneous(contact, before_a, before_b);
  sink->on_collision(collision);
}

template <class S, class Laws>
Collision BasicWorld<S, Laws>::describe(const Contact& contact,
                                        const Time<S>& instant,
                                        const ContactOutcome& outcome) const {
  const PairImpulse<S>& impulse = outcome.impulse;
  const auto& a = at(contact.a);
  const auto& b = at(contact.b);
  const DoubleWord2<S> centre = position_of(contact.a, instant);
  const Radius radius = radius_of(contact.a, instant);
  Collision collision;
  collision.sequence = counters_.collisions;
  collision.instant = to_instant(instant);
  collision.kind = static_cast<ContactKind>(static_cast<int>(contact.kind) -
                                            static_cast<int>(EventKind::DiskDisk));
  collision.regularised = outcome.regularised;
  collision.a = a.id;
  collision.b = b.id;
  collision.normal = {static_cast<double>(impulse.normal_x), static_cast<double>(impulse.normal_y)};
  collision.point =
      shown({centre.x + radius * impulse.normal_x, centre.y + radius * impulse.normal_y});
  collision.impulse = static_cast<double>(impulse.impulse);
  collision.approach_speed = static_cast<double>(impulse.approach_speed);
  collision.velocity_a = detail::rounded(a.velocity());
  collision.velocity_b = detail::rounded(b.velocity());
  collision.spin_a = rotation_of(contact.a).spin;
  collision.spin_b = rotation_of(contact.b).spin;
  return collision;
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Predictions: which event is a body's next.

#include "basic_world.hpp"
#include "contact_time/disk_disk.hpp"
#include "screen.hpp"

namespace stoss::engine {

template <class S>
auto BasicWorld<S>::id_lookup() const {
  return [this](Slot slot, const Event<S>& event) {
    const Id own = at(slot).id;
    if (event.kind == EventKind::NeighbourRenewal) return IdPair{own, own};
    const Id other = event.partner_id;
    return own < other ? IdPair{own, other} : IdPair{other, own};
  };
}

template <class S>
bool BasicWorld<S>::interacts(Slot a, Slot b) const {
  return a != b && (at(a).is_dynamic() || at(b).is_dynamic());
}

template <class S>
bool BasicWorld<S>::holds_prediction(Slot holder, Slot other) const {
  const Body<S>& h = at(holder);
  const Body<S>& o = at(other);
  if (h.is_dynamic() != o.is_dynamic()) return h.is_dynamic();
  return !(h.radius > S(kHolderRatioMax) * o.radius);
}

template <class S>
template <class Visit>
void BasicWorld<S>::for_each_neighbour(Slot slot, Visit&& visit) const {
  if (all_pairs()) {
    for (Slot other = 0; index(other) < bodies_.size(); ++other) {
      if (at(other).id != kNoId && interacts(slot, other)) visit(other);
    }
  } else {
    for (const Slot other : neighbours_.of(slot)) visit(other);
  }
}

template <class S>
RelativeMotion<S> BasicWorld<S>::relative_motion(const Motion<S>& of,
                                                 const Motion<S>& from,
                                                 const Time<S>& reference) const {
  const DoubleWord2<S> p = position_at(of, reference);
  const DoubleWord2<S> q = position_at(from, reference);
  return {{p.x - q.x, p.y - q.y},
          {of.velocity.x - from.velocity.x, of.velocity.y - from.velocity.y},
          velocity_grain(of.velocity, from.velocity)};
}

template <class S>
auto BasicWorld<S>::disk_disk_contact_of(Slot a, Slot b) const -> std::optional<Contact> {
  const Body<S>& first = at(a);
  const Body<S>& second = at(b);
  Contact contact{.a = a,
                  .b = b,
                  .kind = EventKind::DiskDisk,
                  .feature = WallFeature::Face,
                  .reference = std::max(first.motion.since, second.motion.since),
                  .relative = {},
                  .after_reference = {}};
  contact.relative = relative_motion(second.motion, first.motion, contact.reference);
  const auto after = disk_disk_contact<S>(contact.relative, two_sum(first.radius, second.radius));
  if (!after) return std::nullopt;
  contact.after_reference = *after;
  return contact;
}

template <class S>
DoubleWord2<S> BasicWorld<S>::edge_from(const WallEnd& vertex) const {
  const DoubleWord2<S>& edge = shape(vertex.wall).edge;
  return vertex.end == 0 ? edge : DoubleWord2<S>{-edge.x, -edge.y};
}

template <class S>
RelativeMotion<S> BasicWorld<S>::motion_from_end(const RelativeMotion<S>& from_start,
                                                 Slot wall,
                                                 int end) const {
  if (end == 0) return from_start;
  const DoubleWord2<S>& edge = shape(wall).edge;
  return {{from_start.position.x - edge.x, from_start.position.y - edge.y},
          from_start.velocity,
          from_start.grain};
}

// At a shared vertex a contact belongs to a face if the centre then projects inside one of the
// walls that meet there: the disk already touches or has left that face, and the vertex is not in
// its way.
template <class S>
bool BasicWorld<S>::hidden_by_faces(const RelativeMotion<S>& from_vertex,
                                    Slot wall,
                                    int end,
                                    const Duration<S>& after) const {
  if (projects_inside<S>(from_vertex, edge_from({wall, end}), after)) return true;
  for (const WallEnd& other : shape(wall).incident[static_cast<std::size_t>(end)]) {
    if (projects_inside<S>(from_vertex, edge_from(other), after)) return true;
  }
  return false;
}

template <class S>
auto BasicWorld<S>::disk_wall_contact_of(Slot disk, Slot wall) const -> std::optional<Contact> {
  const Body<S>& d = at(disk);
  const Body<S>& w = at(wall);
  const Time<S> reference = std::max(d.motion.since, w.motion.since);
  const RelativeMotion<S> from_start = relative_motion(d.motion, w.motion, reference);
  std::optional<Contact> best;
  const auto consider = [&](EventKind kind,
                            WallFeature feature,
                            const RelativeMotion<S>& relative,
                            const Duration<S>& after) {
    const bool sooner =
        !best || after.hi < best->after_reference.hi ||
        (after.hi == best->after_reference.hi && after.lo < best->after_reference.lo);
    if (sooner) best = Contact{disk, wall, kind, feature, reference, relative, after};
  };
  if (const auto after = disk_wall_face_contact<S>(from_start, shape(wall).edge, d.radius)) {
    consider(EventKind::DiskWall, WallFeature::Face, from_start, *after);
  }
  for (int end = 0; end < 2; ++end) {
    const RelativeMotion<S> from_end = motion_from_end(from_start, wall, end);
    const auto after = disk_point_contact<S>(from_end, d.radius);
    if (!after || hidden_by_faces(from_end, wall, end, *after)) continue;
    consider(
        EventKind::DiskWallEnd, end == 0 ? WallFeature::Start : WallFeature::End, from_end, *after);
  }
  return best;
}

template <class S>
auto BasicWorld<S>::contact_of(Slot i, Slot j) const -> std::optional<Contact> {
  if (at(j).is_wall()) return disk_wall_contact_of(i, j);
  if (at(i).is_wall()) return disk_wall_contact_of(j, i);
  return at(i).id < at(j).id ? disk_disk_contact_of(i, j) : disk_disk_contact_of(j, i);
}

template <class S>
std::optional<Event<S>> BasicWorld<S>::event_with(Slot holder, Slot partner) const {
  const std::optional<Contact> contact = contact_of(holder, partner);
  if (!contact) return std::nullopt;
  const auto instant =
      later_by(contact->reference, contact->after_reference.hi, contact->after_reference.lo);
  if (!instant) return std::nullopt;
  return Event<S>{*instant, partner, at(partner).changes, contact->kind, at(partner).id};
}

// When the body's displacement from its box's anchor reaches the margin, a little early.
template <class S>
Event<S> BasicWorld<S>::renewal_event(Slot slot, const Glance& here) const {
  Event<S> event;
  if (all_pairs()) return event;
  if (here.vx == 0 && here.vy == 0) return event;
  constexpr double kEarly = 1 - kScreenSlack<S>;
  const Glance& anchor = neighbours_.anchor(slot);
  const double margin = neighbours_.margin(slot) * kEarly;
  const double moved_x = (here.x - anchor.x) + (here.x_low - anchor.x_low);
  const double moved_y = (here.y - anchor.y) + (here.y_low - anchor.y_low);
  double after = std::numeric_limits<double>::infinity();
  if (here.vx != 0) {
    after =
        std::min(after, (margin - std::copysign(moved_x, moved_x * here.vx)) / std::abs(here.vx));
  }
  if (here.vy != 0) {
    after =
        std::min(after, (margin - std::copysign(moved_y, moved_y * here.vy)) / std::abs(here.vy));
  }
  if (const auto instant = later_by(now_, S(std::max(after, 0.0)), S(0))) event.at = *instant;
  return event;
}

/// Seconds until an event, a little more; infinity for one that never comes.
template <class S>
double BasicWorld<S>::horizon_of(const Event<S>& event) const {
  if (event.at == Time<S>::never()) return std::numeric_limits<double>::infinity();
  return rough_seconds(event.at, now_) + 1e-15;
}

// Can the two meet within `horizon` seconds? A "no" is certain.
template <class S>
bool BasicWorld<S>::may_meet(Slot slot, const Glance& here, Slot other, double horizon) const {
  const Body<S>& own = at(slot);
  const Body<S>& theirs = at(other);
  const Glance there = glance<S>(theirs.motion, now_);
  if (own.is_wall() || theirs.is_wall()) {
    const DoubleWord2<S>& edge = own.is_wall() ? shape(slot).edge : shape(other).edge;
    const auto radius = static_cast<double>(own.is_wall() ? theirs.radius : own.radius);
    return disk_may_meet_wall(own.is_wall() ? there : here,
                              own.is_wall() ? here : there,
                              radius,
                              static_cast<double>(edge.x.hi),
                              static_cast<double>(edge.y.hi),
                              horizon,
                              kScreenSlack<S>);
  }
  const double reach = static_cast<double>(own.radius) + static_cast<double>(theirs.radius);
  return disks_may_meet(here, there, reach, horizon, kScreenSlack<S>);
}

// Finds the body's next event among those that it holds. If the body has changed, the pairs that
// its neighbours hold are offered to them.
template <class S>
void BasicWorld<S>::predict(Slot slot, bool changed) {
  const auto ids = id_lookup();
  const Glance here = glance<S>(at(slot).motion, now_);
  Event<S> best = renewal_event(slot, here);
  double horizon = horizon_of(best);
  for_each_neighbour(slot, [&](Slot other) {
    if (holds_prediction(slot, other)) {
      if (!may_meet(slot, here, other, horizon)) return;
      const auto event = event_with(slot, other);
      if (!event || !earlier(*event, slot, best, slot, ids)) return;
      best = *event;
      horizon = horizon_of(best);
    } else if (changed) {
      const Event<S>& theirs = queue_.event_of(other);
      if (!may_meet(slot, here, other, horizon_of(theirs))) return;
      const auto event = event_with(other, slot);
      if (event && earlier(*event, other, theirs, other, ids)) queue_.set(other, *event, ids);
    }
  });
  if (!all_pairs()) neighbours_.note_work(slot);
  queue_.set(slot, best, ids);
}

/// The body's extent at now(), in doubles, and what rounding may add to it.
template <class S>
Aabb BasicWorld<S>::tight_box(Slot slot) const {
  const Body<S>& body = at(slot);
  const Glance here = glance<S>(body.motion, now_);
  const double x = here.x + here.x_low;
  const double y = here.y + here.y_low;
  const double r = static_cast<double>(body.radius) * (1 + kScreenSlack<S>)+here.error;
  const Aabb box{x - r, y - r, x + r, y + r};
  if (!body.is_wall()) return box;
  const DoubleWord2<S>& edge = shape(slot).edge;
  const double edge_x = static_cast<double>(edge.x.hi) + static_cast<double>(edge.x.lo);
  const double edge_y = static_cast<double>(edge.y.hi) + static_cast<double>(edge.y.lo);
  return merged(box,
                {box.low_x + edge_x, box.low_y + edge_y, box.high_x + edge_x, box.high_y + edge_y});
}

// A margin that the body needs some time to cross, so that renewals cannot crowd into an instant.
template <class S>
double BasicWorld<S>::smallest_margin(Slot slot) const {
  constexpr double kShortestCrossing = 1e-9;  // s; chosen: far above the resolution of an Instant
  constexpr double kPartOfRadius = 1e-3;
  const Motion<S>& motion = at(slot).motion;
  const double speed = std::abs(static_cast<double>(motion.velocity.x.hi)) +
                       std::abs(static_cast<double>(motion.velocity.y.hi));
  return std::max(speed * kShortestCrossing, static_cast<double>(at(slot).radius) * kPartOfRadius);
}

template <class S>
void BasicWorld<S>::renew_box(Slot slot, double margin) {
  if (all_pairs()) return;
  neighbours_.renew(slot,
                    tight_box(slot),
                    glance<S>(at(slot).motion, now_),
                    std::max(margin, smallest_margin(slot)),
                    [this, slot](Slot other) { return interacts(slot, other); });
}

}  // namespace stoss::engine

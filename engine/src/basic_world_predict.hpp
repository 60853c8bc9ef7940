// SPDX-License-Identifier: Apache-2.0
#pragma once

// Predictions: which event is a body's next.

#include "basic_world.hpp"
#include "contact_time/disk_disk.hpp"
#include "screen.hpp"

namespace stoss::engine {

template <class S, class Laws>
auto BasicWorld<S, Laws>::id_lookup() const {
  return [this](Slot slot, const Event<S>& event) {
    const Id own = at(slot).id;
    if (event.partner < 0) return IdPair{own, own};
    const Id other = event.partner_id;
    return own < other ? IdPair{own, other} : IdPair{other, own};
  };
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::interacts(Slot a, Slot b) const {
  if constexpr (!Laws::kPlain) {
    if (is_zone(a) || is_zone(b)) return is_zone_and_disk(a, b);
  }
  return a != b && (at(a).is_dynamic() || at(b).is_dynamic());
}

// Of two bodies whose boxes overlap: can they meet before one of them leaves its box? Beside a
// slanted wall, whose box is wide, disks are told apart by their distance from its line.
template <class S, class Laws>
bool BasicWorld<S, Laws>::may_become_close(Slot a, const Aabb& box_of_a, Slot b) const {
  if (!interacts(a, b)) return false;
  if (is_periodic()) return true;
  if (at(a).is_wall()) return !is_far_from_line(a, neighbours_.box_of(b));
  if (at(b).is_wall()) return !is_far_from_line(b, box_of_a);
  return true;
}

/// Does the box lie on one side of the wall's line, wherever the wall may go within its margin?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_far_from_line(Slot wall, const Aabb& box) const {
  const DoubleWord2<S>& edge = shape(wall).edge;
  const auto ex = static_cast<double>(edge.x.hi);
  const auto ey = static_cast<double>(edge.y.hi);
  const auto [anchor, margin] = neighbours_.leeway(wall);
  const double x = 0.5 * box.low_x + 0.5 * box.high_x - (anchor.x + anchor.x_low);
  const double y = 0.5 * box.low_y + 0.5 * box.high_y - (anchor.y + anchor.y_low);
  const double half_x = 0.5 * (box.high_x - box.low_x) + margin;
  const double half_y = 0.5 * (box.high_y - box.low_y) + margin;
  const double off = kScreenSlack<S> * (std::abs(x) + std::abs(y) + half_x + half_y) +
                     4e-16 * (std::abs(anchor.x) + std::abs(anchor.y));
  // Written so that a NaN from overflow means "near".
  return std::abs(ex * y - ey * x) > std::abs(ex) * (half_y + off) + std::abs(ey) * (half_x + off);
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::holds_prediction(Slot holder, Slot other) const {
  const auto& h = at(holder);
  const auto& o = at(other);
  if constexpr (!Laws::kPlain) {
    if (is_zone(holder) || is_zone(other)) return is_zone(other);
  }
  if (h.is_dynamic() != o.is_dynamic()) return h.is_dynamic();
  return !(h.radius() > S(kHolderRatioMax) * o.radius());
}

template <class S, class Laws>
template <class Visit>
void BasicWorld<S, Laws>::for_each_neighbour(Slot slot, Visit&& visit) const {
  if (all_pairs()) {
    for (Slot other = 0; index(other) < bodies_.size(); ++other) {
      if (at(other).id != kNoId && interacts(slot, other)) visit(other);
    }
  } else if (at(slot).is_dynamic()) {
    neighbours_.for_each(slot, visit);
  } else {
    if constexpr (!Laws::kPlain) {
      if (is_periodic()) {
        for (const Slot other : found_around(slot)) visit(other);
        return;
      }
    }
    const Aabb box = neighbours_.box_of(slot);
    neighbours_.query(box, [&](Slot other) {
      if (may_become_close(slot, box, other)) visit(other);
    });
  }
}

template <class S, class Laws>
[[gnu::always_inline]] inline auto BasicWorld<S, Laws>::relative_motion(
    Slot of, Slot from, const Time<S>& reference, const Which& image) const -> Relative {
  if constexpr (Laws::kDragged) {
    const Flight<S> a = flight_of(of, reference);
    const Flight<S> b = flight_of(from, reference);
    return {{apart(a.position, b.position, image),
             a.velocity - b.velocity,
             at(of).acceleration - at(from).acceleration,
             velocity_grain(a.velocity, b.velocity)},
            laws_.drag};
  }
  const DoubleWord2<S> position =
      apart(position_of(of, reference), position_of(from, reference), image);
  const DoubleWord2<S> v = velocity_of(of, reference);
  const DoubleWord2<S> u = velocity_of(from, reference);
  if constexpr (Laws::kCurved) {
    return {position, v - u, at(of).acceleration - at(from).acceleration, velocity_grain(v, u)};
  } else {
    return {position, v - u, velocity_grain(v, u)};
  }
}

template <class S, class Laws>
auto BasicWorld<S, Laws>::disk_disk_contact_of(Slot a, Slot b, const Which& image) const
    -> std::optional<Contact> {
  const Time<S> reference = std::max(at(a).since(), at(b).since());
  const Relative relative = relative_motion(b, a, reference, image);
  const auto after =
      Laws::pair_contact(relative, reach_between(a, b, reference), valid_for(a, b, reference));
  if (!after) return std::nullopt;
  return Contact{.a = a,
                 .b = b,
                 .kind = EventKind::DiskDisk,
                 .feature = WallFeature::Face,
                 .reference = reference,
                 .relative = relative,
                 .after_reference = *after,
                 .image = image};
}

template <class S, class Laws>
DoubleWord2<S> BasicWorld<S, Laws>::edge_from(const WallEnd& vertex) const {
  const DoubleWord2<S>& edge = shape(vertex.wall).edge;
  return vertex.end == 0 ? edge : DoubleWord2<S>{-edge.x, -edge.y};
}

template <class S, class Laws>
auto BasicWorld<S, Laws>::motion_from_end(const Relative& from_start, Slot wall, int end) const
    -> Relative {
  Relative from_end = from_start;
  if (end != 0) from_end.position = from_start.position - shape(wall).edge;
  return from_end;
}

// At a shared vertex a contact belongs to a face if the centre then projects inside one of the
// walls that meet there: the disk already touches or has left that face, and the vertex is not in
// its way.
template <class S, class Laws>
bool BasicWorld<S, Laws>::hidden_by_faces(const Relative& from_vertex,
                                          Slot wall,
                                          int end,
                                          const Duration<S>& after,
                                          bool has_left_face) const {
  if (!has_left_face && projects_inside(from_vertex, edge_from({wall, end}), after)) return true;
  for (const WallEnd& other : shape(wall).incident[static_cast<std::size_t>(end)]) {
    if (projects_inside(from_vertex, edge_from(other), after)) return true;
  }
  return false;
}

template <class S, class Laws>
auto BasicWorld<S, Laws>::disk_wall_contact_of(Slot disk, Slot wall, const Which& image) const
    -> std::optional<Contact> {
  const auto& d = at(disk);
  const auto& w = at(wall);
  const Time<S> reference = std::max(d.since(), w.since());
  const Relative from_start = relative_motion(disk, wall, reference, -image);
  const S valid = valid_for(disk, wall, reference);
  const auto radius = radius_in_contact(disk, reference);
  std::optional<Contact> best;
  const auto consider =
      [&](EventKind kind, WallFeature feature, const Relative& relative, const Duration<S>& after) {
        const bool sooner =
            !best || after.hi < best->after_reference.hi ||
            (after.hi == best->after_reference.hi && after.lo < best->after_reference.lo);
        if (sooner) best = Contact{disk, wall, kind, feature, reference, relative, after, image};
      };
  // A disk that has slid off a face at an end does not come back to it but by way of that end.
  bool has_left_face = false;
  if constexpr (Laws::kCurved)
    has_left_face = d.slid_off == w.id && rest_images(disk).slid_off == image;
  if (!has_left_face) {
    if (const auto after = Laws::face_contact(from_start, shape(wall).edge, radius, valid)) {
      consider(EventKind::DiskWall, WallFeature::Face, from_start, *after);
    }
  }
  for (int end = 0; end < 2; ++end) {
    const Relative from_end = motion_from_end(from_start, wall, end);
    const auto after = Laws::point_contact(from_end, radius, valid);
    if (!after || hidden_by_faces(from_end, wall, end, *after, has_left_face)) continue;
    consider(
        EventKind::DiskWallEnd, end == 0 ? WallFeature::Start : WallFeature::End, from_end, *after);
  }
  return best;
}

template <class S, class Laws>
auto BasicWorld<S, Laws>::contact_of(Slot i, Slot j) const -> std::optional<Contact> {
  const bool as_they_stand = at(j).is_wall() || (!at(i).is_wall() && at(i).id < at(j).id);
  const Slot a = as_they_stand ? i : j;
  const Slot b = as_they_stand ? j : i;
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) return first_contact_of(a, b);
  }
  return contact_with(a, b, {});
}

// REQUIRES: in the order of a Contact.
template <class S, class Laws>
auto BasicWorld<S, Laws>::contact_with(Slot a, Slot b, const Which& image) const
    -> std::optional<Contact> {
  if constexpr (Laws::kCurved) {
    if (rests_on(a, b, image)) return std::nullopt;
  }
  return at(b).is_wall() ? disk_wall_contact_of(a, b, image) : disk_disk_contact_of(a, b, image);
}

template <class S, class Laws>
std::optional<Event<S>> BasicWorld<S, Laws>::event_with(Slot holder, Slot partner) const {
  if constexpr (!Laws::kPlain) {
    if (is_zone(partner)) return zone_event_of(holder, partner);
  }
  const std::optional<Contact> contact = contact_of(holder, partner);
  if (!contact) return std::nullopt;
  return event_of(*contact, partner);
}

template <class S, class Laws>
[[gnu::always_inline]] inline std::optional<Event<S>> BasicWorld<S, Laws>::event_of(
    const Contact& contact, Slot partner) const {
  const auto instant =
      later_by(contact.reference, contact.after_reference.hi, contact.after_reference.lo);
  if (!instant) return std::nullopt;
  return Event<S>{*instant, partner, at(partner).changes, contact.kind, at(partner).id};
}

// When the body's displacement from its box's anchor reaches the margin, a little early.
template <class S, class Laws>
Event<S> BasicWorld<S, Laws>::renewal_event(Slot slot, const Glance& here) const {
  Event<S> event;
  if (all_pairs() && !is_periodic()) return event;
  const double after = time_in_box(slot, here);
  if (const auto instant = later_by(now_, S(after), S(0))) event.at = *instant;
  return event;
}

/// For how long that displacement stays below the margin, s; infinity if it does for ever.
template <class S, class Laws>
double BasicWorld<S, Laws>::time_in_box(Slot slot, const Glance& here) const {
  double after = std::numeric_limits<double>::infinity();
  double pull = 0;
  if constexpr (Laws::kCurved) pull = pull_of(slot);
  const double growth = growth_of(slot);
  if (here.vx == 0 && here.vy == 0 && pull == 0 && growth == 0) return after;
  constexpr double kEarly = 1 - kScreenSlack<S>;
  const Neighbours::Leeway leeway = leeway_of(slot);
  const Neighbours::Anchor& anchor = leeway.anchor;
  double margin = leeway.margin * kEarly;
  if constexpr (Laws::kGrows) margin -= radius_now(slot) - at(slot).boxed_radius;
  const double moved_x = (here.x - anchor.x) + (here.x_low - anchor.x_low);
  const double moved_y = (here.y - anchor.y) + (here.y_low - anchor.y_low);
  const auto leave = [&](double moved, double v) {
    if constexpr (Laws::kDragged) {  // the drag ends the motion before
      const double way = margin - std::abs(moved);
      const bool is_held = pull == 0 && at(slot).is_dynamic();
      if (is_held && std::abs(v) < static_cast<double>(laws_.drag) * way) return;
    }
    if constexpr (Laws::kCurved) {
      after = std::min({after,
                        shortest_crossing(margin - moved, std::max(v, 0.0), pull),
                        shortest_crossing(margin + moved, std::max(-v, 0.0), pull)});
    } else if constexpr (Laws::kGrows) {
      after = std::min(after, (margin - std::abs(moved)) / (std::abs(v) + growth));
    } else if (v != 0) {
      after = std::min(after, (margin - std::copysign(moved, moved * v)) / std::abs(v));
    }
  };
  leave(moved_x, here.vx);
  leave(moved_y, here.vy);
  if constexpr (!Laws::kCurved) after = std::min(after, kLongestWait);
  return std::max(after, 0.0);
}

/// Seconds until an event, a little more; infinity for one that never comes.
template <class S, class Laws>
double BasicWorld<S, Laws>::horizon_of(const Event<S>& event) const {
  if (event.at == Time<S>::never()) return std::numeric_limits<double>::infinity();
  return rough_seconds(event.at, now_) + 1e-15;
}

// Can the two meet within `horizon` seconds? A "no" is certain.
template <class S, class Laws>
bool BasicWorld<S, Laws>::may_meet(Slot slot,
                                   const Glance& here,
                                   Slot other,
                                   double horizon) const {
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) return may_meet_some_image(slot, here, other, horizon);
  }
  return may_meet_at(slot, here, other, glance_of(other), horizon);
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::may_meet_at(
    Slot slot, const Glance& here, Slot other, const Glance& there, double horizon) const {
  const auto& own = at(slot);
  const auto& theirs = at(other);
  double bend = 0;  // by how far accelerations can lead off the straight line, or disks grow, m
  if (fly_straight(slot, other)) {
    if constexpr (Laws::kDragged)
      horizon = std::min(horizon, kLastOfDrag / static_cast<double>(laws_.drag));
  } else if constexpr (Laws::kCurved) {
    const double pull = bend_of(slot, here) + bend_of(other, there);
    bend = 0.5 * horizon * horizon * pull * (1 + kScreenSlack<S>);
    if (!(bend < std::numeric_limits<double>::infinity())) return true;
  }
  if constexpr (Laws::kGrows) {
    bend = horizon * (growth_of(slot) + growth_of(other)) * (1 + kScreenSlack<S>);
    if (!(bend < std::numeric_limits<double>::infinity())) return true;
  }
  if constexpr (!Laws::kPlain) {
    if (is_zone(slot) || is_zone(other)) {
      return may_cross(slot, here, other, there, horizon, bend);
    }
  }
  if (own.is_wall() || theirs.is_wall()) {
    const DoubleWord2<S>& edge = own.is_wall() ? shape(slot).edge : shape(other).edge;
    const auto radius = radius_now(own.is_wall() ? other : slot) + bend;
    return disk_may_meet_wall(own.is_wall() ? there : here,
                              own.is_wall() ? here : there,
                              radius,
                              static_cast<double>(edge.x.hi),
                              static_cast<double>(edge.y.hi),
                              horizon,
                              kScreenSlack<S>);
  }
  const double reach = radius_now(slot) + radius_now(other) + bend;
  if constexpr (Laws::kCurved || Laws::kGrows) {
    if (disks_are_within(here, there, reach, kScreenSlack<S>)) return true;  // they may turn back
  }
  return disks_may_meet(here, there, reach, horizon, kScreenSlack<S>);
}

// Finds the body's next event among those that it holds. If the body has changed, the pairs that
// its neighbours hold are offered to them.
template <class S, class Laws>
void BasicWorld<S, Laws>::predict(Slot slot, bool changed) {
  if (has_sights()) return foresee(slot, changed);
  if (!all_pairs()) neighbours_.note_work(slot);
  predict_closely(slot, changed);
}

// Two bodies that have met, of which one may give way alone.
template <class S, class Laws>
void BasicWorld<S, Laws>::predict_both(Slot a, Slot b) {
  const bool is_a = at(a).is_dynamic(), is_b = at(b).is_dynamic();
  if (is_a && is_b && has_sights()) return foresee_both(a, b);
  if (is_a) predict(a, /*changed=*/true);
  if (is_b) predict(b, /*changed=*/true);
}

// By the kernels: the event is exact.
template <class S, class Laws>
void BasicWorld<S, Laws>::predict_closely(Slot slot, bool changed) {
  const auto ids = id_lookup();
  const Glance here = glance_of(slot);
  Event<S> best = renewal_event(slot, here);
  if constexpr (!Laws::kPlain) {
    const auto own = own_event(slot);
    if (own && earlier(*own, slot, best, slot, ids)) best = *own;
  }
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
  queue_.set(slot, best, ids);
}

/// The body's extent at now(), in doubles, and what rounding may add to it.
template <class S, class Laws>
Aabb BasicWorld<S, Laws>::tight_box(Slot slot) const {
  return tight_box(slot, glance_of(slot));
}

template <class S, class Laws>
Aabb BasicWorld<S, Laws>::tight_box(Slot slot, const Glance& here) const {
  const auto& body = at(slot);
  const double x = here.x + here.x_low;
  const double y = here.y + here.y_low;
  const double r = radius_now(slot) * (1 + kScreenSlack<S>)+here.error;
  const Aabb box{x - r, y - r, x + r, y + r};
  if (!body.is_wall()) return box;
  const DoubleWord2<S>& edge = shape(slot).edge;
  const double edge_x = static_cast<double>(edge.x.hi) + static_cast<double>(edge.x.lo);
  const double edge_y = static_cast<double>(edge.y.hi) + static_cast<double>(edge.y.lo);
  return merged(box,
                {box.low_x + edge_x, box.low_y + edge_y, box.high_x + edge_x, box.high_y + edge_y});
}

// A margin that the body needs some time to cross, so that renewals cannot crowd into an instant.
template <class S, class Laws>
double BasicWorld<S, Laws>::smallest_margin(Slot slot) const {
  constexpr double kShortestCrossing = 1e-9;  // s; chosen: far above the resolution of an Instant
  constexpr double kPartOfRadius = 1e-3;
  const DoubleWord2<S> v = velocity_of(slot, now_);
  const double speed = std::abs(static_cast<double>(v.x.hi)) +
                       std::abs(static_cast<double>(v.y.hi)) + growth_of(slot);
  return std::max(speed * kShortestCrossing,
                  static_cast<double>(at(slot).radius()) * kPartOfRadius);
}

/// Of a body that comes in. A zone's box is never renewed, and needs no room to move.
template <class S, class Laws>
double BasicWorld<S, Laws>::first_margin(Slot slot) const {
  if constexpr (!Laws::kPlain) {
    if (is_zone(slot)) return 0;
  }
  return static_cast<double>(at(slot).radius());
}

template <class S, class Laws>
void BasicWorld<S, Laws>::renew_box(Slot slot, double margin) {
  const Role role = at(slot).is_dynamic() ? Role::DynamicDisk
                    : at(slot).is_disk()  ? Role::FixedDisk
                                          : Role::Wall;  // zones are as large
  if constexpr (Laws::kGrows) at(slot).boxed_radius = radius_now(slot);
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      renew_cage(slot, role, margin);
      return;
    }
  }
  if (all_pairs()) return;
  const Glance here = glance_of(slot);
  const double least = smallest_margin(slot);
  neighbours_.renew(
      slot,
      role,
      tight_box(slot, here),
      here,
      {std::max(margin, least), least, /*may_stand_in_cells=*/!Laws::kGrows},
      [this, slot](Slot other, const Aabb& box) { return may_become_close(slot, box, other); });
}

/// Brings a disk that has come to the side of its cell to the next. False, and nothing is done,
/// where its box should be renewed.
template <class S, class Laws>
bool BasicWorld<S, Laws>::cross(Slot slot) {
  if (Laws::kGrows || is_periodic() || all_pairs() || !at(slot).is_dynamic()) return false;
  const Vector2 here = rough_place_of(slot);
  const auto interacts = [&](Slot other, const Aabb& box) {
    return may_become_close(slot, box, other);
  };
  return neighbours_.cross(slot, here.x(), here.y(), interacts);
}

}  // namespace stoss::engine

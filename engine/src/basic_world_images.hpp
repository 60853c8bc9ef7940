// SPDX-License-Identifier: Apache-2.0
#pragma once

// Periodic worlds: which images of two bodies may meet, and where bodies are shown (periodic.hpp).
//
// A body's box is kept for the image that was in [0, L) when the box was made. Two boxes tell which
// images of a pair may meet before one of the bodies renews its box, so a contact is a pure
// function of the two motions and of the image, and the earliest contact of the images that the
// boxes let meet is the pair's next one. Worlds that look at all pairs renew boxes too, with a
// margin of their own; no bit of a result depends on it.

#include "basic_world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace stoss::engine {

/// A wall may be this many periods long. Chosen: longer ones have more images than sense.
inline constexpr double kWallPeriodsMax = 1024;
/// A small cage and its margin reach so far from its middle, at most; periods. Chosen: a little
/// below a quarter, for two of them together.
inline constexpr double kSmallCage = 0.249;
/// Periods that a body may cross in a second when a command sets it off. Chosen: boxes that it
/// needs a nanosecond to leave are then a period large.
inline constexpr double kPeriodsPerSecondMax = 0x1p30;

template <class S, class Laws>
bool BasicWorld<S, Laws>::is_periodic() const {
  if constexpr (Laws::kPlain) {
    return false;
  } else {
    return space_.is_periodic();
  }
}

/// m; zero along an open axis.
template <class S, class Laws>
DoubleWord2<S> BasicWorld<S, Laws>::period_words() const {
  if constexpr (Laws::kPlain) {
    return {};
  } else {
    return space_.period;
  }
}

template <class S, class Laws>
Vector2 BasicWorld<S, Laws>::period() const {
  if constexpr (Laws::kPlain) {
    return Vector2::Zero();
  } else {
    return space_.as_asked;
  }
}

/// Calls visit(image) for each image of b, as a sees it, that a may meet before one of them renews
/// its box.
template <class S, class Laws>
template <class Visit>
void BasicWorld<S, Laws>::for_each_image(Slot a, Slot b, Visit&& visit) const {
  if constexpr (Laws::kPlain) {
    visit(Which{});
  } else {
    if (!is_periodic()) {
      visit(Which{});
      return;
    }
    const Cage& of_a = space_.cage(a);
    const Cage& of_b = space_.cage(b);
    space_.for_each_meeting(of_a.box, of_a.home, of_b.box, of_b.home, visit);
  }
}

template <class S, class Laws>
template <class Visit>
void BasicWorld<S, Laws>::for_each_neighbour_image(Slot slot, Visit&& visit) const {
  for_each_neighbour(slot, [&](Slot other) {
    if (is_zone(other)) return;  // it is met by nobody
    for_each_image(slot, other, [&](const Which& image) { visit(other, image); });
  });
}

/// Whom a body without a list may meet, some image of them.
template <class S, class Laws>
std::vector<Slot> BasicWorld<S, Laws>::found_around(Slot slot) const {
  std::vector<Slot> found;
  for_each_stored_copy(neighbours_.box_of(slot), [&](const Aabb& copy) {
    neighbours_.query(copy, [&](Slot other) {
      if (interacts(slot, other)) found.push_back(other);
    });
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template <class S, class Laws>
void BasicWorld<S, Laws>::leave_lists(Slot slot) {
  if (all_pairs()) return;
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      neighbours_.remove(
          slot, [this](const Aabb& box, const auto& visit) { space_.for_each_copy(box, visit); });
      return;
    }
  }
  neighbours_.remove(slot);
}

// Of images met at one instant the lowest comes first. REQUIRES: in the order of a Contact.
template <class S, class Laws>
auto BasicWorld<S, Laws>::first_contact_of(Slot a, Slot b) const -> std::optional<Contact> {
  std::optional<Contact> first;
  for_each_image(a, b, [&](const Which& image) {
    const auto contact = contact_with(a, b, image);
    if (!contact) return;
    const Duration<S>& t = contact->after_reference;
    if (first) {
      const Duration<S>& best = first->after_reference;
      if (!(t.hi < best.hi || (t.hi == best.hi && t.lo < best.lo))) return;
    }
    first = contact;
  });
  return first;
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::may_meet_some_image(Slot slot,
                                              const Glance& here,
                                              Slot other,
                                              double horizon) const {
  const Glance there = glance_of(other);
  bool may = false;
  for_each_image(slot, other, [&](const Image& image) {
    may = may || may_meet_at(slot, here, other, space_.image_of(there, image), horizon);
  });
  return may;
}

/// As normal_towards(), for a disk and a wall.
template <class S, class Laws>
Vector2 BasicWorld<S, Laws>::normal_to_image(Slot disk, Slot wall, const Image& image) const {
  const Vector2 centre = detail::rounded(relative_motion(disk, wall, now_, -image).position);
  const Vector2 edge = detail::rounded(shape(wall).edge);
  return (detail::nearest_on_segment(Vector2::Zero(), edge, centre) - centre).normalized();
}

// Margins end at half a period, so that few images come into question.
template <class S, class Laws>
void BasicWorld<S, Laws>::renew_cage(Slot slot, Role role, double margin) {
  constexpr double kOfAllPairs = 0.25;
  double largest = (all_pairs() ? kOfAllPairs : 0.5) * space_.smallest();
  if (growth_of(slot) > 0) {  // it is looked at before it can touch itself
    largest = std::min(largest, 0.5 * (0.5 * space_.smallest() - radius_now(slot)));
  }
  if (all_pairs()) margin = largest;
  // Where a disk's cage can be small enough for has_small_cage(), it is made so.
  const double small = 0.5 * (kSmallCage * space_.smallest() - radius_now(slot));
  if (!all_pairs() && role == Role::DynamicDisk && 2 * small > radius_now(slot))
    largest = std::min(largest, small);
  margin = std::max(std::min(margin, largest), smallest_margin(slot));
  const Glance here = glance_of(slot);
  const auto home = [](double x, double length) {
    return length > 0 ? -static_cast<std::int64_t>(std::floor(x / length)) : 0;
  };
  const Image image{home(here.x + here.x_low, space_.length_x),
                    home(here.y + here.y_low, space_.length_y)};
  const Aabb tight = tight_box(slot, space_.image_of(here, image));
  if (index(slot) >= space_.cages.size()) space_.cages.resize(index(slot) + 1);
  space_.cages[index(slot)] = {
      grown(tight, margin), image, {here.x, here.y, here.x_low, here.y_low}, margin};
  space_.bounds = merged(space_.bounds, space_.cages[index(slot)].box);
  if (all_pairs()) return;
  renew_sight(slot);
  neighbours_.renew(
      slot,
      role,
      tight,
      here,
      {margin, margin, /*may_stand_in_cells=*/false},
      [this, slot](Slot other, const Aabb&) { return interacts(slot, other); },
      [this](const Aabb& box, const auto& visit) { space_.for_each_copy(box, visit); });
}

/// Do two bodies like this one meet by their nearest images alone, before one of them renews its
/// cage? Their boxes overlap for no other image, and their centres are less than half a period from
/// each other by that one.
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_small_cage([[maybe_unused]] Slot slot) const {
  if constexpr (!Laws::kPlain) {
    if (!is_periodic()) return true;
    if (index(slot) >= space_.cages.size()) return false;
    const Cage& cage = space_.cage(slot);
    const auto is_small = [&](double low, double high, double length) {
      return !(length > 0) || 0.5 * (high - low) + cage.margin < kSmallCage * 1.0001 * length;
    };
    return is_small(cage.box.low_x, cage.box.high_x, space_.length_x) &&
           is_small(cage.box.low_y, cage.box.high_y, space_.length_y);
  } else {
    return true;
  }
}

template <class S, class Laws>
double BasicWorld<S, Laws>::next_margin(Slot slot) const {
  return all_pairs() ? 0 : neighbours_.next_margin(slot);
}

template <class S, class Laws>
Neighbours::Leeway BasicWorld<S, Laws>::leeway_of(Slot slot) const {
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) return {space_.cage(slot).anchor, space_.cage(slot).margin};
  }
  return neighbours_.leeway(slot);
}

/// Calls visit(box) for each copy of a box in which stored boxes that meet one of its images lie.
template <class S, class Laws>
template <class Visit>
void BasicWorld<S, Laws>::for_each_stored_copy(const Aabb& box, Visit&& visit) const {
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      space_.for_each_copy(box, visit);
      return;
    }
  }
  visit(box);
}

/// Where a place is shown: in [0, period) along a periodic axis.
template <class S, class Laws>
Vector2 BasicWorld<S, Laws>::shown(const DoubleWord2<S>& position) const {
  if constexpr (Laws::kPlain) {
    return detail::rounded(position);
  } else {
    return detail::shown(position, space_.period);
  }
}

/// p - q, of the image of p.
template <class S, class Laws>
[[gnu::always_inline]] inline DoubleWord2<S> BasicWorld<S, Laws>::apart(
    const DoubleWord2<S>& p, const DoubleWord2<S>& q, [[maybe_unused]] const Which& image) const {
  if constexpr (Laws::kPlain) {
    return p - q;
  } else {
    return {detail::apart(p.x, q.x, image.x, space_.period.x),
            detail::apart(p.y, q.y, image.y, space_.period.y)};
  }
}

/// a - b, or of the images of a the one nearest to b.
template <class S, class Laws>
DoubleWord2<S> BasicWorld<S, Laws>::nearest_apart(const DoubleWord2<S>& a,
                                                  const DoubleWord2<S>& b) const {
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      const auto along =
          [](const DoubleWord<S>& x, const DoubleWord<S>& from, const DoubleWord<S>& period) {
            const auto k = -detail::periods_in(detail::rough(x - from), detail::rough(period));
            return detail::apart(x, from, k, period);
          };
      return {along(a.x, b.x, space_.period.x), along(a.y, b.y, space_.period.y)};
    }
  }
  return {a.x - b.x, a.y - b.y};
}

/// Beyond this a body's place is no longer resolved well enough, or it has grown until it is about
/// to touch its own image; the world stops and names it.
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_no_place([[maybe_unused]] Slot slot) const {
  if constexpr (!Laws::kPlain) {
    if (!is_periodic()) return false;
    const Glance here = glance_of(slot);
    if (space_.is_beyond({here.x + here.x_low, here.y + here.y_low}, kPeriodsMax<S>)) return true;
    return growth_of(slot) > 0 &&
           !(2 * (radius_now(slot) + smallest_margin(slot)) < space_.smallest());
  } else {
    return false;
  }
}

/// The largest velocity along an axis that a command may set, m/s.
template <class S, class Laws>
double BasicWorld<S, Laws>::speed_max() const {
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      return std::min(detail::kSpeedMax<S>, kPeriodsPerSecondMax * space_.smallest());
    }
  }
  return detail::kSpeedMax<S>;
}

/// Has the disk a place among its own images?
template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_room([[maybe_unused]] const DiskSpec& spec,
                                                      [[maybe_unused]] std::size_t i) const {
  if constexpr (!Laws::kPlain) {
    if (!is_periodic()) return std::nullopt;
    if (!(2 * spec.radius < space_.smallest())) {
      return detail::invalid("disks",
                             i,
                             "radius",
                             spec.id,
                             "must be below half the period: the disk would touch its own image");
    }
    if (space_.is_beyond(spec.position, kPeriodsMax<S> / 2)) {
      return detail::invalid(
          "disks", i, "position", spec.id, "is too many periods away from the origin");
    }
  }
  return std::nullopt;
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_room([[maybe_unused]] const WallSpec& spec,
                                                      [[maybe_unused]] std::size_t i) const {
  if constexpr (!Laws::kPlain) {
    if (!is_periodic()) return std::nullopt;
    if (space_.is_beyond(spec.start, kPeriodsMax<S> / 2)) {
      return detail::invalid(
          "walls", i, "start", spec.id, "is too many periods away from the origin");
    }
    if (space_.is_beyond(spec.end - spec.start, kWallPeriodsMax)) {
      return detail::invalid("walls", i, "end", spec.id, "makes the wall longer than 1024 periods");
    }
  }
  return std::nullopt;
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_room([[maybe_unused]] const ZoneSpec& spec,
                                                      [[maybe_unused]] std::size_t i) const {
  if constexpr (!Laws::kPlain) {
    if (!is_periodic()) return std::nullopt;
    if (!(2 * spec.radius < space_.smallest())) {
      return detail::invalid("zones",
                             i,
                             "radius",
                             spec.id,
                             "must be below half the period: the zone would meet its own image");
    }
    if (space_.is_beyond(spec.center, kPeriodsMax<S> / 2)) {
      return detail::invalid(
          "zones", i, "center", spec.id, "is too many periods away from the origin");
    }
  }
  return std::nullopt;
}

/// Could a body see this image?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_near(const Image& k) {
  const auto farthest = static_cast<std::int64_t>(2 * kPeriodsMax<S>);
  return k.x <= farthest && k.x >= -farthest && k.y <= farthest && k.y >= -farthest;
}

/// Could a body with such numbers have come of commands that were taken?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_in_bounds([[maybe_unused]] Slot slot) const {
  if constexpr (!Laws::kPlain) {
    if (!is_periodic()) return true;
    constexpr double kFaster = 1024;  // chosen: what collisions make of the fastest command
    const auto& body = at(slot);
    if (space_.is_beyond(detail::rounded(body.position()), kPeriodsMax<S>)) return false;
    if (space_.is_beyond(detail::rounded(position_of(slot, now_)), kPeriodsMax<S>)) return false;
    if (!detail::within(detail::rounded(body.velocity()), kFaster * speed_max())) return false;
    const RestImages images = rest_images(slot);
    if (!is_near(images.support) || !is_near(images.second_support) || !is_near(images.slid_off)) {
      return false;
    }
    if (!body.is_wall()) return 2 * static_cast<double>(body.radius()) < space_.smallest();
    return !space_.is_beyond(detail::rounded(shape(slot).edge), kWallPeriodsMax);
  } else {
    return true;
  }
}

/// What a body covers where it is shown, in doubles.
template <class S, class Laws>
Aabb BasicWorld<S, Laws>::shown_box(Slot slot) const {
  if (at(slot).is_wall()) {
    const WallState wall = wall_of(slot);
    const Vector2 low = wall.start.cwiseMin(wall.end);
    const Vector2 high = wall.start.cwiseMax(wall.end);
    return {low.x(), low.y(), high.x(), high.y()};
  }
  const BodyState disk = state_of(slot);
  return {disk.position.x() - disk.radius,
          disk.position.y() - disk.radius,
          disk.position.x() + disk.radius,
          disk.position.y() + disk.radius};
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::some_image_touches([[maybe_unused]] Slot slot,
                                             [[maybe_unused]] const Aabb& box) const {
  bool found = false;
  if constexpr (!Laws::kPlain) {
    const Vector2 low(box.low_x, box.low_y);
    const Vector2 high(box.high_x, box.high_y);
    space_.for_each_meeting(box, {}, shown_box(slot), {}, [&](const Image& k) {
      found = found || touches(slot, low - space_.way(k), high - space_.way(k));
    });
  }
  return found;
}

// An image further away than a period along an axis has a nearer one.
template <class S, class Laws>
double BasicWorld<S, Laws>::distance_to_nearest_image(Slot slot,
                                                      [[maybe_unused]] const Vector2& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  if constexpr (!Laws::kPlain) {
    const Vector2 p = shown(detail::stored<S>(point));
    const auto around = [](double x, double length) {
      return length > 0 ? length : std::abs(x) + std::numeric_limits<double>::infinity();
    };
    const Vector2 far(around(p.x(), space_.length_x), around(p.y(), space_.length_y));
    const Aabb all_near{p.x() - far.x(), p.y() - far.y(), p.x() + far.x(), p.y() + far.y()};
    space_.for_each_meeting(all_near, {}, shown_box(slot), {}, [&](const Image& k) {
      nearest = std::min(nearest, distance_to(slot, p - space_.way(k)));
    });
  }
  return nearest;
}

// Piece by piece of half a period, as far as 1024 periods.
template <class S, class Laws>
std::optional<RayHit> BasicWorld<S, Laws>::ray_among_images(
    [[maybe_unused]] const Vector2& origin,
    [[maybe_unused]] const Vector2& unit,
    [[maybe_unused]] double length_max) const {
  if constexpr (!Laws::kPlain) {
    constexpr int kPiecesMax = 2048;
    constexpr double kOverlap = 1 + 1e-9;  // of pieces, so that nothing slips between two
    const double piece = 0.5 * space_.smallest();
    for (int i = 0; i < kPiecesMax && i * piece <= length_max; ++i) {
      const Vector2 from = shown(detail::stored<S>(Vector2(origin + i * piece * unit)));
      const double left = std::min(piece * kOverlap, length_max - i * piece);
      const Vector2 to = from + left * unit;
      const Vector2 low = from.cwiseMin(to);
      const Vector2 high = from.cwiseMax(to);
      std::optional<RayHit> first;
      for (const Slot slot : ordered_slots()) {
        if (is_zone(slot)) continue;
        const Aabb box = grown({low.x(), low.y(), high.x(), high.y()}, 0);
        space_.for_each_meeting(box, {}, shown_box(slot), {}, [&](const Image& k) {
          const auto hit = ray_meets(slot, from - space_.way(k), unit);
          if (hit && hit->distance <= left && (!first || hit->distance < first->distance)) {
            first = hit;
          }
        });
      }
      if (!first) continue;
      first->point = shown(detail::stored<S>(Vector2(from + first->distance * unit)));
      first->distance += i * piece;
      return first;
    }
  }
  return std::nullopt;
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Questions: evaluations of the stored motions at now(). Nothing here writes.

#include "basic_world.hpp"
#include "motion_law/accelerated.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::engine {

template <class S, class Laws>
Reject BasicWorld<S, Laws>::not_found(Id id) const {
  return {.code = Code::NotFound, .field = "id", .body = id, .reason = "no such body"};
}

template <class S, class Laws>
const std::vector<Slot>& BasicWorld<S, Laws>::ordered_slots() const {
  if (!ordered_valid_) {
    ordered_.clear();
    for (Slot slot = 0; index(slot) < bodies_.size(); ++slot) {
      if (at(slot).id != kNoId) ordered_.push_back(slot);
    }
    std::sort(
        ordered_.begin(), ordered_.end(), [this](Slot a, Slot b) { return at(a).id < at(b).id; });
    ordered_valid_ = true;
  }
  return ordered_;
}

template <class S, class Laws>
BodyState BasicWorld<S, Laws>::state_of(Slot slot) const {
  const auto& body = at(slot);
  BodyState state;
  state.id = body.id;
  state.kind = kind_of(body.type);
  state.instant = to_instant(now_);
  state.position = shown(position_of(slot, now_));
  state.velocity = detail::rounded(velocity_of(slot, now_));
  state.radius = radius_now(slot);
  if (!Laws::kPlain || !rotations_.empty()) {
    const Rotation rotation = rotation_of(slot);
    state.angle = turned(rotation.angle, rotation.spin, to_instant(body.since()), state.instant);
    state.spin = rotation.spin;
  }
  return state;
}

template <class S, class Laws>
WallState BasicWorld<S, Laws>::wall_of(Slot slot) const {
  const DoubleWord2<S>& velocity = at(slot).velocity();
  const DoubleWord2<S>& edge = shape(slot).edge;
  const DoubleWord2<S> start = position_of(slot, now_);
  if constexpr (Laws::kPlain) {
    return {at(slot).id,
            to_instant(now_),
            detail::rounded(start),
            detail::rounded(DoubleWord2<S>{start.x + edge.x, start.y + edge.y}),
            detail::rounded(velocity)};
  } else {
    return detail::shown_wall(at(slot).id, to_instant(now_), start, edge, velocity, period_words());
  }
}

template <class S, class Laws>
Outcome<BodyState> BasicWorld<S, Laws>::state(Id id) const {
  const Slot found = find_slot(id);
  if (found < 0 || !at(found).is_disk()) return not_found(id);
  return state_of(found);
}

template <class S, class Laws>
Outcome<WallState> BasicWorld<S, Laws>::wall(Id id) const {
  const Slot found = find_slot(id);
  if (found < 0 || !at(found).is_wall()) return not_found(id);
  return wall_of(found);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::for_each_disk(const std::function<void(const BodyState&)>& visit) const {
  for (const Slot slot : ordered_slots()) {
    if (at(slot).is_disk()) visit(state_of(slot));
  }
}

template <class S, class Laws>
void BasicWorld<S, Laws>::for_each_wall(const std::function<void(const WallState&)>& visit) const {
  for (const Slot slot : ordered_slots()) {
    if (at(slot).is_wall()) visit(wall_of(slot));
  }
}

template <class S, class Laws>
Conserved BasicWorld<S, Laws>::conserved() const {
  DoubleWord<S> energy{};
  DoubleWord2<S> momentum{};
  double potential = 0;
  for (const Slot slot : ordered_slots()) {
    const auto& body = at(slot);
    if (!body.is_dynamic()) continue;
    const DoubleWord2<S> v = velocity_of(slot, now_);
    energy = energy + square_norm(v) * body.mass() + twice_spin_energy(body);
    if constexpr (Laws::kCurved) potential += potential_energy(slot);
    momentum = {momentum.x + v.x * body.mass(), momentum.y + v.y * body.mass()};
  }
  return {0.5 * static_cast<double>(to_scalar(energy)), potential, detail::rounded(momentum)};
}

namespace detail {

/// The point of the segment from a to b that is nearest to p.
inline Vector2 nearest_on_segment(const Vector2& a, const Vector2& b, const Vector2& p) {
  const Vector2 e = b - a;
  const double s = (p - a).dot(e) / e.squaredNorm();
  return a + std::clamp(s, 0.0, 1.0) * e;
}

/// Does the segment from a to b meet the box? By the slabs of the box.
inline bool segment_meets_box(const Vector2& a,
                              const Vector2& b,
                              const Vector2& low,
                              const Vector2& high) {
  double enter = 0;
  double leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double d = b[axis] - a[axis];
    if (d == 0) {
      if (a[axis] < low[axis] || a[axis] > high[axis]) return false;
      continue;
    }
    const double s = (low[axis] - a[axis]) / d;
    const double t = (high[axis] - a[axis]) / d;
    enter = std::max(enter, std::min(s, t));
    leave = std::min(leave, std::max(s, t));
  }
  return enter <= leave;
}

}  // namespace detail

template <class S, class Laws>
bool BasicWorld<S, Laws>::touches(Slot slot, const Vector2& low, const Vector2& high) const {
  if (at(slot).is_wall()) {
    const WallState wall = wall_of(slot);
    return detail::segment_meets_box(wall.start, wall.end, low, high);
  }
  const BodyState disk = state_of(slot);
  const Vector2 nearest = disk.position.cwiseMax(low).cwiseMin(high);
  return (disk.position - nearest).norm() <= disk.radius;
}

template <class S, class Laws>
std::vector<Id> BasicWorld<S, Laws>::region(const Vector2& low, const Vector2& high) const {
  std::vector<Id> inside;
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) {
      const Aabb box = space_.in_one_cell(low, high);
      for (const Slot slot : ordered_slots()) {
        if (!is_zone(slot) && some_image_touches(slot, box)) inside.push_back(at(slot).id);
      }
      return inside;
    }
  }
  if (all_pairs()) {
    for (const Slot slot : ordered_slots()) {
      if (!is_zone(slot) && touches(slot, low, high)) inside.push_back(at(slot).id);
    }
    return inside;
  }
  neighbours_.query({low.x(), low.y(), high.x(), high.y()}, [&](Slot slot) {
    if (!is_zone(slot) && touches(slot, low, high)) inside.push_back(at(slot).id);
  });
  std::sort(inside.begin(), inside.end());
  return inside;
}

template <class S, class Laws>
double BasicWorld<S, Laws>::distance_to(Slot slot, const Vector2& point) const {
  if (at(slot).is_wall()) {
    const WallState wall = wall_of(slot);
    return (point - detail::nearest_on_segment(wall.start, wall.end, point)).norm();
  }
  const BodyState disk = state_of(slot);
  return (point - disk.position).norm() - disk.radius;
}

template <class S, class Laws>
std::vector<Near> BasicWorld<S, Laws>::nearest(const Vector2& point, std::size_t count) const {
  std::vector<Near> all;
  all.reserve(slots_.size());
  for (const Slot slot : ordered_slots()) {
    if (is_zone(slot)) continue;
    all.push_back(
        {at(slot).id,
         is_periodic() ? distance_to_nearest_image(slot, point) : distance_to(slot, point)});
  }
  count = std::min(count, all.size());
  std::partial_sort(all.begin(),
                    all.begin() + static_cast<std::ptrdiff_t>(count),
                    all.end(),
                    [](const Near& x, const Near& y) {
                      return x.distance != y.distance ? x.distance < y.distance : x.id < y.id;
                    });
  all.resize(count);
  return all;
}

namespace detail {

/// Distance along the ray o + s u (|u| = 1) at which it enters the disk; 0 from inside.
inline std::optional<double> ray_disk(const Vector2& o,
                                      const Vector2& u,
                                      const Vector2& centre,
                                      double radius) {
  const Vector2 p = centre - o;
  const double along = p.dot(u);
  const double outside = p.squaredNorm() - radius * radius;
  if (outside <= 0) return 0.0;
  if (along <= 0) return std::nullopt;
  const double cross = p.x() * u.y() - p.y() * u.x();
  const double disc = radius * radius - cross * cross;
  if (disc < 0) return std::nullopt;
  return outside / (along + std::sqrt(disc));
}

inline std::optional<double> ray_segment(const Vector2& o,
                                         const Vector2& u,
                                         const Vector2& a,
                                         const Vector2& b) {
  const Vector2 e = b - a;
  const Vector2 q = a - o;
  const double denominator = u.x() * e.y() - u.y() * e.x();
  if (denominator == 0) return std::nullopt;
  const double distance = (q.x() * e.y() - q.y() * e.x()) / denominator;
  const double along = (q.x() * u.y() - q.y() * u.x()) / denominator;
  if (!(distance >= 0) || !(along >= 0 && along <= 1)) return std::nullopt;
  return distance;
}

}  // namespace detail

template <class S, class Laws>
std::optional<RayHit> BasicWorld<S, Laws>::ray_meets(Slot slot,
                                                     const Vector2& origin,
                                                     const Vector2& unit) const {
  RayHit hit{.id = at(slot).id};
  std::optional<double> distance;
  if (at(slot).is_wall()) {
    const WallState wall = wall_of(slot);
    distance = detail::ray_segment(origin, unit, wall.start, wall.end);
    const Vector2 edge = (wall.end - wall.start).normalized();
    hit.normal = {-edge.y(), edge.x()};
    if (hit.normal.dot(unit) > 0) hit.normal = -hit.normal;
  } else {
    const BodyState disk = state_of(slot);
    distance = detail::ray_disk(origin, unit, disk.position, disk.radius);
    if (distance) hit.normal = (origin + *distance * unit - disk.position).normalized();
  }
  if (!distance) return std::nullopt;
  hit.distance = *distance;
  hit.point = origin + *distance * unit;
  return hit;
}

template <class S, class Laws>
std::optional<RayHit> BasicWorld<S, Laws>::ray(const Vector2& origin,
                                               const Vector2& direction,
                                               double length_max) const {
  const double length = direction.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  const Vector2 unit = direction / length;
  if (is_periodic()) return ray_among_images(origin, unit, length_max);
  std::optional<RayHit> first;
  for (const Slot slot : ordered_slots()) {
    if (is_zone(slot)) continue;
    const auto hit = ray_meets(slot, origin, unit);
    if (hit && hit->distance <= length_max && (!first || hit->distance < first->distance)) {
      first = hit;
    }
  }
  return first;
}

template <class S, class Laws>
Outcome<MotionRecord> BasicWorld<S, Laws>::motion(Id id) const {
  const Slot found = find_slot(id);
  if (found < 0 || is_zone(found)) return not_found(id);
  MotionRecord record = to_record(id, at(found).motion());
  const Rotation rotation = rotation_of(found);
  record.angle = rotation.angle;
  record.spin = rotation.spin;
  const bool is_pulled = Laws::kCurved && (!Laws::kDragged || at(found).is_dynamic());
  if constexpr (Laws::kCurved) {
    if (is_pulled) {
      record.ax = to_split(at(found).acceleration.x);
      record.ay = to_split(at(found).acceleration.y);
    }
  }
  if constexpr (Laws::kDragged) {
    if (is_pulled) record.drag = static_cast<double>(laws_.drag);
  }
  if constexpr (Laws::kGrows) {
    record.radius = to_split(at(found).grown);
    record.growth = growth_of(found);
  }
  return record;
}

template <class S, class Laws>
Outcome<BodyRecord> BasicWorld<S, Laws>::body(Id id) const {
  const Slot found = find_slot(id);
  if (found < 0 || is_zone(found)) return not_found(id);
  const auto& b = at(found);
  BodyRecord record;
  record.id = id;
  record.is_wall = b.is_wall();
  if (b.is_wall()) {
    record.edge_x = to_split(shape(found).edge.x);
    record.edge_y = to_split(shape(found).edge.y);
  } else {
    record.kind = kind_of(b.type);
    record.radius = radius_now(found);
    record.mass = static_cast<double>(b.mass());
  }
  return record;
}

template <class S, class Laws>
std::vector<Id> BasicWorld<S, Laws>::ids() const {
  std::vector<Id> result;
  result.reserve(slots_.size());
  for (const Slot slot : ordered_slots()) {
    if (!is_zone(slot)) result.push_back(at(slot).id);
  }
  return result;
}

template <class S, class Laws>
std::vector<Change> BasicWorld<S, Laws>::drain_changes() {
  return changes_.drain([this] { return ids(); });
}

}  // namespace stoss::engine

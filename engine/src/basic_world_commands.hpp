// SPDX-License-Identifier: Apache-2.0
#pragma once

// Commands: everything is checked before anything is changed; a refusal leaves every byte as it
// was.

#include "basic_world.hpp"
#include "limits.hpp"
#include "stored.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::engine {

namespace detail {

inline bool is_finite(const Vector2& v) { return std::isfinite(v.x()) && std::isfinite(v.y()); }
inline bool within(const Vector2& v, double limit) {
  return std::abs(v.x()) <= limit && std::abs(v.y()) <= limit;
}
inline std::string field_name(const char* list, std::size_t i, const char* member) {
  std::string name = std::string(list) + "[" + std::to_string(i) + "]";
  return *member == '\0' ? name : name + "." + member;
}

inline Reject invalid(
    const char* list, std::size_t i, const char* member, Id body, std::string reason) {
  return {.code = Code::InvalidArgument,
          .field = field_name(list, i, member),
          .index = i,
          .body = body,
          .reason = std::move(reason)};
}

inline std::optional<Reject> check_vector(
    const Vector2& v, double limit, const char* list, std::size_t i, const char* member, Id body) {
  if (!is_finite(v)) return invalid(list, i, member, body, "is not finite");
  if (!within(v, limit)) {
    return invalid(list, i, member, body, "is beyond what this world's arithmetic can work with");
  }
  return std::nullopt;
}

}  // namespace detail

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_disk(const DiskSpec& spec, std::size_t i) const {
  using detail::invalid;
  const auto check = [&](const Vector2& v, double limit, const char* member) {
    return detail::check_vector(v, limit, "disks", i, member, spec.id);
  };
  if (auto reject = check(spec.position, detail::kLengthMax<S>, "position")) return reject;
  if (auto reject = check(spec.velocity, speed_max(), "velocity")) return reject;
  if (!(spec.radius > 0) || !(spec.radius <= detail::kLengthMax<S>) || !(S(spec.radius) > S(0))) {
    return invalid("disks",
                   i,
                   "radius",
                   spec.id,
                   "must be above 0, finite, and within the range of this world's arithmetic");
  }
  if (!detail::is_usable_mass<S>(spec.mass)) {
    return invalid("disks",
                   i,
                   "mass",
                   spec.id,
                   "must be above 0, finite, and within the range of this world's arithmetic");
  }
  if (!std::isfinite(spec.angle)) return invalid("disks", i, "angle", spec.id, "is not finite");
  if (!std::isfinite(spec.spin)) return invalid("disks", i, "spin", spec.id, "is not finite");
  if (spec.kind > BodyKind::Static) return invalid("disks", i, "kind", spec.id, "is unknown");
  if (spec.kind == BodyKind::Static && spec.velocity != Vector2::Zero()) {
    return invalid("disks", i, "velocity", spec.id, "must be zero for a static disk");
  }
  return check_room(spec, i);
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_wall(const WallSpec& spec, std::size_t i) const {
  const auto check = [&](const Vector2& v, double limit, const char* member) {
    return detail::check_vector(v, limit, "walls", i, member, spec.id);
  };
  if (auto reject = check(spec.start, detail::kLengthMax<S>, "start")) return reject;
  if (auto reject = check(spec.end, detail::kLengthMax<S>, "end")) return reject;
  if (auto reject = check(spec.velocity, speed_max(), "velocity")) return reject;
  if (spec.start == spec.end) {
    return detail::invalid("walls", i, "end", spec.id, "equals start: a wall needs a length");
  }
  return check_room(spec, i);
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_new_ids(const SpawnRequest& request) const {
  std::vector<std::pair<Id, std::size_t>> asked;
  asked.reserve(request.disks.size());
  const auto check = [&](Id id, const char* list, std::size_t i) -> std::optional<Reject> {
    if (id == kNoId) return std::nullopt;
    if (contains(id) || ledger_.is_retired(id)) {
      return Reject{
          .code = Code::AlreadyExists,
          .field = detail::field_name(list, i, "id"),
          .index = i,
          .body = id,
          .reason = contains(id) ? "the id is in use" : "the id was used before and is retired"};
    }
    if (id == std::numeric_limits<Id>::max()) {
      return detail::invalid(list, i, "id", id, "is the last 64-bit number, which is kept free");
    }
    asked.emplace_back(id, i);
    return std::nullopt;
  };
  for (std::size_t i = 0; i < request.disks.size(); ++i) {
    if (auto reject = check(request.disks[i].id, "disks", i)) return reject;
  }
  for (std::size_t i = 0; i < request.walls.size(); ++i) {
    if (auto reject = check(request.walls[i].id, "walls", i)) return reject;
  }
  for (std::size_t i = 0; i < request.zones.size(); ++i) {
    if (auto reject = check(request.zones[i].id, "zones", i)) return reject;
  }
  if (!std::is_sorted(asked.begin(), asked.end())) std::sort(asked.begin(), asked.end());
  const auto twin = std::adjacent_find(
      asked.begin(), asked.end(), [](const auto& x, const auto& y) { return x.first == y.first; });
  if (twin == asked.end()) return std::nullopt;
  return Reject{.code = Code::AlreadyExists,
                .field = "id",
                .index = (twin + 1)->second,
                .body = twin->first,
                .reason = "the id is asked for twice in one command"};
}

/// Whether what is asked for is sound in itself, and its ids are free.
template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_request(const SpawnRequest& request) const {
  for (std::size_t i = 0; i < request.disks.size(); ++i) {
    if (auto reject = check_disk(request.disks[i], i)) return reject;
  }
  for (std::size_t i = 0; i < request.walls.size(); ++i) {
    if (auto reject = check_wall(request.walls[i], i)) return reject;
  }
  for (std::size_t i = 0; i < request.zones.size(); ++i) {
    if (auto reject = check_zone(request.zones[i], i)) return reject;
  }
  return check_new_ids(request);
}

template <class S, class Laws>
Outcome<std::vector<Id>> BasicWorld<S, Laws>::spawn(const SpawnRequest& request) {
  if (auto reject = check_request(request)) return *reject;

  const Id next_id_before = next_id_;
  std::uint64_t unnamed = 0;
  const auto count = [&](const auto& specs) {
    for (const auto& spec : specs) {
      next_id_ = std::max(next_id_, spec.id + 1);
      if (spec.id == kNoId) ++unnamed;
    }
  };
  count(request.disks);
  count(request.walls);
  count(request.zones);
  if (unnamed > std::numeric_limits<Id>::max() - next_id_) {
    next_id_ = next_id_before;
    return Reject{.code = Code::ResourceExhausted,
                  .field = "id",
                  .reason = "this world has no ids left to assign; ask for free ones by number"};
  }
  const std::size_t asked = request.disks.size() + request.walls.size() + request.zones.size();
  make_room(asked);
  std::vector<Slot> placed;
  std::vector<Id> made;
  placed.reserve(asked);
  made.reserve(asked);
  const auto admit = [&](const auto& spec, const Place& where) -> std::optional<Reject> {
    const Slot slot = place(spec);
    placed.push_back(slot);
    made.push_back(at(slot).id);
    renew_box(slot, first_margin(slot));
    if (is_zone(slot)) return std::nullopt;
    auto overlap = overlap_of(slot, where);
    if (overlap) overlap = in_asked_ids(std::move(*overlap), request, made);
    return overlap;
  };
  std::optional<Reject> reject;
  const auto admit_all = [&](const auto& specs, const char* list) {
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < specs.size() && !reject; ++i) {
      if (i + kAhead < specs.size()) slots_.prefetch_place(specs[i + kAhead].id);
      reject = admit(specs[i], {list, i});
    }
  };
  admit_all(request.disks, "disks");
  admit_all(request.walls, "walls");
  admit_all(request.zones, "zones");
  if (reject) {
    for (const Slot slot : placed) release(slot);
    next_id_ = next_id_before;
    return *reject;
  }
  for (const Slot slot : placed) {
    if (at(slot).is_wall()) link_vertices(slot);
    find_who_is_inside(slot);
  }
  for (const Slot slot : placed) {
    enter(slot);
    note_change(slot, ChangeKind::Spawned);
  }
  crowd_ = 0;
  return made;
}

// Ids that the refused command would have been given do not exist: a body without an id of its own
// is named by its place in the command.
template <class S, class Laws>
Reject BasicWorld<S, Laws>::in_asked_ids(Reject overlap,
                                         const SpawnRequest& request,
                                         const std::vector<Id>& made) const {
  const std::size_t disks = request.disks.size();
  const auto asked = [&](std::size_t i) {
    return i < disks ? request.disks[i].id : request.walls[i - disks].id;
  };
  overlap.body = asked(made.size() - 1);
  const auto mate = std::find(made.begin(), made.end(), overlap.other);
  if (mate == made.end()) return overlap;
  const auto i = static_cast<std::size_t>(mate - made.begin());
  overlap.other = asked(i);
  overlap.reason = "overlaps " +
                   (i < disks ? detail::field_name("disks", i, "")
                              : detail::field_name("walls", i - disks, "")) +
                   " of the same command";
  return overlap;
}

/// Before so many bodies come in at once. A few grow what there is as they come, by doubling.
template <class S, class Laws>
void BasicWorld<S, Laws>::make_room(std::size_t count) {
  if (count <= bodies_.size()) return;
  const std::size_t all = bodies_.size() + count;
  bodies_.reserve(all);
  slots_.reserve(all, id_of_slot());
  queue_.admit(static_cast<Slot>(all - 1));
  if (!all_pairs()) neighbours_.make_room(all);
}

template <class S, class Laws>
Slot BasicWorld<S, Laws>::take_slot(Id id, BodyType type) {
  Slot slot;
  if (free_slots_.empty()) {
    slot = static_cast<Slot>(bodies_.size());
    bodies_.add();
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
  }
  bodies_.clear(slot);
  auto&& body = at(slot);
  ++body.changes;
  body.id = id != kNoId ? id : next_id_++;
  body.type = type;
  body.set_since(now_);
  slots_.insert(body.id, slot, id_of_slot());
  queue_.admit(slot);
  note_digest_stale(slot);
  ordered_valid_ = false;
  return slot;
}

template <class S, class Laws>
Slot BasicWorld<S, Laws>::place(const DiskSpec& spec) {
  const Slot slot = take_slot(spec.id, type_of(spec.kind));
  auto&& body = at(slot);
  body.set_position(detail::stored<S>(spec.position));
  body.set_velocity(detail::stored<S>(spec.velocity));
  body.set_radius(S(spec.radius));
  if constexpr (Laws::kGrows) body.grown = {body.radius(), S(0)};
  body.set_mass(S(spec.mass));
  set_rotation(slot, {detail::canonical(spec.angle), detail::canonical(spec.spin)});
  start_kicks(slot);
  renew_law(slot);
  return slot;
}

template <class S, class Laws>
Slot BasicWorld<S, Laws>::place(const WallSpec& spec) {
  const Slot slot = take_slot(spec.id, BodyType::Wall);
  auto&& body = at(slot);
  body.set_position(detail::stored<S>(spec.start));
  body.set_velocity(detail::stored<S>(spec.velocity));
  if (free_shapes_.empty()) {
    body.set_wall(static_cast<std::int32_t>(shapes_.size()));
    shapes_.emplace_back();
  } else {
    body.set_wall(free_shapes_.back());
    free_shapes_.pop_back();
  }
  const DoubleWord2<S> end = detail::stored<S>(spec.end);
  shape(slot) = {{end.x - body.position().x, end.y - body.position().y}, {}};
  ++walls_in_use_;
  renew_law(slot);
  return slot;
}

/// The distance at which two bodies touch, m: between centres, or from a centre to a wall.
template <class S, class Laws>
double BasicWorld<S, Laws>::reach_of(Slot a, Slot b) const {
  return radius_now(a) + radius_now(b);
}

/// The distance of a from the image of b, between surfaces at now(), m; negative for an overlap.
/// Not for two walls.
template <class S, class Laws>
double BasicWorld<S, Laws>::clearance(Slot a, Slot b, const Which& image) const {
  if (at(a).is_wall()) return clearance(b, a, -image);
  const Relative r = relative_motion(a, b, now_, -image);
  DoubleWord2<S> apart = r.position;
  if (at(b).is_wall()) {
    const DoubleWord2<S>& e = shape(b).edge;
    const DoubleWord<S> along = apart.x * e.x + apart.y * e.y;
    const DoubleWord<S> length2 = e.x * e.x + e.y * e.y;
    if (along.hi >= length2.hi) {
      apart = {apart.x - e.x, apart.y - e.y};
    } else if (along.hi > S(0)) {  // the face: its distance is the cross product over the length
      const DoubleWord<S> cross = e.x * apart.y - e.y * apart.x;
      const DoubleWord<S> distance = (cross.hi < S(0) ? -cross : cross) / sqrt(length2);
      return static_cast<double>(to_scalar(distance - radius_of(a, now_)));
    }
  }
  const DoubleWord<S> distance = sqrt(apart.x * apart.x + apart.y * apart.y);
  DoubleWord<S> reach;
  if constexpr (Laws::kGrows) {
    reach = radius_of(a, now_) + radius_of(b, now_);
  } else {
    reach = two_sum(at(a).radius(), at(b).radius());
  }
  return static_cast<double>(to_scalar(distance - reach));
}

/// Two disks of open space without a touch; found in doubles, so a "no" says nothing.
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_clearly_apart(Slot slot, const Glance& here, Slot other) const {
  if (is_periodic() || !at(slot).is_disk() || !at(other).is_disk()) return false;
  return !disks_are_within(here, glance_of(other), reach_of(slot, other), kScreenSlack<S>);
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::overlap_of(Slot slot, const Place& place) const {
  Id worst = kNoId;
  double deepest = 0;
  const Glance here = glance_of(slot);
  for_each_neighbour_image(slot, [&](Slot other, const Which& image) {
    if (is_clearly_apart(slot, here, other)) return;
    const double gap = clearance(slot, other, image);
    if (gap >= -kOverlapTolerance * reach_of(slot, other)) return;
    const Id id = at(other).id;
    if (worst == kNoId || gap < deepest || (gap == deepest && id < worst)) {
      deepest = gap;
      worst = id;
    }
  });
  if (worst == kNoId) return std::nullopt;
  return Reject{.code = Code::Overlap,
                .field = detail::field_name(place.list, place.index, ""),
                .index = place.index,
                .body = at(slot).id,
                .other = worst,
                .clearance = deepest,
                .reason = "overlaps body " + std::to_string(worst)};
}

// A new or changed body: predicts for it, and for the disks whose way a wall's ends now stand in.
template <class S, class Laws>
void BasicWorld<S, Laws>::enter(Slot slot) {
  predict(slot, /*changed=*/true);
  if (!at(slot).is_wall()) return;
  for (const auto& ends : shape(slot).incident) {
    for (const WallEnd& other : ends) predict_around(other.wall);
  }
}

// A wall whose vertices have changed: what was predicted with it may no longer hold.
template <class S, class Laws>
void BasicWorld<S, Laws>::predict_around(Slot wall) {
  ++at(wall).changes;
  predict(wall, /*changed=*/true);
}

// A wall one of whose ends lost a neighbour: contacts that the neighbour hid count from now on, not
// from before.
template <class S, class Laws>
void BasicWorld<S, Laws>::lay_bare(Slot wall) {
  rebase(wall, now_);
  renew_law(wall);
  predict(wall, /*changed=*/true);
}

// Do two ends move as one point? A function of the stored motions, so that a world read from bytes
// finds the same vertices. Chains that were moved and stopped, and arithmetics in which end - start
// is rounded, hold their vertices to rounding: the tolerance is far above that, and far below the
// margin within which faces and ends overlap.
template <class S, class Laws>
bool BasicWorld<S, Laws>::same_vertex(const WallEnd& a, const WallEnd& b) const {
  using detail::magnitude;
  const auto& ma = at(a.wall).motion();
  const auto& mb = at(b.wall).motion();
  const auto same = [](const DoubleWord<S>& x, const DoubleWord<S>& y) {
    return x.hi == y.hi && x.lo == y.lo;
  };
  if (!same(ma.velocity.x, mb.velocity.x) || !same(ma.velocity.y, mb.velocity.y)) return false;

  const Time<S> when = std::max(ma.since, mb.since);
  const DoubleWord2<S> none{};
  const DoubleWord2<S>& to_a = a.end == 0 ? none : shape(a.wall).edge;
  const DoubleWord2<S>& to_b = b.end == 0 ? none : shape(b.wall).edge;
  const DoubleWord2<S> pa = position_at(ma, when);
  const DoubleWord2<S> pb = position_at(mb, when);
  const DoubleWord2<S> apart =
      nearest_apart({pa.x + to_a.x, pa.y + to_a.y}, {pb.x + to_b.x, pb.y + to_b.y});
  const S unit = kCompensated<S> ? S(S(4096) * detail::epsilon<S>() * detail::epsilon<S>())
                                 : S(S(64) * detail::epsilon<S>());
  const S size = detail::sum_norm(ma.position) + detail::sum_norm(mb.position) +
                 detail::sum_norm(pa) + detail::sum_norm(pb) + detail::sum_norm(to_a) +
                 detail::sum_norm(to_b);
  return detail::sum_norm(apart) <= unit * size;
}

template <class S, class Laws>
void BasicWorld<S, Laws>::link_vertices(Slot wall) {
  std::vector<Slot> others;
  const auto collect = [&](Slot other) {
    if ((other != wall || is_periodic()) && at(other).id != kNoId && at(other).is_wall())
      others.push_back(other);
  };
  if (all_pairs()) {
    for (Slot other = 0; index(other) < bodies_.size(); ++other) collect(other);
  } else {
    const Aabb box = tight_box(wall);
    const double size = std::max(
        {std::abs(box.low_x), std::abs(box.low_y), std::abs(box.high_x), std::abs(box.high_y)});
    for_each_stored_copy(grown(box, kScreenSlack<S> * size),  // ends may differ by rounding
                         [&](const Aabb& copy) { neighbours_.query(copy, collect); });
  }
  for (const Slot other : others) {
    for (int end = 0; end < 2; ++end) {
      for (int other_end = 0; other_end < 2; ++other_end) {
        const WallEnd mine{wall, end};
        const WallEnd theirs{other, other_end};
        if (mine == theirs) continue;
        auto& my_links = shape(wall).incident[static_cast<std::size_t>(end)];
        auto& their_links = shape(other).incident[static_cast<std::size_t>(other_end)];
        if (!same_vertex(mine, theirs)) continue;
        if (std::find(my_links.begin(), my_links.end(), theirs) != my_links.end()) continue;
        my_links.push_back(theirs);
        their_links.push_back(mine);
      }
    }
  }
}

template <class S, class Laws>
void BasicWorld<S, Laws>::unlink_vertices(Slot wall) {
  for (auto& links : shape(wall).incident) {
    const std::vector<WallEnd> others = std::move(links);
    links.clear();
    for (const WallEnd& other : others) {
      std::erase_if(shape(other.wall).incident[static_cast<std::size_t>(other.end)],
                    [wall](const WallEnd& end) { return end.wall == wall; });
    }
  }
}

// Frees a slot. Whoever was to meet the body is predicted anew: no event may name a free slot.
template <class S, class Laws>
void BasicWorld<S, Laws>::release(Slot slot) {
  std::vector<Slot> linked;
  if (at(slot).is_wall()) {
    for (const auto& links : shape(slot).incident) {
      for (const WallEnd& other : links) linked.push_back(other.wall);
    }
    unlink_vertices(slot);
    free_shapes_.push_back(at(slot).wall());
    --walls_in_use_;
  }
  forget_passages(slot);
  queue_.erase(slot, id_lookup());
  std::vector<Slot> meeting;
  for_each_neighbour(slot, [&](Slot other) {
    const Event<S>& event = queue_.event_of(other);
    if (event.kind != EventKind::NeighbourRenewal && event.partner == slot) {
      meeting.push_back(other);
    }
  });
  for (const Slot other : meeting) queue_.erase(other, id_lookup());
  leave_lists(slot);
  slots_.erase(at(slot).id, id_of_slot());
  rotations_.erase(slot);
  set_rest_images(slot, {});
  at(slot).id = kNoId;
  ++at(slot).changes;
  free_slots_.push_back(slot);
  note_digest_stale(slot);
  ordered_valid_ = false;
  for (const Slot other : meeting) predict(other, /*changed=*/false);
  for (const Slot other : linked) {
    if (other != slot) lay_bare(other);  // a wall around a periodic world is linked to itself
  }
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_distinct(std::vector<Id> ids,
                                                          const char* list) const {
  std::sort(ids.begin(), ids.end());
  const auto twin = std::adjacent_find(ids.begin(), ids.end());
  if (twin == ids.end()) return std::nullopt;
  return Reject{.code = Code::InvalidArgument,
                .field = list,
                .body = *twin,
                .reason = "the body is named twice in one command"};
}

template <class S, class Laws>
Outcome<Done> BasicWorld<S, Laws>::remove(std::span<const Id> ids) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (contains(ids[i])) continue;
    return Reject{.code = Code::NotFound,
                  .field = detail::field_name("ids", i, ""),
                  .index = i,
                  .body = ids[i],
                  .reason = "no such body"};
  }
  if (auto reject = check_distinct({ids.begin(), ids.end()}, "ids")) return *reject;
  std::vector<Id> woken;
  for (const Id id : ids) {
    const Slot slot = slot_of(id);
    if constexpr (Laws::kCurved) {
      for (const Slot disk : wake_disks_on(slot)) woken.push_back(at(disk).id);
    }
    note_change(slot, ChangeKind::Removed);
    release(slot);
    ledger_.retire(id);
  }
  for (const Id id : woken) {
    if (contains(id)) predict(slot_of(id), /*changed=*/true);
  }
  crowd_ = 0;
  return Done{};
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_targets(std::span<const VectorFor> targets,
                                                         const char* list) const {
  std::vector<Id> ids;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const VectorFor& target = targets[i];
    ids.push_back(target.id);
    if (!contains(target.id)) {
      return Reject{.code = Code::NotFound,
                    .field = detail::field_name(list, i, "id"),
                    .index = i,
                    .body = target.id,
                    .reason = "no such body"};
    }
    if (auto reject =
            detail::check_vector(target.value, speed_max(), list, i, "value", target.id)) {
      return reject;
    }
  }
  return check_distinct(std::move(ids), list);
}

template <class S, class Laws>
Outcome<Done> BasicWorld<S, Laws>::set_velocity(std::span<const VectorFor> velocities) {
  if (auto reject = check_targets(velocities, "velocities")) return *reject;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const Slot slot = slot_of(velocities[i].id);
    if (at(slot).type != BodyType::Static && !is_zone(slot)) continue;
    return Reject{.code = Code::FailedPrecondition,
                  .field = detail::field_name("velocities", i, "id"),
                  .index = i,
                  .body = velocities[i].id,
                  .reason = is_zone(slot) ? "a zone stays where it is"
                                          : "a static disk has no velocity to set"};
  }
  std::vector<Slot> walls;
  std::vector<Slot> woken;
  for (const VectorFor& target : velocities) {
    const Slot slot = slot_of(target.id);
    if constexpr (Laws::kCurved) {
      const std::vector<Slot> disks = wake_disks_on(slot);
      woken.insert(woken.end(), disks.begin(), disks.end());
    }
    rebase(slot, now_);
    let_go(slot);
    at(slot).set_velocity(detail::stored<S>(target.value));
    renew_law(slot);
    if (at(slot).is_wall()) walls.push_back(slot);
  }
  for (const Slot wall : walls) {
    std::vector<Slot> linked;
    for (const auto& links : shape(wall).incident) {
      for (const WallEnd& other : links) linked.push_back(other.wall);
    }
    unlink_vertices(wall);
    for (const Slot other : linked) lay_bare(other);
  }
  for (const Slot wall : walls) link_vertices(wall);
  for (const VectorFor& target : velocities) enter(slot_of(target.id));
  for (const Slot disk : woken) predict(disk, /*changed=*/true);
  crowd_ = 0;
  return Done{};
}

template <class S, class Laws>
Outcome<Done> BasicWorld<S, Laws>::apply_impulse(std::span<const VectorFor> impulses) {
  if (auto reject = check_targets(impulses, "impulses")) return *reject;
  const auto after = [this](const VectorFor& target) {
    const auto& body = at(slot_of(target.id));
    const auto add = [&](const DoubleWord<S>& v, double impulse) {
      return v + detail::stored<S>(impulse) / DoubleWord<S>{body.mass(), S(0)};
    };
    const DoubleWord2<S> v = velocity_of(slot_of(target.id), now_);
    return DoubleWord2<S>{add(v.x, target.value.x()), add(v.y, target.value.y())};
  };
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    const VectorFor& target = impulses[i];
    if (!at(slot_of(target.id)).is_dynamic()) {
      return Reject{.code = Code::FailedPrecondition,
                    .field = detail::field_name("impulses", i, "id"),
                    .index = i,
                    .body = target.id,
                    .reason = "only a dynamic disk answers to an impulse"};
    }
    const DoubleWord2<S> v = after(target);
    if (auto reject =
            detail::check_vector({static_cast<double>(v.x.hi), static_cast<double>(v.y.hi)},
                                 speed_max(),
                                 "impulses",
                                 i,
                                 "value",
                                 target.id)) {
      return *reject;
    }
  }
  for (const VectorFor& target : impulses) {
    const DoubleWord2<S> velocity = after(target);
    rebase(slot_of(target.id), now_);
    let_go(slot_of(target.id));
    at(slot_of(target.id)).set_velocity(velocity);
    renew_law(slot_of(target.id));
  }
  for (const VectorFor& target : impulses) enter(slot_of(target.id));
  crowd_ = 0;
  return Done{};
}

template <class S, class Laws>
void BasicWorld<S, Laws>::nudge(std::uint64_t seed) {
  for (const Slot slot : ordered_slots()) {
    if (!at(slot).is_dynamic()) continue;
    rebase(slot, now_);
    let_go(slot);
    DigestSink signs;
    signs.word(seed);
    signs.word(at(slot).id);
    std::uint64_t bits = signs.digest();
    const auto off = [&bits](const DoubleWord<S>& x) {
      const S unit = std::numeric_limits<S>::epsilon() * x.hi;
      const bool up = (bits & 1) != 0;
      bits >>= 1;
      return x + (up ? unit : S(-unit));
    };
    const auto off_both = [&off](const DoubleWord2<S>& v) {
      const DoubleWord<S> x = off(v.x);
      return DoubleWord2<S>{x, off(v.y)};
    };
    at(slot).set_position(off_both(at(slot).position()));
    at(slot).set_velocity(off_both(at(slot).velocity()));
    renew_law(slot);
  }
  for (const Slot slot : ordered_slots()) predict(slot, /*changed=*/true);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Zones: circles that push nothing and report who crosses their rims. A zone is an entry among the
// bodies, with an id and a box of its own; the prediction of a crossing is held by the disk. A
// crossing writes no motion, so that a world with zones moves to the same bits as one without.
//
// A plain world knows no zones: is_zone() is false there at compile time, and what it guards is
// gone.

#include "basic_world.hpp"
#include "limits.hpp"

#include <stoss/engine/check.hpp>

namespace stoss::engine {

template <class S, class Laws>
bool BasicWorld<S, Laws>::is_zone([[maybe_unused]] Slot slot) const {
  if constexpr (Laws::kPlain) {
    return false;
  } else {
    return at(slot).type == BodyType::Zone;
  }
}

template <class S, class Laws>
bool BasicWorld<S, Laws>::is_zone_and_disk(Slot a, Slot b) const {
  return (is_zone(a) && at(b).is_disk()) || (is_zone(b) && at(a).is_disk());
}

template <class S, class Laws>
std::optional<Reject> BasicWorld<S, Laws>::check_zone(const ZoneSpec& spec, std::size_t i) const {
  if constexpr (Laws::kPlain) {
    return Reject{.code = Code::FailedPrecondition,
                  .field = detail::field_name("zones", i, ""),
                  .index = i,
                  .body = spec.id,
                  .reason = "this world is of a kind that takes no zones"};
  }
  if (auto reject =
          detail::check_vector(spec.center, detail::kLengthMax<S>, "zones", i, "center", spec.id)) {
    return reject;
  }
  if (!(spec.radius > 0) || !(spec.radius <= detail::kLengthMax<S>) || !(S(spec.radius) > S(0))) {
    return detail::invalid("zones",
                           i,
                           "radius",
                           spec.id,
                           "must be above 0, finite, and within the range of this world's "
                           "arithmetic");
  }
  return check_room(spec, i);
}

template <class S, class Laws>
Slot BasicWorld<S, Laws>::place(const ZoneSpec& spec) {
  const Slot slot = take_slot(spec.id, BodyType::Zone);
  at(slot).set_position(detail::stored<S>(spec.center));
  at(slot).set_radius(S(spec.radius));
  ++zones_in_use_;
  renew_law(slot);
  return slot;
}

// Of a zone or a disk that has just come in: who is inside, strictly within the rim? On the rim is
// outside; one that moves in from there enters at once, with an event.
template <class S, class Laws>
void BasicWorld<S, Laws>::find_who_is_inside([[maybe_unused]] Slot slot) {
  if constexpr (!Laws::kPlain) {
    for_each_neighbour(slot, [&](Slot other) {
      if (!is_zone_and_disk(slot, other)) return;
      const Slot zone = is_zone(slot) ? slot : other;
      const Slot disk = zone == slot ? other : slot;
      const DoubleWord<S> radius{at(zone).radius(), S(0)};
      for_each_image(disk, zone, [&](const Image& image) {
        const DoubleWord2<S> from_centre =
            apart(position_of(disk, now_), position_of(zone, now_), -image);
        if (!(detail::height_over_rim(from_centre, radius) < S(0))) return;
        passages_.set(disk, {at(zone).id, true, image, now_});
        note_digest_stale(disk);
      });
    });
  }
}

// Can the disk of the two cross the rim of the other within `horizon` seconds? A "no" is certain.
template <class S, class Laws>
bool BasicWorld<S, Laws>::may_cross(
    Slot a, const Glance& here, Slot b, const Glance& there, double horizon, double bend) const {
  const bool is_disk = at(a).is_disk();
  return may_cross_rim(is_disk ? here : there,
                       is_disk ? there : here,
                       static_cast<double>(at(is_disk ? b : a).radius()),
                       horizon,
                       bend,
                       kScreenSlack<S>);
}

// Inwards the first of the images that the disk may meet, outwards the one that it is in.
template <class S, class Laws>
auto BasicWorld<S, Laws>::crossing_of([[maybe_unused]] Slot disk, [[maybe_unused]] Slot zone) const
    -> std::optional<RimCrossing> {
  std::optional<RimCrossing> first;
  if constexpr (!Laws::kPlain) {
    const Passage<S>* const passage = passages_.find(disk, at(zone).id);
    Time<S> reference = std::max(at(disk).since(), at(zone).since());
    if (passage != nullptr) reference = std::max(reference, passage->since);
    const bool is_inside = passage != nullptr && passage->is_inside;
    const auto consider = [&](const Image& image) {
      const auto after = Laws::zone_crossing(relative_motion(disk, zone, reference, -image),
                                             at(zone).radius(),
                                             is_inside,
                                             valid_for(disk, zone, reference));
      if (!after) return;
      const auto instant = later_by(reference, after->hi, after->lo);
      if (instant && (!first || *instant < first->at)) first = RimCrossing{*instant, image};
    };
    if (is_inside) {
      consider(passage->image);
    } else {
      for_each_image(disk, zone, consider);
    }
  }
  return first;
}

template <class S, class Laws>
std::optional<Event<S>> BasicWorld<S, Laws>::zone_event_of(Slot disk, Slot zone) const {
  const std::optional<RimCrossing> crossing = crossing_of(disk, zone);
  if (!crossing) return std::nullopt;
  return Event<S>{crossing->at, zone, at(zone).changes, EventKind::ZoneCrossing, at(zone).id};
}

template <class S, class Laws>
void BasicWorld<S, Laws>::process_crossing([[maybe_unused]] Slot disk,
                                           [[maybe_unused]] const Event<S>& event,
                                           [[maybe_unused]] CollisionSink* sink) {
  if constexpr (!Laws::kPlain) {
    const std::optional<RimCrossing> crossing = crossing_of(disk, event.partner);
    check(crossing.has_value(), "a scheduled crossing is no crossing of the stored motion");
    check(event.at >= now_, "a crossing was scheduled in the past");
    const Passage<S>* const before = passages_.find(disk, event.partner_id);
    const bool entered = before == nullptr || !before->is_inside;
    const Image image = entered ? crossing->image : Image{};
    passages_.set(disk, {event.partner_id, entered, image, event.at});
    ++counters_.zone_events;
    note_digest_stale(disk);
    predict(disk, /*changed=*/false);
    if (sink == nullptr) return;
    sink->on_zone_event({.sequence = counters_.zone_events,
                         .instant = to_instant(event.at),
                         .zone = event.partner_id,
                         .body = at(disk).id,
                         .entered = entered,
                         .position = shown(position_of(disk, event.at)),
                         .velocity = detail::rounded(velocity_of(disk, event.at))});
  }
}

/// What a disk would have in the queue if there were no zones: what a collision is told to depend
/// on must not hang on them.
template <class S, class Laws>
Event<S> BasicWorld<S, Laws>::next_but_for_zones(Slot disk) const {
  const auto ids = id_lookup();
  Event<S> best;
  const auto offer = [&](const std::optional<Event<S>>& event) {
    if (event && earlier(*event, disk, best, disk, ids)) best = *event;
  };
  if constexpr (!Laws::kPlain) offer(own_event(disk));
  for_each_neighbour(disk, [&](Slot other) {
    if (!is_zone(other) && holds_prediction(disk, other)) offer(event_with(disk, other));
  });
  return best;
}

/// The disk's motion is written anew at this instant.
template <class S, class Laws>
void BasicWorld<S, Laws>::begin_motion([[maybe_unused]] Slot slot,
                                       [[maybe_unused]] const Time<S>& instant) {
  if constexpr (!Laws::kPlain) passages_.begin_motion(slot, instant);
}

/// A disk or a zone goes.
template <class S, class Laws>
void BasicWorld<S, Laws>::forget_passages([[maybe_unused]] Slot slot) {
  if constexpr (!Laws::kPlain) {
    passages_.forget_disk(slot);
    if (!is_zone(slot)) return;
    --zones_in_use_;
    for (Slot disk = 0; index(disk) < bodies_.size(); ++disk) {
      if (passages_.forget_zone(disk, at(slot).id)) note_digest_stale(disk);
    }
  }
}

template <class S, class Laws>
ZoneState BasicWorld<S, Laws>::zone_of(Slot slot) const {
  return {
      at(slot).id, detail::rounded(at(slot).position()), static_cast<double>(at(slot).radius())};
}

template <class S, class Laws>
Outcome<ZoneState> BasicWorld<S, Laws>::zone(Id id) const {
  const Slot found = find_slot(id);
  if (found < 0 || !is_zone(found)) return not_found(id);
  return zone_of(found);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::for_each_zone(const std::function<void(const ZoneState&)>& visit) const {
  if (zones_in_use_ == 0) return;
  for (const Slot slot : ordered_slots()) {
    if (is_zone(slot)) visit(zone_of(slot));
  }
}

template <class S, class Laws>
Outcome<std::vector<Id>> BasicWorld<S, Laws>::inside(Id zone) const {
  const Slot found = find_slot(zone);
  if (found < 0 || !is_zone(found)) return not_found(zone);
  std::vector<Id> disks;
  if constexpr (!Laws::kPlain) {
    for (const Slot slot : ordered_slots()) {
      const Passage<S>* const passage = passages_.find(slot, zone);
      if (passage != nullptr && passage->is_inside) disks.push_back(at(slot).id);
    }
  }
  return disks;
}

template <class S, class Laws>
std::size_t BasicWorld<S, Laws>::passage_count([[maybe_unused]] Slot slot) const {
  if constexpr (Laws::kPlain) {
    return 0;
  } else {
    return passages_.of(slot).size();
  }
}

// The zone, whether the disk is inside, and since when; in a periodic world which image it is in.
template <class S, class Laws>
template <class Sink>
void BasicWorld<S, Laws>::write_passages([[maybe_unused]] Sink& sink,
                                         [[maybe_unused]] Slot slot) const {
  if constexpr (!Laws::kPlain) {
    for (const Passage<S>& passage : passages_.of(slot)) {
      sink.word(passage.zone);
      sink.word(passage.is_inside ? 1 : 0);
      write_time(sink, passage.since);
      if (!is_periodic()) continue;
      sink.word(static_cast<std::uint64_t>(passage.image.x));
      sink.word(static_cast<std::uint64_t>(passage.image.y));
    }
  }
}

/// False if no disk could stand with zones like that.
template <class S, class Laws>
bool BasicWorld<S, Laws>::read_passages([[maybe_unused]] ByteSource& source,
                                        [[maybe_unused]] Slot slot,
                                        std::uint64_t count) {
  if constexpr (!Laws::kPlain) {
    if (count > source.words_left() || (count > 0 && !at(slot).is_disk())) return false;
    Id previous = kNoId;
    for (std::uint64_t i = 0; i < count; ++i) {
      Passage<S> passage;
      passage.zone = source.word();
      const std::uint64_t is_inside = source.word();
      passage.is_inside = is_inside == 1;
      passage.since = read_time<Time<S>>(source);
      if (is_periodic()) {
        passage.image.x = static_cast<std::int64_t>(source.word());
        passage.image.y = static_cast<std::int64_t>(source.word());
      }
      if (passage.zone <= previous || is_inside > 1) return false;
      if (passage.since < at(slot).since() || passage.since > now_) return false;
      if (!is_near(passage.image)) return false;
      previous = passage.zone;
      passages_.set(slot, passage);
    }
    return true;
  } else {
    return count == 0;
  }
}

/// Do bytes name zones that there are, and were there then?
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_sound_passages([[maybe_unused]] Slot slot) const {
  if constexpr (!Laws::kPlain) {
    for (const Passage<S>& passage : passages_.of(slot)) {
      const Slot found = find_slot(passage.zone);
      if (found < 0 || !is_zone(found)) return false;
      if (passage.since < at(found).since()) return false;
    }
  }
  return true;
}

}  // namespace stoss::engine

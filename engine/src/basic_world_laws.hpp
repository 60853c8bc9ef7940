// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where the event loop meets the laws that a world was compiled for (laws.hpp). Of every pair of
// branches here, an instance holds one.

#include "basic_world.hpp"
#include "contact_law/growing.hpp"
#include "contact_law/restitution.hpp"
#include "contact_law/rough.hpp"
#include "motion_law/accelerated.hpp"
#include "motion_law/floor_friction.hpp"
#include "motion_law/growth.hpp"
#include "simultaneous.hpp"

namespace stoss::engine {

template <class S, class Laws>
[[gnu::always_inline]] inline DoubleWord2<S> BasicWorld<S, Laws>::position_of(
    Slot slot, const Time<S>& instant) const {
  const auto& motion = at(slot).motion();
  if constexpr (Laws::kDragged) {
    return flight_of(slot, instant).position;
  } else if constexpr (Laws::kCurved) {
    return position_at(motion, at(slot).acceleration, instant);
  } else {
    return position_at(motion, instant);
  }
}

template <class S, class Laws>
[[gnu::always_inline]] inline DoubleWord2<S> BasicWorld<S, Laws>::velocity_of(
    Slot slot, [[maybe_unused]] const Time<S>& instant) const {
  const auto& motion = at(slot).motion();
  if constexpr (Laws::kDragged) {
    return flight_of(slot, instant).velocity;
  } else if constexpr (Laws::kCurved) {
    return velocity_at(motion, at(slot).acceleration, instant);
  } else {
    return motion.velocity;
  }
}

/// Under drag; walls, kinematic and static disks do not feel it.
template <class S, class Laws>
Flight<S> BasicWorld<S, Laws>::flight_of(Slot slot, const Time<S>& instant) const {
  const auto& body = at(slot);
  if (!body.is_dynamic()) return {position_at(body.motion(), instant), body.velocity()};
  return flight_at(body.motion(), body.acceleration, laws_.drag, instant);
}

/// What the medium's drag is to a body that keeps its velocity: m V, to be held against.
template <class S, class Laws>
DoubleWord2<S> BasicWorld<S, Laws>::wind_on([[maybe_unused]] Slot slot) const {
  if constexpr (Laws::kDragged) {
    return at(slot).velocity() * laws_.drag;
  } else {
    return {};
  }
}

/// What presses a disk on a support as it moves: gravity, and the medium that it is moved through.
template <class S, class Laws>
DoubleWord2<S> BasicWorld<S, Laws>::pull_towards([[maybe_unused]] Slot support) const {
  if constexpr (Laws::kDragged) {
    return laws_.gravity - wind_on(support);
  } else {
    return laws_.gravity;
  }
}

/// Of a disk at an instant before or after its last event; 0 for a wall, a zone's own.
template <class S, class Laws>
auto BasicWorld<S, Laws>::radius_of(Slot slot, [[maybe_unused]] const Time<S>& instant) const
    -> Radius {
  if constexpr (Laws::kGrows) {
    if (!at(slot).is_disk()) return {at(slot).radius(), S(0)};
    return grown_by(at(slot).grown, laws_.growth, at(slot).since(), instant);
  } else {
    return at(slot).radius();
  }
}

/// The radius at now(), rounded, m.
template <class S, class Laws>
double BasicWorld<S, Laws>::radius_now(Slot slot) const {
  if constexpr (Laws::kGrows) {
    return static_cast<double>(to_scalar(radius_of(slot, now_)));
  } else {
    return static_cast<double>(at(slot).radius());
  }
}

/// How fast a body's surface moves without it, m/s.
template <class S, class Laws>
double BasicWorld<S, Laws>::growth_of([[maybe_unused]] Slot slot) const {
  if constexpr (Laws::kGrows) {
    return at(slot).is_disk() ? static_cast<double>(laws_.growth) : 0.0;
  } else {
    return 0;
  }
}

/// The distance at which the centres of two disks touch.
template <class S, class Laws>
auto BasicWorld<S, Laws>::reach_between(Slot a,
                                        Slot b,
                                        [[maybe_unused]] const Time<S>& instant) const -> Reach {
  if constexpr (Laws::kGrows) {
    return {radius_of(a, instant) + radius_of(b, instant), two_sum(laws_.growth, laws_.growth)};
  } else {
    return two_sum(at(a).radius(), at(b).radius());
  }
}

/// The distance at which a disk's centre touches a wall.
template <class S, class Laws>
auto BasicWorld<S, Laws>::radius_in_contact(Slot disk,
                                            [[maybe_unused]] const Time<S>& instant) const {
  if constexpr (Laws::kGrows) {
    return Reach{radius_of(disk, instant), {laws_.growth, S(0)}};
  } else {
    return at(disk).radius();
  }
}

template <class S, class Laws>
Glance BasicWorld<S, Laws>::glance_of(Slot slot) const {
  if constexpr (Laws::kDragged) {
    if (at(slot).is_dynamic())
      return dragged_glance<S>(
          at(slot).motion(), at(slot).acceleration, static_cast<double>(laws_.drag), now_);
  }
  Glance g = glance<S>(at(slot).motion(), now_);
  if constexpr (Laws::kCurved && !Laws::kDragged) {
    const double elapsed = rough_seconds(now_, at(slot).since());
    const auto add = [&](const DoubleWord<S>& acceleration, double& low, double& velocity) {
      const double gained = static_cast<double>(acceleration.hi) * elapsed;
      low += 0.5 * gained * elapsed;
      velocity += gained;
      g.error += kFlightSlack<S> * std::abs(gained * elapsed) + kClock * std::abs(gained);
    };
    add(at(slot).acceleration.x, g.x_low, g.vx);
    add(at(slot).acceleration.y, g.y_low, g.vy);
  }
  return g;
}

/// The sum of the components of a body's acceleration, m/s^2; under drag of what pulls besides.
template <class S, class Laws>
double BasicWorld<S, Laws>::pull_of(Slot slot) const {
  if (Laws::kDragged && !at(slot).is_dynamic()) return 0;
  return static_cast<double>(detail::sum_norm(at(slot).acceleration)) * (1 + kScreenSlack<S>);
}

/// The largest acceleration that a body has from now on until its next event, m/s^2.
template <class S, class Laws>
double BasicWorld<S, Laws>::bend_of(Slot slot, [[maybe_unused]] const Glance& here) const {
  if constexpr (Laws::kDragged) {  // a - m u, which falls as e^(-m t)
    if (!at(slot).is_dynamic()) return 0;
    const DoubleWord2<S>& a = at(slot).acceleration;
    const auto rate = static_cast<double>(laws_.drag);
    return (std::abs(static_cast<double>(a.x.hi) - rate * here.vx) +
            std::abs(static_cast<double>(a.y.hi) - rate * here.vy)) *
           (1 + kScreenSlack<S>)+kScreenSlack<S> * pull_of(slot);
  } else {
    return pull_of(slot);
  }
}

/// Is the motion of one seen from the other straight under drag? It then ends after 1 / m.
template <class S, class Laws>
bool BasicWorld<S, Laws>::fly_straight([[maybe_unused]] Slot a, [[maybe_unused]] Slot b) const {
  if constexpr (Laws::kDragged) {
    return detail::is_zero(at(a).acceleration - at(b).acceleration);
  } else {
    return false;
  }
}

/// For how long after `reference` both motions hold, s.
template <class S, class Laws>
S BasicWorld<S, Laws>::valid_for(Slot a, Slot b, const Time<S>& reference) const {
  if constexpr (Laws::kCurved) {
    const auto left = [&](Slot slot) {
      const S whole = at(slot).moves_for.hi;
      return whole - difference<S>(reference, at(slot).since()).hi;
    };
    return std::min(left(a), left(b));
  } else {
    return S(0);  // not asked for
  }
}

/// Sets what follows from a velocity that has just been written: the law's part, and the sight.
template <class S, class Laws>
void BasicWorld<S, Laws>::renew_law(Slot slot) {
  if constexpr (Laws::kCurved) renew_acceleration(slot);
  renew_sight(slot);
}

/// What pulls at the body, and for how long.
template <class S, class Laws>
void BasicWorld<S, Laws>::renew_acceleration(Slot slot) {
  auto&& body = at(slot);
  body.moves_for = {std::numeric_limits<S>::infinity(), S(0)};
  body.acceleration = wind_on(slot);
  if (!body.is_dynamic()) return;
  if (body.support != kNoId) {
    renew_rest(slot);
    return;
  }
  body.acceleration = laws_.gravity;
  if (!(laws_.deceleration > S(0))) return;
  const Slowing<S> slow = slowing<S>(body.velocity(), laws_.deceleration);
  body.acceleration = slow.acceleration;
  body.moves_for = slow.moves_for;
}

/// What befalls a body by itself, first of all.
template <class S, class Laws>
std::optional<Event<S>> BasicWorld<S, Laws>::own_event(Slot slot) const {
  std::optional<Event<S>> first = kick_event(slot);
  if constexpr (Laws::kCurved) {
    const auto change = law_change(slot);
    if (change && !(first && first->at < change->at)) first = change;
  }
  return first;
}

/// Its stop, or the end of its slide.
template <class S, class Laws>
std::optional<Event<S>> BasicWorld<S, Laws>::law_change(Slot slot) const {
  const auto& body = at(slot);
  if (!(body.moves_for.hi < std::numeric_limits<S>::infinity())) return std::nullopt;
  const auto instant = later_by(body.since(), body.moves_for.hi, body.moves_for.lo);
  if (!instant) return std::nullopt;
  Event<S> event;
  event.at = *instant;
  event.kind = EventKind::LawChange;
  return event;
}

template <class S, class Laws>
void BasicWorld<S, Laws>::process_own_event(Slot slot, const Time<S>& instant) {
  auto&& body = at(slot);
  if (body.support != kNoId) {  // the end of the wall
    rebase(slot, instant);
    const Id wall = body.support;
    const Image image = rest_images(slot).support;
    let_go(slot);
    body.slid_off = wall;
    set_rest_images(slot, {.support = {}, .second_support = {}, .slid_off = image});
    renew_law(slot);
    predict(slot, /*changed=*/true);
    return;
  }
  turn(slot, instant);
  body.set_position(stopping_place<S>(body.motion(), body.moves_for));
  body.set_velocity({});
  body.set_since(instant);
  ++body.changes;
  begin_motion(slot, instant);
  note_digest_stale(slot);
  note_change(slot, ChangeKind::Moved);
  renew_law(slot);
  predict(slot, /*changed=*/true);
}

/// In uniform gravity, zero at the origin; J.
template <class S, class Laws>
double BasicWorld<S, Laws>::potential_energy(Slot slot) const {
  const DoubleWord<S> height = dot(position_of(slot, now_), laws_.gravity);
  return -static_cast<double>(to_scalar(height * at(slot).mass()));
}

template <class S, class Laws>
Rotation BasicWorld<S, Laws>::rotation_of(Slot slot) const {
  if constexpr (Laws::kPlain) {
    const auto rotation = rotations_.find(slot);
    return rotation == rotations_.end() ? Rotation{} : rotation->second;
  } else {
    return {at(slot).angle, static_cast<double>(to_scalar(at(slot).spin))};
  }
}

template <class S, class Laws>
void BasicWorld<S, Laws>::set_rotation(Slot slot, const Rotation& rotation) {
  if constexpr (Laws::kPlain) {
    if (rotation.angle != 0 || rotation.spin != 0) rotations_[slot] = rotation;
  } else {
    at(slot).angle = rotation.angle;
    at(slot).spin = detail::stored<S>(rotation.spin);
  }
}

/// Brings the angle of a disk to an instant, before its motion is written.
template <class S, class Laws>
void BasicWorld<S, Laws>::turn(Slot slot, const Time<S>& instant) {
  if constexpr (Laws::kPlain) {
    if (rotations_.empty()) return;
    const auto rotation = rotations_.find(slot);
    if (rotation == rotations_.end()) return;
    const auto since = to_instant(at(slot).since());
    Rotation& r = rotation->second;
    r.angle = turned(r.angle, r.spin, since, to_instant(instant));
  } else {
    const auto since = to_instant(at(slot).since());
    const Rotation r = rotation_of(slot);
    at(slot).angle = turned(r.angle, r.spin, since, to_instant(instant));
  }
}

template <class S, class Laws>
auto BasicWorld<S, Laws>::impulse_of(const Contact& contact, const Time<S>& instant) const
    -> ContactOutcome {
  const auto& a = at(contact.a);
  const auto& b = at(contact.b);
  const DoubleWord2<S> velocity = velocity_of(contact.b, instant) - velocity_of(contact.a, instant);
  if constexpr (Laws::kPlain) {
    return {elastic_impulse<S>(contact_vector(contact),
                               velocity,
                               a.mass(),
                               !a.is_dynamic(),
                               b.mass(),
                               !b.is_dynamic()),
            {},
            false};
  } else {
    return lossy_impulse(contact, velocity, instant);
  }
}

/// Of b from a where they touch: growing surfaces come towards each other by themselves.
template <class S, class Laws>
DoubleWord2<S> BasicWorld<S, Laws>::surface_velocity([[maybe_unused]] const Contact& contact,
                                                     [[maybe_unused]] const DoubleWord2<S>& normal,
                                                     const DoubleWord2<S>& velocity) const {
  if constexpr (Laws::kGrows) {
    const bool is_pair = contact.kind == EventKind::DiskDisk;
    const DoubleWord<S> growth =
        is_pair ? two_sum(laws_.growth, laws_.growth) : DoubleWord<S>{laws_.growth, S(0)};
    return velocity_of_growing_surfaces(normal, velocity, growth);
  } else {
    return velocity;
  }
}

// An elastic contact is one of restitution 1, to the same bits.
template <class S, class Laws>
auto BasicWorld<S, Laws>::lossy_impulse(const Contact& contact,
                                        const DoubleWord2<S>& velocity,
                                        const Time<S>& instant) const -> ContactOutcome {
  const auto& a = at(contact.a);
  const auto& b = at(contact.b);
  S restitution = b.is_wall() ? laws_.wall_restitution : laws_.disk_restitution;
  ContactOutcome outcome;
  if (restitution < S(1) && collided_lately(a, instant, b)) {
    restitution = S(1);
    outcome.regularised = true;
  }
  const DoubleWord2<S> p = contact_vector(contact);
  outcome.impulse = restitution_impulse<S>(p,
                                           surface_velocity(contact, p, velocity),
                                           a.mass(),
                                           !a.is_dynamic(),
                                           b.mass(),
                                           !b.is_dynamic(),
                                           restitution);
  if constexpr (Laws::kCurved) {
    if (is_last_bounce(contact, outcome.impulse, restitution)) {
      outcome.is_last_bounce = true;
      outcome.impulse = restitution_impulse<S>(
          p, velocity, a.mass(), !a.is_dynamic(), b.mass(), !b.is_dynamic(), S(0));
    } else if (const S hop = hop_speed(contact, outcome.impulse, restitution); hop > S(0)) {
      outcome.regularised = true;
      outcome.impulse =
          hop_impulse<S>(p, velocity, a.mass(), !a.is_dynamic(), b.mass(), !b.is_dynamic(), hop);
    }
  }
  if (laws_.is_rough) {
    outcome.spins =
        add_rough_impulse<S>(outcome.impulse,
                             p,
                             velocity,
                             {a.mass(), a.radius(), !a.is_dynamic(), a.spin},
                             {b.mass(), b.radius(), !b.is_dynamic(), b.spin},
                             {restitution, laws_.tangential_restitution, laws_.friction});
  }
  return outcome;
}

// The rule of contact durations: has one of the two dynamic disks met another body less than that
// ago?
template <class S, class Laws>
bool BasicWorld<S, Laws>::collided_lately(ConstBody a, const Time<S>& instant, ConstBody b) const {
  if (!(laws_.contact_duration > S(0))) return false;
  const auto lately = [&](ConstBody body) {
    return body.is_dynamic() &&
           difference<S>(instant, body.last_contact).hi < laws_.contact_duration;
  };
  return lately(a) || lately(b);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::note_contact(Slot slot,
                                       const DoubleWord<S>& spin_change,
                                       const Time<S>& instant) {
  if constexpr (!Laws::kPlain) {
    at(slot).last_contact = instant;
    at(slot).spin = at(slot).spin + spin_change;
  }
}

// Contacts that lose energy commute at a right angle alone, rough ones not even there.
template <class S, class Laws>
bool BasicWorld<S, Laws>::order_matters_between(
    const Vector2& n1, const Vector2& n2, double w0, double w1, double w2) const {
  if constexpr (!Laws::kPlain) {
    if (laws_.is_rough) return true;
    if (laws_.disk_restitution < S(1) || laws_.wall_restitution < S(1)) return !commute(n1, n2);
  }
  return order_matters(n1, n2, w0, w1, w2);
}

/// Of a disk that turns with moment of inertia m r^2 / 2, J.
template <class S, class Laws>
DoubleWord<S> BasicWorld<S, Laws>::twice_spin_energy(ConstBody body) const {
  if constexpr (Laws::kPlain) {
    return {};
  } else {
    if (!laws_.is_rough) return {};
    return square(body.spin * body.radius()) * body.mass() * S(0.5);
  }
}

/// What a world of that kind holds of a disk besides its motion, and this one may not.
template <class S, class Laws>
template <class Sink>
void BasicWorld<S, Laws>::write_body_part(Sink& sink, Slot slot, const Effects& kind) const {
  const LawsKind laws = laws_for(kind, is_periodic());
  const Rotation rotation = rotation_of(slot);
  sink.word(std::bit_cast<std::uint64_t>(rotation.angle));
  if (laws == LawsKind::Plain) {
    sink.word(std::bit_cast<std::uint64_t>(rotation.spin));
    return;
  }
  if constexpr (Laws::kPlain) {
    write_scalar(sink, detail::stored<S>(rotation.spin));
    write_time(sink, ContactLaws::BodyPart<S>{}.last_contact);
  } else {
    write_scalar(sink, at(slot).spin);
    write_time(sink, at(slot).last_contact);
  }
  if (laws == LawsKind::Growing) {
    if constexpr (Laws::kGrows) {
      write_scalar(sink, at(slot).grown);
    } else {
      write_scalar(sink, DoubleWord<S>{at(slot).radius(), S(0)});
    }
  }
  if (laws == LawsKind::Accelerated || laws == LawsKind::Dragged) {
    if constexpr (Laws::kCurved) {
      sink.word(at(slot).support);
      sink.word(at(slot).second_support);
      sink.word(at(slot).slid_off);
    } else {
      for (int i = 0; i < 3; ++i) sink.word(kNoId);
    }
    if (is_periodic()) {
      const RestImages images = rest_images(slot);
      for (const Image& k : {images.support, images.second_support, images.slid_off}) {
        sink.word(static_cast<std::uint64_t>(k.x));
        sink.word(static_cast<std::uint64_t>(k.y));
      }
    }
  }
  if (kind.thermostat) write_kicks(sink, slot, *kind.thermostat);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::read_body_part(ByteSource& source, Slot slot) {
  const auto angle = std::bit_cast<double>(source.word());
  if constexpr (Laws::kPlain) {
    set_rotation(slot, {angle, std::bit_cast<double>(source.word())});
  } else {
    at(slot).angle = angle;
    at(slot).spin = read_double_word<S>(source);
    at(slot).last_contact = read_time<Time<S>>(source);
  }
  if constexpr (Laws::kGrows) at(slot).grown = read_double_word<S>(source);
  if constexpr (Laws::kCurved) {
    at(slot).support = source.word();
    at(slot).second_support = source.word();
    at(slot).slid_off = source.word();
    if (is_periodic()) {
      RestImages images;
      for (Image* k : {&images.support, &images.second_support, &images.slid_off}) {
        k->x = static_cast<std::int64_t>(source.word());
        k->y = static_cast<std::int64_t>(source.word());
      }
      set_rest_images(slot, images);
    }
  }
  read_kicks(source, slot);
}

}  // namespace stoss::engine

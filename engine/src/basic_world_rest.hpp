// SPDX-License-Identifier: Apache-2.0
#pragma once

// Rest under gravity, as a state of a disk: it slides along a wall's face, or lies on what holds
// it, and costs no events until something happens to it. Worlds of AcceleratedLaws alone have this.
//
// What is treated: faces of walls (flat: the disk slides on for ever, inclined: with the pull along
// the wall), and two supports, or one exactly below, that hold a slow disk up. What is not: a disk
// that rolls over a wall's end or a static disk, and piles on dynamic disks. With a rest speed they
// hop: they separate at no less than that speed times the steepness of the contact, and the contact
// is marked as regularised. Without one their bounces collapse into one instant, where the world
// stops and names the disk.

#include "basic_world.hpp"
#include "motion_law/rest.hpp"

namespace stoss::engine {

/// Are a and the image of b a disk and what it slides or lies on? They have no contacts with each
/// other.
template <class S, class Laws>
bool BasicWorld<S, Laws>::rests_on(Slot a, Slot b, const Which& image) const {
  const auto bears = [this](Slot disk, Slot support, const Which& k) {
    const Id id = at(support).id;
    return (at(disk).support == id && rest_images(disk).support == k) ||
           (at(disk).second_support == id && rest_images(disk).second_support == k);
  };
  return bears(a, b, image) || bears(b, a, -image);
}

template <class S, class Laws>
RestImages BasicWorld<S, Laws>::rest_images([[maybe_unused]] Slot disk) const {
  if constexpr (!Laws::kPlain) {
    if (index(disk) < space_.rests.size()) return space_.rests[index(disk)];
  }
  return {};
}

template <class S, class Laws>
void BasicWorld<S, Laws>::set_rest_images([[maybe_unused]] Slot disk,
                                          [[maybe_unused]] const RestImages& images) {
  if constexpr (Laws::kCurved) {
    if (!is_periodic()) return;
    if (index(disk) >= space_.rests.size()) space_.rests.resize(index(disk) + 1);
    space_.rests[index(disk)] = images;
  }
}

/// Does the disk rest on the support, whichever image of it?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_held_by(Slot disk, Slot support) const {
  const Id id = at(support).id;
  return at(disk).support == id || at(disk).second_support == id;
}

/// Ends a rest: the disk falls freely from here on. The caller writes its motion and its law.
template <class S, class Laws>
void BasicWorld<S, Laws>::let_go([[maybe_unused]] Slot slot) {
  if constexpr (Laws::kCurved) {
    at(slot).support = kNoId;
    at(slot).second_support = kNoId;
    at(slot).slid_off = kNoId;
    set_rest_images(slot, {});
  }
}

/// What a contact with something immovable does when its rebound is too slow to matter and gravity
/// presses the disk on it: nothing is thrown back.
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_last_bounce(const Contact& contact,
                                         const PairImpulse<S>& elastic,
                                         const S& restitution) const {
  if (at(contact.a).is_dynamic() == at(contact.b).is_dynamic()) return false;
  if (!(elastic.approach_speed * restitution <= laws_.rest_speed)) return false;
  const Vector2 normal(static_cast<double>(elastic.normal_x),
                       static_cast<double>(elastic.normal_y));
  const bool a_falls = at(contact.a).is_dynamic();
  const Vector2 down = detail::rounded(pull_towards(a_falls ? contact.b : contact.a));
  if (!((a_falls ? down.dot(normal) : -down.dot(normal)) > 0)) return false;
  return contact.kind == EventKind::DiskWall || finds_hold(contact).has_value();
}

/// For a disk that is pressed so slowly on what cannot hold it that its bounces would collapse: the
/// speed of its least bounce, m/s, which takes as long on every slope; else 0.
template <class S, class Laws>
S BasicWorld<S, Laws>::hop_speed(const Contact& contact,
                                 const PairImpulse<S>& elastic,
                                 const S& restitution) const {
  const Vector2 pull = detail::rounded(at(contact.b).acceleration - at(contact.a).acceleration);
  const Vector2 normal(static_cast<double>(elastic.normal_x),
                       static_cast<double>(elastic.normal_y));
  const double strength = Laws::kDragged ? pull.norm() : detail::rounded(laws_.gravity).norm();
  const double pressed = -pull.dot(normal) / strength;
  if (!(pressed > 0)) return S(0);
  const S speed = laws_.hop_speed * S(pressed);
  return elastic.approach_speed * restitution < speed ? speed : S(0);
}

/// The support that holds a slow disk up together with the one it has just met.
template <class S, class Laws>
auto BasicWorld<S, Laws>::finds_hold(const Contact& contact) const -> std::optional<Hold> {
  constexpr double kTouching = 1e-9;  // of the radius; chosen: far above a last bounce's height
  const bool a_falls = at(contact.a).is_dynamic();
  const Slot disk = a_falls ? contact.a : contact.b;
  const Slot first = a_falls ? contact.b : contact.a;
  const DoubleWord2<S> slip = velocity_of(disk, now_) - velocity_of(first, now_);
  if (!(detail::sum_norm(slip) <= S(2) * laws_.rest_speed)) return std::nullopt;
  const Vector2 down = detail::rounded(pull_towards(first));
  const Which image_of_first = a_falls ? contact.image : -contact.image;
  const Vector2 up_from_first = -normal_towards(disk, first, image_of_first);
  if (contact.kind != EventKind::DiskWall && holds_up(down, up_from_first, up_from_first)) {
    return Hold{};
  }
  std::optional<Hold> hold;
  for_each_neighbour_image(disk, [&](Slot other, const Which& image) {
    if ((other == first && image == image_of_first) || at(other).is_dynamic()) return;
    if (hold && at(other).id > hold->id) return;
    if (clearance(disk, other, image) > kTouching * static_cast<double>(at(disk).radius())) return;
    const DoubleWord2<S> apart = velocity_of(first, now_) - velocity_of(other, now_);
    if (detail::sum_norm(apart) > S(0)) return;
    const Vector2 up_from_other = -normal_towards(disk, other, image);
    if (holds_up(down, up_from_first, up_from_other)) hold = Hold{at(other).id, image};
  });
  return hold;
}

/// The disk of a last bounce, whose velocity is written, takes its place on the support.
template <class S, class Laws>
void BasicWorld<S, Laws>::settle_down(const Contact& contact) {
  const bool a_falls = at(contact.a).is_dynamic();
  const Slot disk = a_falls ? contact.a : contact.b;
  const Slot support = a_falls ? contact.b : contact.a;
  const std::optional<Hold> hold = finds_hold(contact);
  at(disk).support = at(support).id;
  RestImages images;
  images.support = a_falls ? contact.image : -contact.image;
  if (hold) {
    const bool is_another = hold->id != kNoId;
    at(disk).second_support = is_another ? hold->id : at(support).id;
    images.second_support = is_another ? hold->image : images.support;
    at(disk).set_velocity(velocity_of(support, now_));
  }
  set_rest_images(disk, images);
  renew_law(disk);
}

/// The acceleration of a disk that rests, and for how long it has it.
template <class S, class Laws>
void BasicWorld<S, Laws>::renew_rest(Slot slot) {
  auto&& body = at(slot);
  const Slot support = slot_of(body.support);
  body.acceleration = wind_on(support);
  if (body.second_support != kNoId) return;
  const DoubleWord2<S>& edge = shape(support).edge;
  const DoubleWord2<S> pull = pull_along(pull_towards(support), edge);
  const DoubleWord2<S> from_start =
      apart(body.position(), position_of(support, body.since()), -rest_images(slot).support);
  const DoubleWord2<S> slip = body.velocity() - velocity_of(support, body.since());
  if constexpr (Laws::kDragged) {
    body.acceleration = body.acceleration + pull;
    body.moves_for = slide_under_drag_lasts(from_start, slip, pull, edge, laws_.drag);
  } else {
    body.acceleration = pull;
    body.moves_for = slide_lasts(from_start, slip, pull, edge);
  }
}

/// Do bytes name supports that there are, and that can be some?
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_sound_supports([[maybe_unused]] Slot slot) const {
  if constexpr (Laws::kCurved) {
    const auto& body = at(slot);
    const auto is_fixed = [this](Id id) {
      const Slot found = find_slot(id);
      return found >= 0 && !at(found).is_dynamic();
    };
    if (body.support == kNoId) return body.second_support == kNoId;
    if (!body.is_dynamic() || !is_fixed(body.support)) return false;
    if (body.second_support != kNoId) return is_fixed(body.second_support);
    return at(slot_of(body.support)).is_wall();
  } else {
    return true;
  }
}

/// A support is about to move or to go: whoever rests on it is let go, and is returned.
template <class S, class Laws>
std::vector<Slot> BasicWorld<S, Laws>::wake_disks_on(Slot support) {
  std::vector<Slot> woken;
  for_each_neighbour(support, [&](Slot other) {
    if (at(other).is_dynamic() && is_held_by(other, support)) woken.push_back(other);
  });
  for (const Slot disk : woken) {
    rebase(disk, now_);
    let_go(disk);
    renew_law(disk);
  }
  return woken;
}

}  // namespace stoss::engine

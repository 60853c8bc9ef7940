// SPDX-License-Identifier: Apache-2.0
#pragma once

// The kinds of world that the engine is compiled for, and the only place that names them. A world
// is an instance of one of them, picked when it is made (core_of.hpp); inside the event loop
// nothing asks which.
//
// A kind says: what a body holds on its behalf (BodyPart), what it is set to (Settings), how two
// bodies move relative to each other (Relative), how far from each other they touch (Radius,
// Reach), and which kernels find their contacts.

#include "contact_time/accelerated_disk_disk.hpp"
#include "contact_time/accelerated_disk_wall.hpp"
#include "contact_time/curved_rim_crossing.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"
#include "contact_time/drag_curve.hpp"
#include "contact_time/drag_face.hpp"
#include "contact_time/growing.hpp"
#include "contact_time/rim_crossing.hpp"

#include <stoss/engine/effects.hpp>
#include <stoss/engine/instant.hpp>

#include <limits>

namespace stoss::engine {

/// Named after the laws below.
enum class LawsKind { Plain, Contact, Growing, Accelerated, Dragged };

/// The least that has all these effects, in a periodic world or an open one.
inline LawsKind laws_for(const Effects& effects, bool is_periodic = false) {
  if (effects == Effects{} && !is_periodic) return LawsKind::Plain;
  if (effects.growth) return LawsKind::Growing;
  if (effects.drag && effects.drag->rate > 0) return LawsKind::Dragged;
  if (effects.gravity || effects.floor_friction) return LawsKind::Accelerated;
  return LawsKind::Contact;
}

/// Contacts of bodies in uniform motion; what they are asked to do "within" is for ever.
struct UniformMotion {
  static constexpr bool kCurved = false;
  static constexpr bool kDragged = false;
  static constexpr bool kGrows = false;
  template <class S>
  using Relative = RelativeMotion<S>;
  template <class S>
  using Radius = S;
  template <class S>
  using Reach = DoubleWord<S>;

  template <class S>
  static auto pair_contact(const RelativeMotion<S>& motion, const DoubleWord<S>& reach, const S&) {
    return disk_disk_contact<S>(motion, reach);
  }
  template <class S>
  static auto face_contact(const RelativeMotion<S>& motion,
                           const DoubleWord2<S>& edge,
                           const S& radius,
                           const S&) {
    return disk_wall_face_contact<S>(motion, edge, radius);
  }
  template <class S>
  static auto point_contact(const RelativeMotion<S>& motion, const S& radius, const S&) {
    return disk_point_contact<S>(motion, radius);
  }
  template <class S>
  static auto zone_crossing(const RelativeMotion<S>& motion,
                            const S& radius,
                            bool is_inside,
                            const S&) {
    return rim_crossing<S>(motion, radius, is_inside);
  }
};

/// Contacts of bodies in uniformly accelerated motion, `within` so many seconds.
struct AcceleratedMotions {
  static constexpr bool kCurved = true;
  static constexpr bool kDragged = false;
  static constexpr bool kGrows = false;
  template <class S>
  using Relative = AcceleratedMotion<S>;
  template <class S>
  using Radius = S;
  template <class S>
  using Reach = DoubleWord<S>;

  template <class S>
  static auto pair_contact(const AcceleratedMotion<S>& motion,
                           const DoubleWord<S>& reach,
                           const S& within) {
    return accelerated_disk_contact<S>(motion, reach, within);
  }
  template <class S>
  static auto face_contact(const AcceleratedMotion<S>& motion,
                           const DoubleWord2<S>& edge,
                           const S& radius,
                           const S& within) {
    return accelerated_face_contact<S>(motion, edge, radius, within);
  }
  template <class S>
  static auto point_contact(const AcceleratedMotion<S>& motion, const S& radius, const S& within) {
    return accelerated_point_contact<S>(motion, radius, within);
  }
  template <class S>
  static auto zone_crossing(const AcceleratedMotion<S>& motion,
                            const S& radius,
                            bool is_inside,
                            const S& within) {
    return accelerated_rim_crossing<S>(motion, radius, is_inside, within);
  }
};

/// Contacts of bodies under linear drag, `within` so many seconds.
struct DraggedMotions {
  static constexpr bool kCurved = true;
  static constexpr bool kDragged = true;
  static constexpr bool kGrows = false;
  template <class S>
  using Relative = DragMotion<S>;
  template <class S>
  using Radius = S;
  template <class S>
  using Reach = DoubleWord<S>;

  template <class S>
  static auto pair_contact(const DragMotion<S>& motion,
                           const DoubleWord<S>& reach,
                           const S& within) {
    return drag_curve_contact<S>(motion, reach, motion.rate, within);
  }
  template <class S>
  static auto face_contact(const DragMotion<S>& motion,
                           const DoubleWord2<S>& edge,
                           const S& radius,
                           const S& within) {
    return drag_face_contact<S>(motion, edge, radius, motion.rate, within);
  }
  template <class S>
  static auto point_contact(const DragMotion<S>& motion, const S& radius, const S& within) {
    return drag_curve_contact<S>(motion, {radius, S(0)}, motion.rate, within);
  }
  template <class S>
  static auto zone_crossing(const DragMotion<S>& motion,
                            const S& radius,
                            bool is_inside,
                            const S& within) {
    return drag_rim_crossing<S>(motion, radius, is_inside, within);
  }
};

/// Contacts of disks in uniform motion whose radii grow.
struct GrowingDisks {
  static constexpr bool kCurved = false;
  static constexpr bool kDragged = false;
  static constexpr bool kGrows = true;
  template <class S>
  using Relative = RelativeMotion<S>;
  template <class S>
  using Radius = DoubleWord<S>;
  template <class S>
  using Reach = GrowingReach<S>;

  template <class S>
  static auto pair_contact(const RelativeMotion<S>& motion,
                           const GrowingReach<S>& reach,
                           const S&) {
    return growing_disk_contact<S>(motion, reach);
  }
  template <class S>
  static auto face_contact(const RelativeMotion<S>& motion,
                           const DoubleWord2<S>& edge,
                           const GrowingReach<S>& radius,
                           const S&) {
    return growing_face_contact<S>(motion, edge, radius);
  }
  template <class S>
  static auto point_contact(const RelativeMotion<S>& motion,
                            const GrowingReach<S>& radius,
                            const S&) {
    return growing_disk_contact<S>(motion, radius);
  }
  template <class S>
  static auto zone_crossing(const RelativeMotion<S>& motion,
                            const S& radius,
                            bool is_inside,
                            const S&) {
    return rim_crossing<S>(motion, radius, is_inside);
  }
};

/// Uniform motion, elastic contacts, and not a byte or an instruction for anything else.
struct PlainLaws : UniformMotion {
  static constexpr bool kPlain = true;
  template <class S>
  struct BodyPart {};
  template <class S>
  struct Settings {
    explicit Settings(const Effects&) {}
    Effects effects() const { return {}; }
  };
};

/// Uniform motion; contacts that lose energy or turn disks.
struct ContactLaws : UniformMotion {
  static constexpr bool kPlain = false;

  template <class S>
  struct BodyPart {
    DoubleWord<S> spin;  ///< rad/s
    double angle = 0;    ///< rad, at the motion's `since`
    /// Long before any contact that a rule of durations could see.
    Time<S> last_contact = from_instant<Time<S>>({-kSecondsMax + 1, 0});
  };

  template <class S>
  struct Settings {
    explicit Settings(const Effects& effects)
        : is_rough(effects.rough.has_value()),
          disk_restitution(effects.restitution ? S(effects.restitution->coefficient) : S(1)),
          wall_restitution(effects.restitution ? S(effects.restitution->wall_coefficient) : S(1)),
          contact_duration(effects.restitution ? S(effects.restitution->contact_duration) : S(0)),
          tangential_restitution(effects.rough ? S(effects.rough->tangential_restitution) : S(-1)),
          friction(effects.rough ? S(effects.rough->friction) : S(0)),
          as_asked(effects) {}
    Effects effects() const { return as_asked; }

    bool is_rough;
    S disk_restitution;  ///< of disks among themselves
    S wall_restitution;
    S contact_duration;  ///< s; 0: no rule
    S tangential_restitution;
    S friction;
    Effects as_asked;
  };
};

/// Uniform motion; disks that grow, and contacts that may lose energy.
struct GrowingLaws : GrowingDisks {
  static constexpr bool kPlain = false;

  template <class S>
  struct BodyPart : ContactLaws::BodyPart<S> {
    DoubleWord<S> grown;      ///< the radius at the motion's `since`, m; 0 for a wall
    double boxed_radius = 0;  ///< when the body's box was made, m; of no result
  };

  template <class S>
  struct Settings : ContactLaws::Settings<S> {
    explicit Settings(const Effects& effects)
        : ContactLaws::Settings<S>(effects), growth(S(effects.growth->rate)) {}
    S growth;  ///< m/s
  };
};

/// Uniform gravity, or friction with the floor; any contacts.
struct AcceleratedLaws : AcceleratedMotions {
  /// Where a scene names none. Chosen: a bounce of 5e-20 m in ordinary gravity.
  static constexpr double kRestSpeedMps = 1e-9;
  static constexpr bool kPlain = false;

  template <class S>
  struct BodyPart : ContactLaws::BodyPart<S> {
    DoubleWord2<S> acceleration;  ///< m/s^2
    /// s after `since`, until it stops or slides off by itself
    DoubleWord<S> moves_for{std::numeric_limits<S>::infinity(), S(0)};
    Id support = kNoId;         ///< what it slides or lies on
    Id second_support = kNoId;  ///< it lies, held by both (they may be one)
    Id slid_off = kNoId;        ///< the wall whose face it has just left at an end
  };

  template <class S>
  struct Settings : ContactLaws::Settings<S> {
    explicit Settings(const Effects& effects) : ContactLaws::Settings<S>(effects) {
      if (effects.gravity) {
        gravity = {{S(effects.gravity->acceleration.x()), S(0)},
                   {S(effects.gravity->acceleration.y()), S(0)}};
      }
      if (effects.restitution && effects.restitution->rest_speed > 0) {
        rest_speed = S(effects.restitution->rest_speed);
        hop_speed = rest_speed;
      }
      if (effects.floor_friction) deceleration = S(effects.floor_friction->deceleration);
    }
    DoubleWord2<S> gravity;           ///< m/s^2
    S deceleration{};                 ///< m/s^2
    S rest_speed = S(kRestSpeedMps);  ///< m/s
    S hop_speed{};                    ///< m/s; 0: no least bounce
  };
};

/// Linear drag, with gravity or without; any contacts. The acceleration of a body is here what
/// pulls at it besides the drag: m V for one that keeps its velocity V.
struct DragLaws : DraggedMotions {
  static constexpr bool kPlain = false;

  template <class S>
  using BodyPart = AcceleratedLaws::BodyPart<S>;

  template <class S>
  struct Settings : AcceleratedLaws::Settings<S> {
    explicit Settings(const Effects& effects)
        : AcceleratedLaws::Settings<S>(effects), drag(S(effects.drag->rate)) {}
    S drag;  ///< 1/s, > 0
  };
};

}  // namespace stoss::engine

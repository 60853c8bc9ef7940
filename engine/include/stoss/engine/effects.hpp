// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a world may have besides uniform motion, elastic contacts and open space. An effect that is
// absent is simulated nowhere: the world is then an instance of the engine that does not know it.

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>

#include <cstdint>
#include <optional>

namespace stoss::engine {

/// Uniform gravity on dynamic disks.
struct Gravity {
  Vector2 acceleration = Vector2::Zero();  ///< m/s^2

  friend bool operator==(const Gravity&, const Gravity&) = default;
};

/// Friction with the floor on dynamic disks: a constant deceleration to a stop.
struct FloorFriction {
  double deceleration = 0;  ///< m/s^2, >= 0

  friend bool operator==(const FloorFriction&, const FloorFriction&) = default;
};

/// Contacts that lose energy: the normal relative speed after one is `coefficient` times that
/// before. NUMERICS B1; the guard: Luding and McNamara, Granular Matter 1 (1998) 113.
struct Restitution {
  double coefficient = 1;       ///< of disks among themselves, in [0, 1]
  double wall_coefficient = 1;  ///< of disks with walls, in [0, 1]
  /// s; a contact less than this after an earlier one of either disk is elastic, and marked as
  /// regularised. 0: never, and then an inelastic collapse stops the world.
  double contact_duration = 0;
  /// m/s; under gravity or drag a disk whose bounce would be slower than this stays on what it has
  /// met. 0: 1e-9.
  double rest_speed = 0;

  friend bool operator==(const Restitution&, const Restitution&) = default;
};

/// Rough contacts, which turn disks: uniform disks with a moment of inertia of m r^2 / 2. Walton
/// and Braun, J. Rheol. 30 (1986) 949.
struct Rough {
  /// The tangential relative velocity of the surfaces after a contact that sticks is minus this
  /// times that before; in [-1, 1]. -1: smooth.
  double tangential_restitution = -1;
  double friction = 0;  ///< Coulomb's limit: tangential over normal impulse, >= 0

  friend bool operator==(const Rough&, const Rough&) = default;
};

/// Kicks that hold a temperature, after Andersen, J. Chem. Phys. 72 (1980) 2384: at the points of a
/// Poisson process a dynamic disk gets a velocity of the Maxwell distribution, and a rough one a
/// spin. What is drawn is a function of (seed, id of the body, its kicks so far).
struct Thermostat {
  double temperature = 0;  ///< J: kT, the mean kinetic energy of the two directions together
  double rate = 0;         ///< kicks a second of each disk, >= 0
  std::uint64_t seed = 0;

  friend bool operator==(const Thermostat&, const Thermostat&) = default;
};

/// Linear drag on dynamic disks, by a medium at rest: velocities fall as e^(-rate t).
struct Drag {
  double rate = 0;  ///< 1/s; 0, or in [1e-12, 1e12]

  friend bool operator==(const Drag&, const Drag&) = default;
};

/// Disks of all kinds whose radii grow alike, so that a packing can be made. Lubachevsky and
/// Stillinger, J. Stat. Phys. 60 (1990) 561.
struct Growth {
  double rate = 0;  ///< of each radius, m/s, >= 0

  friend bool operator==(const Growth&, const Growth&) = default;
};

/// Present = on.
struct Effects {
  std::optional<Gravity> gravity;
  std::optional<FloorFriction> floor_friction;
  std::optional<Restitution> restitution;
  std::optional<Rough> rough;
  std::optional<Thermostat> thermostat;
  std::optional<Drag> drag;
  std::optional<Growth> growth;
  /// The world takes zones, as one with any effect does. Set by itself when a zone comes into a
  /// world without effects, and as long as there are zones; it shows nowhere but here.
  bool zones = false;

  friend bool operator==(const Effects&, const Effects&) = default;
};

/// Nothing if a world can have these effects together. Errors: InvalidArgument for a number out of
/// its range, with the field as in "restitution.coefficient"; Unimplemented for a combination that
/// has no exact treatment.
[[nodiscard]] std::optional<Reject> check_effects(const Effects& effects);

/// Nothing if a world can have these periods (m; 0: open along that axis). Errors: InvalidArgument
/// for a number that is none, negative, or beyond the range of lengths, with the field "period.x"
/// or "period.y".
[[nodiscard]] std::optional<Reject> check_period(const Vector2& period);

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Watches over a running world: every so many events a census of overlaps and missed contacts, and
// the books of energy and momentum. It only asks, so no byte of the world depends on it.
//
// What is conserved. Collisions of dynamic disks with one another keep both sums; walls and disks
// that are not dynamic take momentum up, and do work when they move; commands change what they
// like. The verifier books all of that as it happens, so that the drift it reports is the world's
// own error whatever the scene:
//
//   dp = -J n,   dE = V . dp                                                          (1)
//
// for a dynamic disk that meets an immovable body of velocity V (m/s), J: impulse (kg m/s), n: unit
// normal out of the disk. (1) is exact for elastic contacts: (v + v') . n = 2 V . n.
//
// In a world with effects contacts lose energy and gravity gives momentum: there the books stay
// shut, and overlaps and missed contacts alone are checked.
//
// Accuracy: the books are kept in double-words, but impulses reach them rounded to the world's
// arithmetic (at most to double). So a healthy drift is a random walk of that rounding per contact
// with an immovable body, and nothing but the world's own rounding where there is none.
//
// Thread safety: none; it belongs to the thread of its world.

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/engine/world.hpp>

#include <cstdint>
#include <span>
#include <unordered_set>

namespace stoss::engine {

/// Events between two checks unless told otherwise; chosen: a census of N bodies costs about as
/// much as 10 N collisions, so that a world of 10,000 spends half of its time on them at most.
inline constexpr std::uint64_t kVerifyPeriod = 100'000;

/// What all checks found together. Zero is the only good figure for `overlaps` and `missed`.
struct Verification {
  std::uint64_t checks = 0;
  std::uint64_t overlaps = 0;  ///< pairs deeper than overlap_tolerance(), summed over the checks
  std::uint64_t missed = 0;    ///< contacts in the past that were not processed, likewise
  double deepest = 0;          ///< overlap of any pair, as a part of its contact distance
  double energy_error = 0;     ///< largest |E - booked| as a part of the largest E of the world
  double momentum_error = 0;   ///< largest |p - booked| as a part of sqrt(2 E M), M: total mass
};

/// The deepest overlap that rounding explains, as a part of the contact distance: 1e-9, in float
/// 1e-3 (NUMERICS.md). A hundred times the deepest that healthy dense runs show, or more.
double overlap_tolerance(Arithmetic arithmetic);
/// The drift of energy or momentum that rounding explains: the square root of the rounding unit.
double drift_tolerance(Arithmetic arithmetic);
/// No overlap, nothing missed, and no drift beyond drift_tolerance().
bool is_healthy(const Verification& found, Arithmetic arithmetic);

class Verifier {
 public:
  /// REQUIRES: period > 0.
  explicit Verifier(std::uint64_t period) : period_(period), left_(period) {}

  /// Opens the books on a world that takes the place of the one before; findings are kept.
  void begin(const World& world);

  /// Books a collision. Every one must be told, in order.
  void on_collision(const Collision& collision);
  /// Around a command: the bodies that it may change, before and after. Ids that do not exist then
  /// are passed over, so both may be called with all ids that the command names or makes.
  void take_out(const World& world, std::span<const Id> ids);
  void put_in(const World& world, std::span<const Id> ids);

  [[nodiscard]] std::uint64_t period() const { return period_; }
  /// Events until the next check is due; 0: now. To be asked before each advance.
  [[nodiscard]] std::uint64_t events_left() const { return left_; }
  void count_events(std::uint64_t events) { left_ -= events < left_ ? events : left_; }

  /// Checks the world now, and counts the events to the next check anew.
  const Verification& check(const World& world);
  [[nodiscard]] const Verification& found() const { return found_; }

 private:
  struct Sums {
    DoubleWord<double> energy;     // J
    DoubleWord2<double> momentum;  // kg m/s
  };

  void book(const World& world, Id id, double sign);
  void give(const Vector2& impulse, const Vector2& velocity);
  void audit(const World& world);

  std::uint64_t period_;
  std::uint64_t left_;
  Sums booked_;
  std::unordered_set<Id> immovable_;  // disks that are not dynamic
  double energy_max_ = 0;             // of this world so far, J
  bool keeps_books_ = true;
  Verification found_;
};

}  // namespace stoss::engine

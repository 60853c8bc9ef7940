// SPDX-License-Identifier: Apache-2.0
// When ticks are due in real time. Slips when the machine is too slow, and never skips a tick:
// simulated time advances by whole ticks whatever real time does.
#pragma once

#include "clock.hpp"

#include <stoss/engine/instant.hpp>

#include <cstdint>

namespace stoss::service {

/// Ticks that are late are caught up at a stretch: so many, or as many as fall into kCatchUpTime if
/// that is more. The rest of the delay is put off for good. More would let a daemon that was
/// suspended run wild; fewer would slow a world down for every hiccup of the scheduler.
inline constexpr unsigned kCatchUpTicks = 4;
inline constexpr Nanoseconds kCatchUpTime{50'000'000};
/// At very high tick rates the world's thread would not come back for too long.
inline constexpr unsigned kCatchUpTicksMax = 1000;

/// Ties simulated instants to real time by an anchor and a speed.
class Pacer {
 public:
  /// `speed`: simulated seconds per real second, > 0; infinity: as fast as possible.
  Pacer(double tick_rate, double speed) : period_s_(1 / tick_rate), speed_(speed) {}

  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] bool flat_out() const;
  void set_speed(double speed) { speed_ = speed; }
  /// How many late ticks may be caught up at a stretch.
  [[nodiscard]] unsigned catch_up_ticks() const;

  /// From here on `instant` belongs to the real time `now`. Needed after every pause and change of
  /// speed.
  void anchor(Nanoseconds now, const engine::Instant& instant);

  /// The real time at which an instant after the anchor is due; the anchor's own when flat out.
  [[nodiscard]] Nanoseconds due(const engine::Instant& instant) const;

  /// Notes that the tick at `instant` begins. It counts as late when that is a whole period or more
  /// after it was due.
  void note_begin(Nanoseconds now, const engine::Instant& instant);

  /// After as many ticks at a stretch as may be: if the next is due already, moves the anchor so
  /// that it is due now, and counts the whole ticks that were put off.
  void slip(Nanoseconds now, const engine::Instant& next);

  [[nodiscard]] std::uint64_t ticks_late() const { return late_; }
  [[nodiscard]] std::uint64_t ticks_slipped() const { return slipped_; }

 private:
  [[nodiscard]] double real_period_ns() const;

  double period_s_;
  double speed_;
  Nanoseconds anchor_time_{0};
  engine::Instant anchor_instant_;
  std::uint64_t late_ = 0;
  std::uint64_t slipped_ = 0;
  double slipped_rest_ = 0;  ///< part of a tick put off and not counted yet
};

}  // namespace stoss::service

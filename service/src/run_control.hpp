// SPDX-License-Identifier: Apache-2.0
// Whether simulated time runs, how far, and the numbers of ticks. Knows no real time.
//
// Invariants:
//  1. The instant of a tick is computed from its number.
//  2. tick() is the number of the last tick at or before the present.
//  3. stop_at() is at or after the present.
#pragma once

#include <stoss/engine/tick_clock.hpp>

#include <cstdint>
#include <optional>

namespace stoss::service {

class RunControl {
 public:
  RunControl(const engine::TickClock& clock, bool running) : clock_(clock), running_(running) {}

  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] std::uint64_t tick() const { return tick_; }
  [[nodiscard]] const engine::TickClock& clock() const { return clock_; }
  /// The instant of the tick after tick().
  [[nodiscard]] engine::Instant next_tick() const { return clock_.instant_of(tick_ + 1); }
  /// Where the world is to be paused, if anywhere.
  [[nodiscard]] const std::optional<engine::Instant>& stop_at() const { return stop_at_; }

  void pause() {
    running_ = false;
    stop_at_.reset();
  }
  /// Runs on without an end.
  void resume() {
    running_ = true;
    stop_at_.reset();
  }
  /// Runs up to an instant at or after the present, and pauses there.
  void run_to(const engine::Instant& instant) {
    running_ = true;
    stop_at_ = instant;
  }

  /// The world's present is now `now`, at or before next_tick().
  void reached(const engine::Instant& now) {
    if (now >= next_tick()) ++tick_;
  }
  /// Pauses when `now` is where the world is to be paused.
  void stop_if_due(const engine::Instant& now) {
    if (stop_at_ && now >= *stop_at_) pause();
  }
  /// Back to tick 0.
  void restart() {
    tick_ = 0;
    stop_at_.reset();
  }

  /// The number of the last tick at or before `instant`, which is not before the start.
  [[nodiscard]] std::uint64_t tick_at(const engine::Instant& instant) const {
    const auto next = clock_.first_at_or_after(instant);
    if (!next) return ~std::uint64_t{0};
    return clock_.instant_of(*next) == instant ? *next : *next - 1;
  }

 private:
  engine::TickClock clock_;
  bool running_;
  std::uint64_t tick_ = 0;
  std::optional<engine::Instant> stop_at_;
};

}  // namespace stoss::service

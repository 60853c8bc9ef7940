// SPDX-License-Identifier: Apache-2.0
// When frames are sent: at a rate of their own, but not again what was sent already. A frame whose
// time comes a little before its tick's waits for that. Without that a world of as many ticks as
// frames would lose every frame whose tick came late by the least.
#pragma once

#include "clock.hpp"

#include <cstdint>

namespace stoss::service {

class FrameTimes {
 public:
  FrameTimes(Nanoseconds interval, Nanoseconds first) : interval_(interval), next_(first) {}

  /// Is one to be sent now? Asked when next() has come, and when there is news since the last one.
  /// It is told when it waits for no news a whole interval.
  [[nodiscard]] bool take(Nanoseconds now, bool is_news) {
    const bool is_due = now >= next_;
    if (is_due) next_ += interval_;
    if (next_ < now) {  // the newest wins; those in between are never made
      ++late_;
      next_ = now + interval_;
    }
    const bool has_waited = waits_;
    waits_ = (is_due || has_waited) && !is_news;
    return is_news ? is_due || has_waited : is_due && has_waited;
  }

  [[nodiscard]] Nanoseconds next() const { return next_; }
  /// How often some were left out.
  [[nodiscard]] std::uint64_t late() const { return late_; }

 private:
  Nanoseconds interval_;
  Nanoseconds next_;
  bool waits_ = false;
  std::uint64_t late_ = 0;
};

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include "pacer.hpp"

#include <algorithm>
#include <cmath>

namespace stoss::service {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
/// Due times are cut off here, so that a very slow world does not leave the range of the clock.
constexpr double kFarNs = 1e18;

}  // namespace

bool Pacer::flat_out() const { return std::isinf(speed_); }

double Pacer::real_period_ns() const { return period_s_ / speed_ * kNanosecondsPerSecond; }

unsigned Pacer::catch_up_ticks() const {
  const double ticks = static_cast<double>(kCatchUpTime.count()) / real_period_ns();
  return std::max(kCatchUpTicks, static_cast<unsigned>(std::min<double>(ticks, kCatchUpTicksMax)));
}

void Pacer::anchor(Nanoseconds now, const engine::Instant& instant) {
  anchor_time_ = now;
  anchor_instant_ = instant;
}

Nanoseconds Pacer::due(const engine::Instant& instant) const {
  if (flat_out()) return anchor_time_;
  const double ns =
      engine::seconds_between(anchor_instant_, instant) / speed_ * kNanosecondsPerSecond;
  return anchor_time_ + Nanoseconds(std::llround(std::min(ns, kFarNs)));
}

void Pacer::note_begin(Nanoseconds now, const engine::Instant& instant) {
  if (flat_out()) return;
  const double delay = static_cast<double>((now - due(instant)).count());
  if (delay >= real_period_ns()) ++late_;
}

void Pacer::slip(Nanoseconds now, const engine::Instant& next) {
  if (flat_out()) return;
  const Nanoseconds delay = now - due(next);
  if (delay <= Nanoseconds(0)) return;
  anchor_time_ += delay;
  slipped_rest_ += static_cast<double>(delay.count()) / real_period_ns();
  const double whole = std::floor(slipped_rest_);
  slipped_rest_ -= whole;
  slipped_ += static_cast<std::uint64_t>(whole);
}

}  // namespace stoss::service

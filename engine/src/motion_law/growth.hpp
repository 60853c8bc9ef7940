// SPDX-License-Identifier: Apache-2.0
// The radius of a growing disk: what worlds, the daemon and replicas evaluate alike.
//   (1) r(t) = r + m (t - t0)     r [m]: at t0, the disk's last physical event; m: growth [m/s]
// Source: Lubachevsky, Stillinger, J. Stat. Phys. 60 (1990) 561.
// Deviation: r is a double word, written with the motion at the disk's events and at none but
// these. Accuracy: (1) to 2^-105 of r, and as much again at each event;
// tests/engine/effects/growth_test.cpp. Preconditions: r > 0, m >= 0.
#pragma once

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/instant.hpp>

namespace stoss::engine {

/// (1) at an instant before or after `since`.
template <class S>
[[nodiscard]] inline DoubleWord<S> grown_by(const DoubleWord<S>& radius,
                                            const S& growth,
                                            const Time<S>& since,
                                            const Time<S>& instant) noexcept {
  if (instant == since || growth == S(0)) return radius;
  return radius + difference<S>(instant, since) * growth;
}

}  // namespace stoss::engine

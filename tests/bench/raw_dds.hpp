// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the daemon is compared with: bare Cyclone DDS with the daemon's types, topics and network,
// and no world behind it. Each runs until it is killed; 1 when DDS takes a sample no more.

#include <cstddef>

namespace stoss::bench {

inline constexpr unsigned kDomain = 67;
inline constexpr const char* kWorld = "bench";
inline constexpr const char* kRawWorld = "raw";  ///< where raw_frames() writes
inline constexpr int kFramesPerSecond = 60;

/// Writes frames of so many bodies from arrays of its own.
int raw_frames(std::size_t bodies);

/// Answers each command of the client 1 with a reply.
int raw_echo();

}  // namespace stoss::bench

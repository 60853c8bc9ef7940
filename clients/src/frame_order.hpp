// SPDX-License-Identifier: Apache-2.0
#pragma once

// Whole frames out of chunks. Frames are pictures: a newer one is worth more than a complete
// series, so of those that are under way only the newest few are kept.

#include <stoss/client/feeds.hpp>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace stoss::client {

/// Frames under way at once; chunks of one may arrive among those of the next.
inline constexpr std::size_t kFramesUnderWayMax = 3;

class FrameOrder {
 public:
  /// Takes in one chunk: its bodies with the frame's epoch, tick and instant. The frame, once it is
  /// whole; never one that is older than one given out before.
  std::optional<Frame> add(Frame chunk, std::uint32_t index, std::uint32_t count);

 private:
  struct Partial {
    Frame frame;
    std::vector<std::optional<std::vector<FrameBody>>> chunks;
    std::size_t arrived = 0;
  };

  [[nodiscard]] Partial* partial_of(const Frame& frame, std::uint32_t count);

  std::deque<Partial> under_way_;
  std::optional<Frame> newest_;  ///< given out; without its bodies
};

}  // namespace stoss::client

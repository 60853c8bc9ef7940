// SPDX-License-Identifier: Apache-2.0
#pragma once

// Collisions in their order without gaps, out of batches that may come late, twice or not at all.
//
// Thread safety: none. Invariant: what take() yields continues what it yielded before, by number,
// within an epoch, but for what give_up() declared lost.

#include <stoss/engine/types.hpp>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace stoss::client {

/// Collisions by number, from `first` on.
struct CollisionRange {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

class CollisionOrder {
 public:
  /// Starts with the collision of this number, or with the first that is offered.
  explicit CollisionOrder(std::optional<std::uint64_t> first);

  /// Takes in collisions of consecutive numbers. A higher epoch begins anew at number 1, a lower
  /// one is ignored.
  void offer(std::uint64_t epoch, std::vector<engine::Collision> collisions);

  /// What has to be offered before take() can go on.
  [[nodiscard]] std::optional<CollisionRange> missing() const;
  /// What is missing is not to be had any more: goes on behind it.
  void give_up();

  /// The collisions whose turn it is.
  [[nodiscard]] std::vector<engine::Collision> take();

  [[nodiscard]] std::uint64_t epoch() const { return epoch_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] std::uint64_t gaps() const { return gaps_; }

 private:
  std::deque<std::vector<engine::Collision>> held_;  ///< sorted by number, none empty
  std::optional<std::uint64_t> next_;
  std::uint64_t epoch_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t gaps_ = 0;
  std::optional<std::uint64_t> counted_;  ///< the beginning of the gap counted last
  bool any_ = false;                      ///< an epoch is known
};

}  // namespace stoss::client

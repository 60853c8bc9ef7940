// SPDX-License-Identifier: Apache-2.0
#pragma once

// Who met whom, run against run: how far a run tells the story of the reference.

#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stoss::client::accuracy {

struct Meeting {
  engine::Id a = engine::kNoId;
  engine::Id b = engine::kNoId;
  engine::Instant instant;
  bool of_disks = false;
};

/// Takes the collisions of a run. Beyond some millions it only counts.
class Story final : public engine::CollisionSink {
 public:
  void on_collision(const engine::Collision& collision) override;

  [[nodiscard]] const std::vector<Meeting>& meetings() const { return meetings_; }
  /// Collisions so far, and how many of them were of two disks.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
  [[nodiscard]] bool complete() const { return count_ == meetings_.size(); }

 private:
  std::vector<Meeting> meetings_;
  std::uint64_t count_ = 0;
  std::uint64_t pairs_ = 0;
};

/// How far a story is that of the reference.
struct Agreement {
  std::optional<engine::Instant> first_wrong;  ///< of the reference's collision that it tells not
  std::uint64_t collisions = 0;                ///< of the reference before that one
  std::uint64_t pairs = 0;                     ///< of those, collisions of two disks
};

/// Compares whom each body meets, in its own order: unrelated collisions may change places. Where a
/// story stops before a collision of the reference that is later than `open_from`, that may be the
/// end of the run and is not held against it.
[[nodiscard]] Agreement compare(const Story& reference,
                                const Story& story,
                                const engine::Instant& open_from);

}  // namespace stoss::client::accuracy

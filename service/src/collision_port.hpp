// SPDX-License-Identifier: Apache-2.0
// The collision topic: every collision in order, numbered without gaps within an epoch, and the
// last of them for those who missed some.
#pragma once

#include "records.hpp"
#include "topics.hpp"

#include <stoss/translate/columns.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stoss::service {

/// Collisions kept for ASK_COLLISIONS.
inline constexpr std::size_t kCollisionsKept = 65'536;

class CollisionPort {
 public:
  CollisionPort(const dds::Publisher& publisher, const Topics& topics)
      : writer_(idl::make_writer(publisher, topics.collision, idl::kCollisionTopic)) {}

  void begin_epoch();
  /// Publishes a tick's collisions, if there are any, and keeps them. Without a reader it only
  /// keeps them.
  void publish(const TickRecord& record);

  /// Of the last collision.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Of the oldest one that is kept; number() + 1 when there is none.
  [[nodiscard]] std::uint64_t oldest() const { return number_ + 1 - kept_; }
  /// Collision `number`. REQUIRES: oldest() <= number <= number()
  [[nodiscard]] const engine::Collision& at(std::uint64_t number) const {
    return ring_[number % kCollisionsKept];
  }
  [[nodiscard]] std::uint64_t failures() const { return writer_.failures(); }

 private:
  dds::Writer<wire::CollisionBatch> writer_;
  translate::CollisionColumns columns_;
  std::vector<engine::Collision> ring_;  // a collision is at its number modulo the length
  std::uint64_t number_ = 0;
  std::size_t kept_ = 0;
};

}  // namespace stoss::service

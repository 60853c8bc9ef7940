// SPDX-License-Identifier: Apache-2.0
#include "collision_port.hpp"

#include <algorithm>

namespace stoss::service {

void CollisionPort::begin_epoch() {
  number_ = 0;
  kept_ = 0;
}

void CollisionPort::publish(const TickRecord& record) {
  if (record.collisions.empty()) return;
  if (ring_.empty()) ring_.resize(kCollisionsKept);
  for (const engine::Collision& collision : record.collisions) {
    if (collision.sequence != number_ + 1) kept_ = 0;  // some were lost before this one
    number_ = collision.sequence;
    ring_[number_ % kCollisionsKept] = collision;
    kept_ = std::min(kept_ + 1, kCollisionsKept);
  }
  if (writer_.readers() == 0) return;
  const std::size_t count = record.collisions.size();
  for (std::size_t first = 0; first < count; first += stoss_v1_MAX_COLLISIONS) {
    const std::size_t rows = std::min<std::size_t>(stoss_v1_MAX_COLLISIONS, count - first);
    columns_.clear();
    for (std::size_t i = first; i < first + rows; ++i) columns_.append(record.collisions[i]);
    wire::CollisionBatch batch{};
    batch.epoch = record.moment.epoch;
    batch.first_number = record.collisions[first].sequence;
    batch.tick = record.moment.tick;
    batch.at = translate::to_wire(record.moment.at);
    columns_.lend(batch.collisions, 0, rows);
    static_cast<void>(writer_.write(batch));
  }
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include "collision_order.hpp"

#include <utility>

namespace stoss::client {

CollisionOrder::CollisionOrder(std::optional<std::uint64_t> first) : next_(first) {}

void CollisionOrder::offer(std::uint64_t epoch, std::vector<engine::Collision> collisions) {
  if (collisions.empty() || (any_ && epoch < epoch_)) return;
  if (any_ && epoch > epoch_) {
    held_.clear();
    next_ = 1;
  }
  any_ = true;
  epoch_ = epoch;
  const std::uint64_t first = collisions.front().sequence;
  if (!next_) next_ = first;
  if (collisions.back().sequence < *next_) return;
  auto place = held_.end();
  while (place != held_.begin() && std::prev(place)->front().sequence > first) --place;
  held_.insert(place, std::move(collisions));
}

std::optional<CollisionRange> CollisionOrder::missing() const {
  if (held_.empty() || !next_) return std::nullopt;
  const std::uint64_t first = held_.front().front().sequence;
  if (first <= *next_) return std::nullopt;
  return CollisionRange{*next_, first - *next_};
}

void CollisionOrder::give_up() {
  const std::optional<CollisionRange> range = missing();
  if (!range) return;
  lost_ += range->count;
  next_ = range->first + range->count;
}

std::vector<engine::Collision> CollisionOrder::take() {
  std::vector<engine::Collision> result;
  while (!held_.empty() && !missing()) {
    for (engine::Collision& collision : held_.front()) {
      if (collision.sequence != *next_) continue;  // delivered before
      result.push_back(collision);
      ++*next_;
    }
    held_.pop_front();
  }
  if (missing() && counted_ != next_) {
    counted_ = next_;
    ++gaps_;
  }
  return result;
}

}  // namespace stoss::client

// SPDX-License-Identifier: Apache-2.0
#include "outbox.hpp"

#include <utility>

namespace stoss::service {

void Outbox::push(OutboxItem item) {
  const std::lock_guard lock(mutex_);
  if (std::holds_alternative<TickRecord>(item)) ticks_.fetch_add(1, std::memory_order_relaxed);
  items_.push_back(std::move(item));
  news_ = true;
  arrived_.notify_one();
}

bool Outbox::make_room_for_refusal() {
  if (refusals_ >= kUnticketedMax) {
    refusals_dropped_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  ++refusals_;
  news_ = true;
  return true;
}

bool Outbox::push_refusal(ReplyRecord reply) {
  const std::lock_guard lock(mutex_);
  if (!make_room_for_refusal()) return false;
  items_.emplace_back(ReplyItem{std::move(reply), {}});
  arrived_.notify_one();
  return true;
}

bool Outbox::push_refusal(AnswerItem answer) {
  const std::lock_guard lock(mutex_);
  if (!make_room_for_refusal()) return false;
  items_.emplace_back(std::move(answer));
  arrived_.notify_one();
  return true;
}

void Outbox::wake() {
  const std::lock_guard lock(mutex_);
  news_ = true;
  arrived_.notify_one();
}

std::deque<OutboxItem> Outbox::take(Nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, timeout, [this] { return news_; });
  news_ = false;
  refusals_ = 0;
  ticks_.store(0, std::memory_order_relaxed);
  return std::exchange(items_, {});
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// What waits for the publisher's thread, in the order in which it was handed over. Nobody who
// pushes ever waits. It is bounded: records by whoever pushes them (see ticks_waiting), replies and
// answers by the tickets that they hold, the rest by kUnticketedMax.
//
// Thread safety: any thread may push; one thread takes.
#pragma once

#include "clock.hpp"
#include "records.hpp"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>

namespace stoss::service {

/// Refusals given out without a ticket (because there was none left) that may wait at once. Beyond
/// it they are dropped and counted; their senders ask again.
inline constexpr std::size_t kUnticketedMax = 16'384;

class Outbox {
 public:
  void push(OutboxItem item);
  /// False, and counted in refusals_dropped(), when kUnticketedMax of them wait already.
  bool push_refusal(ReplyRecord reply);
  bool push_refusal(AnswerItem answer);
  void wake();

  /// Everything that waits, after waiting at most `timeout` for something.
  [[nodiscard]] std::deque<OutboxItem> take(Nanoseconds timeout);

  /// Records of ticks that the publisher has not taken yet.
  [[nodiscard]] std::size_t ticks_waiting() const { return ticks_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t refusals_dropped() const {
    return refusals_dropped_.load(std::memory_order_relaxed);
  }

  /// Whether anybody reads the state hashes of motion batches; set by the publisher.
  std::atomic<bool> hash_wanted{false};

 private:
  bool make_room_for_refusal();

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<OutboxItem> items_;
  bool news_ = false;
  std::size_t refusals_ = 0;
  std::atomic<std::size_t> ticks_{0};
  std::atomic<std::uint64_t> refusals_dropped_{0};
};

}  // namespace stoss::service

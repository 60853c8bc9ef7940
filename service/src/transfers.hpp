// SPDX-License-Identifier: Apache-2.0
// Answers on their way. Small ones go out at once; of a large one a few chunks at a time, so that a
// burst does not drown the client's socket, and only a window of them ahead of the acknowledgments,
// so that a client that does not read costs a bounded amount of memory.
#pragma once

#include "answers.hpp"
#include "mailboxes.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

namespace stoss::service {

/// Chunks of one answer that may be unacknowledged: some 6 MB. An acknowledgment takes a heartbeat,
/// 20 ms, so a small window would make a large world take long.
inline constexpr std::uint32_t kWindowChunks = 160;
/// Chunks sent at a stretch: less than what a socket of Linux' default size takes in.
inline constexpr std::uint32_t kBurstChunks = 8;
/// Large answers underway at once. Each holds its content and a window of chunks.
inline constexpr std::size_t kLargeAnswersMax = 8;
/// An answer that makes no progress for this long is dropped and counted.
inline constexpr Nanoseconds kTransferPatience{5'000'000'000};

/// The numbers that every chunk of an answer carries.
struct AnswerHead {
  Moment moment;
  std::uint64_t motion_number = 0;
  std::uint64_t collision_number = 0;
  std::uint64_t zone_number = 0;
};

class Transfers {
 public:
  explicit Transfers(Mailboxes& mailboxes) : mailboxes_(mailboxes) {}

  /// Starts to send an answer. A question that is being answered already is not answered twice: a
  /// client that asks again would mix the chunks of two answers.
  void start(const RequestId& request,
             const AnswerHead& head,
             std::shared_ptr<AnswerContent> content,
             Ticket ticket,
             Nanoseconds now);
  [[nodiscard]] bool is_underway(const RequestId& request) const;
  /// Whether another answer that may be large can be started.
  [[nodiscard]] bool has_room() const { return transfers_.size() < kLargeAnswersMax; }
  /// Sends what may be sent. True when something waits for acknowledgments.
  bool pump(Nanoseconds now);

  [[nodiscard]] std::size_t underway() const { return transfers_.size(); }
  [[nodiscard]] std::uint64_t abandoned() const { return abandoned_; }

 private:
  struct Transfer {
    RequestId request;
    AnswerHead head;
    std::shared_ptr<AnswerContent> content;
    Ticket ticket;
    std::uint32_t next = 0;       ///< chunk to send
    std::uint32_t in_flight = 0;  ///< sent since everything was last acknowledged
    Nanoseconds progress{0};
  };

  /// Sends what may be sent of one. True when it is done, or given up.
  bool advance(Transfer& transfer, Nanoseconds now);
  bool write_chunk(Transfer& transfer, Mailbox& mailbox);

  Mailboxes& mailboxes_;
  std::list<Transfer> transfers_;
  std::uint64_t abandoned_ = 0;
};

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// Where each client gets its replies and answers: writers in a partition of its own, made at its
// first request. Bounded: one whose client is gone goes after a while, and the one that was idle
// longest goes when there are too many.
#pragma once

#include "admission.hpp"
#include "clock.hpp"
#include "topics.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace stoss::service {

inline constexpr std::size_t kMailboxesMax = 256;
/// A mailbox that nobody reads and nobody writes to is kept for this long: longer than a client may
/// take to find it.
inline constexpr Nanoseconds kMailboxPatience{10'000'000'000};

struct Mailbox {
  Mailbox(const dds::Participant& participant, const Topics& topics, const std::string& partition)
      : publisher(participant, partition),
        reply(idl::make_writer(publisher, topics.reply, idl::kReplyTopic)),
        answer(idl::make_writer(publisher, topics.answer, idl::kAnswerTopic)) {}

  [[nodiscard]] bool has_reader() const { return reply.readers() > 0 || answer.readers() > 0; }

  dds::Publisher publisher;
  dds::Writer<wire::Reply> reply;
  dds::Writer<wire::Answer> answer;
  Nanoseconds used{0};
};

class Mailboxes {
 public:
  Mailboxes(const dds::Participant& participant, const Topics& topics, std::string world)
      : participant_(participant), topics_(topics), world_(std::move(world)) {}

  /// A client's mailbox, made when there is none. Null when DDS refuses, which is counted.
  /// Valid until the next call of a member that is not const.
  [[nodiscard]] Mailbox* of(const ClientId& client, Nanoseconds now);
  /// The mailbox if there is one.
  [[nodiscard]] Mailbox* find(const ClientId& client);

  /// Drops the mailboxes of clients that are gone. Returns these clients.
  [[nodiscard]] std::vector<ClientId> sweep(Nanoseconds now);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  [[nodiscard]] std::uint64_t evicted() const { return evicted_; }
  [[nodiscard]] std::uint64_t failures() const { return failures_; }

 private:
  void evict_one();

  const dds::Participant& participant_;
  const Topics& topics_;
  std::string world_;
  std::unordered_map<ClientId, std::unique_ptr<Mailbox>, ClientHash> boxes_;
  std::uint64_t evicted_ = 0;
  std::uint64_t failures_ = 0;
};

}  // namespace stoss::service

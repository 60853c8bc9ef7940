// SPDX-License-Identifier: Apache-2.0
// What makes a command take effect once although it may arrive several times: the requests that are
// waiting, and the last replies of each client.
//
// A request that is older than the replies that are kept is refused, never applied again. Only when
// a client was silent while kClientsMax others came is it forgotten as a whole.
#pragma once

#include "records.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <set>
#include <unordered_map>
#include <variant>

namespace stoss::service {

/// Replies kept for each client, by number and by size. A client that keeps more than this many
/// commands unanswered before it asks again may learn that an outcome is no longer known.
inline constexpr std::size_t kRepliesKept = 256;
inline constexpr std::size_t kReplyBytesKept = 256 * 1024;
/// Clients remembered.
inline constexpr std::size_t kClientsMax = 1024;

class ReplyTable {
 public:
  struct New {};
  struct Waiting {};
  struct Forgotten {};
  using Verdict = std::variant<New, Waiting, ReplyRecord, Forgotten>;

  /// Whether a command was seen before; from now on it is waiting if it was not.
  [[nodiscard]] Verdict admit(const RequestId& request);
  /// Keeps the reply of a request that admit() called new.
  void finish(const ReplyRecord& reply);

  [[nodiscard]] std::size_t client_count() const { return clients_.size(); }

 private:
  struct Client {
    std::set<std::uint64_t> waiting;
    std::map<std::uint64_t, ReplyRecord> replies;
    std::list<std::uint64_t> order;  ///< of the replies, oldest first
    std::size_t bytes = 0;
    std::uint64_t forgotten = 0;  ///< the highest number whose reply is no longer kept
    std::list<ClientId>::iterator recent;
  };

  Client& client_of(const ClientId& id);
  static void forget_old_replies(Client& client);
  void forget_old_clients();

  std::unordered_map<ClientId, Client, ClientHash> clients_;
  std::list<ClientId> recent_;  ///< most recently heard of first
};

}  // namespace stoss::service

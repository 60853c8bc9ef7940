// SPDX-License-Identifier: Apache-2.0
// What waits for the world's thread. Bounded by the tickets that its items hold.
//
// Thread safety: any thread may push; one thread takes.
#pragma once

#include "clock.hpp"
#include "records.hpp"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

namespace stoss::service {

class Inbox {
 public:
  void push(CommandItem command);
  void push(QueryItem query);
  /// Tells that a client is gone for good.
  void push_gone(const ClientId& client);
  /// Wakes the taker up, now or at its next wait.
  void wake();

  /// At most `most` commands: each client's in the order of arrival, one of each client in turn, so
  /// that a client with many does not hold up the others.
  [[nodiscard]] std::vector<CommandItem> take_commands(std::size_t most);
  [[nodiscard]] std::vector<QueryItem> take_queries(std::size_t most);
  [[nodiscard]] std::vector<ClientId> take_gone();
  [[nodiscard]] bool has_commands() const;

  /// Waits until something new arrived, wake() was called, or `timeout` is over.
  void wait(Nanoseconds timeout);

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  bool news_ = false;
  std::map<ClientId, std::deque<CommandItem>> commands_;
  ClientId next_client_{};  ///< whose turn it is
  std::deque<QueryItem> queries_;
  std::vector<ClientId> gone_;
};

}  // namespace stoss::service

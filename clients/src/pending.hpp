// SPDX-License-Identifier: Apache-2.0
#pragma once

// The requests of a session that have no answer yet, and what becomes of them. No DDS in here: time
// and samples are handed in.
//
// Thread safety: none; the session holds its lock.

#include "wire.hpp"

#include <stoss/client/session.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace stoss::client {

using SteadyTime = std::chrono::steady_clock::time_point;

/// A command without an answer is sent again after this time.
inline constexpr Milliseconds kCommandRetry{200};
/// A query is asked again when for this time no chunk of its answer has come. Answers can be long,
/// so it is patient.
inline constexpr Milliseconds kQueryRetry{500};
/// The chunks of one answer; the bodies of a world of 2^30 fit.
inline constexpr std::uint32_t kChunksMax = 1U << 22;

struct PendingCommand {
  translate::CommandSpec spec{};
  Session::ReplyHandler handler{};
  SteadyTime deadline{};
  SteadyTime resend{};
};

/// A query and the chunks of its answer so far. All chunks carry the same stamp; chunks with
/// another one belong to an answer to the same question asked again, and the latest asked wins.
struct PendingQuery {
  Query query{};
  Session::AnswerHandler handler{};
  SteadyTime deadline{};
  SteadyTime resend{};
  std::vector<std::optional<Answer>> chunks{};
  std::size_t arrived = 0;
  Answer stamp{};  ///< epoch, instant, tick and numbers of the chunks so far
};

/// What to do for requests whose time has come.
struct Due {
  std::vector<std::uint64_t> commands_to_send;
  std::vector<std::uint64_t> queries_to_send;
  std::vector<Session::ReplyHandler> silent_commands;
  std::vector<Session::AnswerHandler> silent_queries;
};

class PendingRequests {
 public:
  void add(std::uint64_t number, PendingCommand command);
  void add(std::uint64_t number, PendingQuery query);

  [[nodiscard]] const PendingCommand* command(std::uint64_t number) const;
  [[nodiscard]] const PendingQuery* query(std::uint64_t number) const;
  [[nodiscard]] bool empty() const { return commands_.empty() && queries_.empty(); }

  /// The handler that a reply completes; nothing for a stray one. The request is forgotten.
  std::optional<Session::ReplyHandler> take_command(std::uint64_t number);
  /// The same for an answer that is complete or a refusal.
  std::optional<Session::AnswerHandler> take_query(std::uint64_t number);

  /// Puts a chunk in its place. The whole answer once every chunk is there.
  std::optional<Answer> add_chunk(std::uint64_t number,
                                  std::uint32_t chunk,
                                  std::uint32_t chunks,
                                  Answer content,
                                  SteadyTime now);

  /// Takes out what is past its deadline and lists what is to be sent again.
  Due due(SteadyTime now);
  /// Takes out everything.
  Due drop_all();

 private:
  std::map<std::uint64_t, PendingCommand> commands_;
  std::map<std::uint64_t, PendingQuery> queries_;
};

}  // namespace stoss::client

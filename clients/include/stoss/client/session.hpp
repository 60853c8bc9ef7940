// SPDX-License-Identifier: Apache-2.0
// A client's connection to one world.
#pragma once

#include <stoss/client/command.hpp>
#include <stoss/client/query.hpp>
#include <stoss/client/result.hpp>
#include <stoss/client/status.hpp>
#include <stoss/dds/config.hpp>
#include <stoss/dds/participant.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>

namespace stoss::client {

using Milliseconds = std::chrono::milliseconds;

/// Who a client is to a world: random, made anew by every session.
using ClientId = std::array<std::uint8_t, 16>;

struct ConnectOptions {
  std::string world;
  std::uint32_t domain = 0;
  Milliseconds timeout{5000};
  dds::Network network;  ///< its role is always a client's
};

/// No world answered in time.
class NoWorldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a session has seen go by; for tests and for the curious.
struct SessionCounters {
  std::uint64_t retries = 0;        ///< requests sent again because no answer had come
  std::uint64_t stray_replies = 0;  ///< replies to what was already answered or given up
  std::uint64_t malformed = 0;      ///< samples whose arrays contradict each other
};

/// A connection. Thread-safe: any thread may ask or command at any time; requests of one session
/// are numbered in the order in which they are made.
///
/// A command is sent again, with the same number, every 200 ms until its reply comes or its time is
/// up; the daemon applies it once. Replies arrive on a thread of the session.
///
/// Invariants: every submitted request completes exactly once: by its answer, by its deadline, or
/// by the end of the session.
class Session {
 public:
  /// Connects and waits until the world's answers find their way back. Throws NoWorldError, or
  /// dds::Error when there is no network to use, or std::invalid_argument for a bad name.
  explicit Session(const ConnectOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  using ReplyHandler = std::function<void(Result<Reply>)>;
  using AnswerHandler = std::function<void(Result<Answer>)>;

  /// Sends a command and waits for its reply.
  Result<Reply> command(const Command& command);
  Result<Reply> command(const Command& command, Milliseconds timeout);
  /// Sends a command without waiting; many may be under way at once.
  std::future<Result<Reply>> submit(const Command& command);
  /// As above; `handler` is called on the session's thread and must neither block nor throw.
  void submit(const Command& command, Milliseconds timeout, ReplyHandler handler);

  /// Asks and waits for the whole answer.
  Result<Answer> ask(const Query& query);
  Result<Answer> ask(const Query& query, Milliseconds timeout);
  /// As submit() with a handler.
  void submit(const Query& query, Milliseconds timeout, AnswerHandler handler);

  [[nodiscard]] const std::string& world() const;
  [[nodiscard]] const ClientId& id() const;
  /// The status that the world answered the connection with.
  [[nodiscard]] const Status& first_status() const;
  [[nodiscard]] Milliseconds timeout() const;
  [[nodiscard]] SessionCounters counters() const;
  /// For readers of the world's topics.
  [[nodiscard]] const dds::Participant& participant() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stoss::client

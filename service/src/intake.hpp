// SPDX-License-Identifier: Apache-2.0
// The intake's thread: takes commands and questions out of DDS as fast as they come, refuses what
// is malformed or too much, and queues the rest for the world. It never waits for the world, since
// an undrained reader would grow without bound.
#pragma once

#include "admission.hpp"
#include "inbox.hpp"
#include "outbox.hpp"
#include "publication.hpp"
#include "topics.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <thread>

namespace stoss::service {

/// Commands in the daemon: one client's, all, and the memory of all. A tick takes in 4096 at most.
inline constexpr Admission::Limits kCommandLimits{1024, 16'384, std::size_t{64} << 20U};
/// Questions in the daemon, from their arrival to the last chunk of their answer.
inline constexpr Admission::Limits kQueryLimits{64, 1024, std::size_t{16} << 20U};
/// Refusals for want of room that are remembered, so that a command that its client was told is
/// refused is not applied when a copy of it comes later.
inline constexpr std::size_t kRefusalsKept = 65'536;

/// The requests that were refused lately. Bounded; the oldest is forgotten first.
class RefusalLog {
 public:
  void add(const RequestId& request);
  [[nodiscard]] bool contains(const RequestId& request) const;

 private:
  std::map<RequestId, bool> refused_;
  std::deque<RequestId> order_;
};

/// The doors of the daemon. Their tickets lie in its queues, so it must outlive all of them.
struct Gates {
  Admission commands{kCommandLimits};
  Admission queries{kQueryLimits};
};

class Intake {
 public:
  Intake(const dds::Participant& participant,
         const Topics& topics,
         const std::string& world,
         Gates& gates,
         Inbox& inbox,
         Outbox& outbox,
         SharedCounters& shared);
  Intake(const Intake&) = delete;
  Intake& operator=(const Intake&) = delete;
  ~Intake() { stop(); }

  /// `failure` is set when the thread cannot go on; it must outlive the intake.
  void start(std::atomic<int>& failure);
  /// No longer takes anything in; ends the thread.
  void stop() noexcept;

 private:
  void run();
  void take(const wire::Command& command);
  void take(const wire::Query& query);
  void refuse(const RequestId& request, engine::Reject reject, bool duplicate);

  Gates& gates_;
  Inbox& inbox_;
  Outbox& outbox_;
  SharedCounters& shared_;
  RefusalLog refusals_;
  dds::Subscriber subscriber_;
  dds::Reader<wire::Command> command_reader_;
  dds::Reader<wire::Query> query_reader_;
  dds::Guard stop_;
  dds::WaitSet waitset_;
  std::atomic<bool> stopping_{false};
  std::jthread thread_;
};

}  // namespace stoss::service

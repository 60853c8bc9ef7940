// SPDX-License-Identifier: Apache-2.0
// The daemon's threads and what ties them together: intake -> inbox -> world -> outbox ->
// publisher.
#pragma once

#include "forecaster.hpp"
#include "inbox.hpp"
#include "intake.hpp"
#include "outbox.hpp"
#include "publication.hpp"
#include "simulation.hpp"
#include "topics.hpp"

#include <atomic>
#include <string>
#include <thread>

namespace stoss::service {

struct DaemonOptions {
  std::uint32_t domain = 0;
  dds::Network network;
  SimulationOptions simulation;
  PublicationOptions publication;
};

class Daemon {
 public:
  /// Takes part in the domain and begins the world; nothing runs yet. Throws dds::Error and what
  /// Participant throws.
  Daemon(const DaemonOptions& options, translate::SceneBodies scene, translate::SceneWorld world);
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;
  ~Daemon() { stop(); }

  void start();
  /// Refuses what waits, finishes the tick, tells the last status. Ends all threads, those of a
  /// start that failed half-way and those that cannot go on included.
  void stop() noexcept;
  /// The exit status that a thread asks for because it cannot go on; 0 while all is well.
  [[nodiscard]] int failure() const { return failure_.load(); }

 private:
  void run_world();
  void run_publication();

  std::atomic<int> failure_{0};
  SteadyClock clock_;
  Gates gates_;  // before everything that holds its tickets
  SharedCounters shared_;
  Inbox inbox_;
  Outbox outbox_;
  dds::Participant participant_;
  Topics topics_;
  Publication publication_;
  Forecaster forecaster_;
  Simulation simulation_;
  Intake intake_;
  std::atomic<bool> stop_world_{false};
  std::atomic<bool> stop_publication_{false};
  std::jthread world_thread_;  // last, so that nothing they use goes before them
  std::jthread publication_thread_;
};

}  // namespace stoss::service

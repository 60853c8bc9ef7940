// SPDX-License-Identifier: Apache-2.0
#include "daemon.hpp"

#include "exit_codes.hpp"
#include "fp_environment.hpp"
#include "guarded_thread.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace stoss::service {

Daemon::Daemon(const DaemonOptions& options,
               translate::SceneBodies scene,
               translate::SceneWorld world)
    : participant_(options.domain, options.network),
      topics_(participant_),
      publication_(participant_, topics_, options.publication, clock_, inbox_, outbox_, shared_),
      forecaster_(outbox_),
      simulation_(std::move(scene),
                  std::move(world),
                  options.simulation,
                  clock_,
                  inbox_,
                  outbox_,
                  forecaster_),
      intake_(participant_, topics_, options.publication.world, gates_, inbox_, outbox_, shared_) {}

void Daemon::start() {
  publication_thread_ =
      std::jthread([this] { run_guarded("publisher", failure_, [this] { run_publication(); }); });
  world_thread_ = std::jthread([this] { run_guarded("world", failure_, [this] { run_world(); }); });
  intake_.start(failure_);
}

void Daemon::stop() noexcept {
  intake_.stop();
  stop_world_ = true;
  inbox_.wake();
  if (world_thread_.joinable()) world_thread_.join();
  forecaster_.stop();
  stop_publication_ = true;
  outbox_.wake();
  if (publication_thread_.joinable()) publication_thread_.join();
}

void Daemon::run_world() {
  if (!fp_environment_is_exact()) {
    spdlog::critical("the processor is set to flush subnormal numbers or not to round to nearest");
    failure_ = kExitInvariant;
    return;
  }
  bool had_failed = false;
  while (!stop_world_) {
    const Nanoseconds next = simulation_.turn();
    if (simulation_.failed() && !had_failed) {
      spdlog::error("the world has failed and stands still until it is reset");
    }
    had_failed = simulation_.failed();
    const Nanoseconds left = next - clock_.now();
    if (left > Nanoseconds::zero()) inbox_.wait(left);
  }
  simulation_.stop();
}

void Daemon::run_publication() {
  while (!stop_publication_) publication_.turn();
  publication_.finish();
}

}  // namespace stoss::service

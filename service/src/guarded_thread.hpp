// SPDX-License-Identifier: Apache-2.0
// The body of a thread of the daemon: it has a name, and no exception leaves it.
#pragma once

#include "exit_codes.hpp"
#include "thread_name.hpp"

#include <spdlog/spdlog.h>

#include <atomic>
#include <exception>
#include <utility>

namespace stoss::service {

/// Runs `body` as the thread `name`. An exception in it is a fault of the program or a want of
/// memory: it is said, and `failure` becomes the exit status that the process is to end with.
template <class Body>
void run_guarded(const char* name, std::atomic<int>& failure, Body&& body) {
  try {
    name_thread(name);
    std::forward<Body>(body)();
  } catch (const std::exception& error) {
    spdlog::critical("the {} thread cannot go on: {}", name, error.what());
    failure = kExitInvariant;
  }
}

}  // namespace stoss::service

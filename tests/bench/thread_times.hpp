// SPDX-License-Identifier: Apache-2.0
#pragma once

// Processor time of a process's threads, as the scheduler counts it.

#include <sys/types.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace stoss::bench {

/// ns since their starts.
struct ThreadTimes {
  double all = 0;
  double named = 0;  ///< of the threads of one name

  friend ThreadTimes operator-(const ThreadTimes& a, const ThreadTimes& b) {
    return {a.all - b.all, a.named - b.named};
  }
};

inline ThreadTimes thread_times(pid_t pid, const std::string& name = {}) {
  ThreadTimes times;
  const std::filesystem::path tasks = "/proc/" + std::to_string(pid) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks)) {
    double ns = 0;
    std::ifstream(task.path() / "schedstat") >> ns;
    std::string its_name;
    std::getline(std::ifstream(task.path() / "comm"), its_name);
    times.all += ns;
    if (its_name == name) times.named += ns;
  }
  return times;
}

}  // namespace stoss::bench

// SPDX-License-Identifier: Apache-2.0
// A real stossd in a process of its own.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace stoss::tests {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Runs a program with its standard error in a file; kills it at the end if it still runs.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments) {
    std::string name = ::testing::TempDir() + "stoss_process_XXXXXX";
    const int log = mkstemp(name.data());
    if (log < 0) throw std::runtime_error("cannot make a log file");
    log_file_ = name;
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ == 0) {
      dup2(log, STDERR_FILENO);
      const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
      dup2(nothing, STDOUT_FILENO);
      constexpr int kDescriptorsMax = 256;
      for (int fd = 3; fd < kDescriptorsMax; ++fd) close(fd);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(log);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (pid_ > 0) {
      kill(pid_, SIGCONT);
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    unlink(log_file_.c_str());
  }

  /// Waits until it has stopped where it is to stop: its threads do so one by one.
  void signal(int number) const {
    kill(pid_, number);
    siginfo_t how{};
    if (number == SIGSTOP) {
      waitid(P_PID, static_cast<id_t>(pid_), &how, WSTOPPED | WEXITED | WNOWAIT);
    }
  }
  [[nodiscard]] pid_t pid() const { return pid_; }

  /// Its exit status; 128 + signal when it was killed; nothing when it still runs after `timeout`.
  std::optional<int> wait(milliseconds timeout = milliseconds(10'000)) {
    const auto until = steady_clock::now() + timeout;
    do {
      int status = 0;
      if (waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      std::this_thread::sleep_for(milliseconds(2));
    } while (steady_clock::now() < until);
    return std::nullopt;
  }

  /// What it has written to standard error so far.
  [[nodiscard]] std::string log() const {
    std::ostringstream text;
    text << std::ifstream(log_file_).rdbuf();
    return text.str();
  }

  /// Processor time that it has used, in seconds, all threads together.
  [[nodiscard]] double cpu_seconds() const {
    std::ifstream stat("/proc/" + std::to_string(pid_) + "/stat");
    std::string text;
    std::getline(stat, text);
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skip;
    constexpr int kFieldsBeforeTimes = 11;
    for (int i = 0; i < kFieldsBeforeTimes; ++i) fields >> skip;
    double user = 0;
    double system = 0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

 private:
  pid_t pid_ = -1;
  std::string log_file_;
};

/// stossd on a domain, with more options.
inline std::vector<std::string> stossd(unsigned domain, std::vector<std::string> options) {
  std::vector<std::string> arguments = {
      STOSS_BIN_DIR "/stossd", "--domain", std::to_string(domain)};
  for (std::string& option : options) arguments.push_back(std::move(option));
  return arguments;
}

inline std::string scene(const std::string& name) {
  return std::string(STOSS_SCENE_DIR) + "/" + name + ".json";
}

}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Runs a program to its end and keeps what it wrote.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stoss::tests {

struct Finished {
  int status = -1;  ///< exit status; 128 + signal when it was killed
  std::string out;
  std::string error;
};

/// Runs `arguments` (the program first) with nothing to read; kills it after `limit`.
inline Finished run_program(std::vector<std::string> arguments,
                            std::chrono::seconds limit = std::chrono::seconds(60)) {
  std::array<int, 2> out{};
  std::array<int, 2> error{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(error.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("cannot make a pipe");
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("cannot fork");
  if (pid == 0) {
    dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    dup2(error[1], STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  close(out[1]);
  close(error[1]);
  Finished result;
  const auto end = std::chrono::steady_clock::now() + limit;
  std::array<pollfd, 2> watched = {pollfd{out[0], POLLIN, 0}, pollfd{error[0], POLLIN, 0}};
  std::array<std::string*, 2> texts = {&result.out, &result.error};
  std::array<char, 65536> buffer{};
  while (watched[0].fd >= 0 || watched[1].fd >= 0) {
    if (std::chrono::steady_clock::now() > end) kill(pid, SIGKILL);
    if (poll(watched.data(), watched.size(), 100) <= 0) continue;
    for (std::size_t i = 0; i < watched.size(); ++i) {
      if (watched[i].fd < 0 || watched[i].revents == 0) continue;
      const ssize_t got = read(watched[i].fd, buffer.data(), buffer.size());
      if (got > 0) {
        texts[i]->append(buffer.data(), static_cast<std::size_t>(got));
      } else {
        close(watched[i].fd);
        watched[i].fd = -1;
      }
    }
  }
  int status = 0;
  waitpid(pid, &status, 0);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

/// The `stoss` of this build.
inline Finished stoss(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {STOSS_BIN_DIR "/stoss"};
  for (const std::string& argument : arguments) all.push_back(argument);
  return run_program(std::move(all));
}

/// The same from one text, divided at blanks.
inline Finished stoss_words(const std::string& command) {
  std::istringstream words(command);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  return stoss(std::move(arguments));
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace stoss::tests

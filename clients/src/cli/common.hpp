// SPDX-License-Identifier: Apache-2.0
#pragma once

// What all verbs share: the options that every one takes, reading numbers off the command line, and
// finding the world.

#include "cli/exit_code.hpp"

#include <stoss/client/session.hpp>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stoss::client::cli {

struct GlobalOptions {
  std::string world;  ///< empty: the only one there is
  std::string domain = "0";
  std::string timeout = "5";  ///< s
  bool json = false;
};

/// The command line as parsed. A verb's parsing stores what to do; main() then does it.
struct Invocation {
  GlobalOptions global;
  std::function<void()> action;
};

// Each adds a group of verbs.
void add_world_verbs(CLI::App& app, Invocation& invocation);
void add_body_verbs(CLI::App& app, Invocation& invocation);
void add_effect_verbs(CLI::App& app, Invocation& invocation);
void add_question_verbs(CLI::App& app, Invocation& invocation);
void add_clock_verbs(CLI::App& app, Invocation& invocation);
void add_stream_verbs(CLI::App& app, Invocation& invocation);
void add_top_verb(CLI::App& app, Invocation& invocation);
void add_simulate_verb(CLI::App& app, Invocation& invocation);
void add_accuracy_verb(CLI::App& app, Invocation& invocation);

/// A verb with its one-line description and an example; options of the command itself may follow
/// it.
CLI::App* add_verb(CLI::App& app,
                   const std::string& name,
                   const std::string& description,
                   const std::string& example);

// Texts from the command line as values; UsageError names the option otherwise.
[[nodiscard]] double number_of(const std::string& option, const std::string& text);
[[nodiscard]] std::uint64_t count_of(const std::string& option, const std::string& text);
[[nodiscard]] engine::Vector2 vector_of(const std::string& option, const std::string& text);
[[nodiscard]] engine::Instant instant_of(const std::string& option, const std::string& text);
[[nodiscard]] std::vector<engine::Id> ids_of(const std::vector<std::string>& texts);

[[nodiscard]] std::uint32_t domain_of(const GlobalOptions& global);
[[nodiscard]] Milliseconds timeout_of(const GlobalOptions& global);

/// Connects to the world named, or to the only one there is. Throws NoAnswerError, or UsageError
/// when there are several to choose from.
[[nodiscard]] std::unique_ptr<Session> connect(const GlobalOptions& global);

/// The value of a result; else RefusedError or NoAnswerError.
template <class T>
[[nodiscard]] T value_or_throw(Result<T> result) {
  if (!result) {
    const Failure& failure = result.failure();
    if (!failure.answered) throw NoAnswerError(failure.reject.reason);
    throw RefusedError(failure.reject);
  }
  return std::move(result).value();
}

/// True once the user has asked for the end (Ctrl-C, or the reader of the output has gone).
[[nodiscard]] bool interrupted();
/// Makes Ctrl-C and SIGTERM set interrupted() instead of killing the process.
void catch_interrupts();

/// Writes a text to standard output at once. A reader that has gone counts as an interrupt.
void print(const std::string& text);

}  // namespace stoss::client::cli

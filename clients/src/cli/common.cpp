// SPDX-License-Identifier: Apache-2.0
#include "cli/common.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/client/discovery.hpp>
#include <stoss/dds/config.hpp>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

namespace stoss::client::cli {
namespace {

/// After the first world has answered, others get this long to make themselves known.
constexpr Milliseconds kSettle{150};
constexpr double kTimeoutMaxS = 1e6;

// The handler may run on any thread at any time.
std::atomic<bool> interrupt_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int) { interrupt_asked = true; }

std::string only_world(const GlobalOptions& global) {
  const std::vector<Status> found = worlds(domain_of(global), {}, timeout_of(global), kSettle);
  if (found.empty()) throw NoAnswerError("no world in domain " + global.domain);
  if (found.size() == 1) return found.front().world;
  std::string names;
  for (const Status& status : found) names += ' ' + status.world;
  throw UsageError("several worlds are running; name one with --world:" + names);
}

}  // namespace

CLI::App* add_verb(CLI::App& app,
                   const std::string& name,
                   const std::string& description,
                   const std::string& example) {
  CLI::App* verb = app.add_subcommand(name, description);
  verb->fallthrough();
  verb->footer("Example: " + example);
  return verb;
}

double number_of(const std::string& option, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value) throw UsageError(option + ": \"" + text + "\" is not a number");
  return *value;
}

std::uint64_t count_of(const std::string& option, const std::string& text) {
  const std::optional<std::uint64_t> value = parse_count(text);
  if (!value) throw UsageError(option + ": \"" + text + "\" is not a whole number from 0 up");
  return *value;
}

engine::Vector2 vector_of(const std::string& option, const std::string& text) {
  const std::optional<engine::Vector2> value = parse_vector(text);
  if (!value) throw UsageError(option + ": \"" + text + "\" is not X,Y");
  return *value;
}

engine::Instant instant_of(const std::string& option, const std::string& text) {
  const std::optional<engine::Instant> value = parse_instant(text);
  if (!value) {
    throw UsageError(option + ": \"" + text +
                     "\" is neither a decimal number of seconds nor SECONDS:FRACTION");
  }
  return *value;
}

std::vector<engine::Id> ids_of(const std::vector<std::string>& texts) {
  std::vector<engine::Id> ids;
  ids.reserve(texts.size());
  for (const std::string& text : texts) ids.push_back(count_of("ID", text));
  return ids;
}

std::uint32_t domain_of(const GlobalOptions& global) {
  const std::uint64_t domain = count_of("--domain", global.domain);
  if (domain > dds::kMaxDomainId) {
    throw UsageError("--domain: must be 0 to " + std::to_string(dds::kMaxDomainId));
  }
  return static_cast<std::uint32_t>(domain);
}

Milliseconds timeout_of(const GlobalOptions& global) {
  const double seconds = number_of("--timeout", global.timeout);
  if (!(seconds > 0 && seconds <= kTimeoutMaxS)) {
    throw UsageError("--timeout: must be above 0 and at most 1e6 seconds");
  }
  constexpr double kPerSecond = 1000;
  return Milliseconds(static_cast<Milliseconds::rep>(seconds * kPerSecond) + 1);
}

std::unique_ptr<Session> connect(const GlobalOptions& global) {
  ConnectOptions options;
  options.domain = domain_of(global);
  options.timeout = timeout_of(global);
  options.world = global.world.empty() ? only_world(global) : global.world;
  try {
    return std::make_unique<Session>(options);
  } catch (const NoWorldError& error) {
    throw NoAnswerError(error.what());
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--world: ") + error.what());
  }
}

bool interrupted() { return interrupt_asked; }

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void print(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written) return;
  if (errno != EPIPE && errno != EINTR) {
    throw std::system_error(errno, std::generic_category(), "standard output");
  }
  interrupt_asked = true;
}

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
// pause, resume, step, run-for, run-to, speed, reset

#include "cli/common.hpp"
#include "cli/table.hpp"

#include <chrono>
#include <limits>
#include <thread>
#include <utility>

namespace stoss::client::cli {
namespace {

constexpr Milliseconds kLook{20};

struct ClockOptions {
  std::string value;
  std::string at;
  bool no_wait = false;
};

void add_at(CLI::App* verb, ClockOptions& options) {
  verb->add_option("--at", options.at, "Instant of the world's clock at which to apply it [s]");
}

/// Before a world is looked for, so that a mistake in the options is told at once.
Command timed(Command command, const ClockOptions& options) {
  if (!options.at.empty()) command.at(instant_of("--at", options.at));
  return command;
}

/// Waits until the world has stopped where it was told to, or has passed by there because somebody
/// else lets it run on. Silence for the session's timeout ends the wait.
template <class Arrived>
void wait_for(Session& session, Arrived arrived) {
  while (!interrupted()) {
    const Answer answer = value_or_throw(session.ask(Query::status()));
    if (!answer.status || answer.status->state != idl::WorldState::kRunning) return;
    if (arrived(*answer.status)) return;
    std::this_thread::sleep_for(kLook);
  }
}

using Make = std::function<Command(const ClockOptions&)>;

void add_plain(CLI::App& app,
               Invocation& invocation,
               const std::string& name,
               const std::string& description,
               const std::string& example,
               Make make) {
  auto options = std::make_shared<ClockOptions>();
  CLI::App* verb = add_verb(app, name, description, example);
  add_at(verb, *options);
  verb->callback([&invocation, options, make = std::move(make)] {
    invocation.action = [&global = invocation.global, options, make] {
      const Command command = timed(make(*options), *options);
      const auto session = connect(global);
      print(reply_text(value_or_throw(session->command(command)), global.json));
    };
  });
}

void step(const GlobalOptions& global, const ClockOptions& options) {
  const std::uint64_t ticks = count_of("N", options.value);
  const Command command = timed(Command::step(ticks), options);
  const auto session = connect(global);
  const Reply reply = value_or_throw(session->command(command));
  if (!options.no_wait) {
    wait_for(*session, [&](const Status& status) {
      return status.epoch != reply.epoch || status.tick >= reply.tick + ticks;
    });
  }
  print(reply_text(reply, global.json));
}

void run_to(const GlobalOptions& global, const ClockOptions& options) {
  const engine::Instant target = instant_of("T", options.value);
  const Command command = timed(Command::run_to(target), options);
  const auto session = connect(global);
  const Reply reply = value_or_throw(session->command(command));
  if (!options.no_wait) {
    wait_for(*session, [&](const Status& status) {
      return status.epoch != reply.epoch || status.at >= target;
    });
  }
  print(reply_text(reply, global.json));
}

void run_for(const GlobalOptions& global, const ClockOptions& options) {
  const double seconds = number_of("S", options.value);
  const Command command = timed(Command::run_for(seconds), options);
  const auto session = connect(global);
  const Reply reply = value_or_throw(session->command(command));
  const auto target = engine::offset_by(reply.at, seconds);
  if (!options.no_wait) {
    wait_for(*session, [&](const Status& status) {
      return status.epoch != reply.epoch || !target || status.at >= *target;
    });
  }
  print(reply_text(reply, global.json));
}

using Run = void (*)(const GlobalOptions&, const ClockOptions&);

void add_run(CLI::App& app,
             Invocation& invocation,
             const std::string& name,
             const std::string& description,
             const std::string& example,
             const std::string& symbol,
             const std::string& meaning,
             Run run) {
  auto options = std::make_shared<ClockOptions>();
  CLI::App* verb =
      add_verb(app, name, description + ", then pause; waits until that is done", example);
  CLI::Option* value = verb->add_option(symbol, options->value, meaning);
  if (name == "step") {
    options->value = "1";
  } else {
    value->required();
  }
  verb->add_flag("--no-wait", options->no_wait, "Return as soon as the world has agreed");
  add_at(verb, *options);
  verb->callback([&invocation, options, run] {
    invocation.action = [&invocation, options, run] {
      catch_interrupts();
      run(invocation.global, *options);
    };
  });
}

void add_speed(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<ClockOptions>();
  CLI::App* verb = add_verb(app,
                            "speed",
                            "Set the simulated seconds per real second",
                            "stoss speed 0.25, or stoss speed max");
  verb->add_option("X", options->value, "A number above 0, or max")->required();
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&global = invocation.global, options] {
      const double speed = options->value == "max" ? std::numeric_limits<double>::infinity()
                                                   : number_of("X", options->value);
      const Command command = timed(Command::set_speed(speed), *options);
      const auto session = connect(global);
      print(reply_text(value_or_throw(session->command(command)), global.json));
    };
  });
}

}  // namespace

void add_clock_verbs(CLI::App& app, Invocation& invocation) {
  const auto plain =
      [&](const char* name, const char* description, const char* example, Command (*make)()) {
        add_plain(app, invocation, name, description, example, [make](const ClockOptions&) {
          return make();
        });
      };
  plain("pause", "Stop the world's time", "stoss pause", &Command::pause);
  plain("resume", "Let the world's time run on", "stoss resume", &Command::resume);
  plain("reset", "Go back to the scene as loaded", "stoss reset", &Command::reset);
  add_run(app, invocation, "step", "Run some ticks", "stoss step 10", "N", "How many ticks", &step);
  add_run(app,
          invocation,
          "run-for",
          "Run some simulated seconds",
          "stoss run-for 2.5",
          "S",
          "Simulated seconds",
          &run_for);
  add_run(app,
          invocation,
          "run-to",
          "Run to an instant of the world's clock",
          "stoss run-to 12.75",
          "T",
          "The instant [s]",
          &run_to);
  add_speed(app, invocation);
}

}  // namespace stoss::client::cli

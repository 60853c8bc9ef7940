// SPDX-License-Identifier: Apache-2.0
// The `stoss` command: parses, does, and tells by its exit status how it went.

#include "cli/common.hpp"
#include "cli/json_object.hpp"

#include <stoss/dds/log.hpp>

#include <cctype>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace stoss::client::cli {
namespace {

int exit_status(ExitCode code) { return static_cast<int>(code); }

/// Arguments as CLI11 takes them: in reverse, and negative numbers that it would take for options
/// (-.5, -inf) behind a blank, which the readers of numbers skip. --verify takes the word behind it
/// only if that is a number: `simulate --verify SCENE` means the scene.
std::vector<std::string> prepared(int argc, const char* const* argv) {
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {
    std::string argument = argv[i];
    const bool disguised = argument.rfind("-.", 0) == 0 || argument.rfind("-inf", 0) == 0 ||
                           argument.rfind("-nan", 0) == 0;
    const bool has_number = i + 1 < argc && std::isdigit(static_cast<unsigned char>(*argv[i + 1]));
    if (argument == "--verify" && !has_number) argument += "=true";
    arguments.push_back(disguised ? ' ' + argument : argument);
  }
  return arguments;
}

void describe_app(CLI::App& app, Invocation& invocation) {
  GlobalOptions& global = invocation.global;
  app.name("stoss");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("stoss ") + STOSS_VERSION);
  const auto add = [&app](const char* name, std::string& value, const char* description) {
    // The last one wins, so that an alias or a script can be overruled.
    return app.add_option(name, value, description)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  };
  add("--world", global.world, "The world's name (default: the only one there is)");
  add("--domain", global.domain, "DDS domain, 0 to 101")->capture_default_str();
  add("--timeout", global.timeout, "Seconds to wait for an answer")->capture_default_str();
  app.add_flag("--json", global.json, "Print JSON, one object a line");
  app.footer(
      "Exit status: 0 done; 1 refused by the world; 2 bad usage; 3 no world answered in time.\n"
      "Instants (--at, run-to) are seconds of the world's clock: a decimal number, taken exactly, "
      "or SECONDS:FRACTION in units of 2^-64 s.\n"
      "`stoss VERB --help` explains a verb.");
  add_world_verbs(app, invocation);
  add_body_verbs(app, invocation);
  add_effect_verbs(app, invocation);
  add_question_verbs(app, invocation);
  add_clock_verbs(app, invocation);
  add_stream_verbs(app, invocation);
  add_top_verb(app, invocation);
  add_simulate_verb(app, invocation);
  add_accuracy_verb(app, invocation);
}

int complain(ExitCode code, const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
  return exit_status(code);
}

std::string refusal_json(const engine::Reject& reject) {
  JsonObject object;
  object.string("code", engine::to_string(reject.code)).string("reason", reject.reason);
  if (!reject.field.empty()) object.string("field", reject.field);
  if (reject.index != 0) object.count("index", reject.index);
  if (reject.body != engine::kNoId) object.integer("body", reject.body);
  if (reject.other != engine::kNoId) {
    object.integer("other", reject.other).number("clearance", reject.clearance);
  }
  return object.text() + '\n';
}

int act(const Invocation& invocation) {
  try {
    invocation.action();
    return exit_status(ExitCode::Done);
  } catch (const UsageError& error) {
    return complain(ExitCode::BadUsage, std::string("stoss: ") + error.what());
  } catch (const NoAnswerError& error) {
    return complain(ExitCode::NoAnswer, std::string("stoss: ") + error.what());
  } catch (const RefusedError& error) {
    if (invocation.global.json) print(refusal_json(error.reject()));
    return complain(ExitCode::Refused, error.what());
  } catch (const std::exception& error) {
    return complain(ExitCode::Refused, std::string("INTERNAL: ") + error.what());
  }
}

int run(int argc, const char* const* argv) {
  std::signal(SIGPIPE, SIG_IGN);
  // What DDS has to say is for daemons' logs; a command says in its own words what went wrong.
  dds::set_log_sink({});
  Invocation invocation;
  CLI::App app("Talk to live worlds of disks and walls, or simulate one offline.");
  describe_app(app, invocation);
  try {
    std::vector<std::string> arguments = prepared(argc, argv);
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    const std::vector<std::string> unknown = app.remaining();
    if (!unknown.empty() && app.get_subcommands().empty()) {
      return complain(ExitCode::BadUsage,
                      "stoss: no such verb: " + unknown.front() + "; stoss --help lists them");
    }
    static_cast<void>(app.exit(error));
    return exit_status(ExitCode::BadUsage);
  }
  return act(invocation);
}

}  // namespace
}  // namespace stoss::client::cli

int main(int argc, char** argv) {
  try {
    return stoss::client::cli::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "INTERNAL: %s\n", error.what());
    return 1;
  }
}

// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include "exit_codes.hpp"

#include <stoss/dds/config.hpp>
#include <stoss/engine/tick_clock.hpp>
#include <stoss/engine/verify.hpp>
#include <stoss/idl/topics.hpp>
#include <stoss/translate/basics.hpp>
#include <stoss/translate/scene.hpp>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include <charconv>
#include <iostream>
#include <limits>

namespace stoss::service {
namespace {

constexpr double kFrameRateMax = 1000;

constexpr const char* kFooter = R"(
Example: stossd --scene clients/scenes/tutorial.json
         stoss status            (in another terminal; stoss --help says what else there is)

A configuration file has one "name = value" a line, named as the options are: tick-rate = 120
Exit status: 0 stopped, 64 bad usage, 65 scene refused, 70 a promise of the program is broken,
71 refused by the system, 75 the world's name is taken, 78 bad configuration.)";

// A speed is a number above 0, or "max".
std::string parse_speed(const std::string& text, double& speed) {
  if (text == "max") {
    speed = std::numeric_limits<double>::infinity();
    return {};
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, speed);
  const bool good = error == std::errc() && stop == end && speed > 0 &&
                    speed < std::numeric_limits<double>::infinity();
  return good ? std::string() : "must be a number above 0, or max";
}

CLI::Validator check(const std::string& description,
                     std::function<std::string(const std::string&)> wrong) {
  return CLI::Validator([wrong = std::move(wrong)](std::string& text) { return wrong(text); },
                        description);
}

CLI::Validator number_in(double above, double up_to, const std::string& description) {
  return check(description, [=](const std::string& text) -> std::string {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool good = error == std::errc() && stop == end && value > above && value <= up_to;
    return good ? "" : "must be " + description + ", not " + text;
  });
}

void add_world_options(CLI::App& app, Options& options, std::string& speed) {
  app.add_option("--scene", options.scene, "The world as it begins: .json, .textproto or .binpb")
      ->type_name("FILE");
  app.add_option("--world",
                 options.world,
                 "Its name on the network: 1 to 64 of A-Z a-z 0-9 . _ - (default: the scene's)")
      ->type_name("NAME")
      ->check(check("", [](const std::string& name) -> std::string {
        return idl::valid_world_name(name) ? "" : "must be 1 to 64 of A-Z a-z 0-9 . _ -";
      }));
  app.add_option("--tick-rate", options.tick_rate, "Ticks per simulated second")
      ->type_name("HZ")
      ->capture_default_str()
      ->check(check("", [](const std::string& text) -> std::string {
        double hz = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, hz);
        const bool good =
            error == std::errc() && stop == end && engine::TickClock::from_rate({}, hz).has_value();
        return good ? "" : "must be a number of hertz above 0, not " + text;
      }));
  app.add_option("--speed", speed, "Simulated seconds per real second, or max")
      ->type_name("X")
      ->capture_default_str()
      ->check(check("", [](const std::string& text) {
        double value = 0;
        return parse_speed(text, value);
      }));
  app.add_flag("--paused", options.paused, "Start at a standstill");
  app.add_option("--max-bodies", options.bodies_max, "Bodies that the world takes")
      ->type_name("N")
      ->capture_default_str();
}

// A number of events above 0; the option without one (which CLI11 hands over as "true") is the
// default, and "false", as a configuration file may say, is none.
std::string parse_verify(const std::string& text, std::uint64_t& verify) {
  if (text == "true" || text == "false") {
    verify = text == "true" ? engine::kVerifyPeriod : 0;
    return {};
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, verify);
  return error == std::errc() && stop == end && verify > 0 ? "" : "must be a number above 0";
}

std::string wrong_scalar(const std::string& name) {
  std::string known;
  for (const engine::Arithmetic arithmetic : translate::arithmetics()) {
    if (name == translate::name_of(arithmetic)) return {};
    known += known.empty() ? "" : ", ";
    known += translate::name_of(arithmetic);
  }
  return "must be one of " + known + ", not " + name;
}

void add_engine_options(CLI::App& app,
                        std::string& scalar,
                        std::string& broad_phase,
                        std::string& verify) {
  app.add_option("--scalar",
                 scalar,
                 "The arithmetic: float, double, long-double, double-double or float128")
      ->type_name("NAME")
      ->capture_default_str()
      ->check(check("", wrong_scalar));
  app.add_option("--verify",
                 verify,
                 "Check the whole world for overlaps, missed contacts and drift every so many "
                 "events (100000 unless given), and tell in the status")
      ->type_name("[EVENTS]")
      ->expected(0, 1)
      ->check(check("", [](const std::string& text) {
        std::uint64_t value = 0;
        return parse_verify(text, value);
      }));
  app.add_option("--broad-phase",
                 broad_phase,
                 "neighbours or all-pairs; the first is faster, the results are the same")
      ->type_name("NAME")
      ->capture_default_str()
      ->check(CLI::IsMember({"neighbours", "all-pairs"}));
}

void add_network_options(CLI::App& app, Options& options) {
  app.add_option("--domain", options.domain, "DDS domain")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0U, dds::kMaxDomainId));
  app.add_option("--frame-rate", options.frame_rate, "Frames per real second")
      ->type_name("HZ")
      ->capture_default_str()
      ->check(number_in(0, kFrameRateMax, "a number above 0, at most 1000"));
  app.add_option("--interface", options.interface, "The network interface to use")
      ->type_name("NAME")
      ->capture_default_str();
  app.add_flag("--allow-network",
               options.allow_network,
               "Allow an interface beyond this machine. Only for networks whose every host is "
               "trusted: commands are not authenticated");
}

void add_program_options(CLI::App& app, Options& options) {
  app.add_option("--log-level", options.log_level, "trace, debug, info, warning, error or off")
      ->type_name("LEVEL")
      ->capture_default_str()
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}));
  app.set_config("--config", "", "Read options from a file; those given here come first")
      ->type_name("FILE");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.add_flag("--check-config", options.check_config, "Check the options and the scene, and exit")
      ->configurable(false);
  app.set_version_flag("--version", "stossd " STOSS_VERSION);
}

}  // namespace

std::variant<Options, Exit> parse_options(int argc, const char* const* argv) {
  Options options;
  std::string speed = "1";
  std::string scalar = "double";
  std::string broad_phase = "neighbours";
  std::string verify = "false";
  CLI::App app("Holds a live two-dimensional world of disks and walls, and advances it exactly.",
               "stossd");
  app.footer(kFooter);
  add_world_options(app, options, speed);
  add_engine_options(app, scalar, broad_phase, verify);
  add_network_options(app, options);
  add_program_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_config = dynamic_cast<const CLI::FileError*>(&error) != nullptr ||
                           dynamic_cast<const CLI::ConfigError*>(&error) != nullptr;
    if (app.exit(error, std::cout, std::cerr) == 0) return Exit{kExitOk};
    return Exit{is_config ? kExitConfig : kExitUsage};
  }
  static_cast<void>(parse_speed(speed, options.speed));
  static_cast<void>(parse_verify(verify, options.verify));
  options.arithmetic = translate::arithmetic_of(scalar).value_or(options.arithmetic);
  options.broad_phase = translate::broad_phase_of(broad_phase).value_or(options.broad_phase);
  if (options.scene.empty() && options.world.empty()) {
    std::cerr << "Give --scene FILE, or --world NAME for a world without bodies.\n"
                 "Run with --help for more information.\n";
    return Exit{kExitUsage};
  }
  if (options.interface != "lo" && !options.allow_network) {
    std::cerr << "--interface "
              << options.interface << " leaves this machine; that needs --allow-network.\n";
    return Exit{kExitConfig};
  }
  return options;
}

}  // namespace stoss::service

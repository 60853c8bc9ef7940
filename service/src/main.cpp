// SPDX-License-Identifier: Apache-2.0
// stossd: reads its options and the scene, starts the daemon, waits for a signal.
#include "daemon.hpp"
#include "exit_codes.hpp"
#include "log.hpp"
#include "options.hpp"
#include "world_lock.hpp"

#include <stoss/idl/scene_file.hpp>
#include <stoss/translate/scene.hpp>

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace stoss::service {
namespace {

struct Start {
  Scene scene;
  translate::SceneBodies bodies;
  std::string world;
};

std::string describe(const engine::Reject& reject) {
  std::string text = engine::to_string(reject.code);
  text += ": " + (reject.field.empty() ? "" : reject.field + " ") + reject.reason;
  if (reject.body != engine::kNoId) text += " (body " + std::to_string(reject.body) + ")";
  return text;
}

// The scene's own name, or its file's, whichever can be a world's name.
std::optional<std::string> world_name(const Options& options, const Scene& scene) {
  const std::string stem = std::filesystem::path(options.scene).stem().string();
  for (const std::string& name : {options.world, scene.name(), stem}) {
    if (idl::valid_world_name(name)) return name;
  }
  return std::nullopt;
}

std::variant<Start, Exit> load(const Options& options) {
  Start start;
  if (!options.scene.empty()) {
    auto loaded = idl::load_scene(options.scene);
    if (const auto* const error = std::get_if<idl::SceneError>(&loaded)) {
      std::cerr << "stossd: " << error->message() << '\n';
      return Exit{kExitData};
    }
    start.scene = std::get<Scene>(std::move(loaded));
  }
  auto bodies = translate::bodies_of(start.scene);
  if (!bodies) {
    std::cerr << "stossd: " << options.scene << ": " << describe(bodies.reject()) << '\n';
    return Exit{kExitData};
  }
  start.bodies = std::move(bodies).value();
  const auto name = world_name(options, start.scene);
  if (!name) {
    std::cerr << "stossd: neither the scene's name nor its file's can be a world's name; "
                 "give --world NAME\n";
    return Exit{kExitUsage};
  }
  start.world = *name;
  return start;
}

// Milliseconds since 1970: a daemon that is started again has a higher epoch than before, so that
// nobody takes its numbers for a continuation.
std::uint64_t first_epoch() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

DaemonOptions daemon_options(const Options& options, const Start& start) {
  DaemonOptions result;
  result.domain = options.domain;
  result.network.role = dds::Role::kDaemon;
  result.network.interface = options.interface;
  result.network.allow_network = options.allow_network;
  result.simulation = {.tick_rate = options.tick_rate,
                       .speed = options.speed,
                       .paused = options.paused,
                       .bodies_max = options.bodies_max,
                       .epoch = first_epoch(),
                       .verify = options.verify,
                       .choice = {options.arithmetic, options.broad_phase}};
  result.publication = {.world = start.world,
                        .scene_name = start.scene.name(),
                        .frame_rate = options.frame_rate,
                        .arithmetic = options.arithmetic,
                        .period = start.bodies.period};
  return result;
}

// Only main takes signals; the threads inherit the mask.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
  return signals;
}

extern "C" void exit_at_once(int signal) {
  constexpr int kShellOffset = 128;
  _exit(kShellOffset + signal);
}

// Waits for a signal or for a thread that cannot go on. Returns the exit status so far.
int wait_for_end(const Daemon& daemon, const sigset_t& signals) {
  constexpr timespec kPoll{0, 100'000'000};
  for (;;) {
    const int signal = sigtimedwait(&signals, nullptr, &kPoll);
    if (daemon.failure() != 0) return daemon.failure();
    if (signal <= 0) continue;
    spdlog::info("stopping on signal {}; another one ends it at once", signal);
    static_cast<void>(std::signal(SIGTERM, exit_at_once));
    static_cast<void>(std::signal(SIGINT, exit_at_once));
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    return kExitOk;
  }
}

int serve(const Options& options, Start start, translate::SceneWorld world) {
  const auto lock = WorldLock::take(options.domain, start.world);
  if (!lock) {
    std::cerr << "stossd: a world named \"" << start.world << "\" is served already in domain "
              << options.domain << "; give this one another name with --world\n";
    return kExitTaken;
  }
  start_log(options.log_level);
  const sigset_t signals = block_signals();
  Daemon daemon(daemon_options(options, start), std::move(start.bodies), std::move(world));
  daemon.start();
  spdlog::info("world \"{}\" is served in domain {} on {}, {} ticks per second{}",
               start.world,
               options.domain,
               options.interface,
               options.tick_rate,
               options.paused ? ", paused" : "");
  const int status = wait_for_end(daemon, signals);
  daemon.stop();
  const int failure = daemon.failure();
  spdlog::info("world \"{}\" has stopped", start.world);
  return failure != 0 ? failure : status;
}

int run(int argc, char** argv) {
  const auto parsed = parse_options(argc, argv);
  if (const auto* const exit = std::get_if<Exit>(&parsed)) return exit->status;
  const auto& options = std::get<Options>(parsed);
  auto loaded = load(options);
  if (const auto* const exit = std::get_if<Exit>(&loaded)) return exit->status;
  auto& start = std::get<Start>(loaded);
  auto world = translate::make_world(start.bodies, {options.arithmetic, options.broad_phase});
  if (!world) {
    std::cerr << "stossd: " << options.scene << ": " << describe(world.reject()) << '\n';
    return kExitData;
  }
  if (options.check_config) {
    std::cout << "world \"" << start.world << "\": " << start.bodies.disks.size() << " disks, "
              << start.bodies.walls.size() << " walls";
    if (!start.bodies.zones.empty()) std::cout << ", " << start.bodies.zones.size() << " zones";
    std::cout << "; all is well\n";
    return kExitOk;
  }
  return serve(options, std::move(start), std::move(world).value());
}

}  // namespace
}  // namespace stoss::service

int main(int argc, char** argv) {
  try {
    return stoss::service::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "stossd: " << error.what() << '\n';
    return stoss::service::kExitSystem;
  }
}

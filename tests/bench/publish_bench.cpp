// SPDX-License-Identifier: Apache-2.0
// What it costs the daemon to publish a body's state and to answer a command, beside raw Cyclone
// DDS that does the same with the same types, in turn with it in the same run; and whether the
// physics keeps its pace meanwhile. Processor time of all threads of a process; of the daemon's
// without the thread of its world, and without what the same threads take for each event when
// nobody reads frames.
//
//   publish_bench [--seconds S] [--pace S] [--rounds N] [--bodies B] [--json FILE]
//
// --seconds (default 4): of each measurement; --pace (default: as long): at least, of the one that
// tells the real-time factor, which is off by some ms in that time; N (default 3) rounds; figures
// are medians. B: of that many bodies alone, in place of 10,000 and 100,000. It runs itself as
// `publish_bench raw-frames BODIES` and `publish_bench raw-echo` for the raw counterparts.
#include "bench/raw_dds.hpp"
#include "bench/scenes.hpp"
#include "bench/thread_times.hpp"
#include "integration/daemon_client.hpp"
#include "integration/daemon_process.hpp"

#include <stoss/idl/scene_file.hpp>

#include <nlohmann/json.hpp>
#include <scene.pb.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace stoss::bench {
namespace {

using engine::Code;
using idl::Op;
using tests::Process;
using tests::WireClient;
using Clock = std::chrono::steady_clock;
using Seconds = WireClient::Seconds;

namespace wire = idl::wire;

constexpr const char* kSelf = "/proc/self/exe";
constexpr double kAreaFraction = 0.3;
/// Of the bench's gas, so that a disk meets another about once in a second.
constexpr double kSpeed = 0.4;
constexpr std::size_t kCommandBodies = 10'000;
constexpr std::uint64_t kWindow = 64;  ///< commands under way at once
constexpr auto kWarmUp = std::chrono::milliseconds(1500);

struct Options {
  double seconds = 4;
  double pace = 0;
  int rounds = 3;
  std::vector<std::size_t> bodies{kCommandBodies, 100'000};
  std::string json;
};

std::string write_scene(std::size_t bodies) {
  const BenchScene gas = bench::gas(bodies, kAreaFraction);
  const auto put = [](const engine::Vector2& from, Vector2& to) {
    to.set_x(from.x());
    to.set_y(from.y());
  };
  Scene scene;
  for (const engine::DiskSpec& spec : gas.disks) {
    Disk& disk = *scene.add_disks();
    put(spec.position, *disk.mutable_position());
    put(kSpeed * spec.velocity, *disk.mutable_velocity());
    disk.set_radius(spec.radius);
  }
  for (const engine::WallSpec& spec : gas.walls) {
    Wall& wall = *scene.add_walls();
    put(spec.start, *wall.mutable_start());
    put(spec.end, *wall.mutable_end());
  }
  const std::string path = testing::TempDir() + "publish_bench_" + std::to_string(getpid()) + "_" +
                           std::to_string(bodies) + ".binpb";
  if (const auto error = idl::save_scene(scene, path)) throw std::runtime_error(error->message());
  return path;
}

class FrameReader {
 public:
  explicit FrameReader(WireClient& client)
      : topic_(idl::make_topic(client.participant(), idl::kFrameTopic)),
        reader_(idl::make_reader(client.subscriber(), topic_, idl::kFrameTopic)) {}

  /// Reads for so long; the states that came.
  double states_in(Seconds seconds) {
    double states = 0;
    const auto until = Clock::now() + seconds;
    while (Clock::now() < until) {
      reader_.drain([&](const dds::Sample<wire::FrameChunk>& sample) {
        if (!sample.valid()) return;
        states += sample.data.id._length;
        tick_ = std::max(tick_, sample.data.tick);
      });
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return states;
  }
  /// The newest that came.
  [[nodiscard]] std::uint64_t tick() const { return tick_; }

 private:
  std::uint64_t tick_ = 0;
  dds::Topic<wire::FrameChunk> topic_;
  dds::Reader<wire::FrameChunk> reader_;
};

using Figures = std::map<std::string, double>;

/// A raw writer of frames, read for so long: ns of its threads and ours for each state that it
/// sent.
Figures raw_frame_cost(std::size_t bodies, Seconds seconds) {
  Process writer({kSelf, "raw-frames", std::to_string(bodies)});
  WireClient client(kDomain, kRawWorld, 1);
  FrameReader frames(client);
  frames.states_in(kWarmUp);
  const std::uint64_t first = frames.tick();
  const ThreadTimes sender = thread_times(writer.pid());
  const ThreadTimes receiver = thread_times(getpid());
  const double states = frames.states_in(seconds);
  const double sender_ns = (thread_times(writer.pid()) - sender).all;
  const double receiver_ns = (thread_times(getpid()) - receiver).all;
  const double sent = static_cast<double>((frames.tick() - first) * bodies);
  return {{"raw_ns", sender_ns / sent},
          {"raw_receiver_ns", receiver_ns / sent},
          {"raw_arrived", states / sent}};
}

/// Of the daemon at an instant.
struct Look {
  ThreadTimes sender;
  ThreadTimes receiver = thread_times(getpid());
  wire::Status status{};
  double frames_late = 0;
};

tests::GotAnswer status_of(const Process& daemon, WireClient& client) {
  tests::GotAnswer got = client.ask(idl::Ask::kStatus);
  if (!got.status) throw std::runtime_error("the daemon does not answer: " + daemon.log());
  return got;
}

/// Just after a tick: in between, the simulated time stands still while the real time goes on. When
/// its work is done, that is, some ms after it was due.
Look look_at(const Process& daemon, WireClient& client) {
  tests::GotAnswer got = status_of(daemon, client);
  const std::uint64_t tick = got.status->tick;
  while (got.status->tick == tick) {
    std::this_thread::sleep_for(std::chrono::microseconds(500));
    got = status_of(daemon, client);
  }
  Look look{.sender = thread_times(daemon.pid(), "world"), .status = *got.status};
  look.frames_late = static_cast<double>(got.counters["frames_late"]);
  return look;
}

double between(std::uint64_t before, std::uint64_t after) {
  return static_cast<double>(after - before);
}

/// Between two looks.
struct Stretch {
  Stretch(const Look& before, const Look& after)
      : world_ns((after.sender - before.sender).named),
        others_ns((after.sender - before.sender).all - world_ns),
        receiver_ns((after.receiver - before.receiver).all),
        events(between(before.status.events, after.status.events)),
        frames(between(before.status.frame_count, after.status.frame_count)) {}

  double world_ns;   ///< of the thread that does the physics
  double others_ns;  ///< of all the others
  double receiver_ns;
  double events;
  double frames;
};

/// The daemon's world goes on while the raw writer is measured, so that both have the same company.
Figures frame_cost(const std::string& scene, std::size_t bodies, Seconds seconds, Seconds pace) {
  Process daemon(tests::stossd(
      kDomain,
      {"--scene", scene, "--world", kWorld, "--frame-rate", std::to_string(kFramesPerSecond)}));
  WireClient client(kDomain, kWorld, 1);
  if (!client.connect()) throw std::runtime_error("no daemon: " + daemon.log());
  std::this_thread::sleep_for(kWarmUp);
  const Look alone = look_at(daemon, client);
  std::this_thread::sleep_for(seconds);
  const Look alone_after = look_at(daemon, client);
  Figures figures = raw_frame_cost(bodies, seconds);

  FrameReader frames(client);
  frames.states_in(kWarmUp);
  const Look before = look_at(daemon, client);
  const double states = frames.states_in(std::max(seconds, pace));
  const Look after = look_at(daemon, client);

  const Stretch quiet(alone, alone_after);
  const Stretch busy(before, after);
  const double following_ns = quiet.others_ns / quiet.events;
  const double real_s = after.status.uptime - before.status.uptime;
  const double simulated_s = engine::seconds_between(translate::to_engine(before.status.at),
                                                     translate::to_engine(after.status.at));
  const double sent = busy.frames * static_cast<double>(bodies);
  figures.merge(
      Figures{{"stossd_ns", (busy.others_ns - following_ns * busy.events) / sent},
              {"following_ns", following_ns},
              {"stossd_receiver_ns", busy.receiver_ns / sent},
              {"stossd_arrived", states / sent},
              {"frames_per_second", busy.frames / real_s},
              {"frames_late", after.frames_late - before.frames_late},
              {"world_ns_alone", quiet.world_ns / quiet.events},
              {"world_ns_publishing", busy.world_ns / busy.events},
              {"world_share", busy.world_ns / (1e9 * real_s)},
              {"others_share", busy.others_ns / (1e9 * real_s)},
              {"real_time_factor", simulated_s / real_s},
              {"ticks_late", between(before.status.ticks_late, after.status.ticks_late)},
              {"ticks_slipped", between(before.status.ticks_slipped, after.status.ticks_slipped)}});
  return figures;
}

/// Windows of commands for so long; ns of the other process for each command answered.
double command_ns(const Process& daemon, WireClient& client, Seconds seconds) {
  const tests::Targets velocity({1}, {0.0}, {0.0});
  const ThreadTimes before = thread_times(daemon.pid());
  const auto until = Clock::now() + seconds;
  double count = 0;
  while (Clock::now() < until) {
    std::uint64_t last = 0;
    for (std::uint64_t i = 0; i < kWindow; ++i) last = client.send(Op::kSetVelocity, velocity);
    if (!client.reply(last)) throw std::runtime_error("no reply: " + daemon.log());
    count += kWindow;
  }
  return (thread_times(daemon.pid()) - before).all / count;
}

Figures command_cost(const std::string& scene, Seconds seconds) {
  Figures figures;
  {
    Process echo({kSelf, "raw-echo"});
    WireClient client(kDomain, kWorld, 1);
    if (!client.connect() || !client.reply(client.send(Op::kPause))) {
      throw std::runtime_error("no echo");
    }
    figures["raw_ns"] = command_ns(echo, client, seconds);
  }
  Process daemon(tests::stossd(kDomain, {"--scene", scene, "--world", kWorld, "--paused"}));
  WireClient client(kDomain, kWorld, 1);
  if (!client.connect()) throw std::runtime_error("no daemon: " + daemon.log());
  client.status();
  figures["stossd_ns"] = command_ns(daemon, client, seconds);
  return figures;
}

Figures medians(const std::vector<Figures>& rounds) {
  Figures result;
  for (const auto& entry : rounds.front()) {
    std::vector<double> values;
    for (const Figures& round : rounds) values.push_back(round.at(entry.first));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    result[entry.first] = *middle;
  }
  result["ratio"] = result["stossd_ns"] / result["raw_ns"];
  return result;
}

void print(std::size_t bodies, Figures& f) {
  std::printf("%zu bodies\n  a state in a frame: raw %.1f ns, stossd %.1f ns: %.2f; ",
              bodies,
              f["raw_ns"],
              f["stossd_ns"],
              f["ratio"]);
  std::printf("receivers %.1f and %.1f ns; arrived %.1f %% and %.1f %%\n",
              f["raw_receiver_ns"],
              f["stossd_receiver_ns"],
              100 * f["raw_arrived"],
              100 * f["stossd_arrived"]);
  std::printf(
      "  frames: %.1f a second, %.0f late; real-time factor %.4f, ticks late %.0f, put off "
      "%.0f\n",
      f["frames_per_second"],
      f["frames_late"],
      f["real_time_factor"],
      f["ticks_late"],
      f["ticks_slipped"]);
  std::printf(
      "  the world's thread: %.1f %% of a core, %.0f ns an event, %.0f ns without readers\n",
      100 * f["world_share"],
      f["world_ns_publishing"],
      f["world_ns_alone"]);
  std::printf("  the others: %.1f %% of a core, of it %.0f ns an event to follow the world\n",
              100 * f["others_share"],
              f["following_ns"]);
}

/// False when a figure cannot be true: nothing came, or no time went by.
bool is_sound(const Figures& figures) {
  return std::all_of(figures.begin(),
                     figures.end(),
                     [](const auto& entry) { return std::isfinite(entry.second); }) &&
         figures.at("raw_ns") > 0 && figures.at("stossd_ns") > 0;
}

bool has_arrived(const Figures& frames) {
  return frames.at("raw_arrived") > 0 && frames.at("stossd_arrived") > 0;
}

int run(const Options& options) {
  const Seconds seconds(options.seconds);
  nlohmann::ordered_json page;
  bool is_good = true;
  for (const std::size_t bodies : options.bodies) {
    const std::string scene = write_scene(bodies);
    std::vector<Figures> rounds, commands;
    for (int round = 0; round < options.rounds; ++round) {
      rounds.push_back(frame_cost(scene, bodies, seconds, Seconds(options.pace)));
      if (bodies == kCommandBodies) commands.push_back(command_cost(scene, seconds));
    }
    std::filesystem::remove(scene);
    Figures frames = medians(rounds);
    is_good = is_good && is_sound(frames) && has_arrived(frames);
    print(bodies, frames);
    page["frames"].push_back(frames);
    page["frames"].back()["bodies"] = bodies;
    if (commands.empty()) continue;
    Figures command = medians(commands);
    is_good = is_good && is_sound(command);
    std::printf("  command and reply: raw %.0f ns, stossd %.0f ns: %.2f\n",
                command["raw_ns"],
                command["stossd_ns"],
                command["ratio"]);
    page["command"] = command;
  }
  if (!options.json.empty()) std::ofstream(options.json) << page.dump(1) << '\n';
  return is_good ? 0 : 1;
}

int usage() {
  std::fputs(
      "usage: publish_bench [--seconds S] [--pace S] [--rounds N] [--bodies B] [--json FILE]\n",
      stderr);
  return 2;
}

int main_of(const std::vector<std::string>& words) {
  if (words.size() == 2 && words[0] == "raw-frames") return raw_frames(std::stoul(words[1]));
  if (words.size() == 1 && words[0] == "raw-echo") return raw_echo();
  Options options;
  if (words.size() % 2 != 0) return usage();
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    if (words[i] == "--seconds") {
      options.seconds = std::strtod(words[i + 1].c_str(), nullptr);
    } else if (words[i] == "--pace") {
      options.pace = std::strtod(words[i + 1].c_str(), nullptr);
    } else if (words[i] == "--rounds") {
      options.rounds = std::atoi(words[i + 1].c_str());
    } else if (words[i] == "--bodies") {
      options.bodies = {std::strtoul(words[i + 1].c_str(), nullptr, 10)};
    } else if (words[i] == "--json") {
      options.json = words[i + 1];
    } else {
      return usage();
    }
  }
  if (!(options.seconds > 0) || !(options.pace >= 0) || options.rounds < 1 ||
      options.bodies.front() == 0)
    return usage();
  return run(options);
}

}  // namespace
}  // namespace stoss::bench

int main(int argc, char** argv) {
  try {
    return stoss::bench::main_of({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "publish_bench: %s\n", error.what());
    return 1;
  }
}

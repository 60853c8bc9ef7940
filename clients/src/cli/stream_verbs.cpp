// SPDX-License-Identifier: Apache-2.0
// states, collisions, zones

#include "cli/common.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/client/feeds.hpp>
#include <stoss/client/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace stoss::client::cli {
namespace {

constexpr Milliseconds kLook{100};
constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

std::uint64_t limit_of(const std::string& option, const std::string& text) {
  return text.empty() ? kNoLimit : count_of(option, text);
}

struct StatesOptions {
  std::vector<std::string> ids;
  std::string count;
  std::string head;
};

engine::BodyState state_of(const FrameBody& body, const engine::Instant& at) {
  engine::BodyState state;
  state.id = body.id;
  state.instant = at;
  state.position = body.position;
  state.velocity = body.velocity;
  state.angle = body.angle;
  state.spin = body.spin;
  state.radius = body.radius;
  return state;
}

/// Radii travel in frames where they grow; else the scene has them. It may come after the frames
/// that it is wanted for, so a disk that it does not know yet is waited for, once in vain at most.
class Radii {
 public:
  explicit Radii(const Session& session)
      : feed_(session), timeout_(session.timeout()), patience_(timeout_) {}
  double operator()(engine::Id id) {
    const SceneImage::DiskShape* disk = find(id);
    const auto until = std::chrono::steady_clock::now() + patience_;
    while (disk == nullptr && !interrupted()) {
      refresh(patience_ > Milliseconds{0} ? kLook : Milliseconds{0});
      disk = find(id);
      if (std::chrono::steady_clock::now() >= until) break;
    }
    patience_ = disk == nullptr ? Milliseconds{0} : timeout_;
    return disk == nullptr ? 0 : disk->radius;
  }

 private:
  const SceneImage::DiskShape* find(engine::Id id) const {
    const auto found = std::lower_bound(
        disks_.begin(), disks_.end(), id, [](const SceneImage::DiskShape& disk, engine::Id wanted) {
          return disk.id < wanted;
        });
    return found == disks_.end() || found->id != id ? nullptr : &*found;
  }

  void refresh(Milliseconds patience) {
    std::optional<SceneImage> scene = feed_.next(patience);
    if (!scene) return;
    disks_ = std::move(scene->disks);
    std::sort(
        disks_.begin(), disks_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  }

  SceneFeed feed_;
  Milliseconds timeout_;
  Milliseconds patience_;  ///< for the next disk that is not known
  std::vector<SceneImage::DiskShape> disks_;
};

std::string frame_json(const Frame& frame, std::size_t head, Radii& radii) {
  std::string out;
  for (std::size_t i = 0; i < std::min(head, frame.bodies.size()); ++i) {
    engine::BodyState state = state_of(frame.bodies[i], frame.at);
    if (state.radius == 0) state.radius = radii(state.id);
    append_json(out, state);
    out += '\n';
  }
  return out;
}

std::string frame_text(const Frame& frame, std::size_t head) {
  Table table({"id", "x", "y", "vx", "vy"});
  for (std::size_t i = 0; i < std::min(head, frame.bodies.size()); ++i) {
    const FrameBody& body = frame.bodies[i];
    table.add({std::to_string(body.id),
               format_number(body.position.x()),
               format_number(body.position.y()),
               format_number(body.velocity.x()),
               format_number(body.velocity.y())});
  }
  return "t = " + format_instant(frame.at) + " s, tick " + std::to_string(frame.tick) + ", " +
         std::to_string(frame.bodies.size()) + " disks\n" + table.text();
}

/// The world itself may go on in silence (paused), so silence is not the end of a stream; but a
/// daemon that has gone is.
void check_alive(Session& session) {
  static_cast<void>(value_or_throw(session.ask(Query::status())));
}

void stream_frames(const GlobalOptions& global, const StatesOptions& options) {
  const std::uint64_t count = limit_of("--count", options.count);
  const std::uint64_t head = limit_of("--head", options.head);
  const auto session = connect(global);
  FrameFeed feed(*session);
  Radii radii(*session);
  auto heard = std::chrono::steady_clock::now();
  for (std::uint64_t frames = 0; frames < count && !interrupted();) {
    if (const std::optional<Frame> frame = feed.next(kLook)) {
      print(global.json ? frame_json(*frame, head, radii) : frame_text(*frame, head));
      heard = std::chrono::steady_clock::now();
      ++frames;
    } else if (std::chrono::steady_clock::now() - heard > session->timeout()) {
      check_alive(*session);
      heard = std::chrono::steady_clock::now();
    }
  }
}

std::string body_line(const BodyUpdate& update, bool json) {
  const engine::BodyState& state = update.state;
  if (json) {
    std::string out;
    append_json(out, state);
    return out + '\n';
  }
  return "t " + format_instant(state.instant) + "  id " + std::to_string(state.id) + "  x " +
         format_number(state.position.x()) + "  y " + format_number(state.position.y()) + "  vx " +
         format_number(state.velocity.x()) + "  vy " + format_number(state.velocity.y()) + '\n';
}

void stream_bodies(const GlobalOptions& global, const StatesOptions& options) {
  const std::uint64_t count = limit_of("--count", options.count);
  const std::vector<engine::Id> ids = ids_of(options.ids);
  const auto session = connect(global);
  BodyFeed feed(*session);
  static_cast<void>(value_or_throw(session->command(Command::watch(ids))));
  std::size_t left = ids.size();
  auto heard = std::chrono::steady_clock::now();
  for (std::uint64_t updates = 0; updates < count && left > 0 && !interrupted();) {
    const std::optional<BodyUpdate> update = feed.next(kLook);
    if (!update) {
      if (std::chrono::steady_clock::now() - heard > session->timeout()) {
        check_alive(*session);
        heard = std::chrono::steady_clock::now();
      }
      continue;
    }
    heard = std::chrono::steady_clock::now();
    // Others may watch other bodies; a slot that falls empty does not say whose it was.
    if (update->gone) {
      const Result<Answer> still = session->ask(Query::states(ids));
      if (!still && still.failure().answered) break;
      continue;
    }
    if (std::find(ids.begin(), ids.end(), update->state.id) == ids.end()) continue;
    print(body_line(*update, global.json));
    ++updates;
  }
  static_cast<void>(session->command(Command::unwatch(ids), Milliseconds{500}).ok());
}

void add_states(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<StatesOptions>();
  CLI::App* verb = add_verb(app,
                            "states",
                            "Print the states of all disks, frame by frame, or of some bodies, "
                            "as they are published; Ctrl-C ends it",
                            "stoss states --count 1, or stoss states 3 4 --json");
  verb->add_option("ID", options->ids, "Only these bodies");
  verb->add_option("--count", options->count, "End after so many frames (with IDs: states)");
  verb->add_option("--head", options->head, "Print only the first so many disks of a frame");
  verb->callback([&invocation, options] {
    invocation.action = [&global = invocation.global, options] {
      catch_interrupts();
      if (options->ids.empty()) {
        stream_frames(global, *options);
      } else {
        stream_bodies(global, *options);
      }
    };
  });
}

struct EventOptions {
  std::string count;
  std::string since;
};

std::string event_line(const engine::Collision& c) {
  std::string out = '#' + std::to_string(c.sequence) + "  t " + format_instant(c.instant) + "  " +
                    word(c.kind) + ' ' + std::to_string(c.a) + ' ' + std::to_string(c.b) + "  at " +
                    format_number(c.point.x()) + ',' + format_number(c.point.y()) + "  impulse " +
                    format_number(c.impulse) + "  approach " + format_number(c.approach_speed);
  if (c.regularised) out += "  regularised";
  if (c.order_dependent) out += "  order-dependent";
  return out + '\n';
}

std::string event_line(const engine::ZoneEvent& e) {
  return '#' + std::to_string(e.sequence) + "  t " + format_instant(e.instant) + "  body " +
         std::to_string(e.body) + (e.entered ? " enters " : " leaves ") + "zone " +
         std::to_string(e.zone) + "  at " + format_number(e.position.x()) + ',' +
         format_number(e.position.y()) + "  velocity " + format_number(e.velocity.x()) + ',' +
         format_number(e.velocity.y()) + '\n';
}

const std::vector<engine::Collision>& events_of(const CollisionRun& run) { return run.collisions; }
const std::vector<engine::ZoneEvent>& events_of(const ZoneRun& run) { return run.events; }

/// Prints at most `room` events of a run; returns how many.
template <class Run>
std::uint64_t print_run(const Run& run, const char* what, std::uint64_t room, bool json) {
  if (run.lost > 0) {
    std::fprintf(stderr,
                 "stoss: %llu %s are no longer kept by the daemon\n",
                 static_cast<unsigned long long>(run.lost),
                 what);
  }
  std::string out;
  std::uint64_t printed = 0;
  for (const auto& event : events_of(run)) {
    if (printed == room) break;
    if (json) {
      append_json(out, event);
      out += '\n';
    } else {
      out += event_line(event);
    }
    ++printed;
  }
  print(out);
  return printed;
}

template <class Feed>
void stream_events(const GlobalOptions& global, const char* what, const EventOptions& options) {
  const std::uint64_t count = limit_of("--count", options.count);
  std::optional<std::uint64_t> since;
  if (!options.since.empty()) since = count_of("--since", options.since);
  const auto session = connect(global);
  Feed feed(*session, since);
  auto heard = std::chrono::steady_clock::now();
  for (std::uint64_t printed = 0; printed < count && !interrupted();) {
    if (const auto run = feed.next(kLook)) {
      printed += print_run(*run, what, count - printed, global.json);
      heard = std::chrono::steady_clock::now();
    } else if (std::chrono::steady_clock::now() - heard > session->timeout()) {
      check_alive(*session);
      heard = std::chrono::steady_clock::now();
    }
  }
}

template <class Feed>
void add_event_verb(CLI::App& app,
                    Invocation& invocation,
                    const char* name,
                    const char* what,
                    const std::string& description) {
  auto options = std::make_shared<EventOptions>();
  CLI::App* verb = add_verb(app,
                            name,
                            description + " in their order as they happen; Ctrl-C ends it",
                            "stoss " + std::string(name) + " --since 1 --count 10 --json");
  verb->add_option("--count", options->count, "End after so many");
  verb->add_option("--since",
                   options->since,
                   "Begin with the one of this number, as far back as the daemon keeps them");
  verb->callback([&invocation, options, what] {
    invocation.action = [&global = invocation.global, options, what] {
      catch_interrupts();
      stream_events<Feed>(global, what, *options);
    };
  });
}

}  // namespace

void add_stream_verbs(CLI::App& app, Invocation& invocation) {
  add_states(app, invocation);
  add_event_verb<CollisionFeed>(app, invocation, "collisions", "collisions", "Print collisions");
  add_event_verb<ZoneFeed>(
      app, invocation, "zones", "zone events", "Print entries into zones and exits from them");
}

}  // namespace stoss::client::cli

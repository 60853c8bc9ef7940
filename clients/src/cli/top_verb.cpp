// SPDX-License-Identifier: Apache-2.0
// top

#include "cli/common.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "cli/top_screen.hpp"

#include <chrono>
#include <limits>
#include <utility>

namespace stoss::client::cli {
namespace {

using std::chrono::steady_clock;

constexpr Milliseconds kRedraw{100};
constexpr std::chrono::seconds kLineInterval{1};

struct TopOptions {
  std::string count;
};

/// How fast a counter grows per real second, from one look to the next.
class Rate {
 public:
  double update(std::uint64_t count, steady_clock::time_point now) {
    const double elapsed = std::chrono::duration<double>(now - time_).count();
    if (count >= count_ && known_ && elapsed > 0) {
      value_ = static_cast<double>(count - count_) / elapsed;
    }
    known_ = true;
    count_ = count;
    time_ = now;
    return value_;
  }

 private:
  bool known_ = false;
  std::uint64_t count_ = 0;
  steady_clock::time_point time_{};
  double value_ = 0;
};

/// Keeps a view up to date from the world's topics; silence for long is looked into.
class Watch {
 public:
  explicit Watch(Session& session)
      : session_(session), statuses_(session), frames_(session), heard_(steady_clock::now()) {
    take(session.first_status());
  }

  /// Takes what arrives for `time`. Throws NoAnswerError when the world has gone.
  void run(Milliseconds time) {
    const auto end = steady_clock::now() + time;
    while (!interrupted()) {
      const auto left = std::chrono::duration_cast<Milliseconds>(end - steady_clock::now());
      if (auto frame = frames_.next(std::max(left, Milliseconds{0}))) {
        ++frames_seen_;
        view_.frame = std::move(*frame);
      }
      if (auto status = statuses_.next(Milliseconds{0})) take(*status);
      if (left <= Milliseconds{0}) break;
    }
    if (steady_clock::now() - heard_ <= session_.timeout()) return;
    const Answer answer = value_or_throw(session_.ask(Query::status()));
    if (answer.status) take(*answer.status);
  }

  [[nodiscard]] const TopView& view() const { return view_; }

 private:
  void take(const Status& status) {
    heard_ = steady_clock::now();
    view_.status = status;
    view_.collisions_per_second = collisions_.update(status.collisions, heard_);
    view_.frames_per_second = frame_rate_.update(frames_seen_, heard_);
  }

  Session& session_;
  StatusFeed statuses_;
  FrameFeed frames_;
  Rate collisions_;
  Rate frame_rate_;
  std::uint64_t frames_seen_ = 0;
  steady_clock::time_point heard_;
  TopView view_;
};

void show_screens(Watch& watch, std::uint64_t count) {
  Terminal terminal;
  for (std::uint64_t shown = 0; shown < count && !interrupted(); ++shown) {
    watch.run(kRedraw);
    const TerminalSize size = terminal.size();
    terminal.show(top_screen(watch.view(), size.columns, size.rows));
    while (const std::optional<char> key = terminal.key()) {
      if (*key == 'q' || *key == 'Q') return;
    }
  }
}

void show_lines(Watch& watch, std::uint64_t count, bool json) {
  for (std::uint64_t shown = 0; shown < count && !interrupted(); ++shown) {
    watch.run(kLineInterval);
    if (interrupted()) return;
    print(json ? status_json(watch.view().status) : top_line(watch.view()));
  }
}

void top(const GlobalOptions& global, const TopOptions& options) {
  const std::uint64_t count = options.count.empty() ? std::numeric_limits<std::uint64_t>::max()
                                                    : count_of("--count", options.count);
  const auto session = connect(global);
  Watch watch(*session);
  if (is_terminal() && !global.json) {
    show_screens(watch, count);
  } else {
    show_lines(watch, count, global.json);
  }
}

}  // namespace

void add_top_verb(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<TopOptions>();
  CLI::App* verb = add_verb(
      app,
      "top",
      "Watch a world live: rates, health, fastest disks; q quits. Without a terminal: a line a "
      "second",
      "stoss top --world gas");
  verb->add_option("--count", options->count, "End after so many screens or lines");
  verb->callback([&invocation, options] {
    invocation.action = [&global = invocation.global, options] {
      catch_interrupts();
      top(global, *options);
    };
  });
}

}  // namespace stoss::client::cli

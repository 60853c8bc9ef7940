// SPDX-License-Identifier: Apache-2.0
#include "cli/top_screen.hpp"

#include "cli/json_object.hpp"
#include "cli/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <vector>

namespace stoss::client::cli {
namespace {

constexpr int kHeaderRows = 9;

/// As printf, into a string; longer lines are cut.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...) {
  std::array<char, 256> buffer{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

double seconds_of(const engine::Instant& at) { return engine::seconds_between({}, at); }

/// The frame's instant is the newer one while the world runs.
engine::Instant present(const TopView& view) {
  if (!view.frame || view.frame->epoch != view.status.epoch) return view.status.at;
  return std::max(view.frame->at, view.status.at);
}

std::string speed_word(double speed) {
  return std::isinf(speed) ? "max" : formatted("%.4g", speed);
}

std::vector<FrameBody> fastest(const Frame& frame, std::size_t count) {
  std::vector<FrameBody> bodies = frame.bodies;
  count = std::min(count, bodies.size());
  const auto faster = [](const FrameBody& a, const FrameBody& b) {
    const double speed_a = a.velocity.stableNorm();
    const double speed_b = b.velocity.stableNorm();
    return speed_a != speed_b ? speed_a > speed_b : a.id < b.id;
  };
  std::partial_sort(
      bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(count), bodies.end(), faster);
  bodies.resize(count);
  return bodies;
}

std::string verify_row(const Status& s) {
  if (s.verify_period == 0) return "verify off";
  return formatted("verify %8llu x  overlaps %llu  missed %llu  deepest %.1g  dE %.1g  dp %.1g",
                   static_cast<unsigned long long>(s.verify_checks),
                   static_cast<unsigned long long>(s.verify_overlaps),
                   static_cast<unsigned long long>(s.verify_missed),
                   s.verify_worst_overlap,
                   s.verify_energy_error,
                   s.verify_momentum_error);
}

std::vector<std::string> header(const TopView& view) {
  const Status& s = view.status;
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  return {
      formatted("stoss top   world %s   in %s   %s%s%s",
                s.world.c_str(),
                arithmetic_name(s).c_str(),
                idl::name_of(s.state).data(),
                s.reason.empty() ? "" : ": ",
                s.reason.c_str()),
      formatted("time   %14.6f s   tick %12llu at %.6g Hz   speed %.3g of %s",
                seconds_of(present(view)),
                number(s.tick),
                s.tick_rate,
                s.speed_reached,
                speed_word(s.speed_asked).c_str()),
      formatted("bodies %14llu disks  %llu walls, %llu watched   frames %.3g /s",
                number(s.bodies),
                number(s.walls),
                number(s.watched),
                view.frames_per_second),
      formatted("events %14llu         %.4g /s", number(s.events), s.events_per_second),
      formatted("colls  %14llu         %.4g /s   regularised %llu   order-dependent %llu",
                number(s.collisions),
                view.collisions_per_second,
                number(s.regularised),
                number(s.order_dependent)),
      formatted("cmds   %14llu         rejected %llu  duplicates %llu  queries %llu",
                number(s.commands),
                number(s.rejected),
                number(s.duplicates),
                number(s.queries)),
      formatted("hash   %s   epoch %llu  dropped %llu  late %llu  slipped %llu",
                hexadecimal(s.state_hash).c_str(),
                number(s.epoch),
                number(s.dropped),
                number(s.ticks_late),
                number(s.ticks_slipped)),
      verify_row(s),
  };
}

}  // namespace

std::string top_screen(const TopView& view, int columns, int rows) {
  std::vector<std::string> lines = header(view);
  lines.emplace_back();
  if (view.frame && rows > kHeaderRows + 2) {
    lines.push_back(
        formatted("%10s %14s %14s %12s %12s %12s", "fastest", "x", "y", "vx", "vy", "speed"));
    const auto room = static_cast<std::size_t>(rows - kHeaderRows - 2);
    for (const FrameBody& body : fastest(*view.frame, room)) {
      lines.push_back(formatted("%10llu %14.6g %14.6g %12.5g %12.5g %12.5g",
                                static_cast<unsigned long long>(body.id),
                                body.position.x(),
                                body.position.y(),
                                body.velocity.x(),
                                body.velocity.y(),
                                body.velocity.stableNorm()));
    }
  }
  const auto last = static_cast<std::size_t>(std::max(rows - 1, 1));
  if (lines.size() > last) lines.resize(last);
  while (lines.size() < last) lines.emplace_back();
  lines.emplace_back("q quits");
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out += lines[i].substr(0, static_cast<std::size_t>(std::max(columns, 1)));
    if (i + 1 < lines.size()) out += '\n';
  }
  return out;
}

std::string top_line(const TopView& view) {
  const Status& s = view.status;
  return formatted("t %.3f s  %s  speed %.3g  disks %llu  collisions %llu  %.4g /s  hash %s\n",
                   seconds_of(present(view)),
                   idl::name_of(s.state).data(),
                   s.speed_reached,
                   static_cast<unsigned long long>(s.bodies),
                   static_cast<unsigned long long>(s.collisions),
                   view.collisions_per_second,
                   hexadecimal(s.state_hash).c_str());
}

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
#include "accuracy/picture.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace stoss::client::accuracy {
namespace {

/// Colour, gnuplot's point type and dash type of a method.
struct Style {
  const char* name;
  const char* colour;
  int marker;
  const char* dash;
};

// Okabe, Ito: Color Universal Design (2008); grey stands for their yellow, which is lost on white.
constexpr std::array kStyles = {
    Style{"float", "#E69F00", 4, "solid"},
    Style{"double", "#0072B2", 7, "solid"},
    Style{"long-double", "#009E73", 8, "solid"},
    Style{"double-double", "#CC79A7", 12, "solid"},
    Style{"float128", "#000000", 2, "solid"},
    Style{"detect", "#D55E00", 5, "'-'"},
    Style{"substeps", "#56B4E9", 9, "'_'"},
    Style{"back-up", "#666666", 13, "'-.'"},
};
constexpr Style kOther = {"", "#000000", 1, "'.'"};

std::string style_of(const std::string& method) {
  const auto* found = std::find_if(
      kStyles.begin(), kStyles.end(), [&](const Style& style) { return method == style.name; });
  const Style& style = found == kStyles.end() ? kOther : *found;
  std::ostringstream out;
  out << "lc rgb '" << style.colour << "' lw 1.5 dt " << style.dash << " pt " << style.marker
      << " ps 0.7";
  return out.str();
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\n') continue;  // no string of gnuplot holds one
    out += c;
    if (c == '\'') out += c;
  }
  return out + "'";
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// x and y of one curve; those that a logarithmic axis cannot show are left out.
class Curve {
 public:
  void add(double x, double y, bool log_x = true) {
    if (std::isfinite(x) && std::isfinite(y) && y > 0 && (x > 0 || !log_x)) {
      points_ << x << ' ' << y << '\n';
      low_ = {std::min(low_[0], x), std::min(low_[1], y)};
      high_ = {std::max(high_[0], x), std::max(high_[1], y)};
    }
  }
  [[nodiscard]] bool empty() const { return low_[0] > high_[0]; }
  [[nodiscard]] std::string text() const { return points_.str(); }
  [[nodiscard]] double low(std::size_t axis) const { return low_[axis]; }
  [[nodiscard]] double high(std::size_t axis) const { return high_[axis]; }

 private:
  std::ostringstream points_;
  std::array<double, 2> low_ = {kInfinity, kInfinity};
  std::array<double, 2> high_ = {-kInfinity, -kInfinity};
};

/// One panel: named curves, then the plot command that draws them.
class Panel {
 public:
  Panel(std::ostringstream& out, int number) : out_(out), number_(number) {}

  Curve& curve(const std::string& method, const std::string& label) {
    for (auto& entry : curves_) {
      if (entry.label == label) return entry.curve;
    }
    return curves_.emplace_back(Entry{method, label, {}}).curve;
  }
  /// `logarithmic`: of x and y, "xy", "y" or "".
  void draw(const std::string& settings, const std::string& logarithmic, const std::string& with) {
    logarithmic_ = logarithmic;
    std::string plot;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      if (curves_[i].curve.empty()) continue;
      const std::string block = "$p" + std::to_string(number_) + "_" + std::to_string(i);
      out_ << block << " << EOD\n" << curves_[i].curve.text() << "EOD\n";
      plot += (plot.empty() ? "plot " : ", ") + block + " using 1:2 with " + with + " " +
              style_of(curves_[i].method) + " title " + quoted(curves_[i].label);
    }
    out_ << settings << range("x", 0) << range("y", 1);
    out_ << (plot.empty() ? "set multiplot next\n" : plot + "\n");
  }

 private:
  struct Entry {
    std::string method;
    std::string label;
    Curve curve;
  };
  /// A range with room around the curves: gnuplot's own puts points onto the frame.
  [[nodiscard]] std::string range(const std::string& axis, std::size_t index) const {
    double low = kInfinity;
    double high = -kInfinity;
    for (const Entry& entry : curves_) {
      low = std::min(low, entry.curve.low(index));
      high = std::max(high, entry.curve.high(index));
    }
    std::ostringstream out;
    if (logarithmic_.find(axis) == std::string::npos) {
      constexpr double kRoom = 1.05;
      out << "unset logscale " << axis << "\nset " << axis
          << "range [0:" << (high > 0 ? kRoom * high : 1) << "]\n";
    } else if (low <= high) {
      const double room = std::max(2.0, std::pow(high / low, 0.05));
      out << "set logscale " << axis << "\nset " << axis << "range [" << low / room << ':'
          << high * room << "]\n";
    }
    return out.str();
  }

  std::ostringstream& out_;
  int number_;
  std::string logarithmic_;
  std::vector<Entry> curves_;
};

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", value);
  return text;
}

std::string label_of(const Method& method) {
  return method.arithmetic ? method.name : method.name + ", " + seconds(method.step);
}

void work_and_precision(const Report& report, std::ostringstream& out) {
  // An eighth of the run is before the error of most methods is as large as it can be.
  constexpr double kPart = 0.125;
  Panel panel(out, 1);
  for (const Figures& figures : report.methods) {
    Curve& curve = panel.curve(figures.method.name, figures.method.name);
    for (const Point& point : figures.points) {
      if (point.time_s < kPart * report.until_s) continue;
      curve.add(point.position_error_rms_m, figures.cpu_s_per_s);
      break;
    }
  }
  panel.draw("set title 'Work and precision, after " + seconds(kPart * report.until_s) +
                 "'\nset xlabel 'rms error of position (m)'\n"
                 "set ylabel 'CPU time for a simulated second (s)'\n"
                 "set key outside right\n",
             "xy",
             "linespoints");
}

/// Of the baselines with several steps, the one of the finest that came to the end.
std::vector<const Figures*> one_of_each(const Report& report) {
  std::map<std::string, const Figures*> best;
  for (const Figures& figures : report.methods) {
    const Figures*& known = best[figures.method.name];
    if (known == nullptr || figures.reached_s > known->reached_s ||
        (figures.reached_s == known->reached_s && figures.method.step < known->method.step)) {
      known = &figures;
    }
  }
  std::vector<const Figures*> list;
  for (const Figures& figures : report.methods) {
    if (best[figures.method.name] == &figures) list.push_back(&figures);
  }
  return list;
}

void growth_of_error(const Report& report, std::ostringstream& out) {
  Panel panel(out, 2);
  for (const Figures* one : one_of_each(report)) {
    const Figures& figures = *one;
    Curve& curve = panel.curve(figures.method.name, label_of(figures.method));
    for (const Point& point : figures.points) {
      curve.add(point.time_s, point.position_error_rms_m, false);
    }
  }
  panel.draw(
      "set title 'Growth of the error'\nset xlabel 'simulated time (s)'\n"
      "set ylabel 'rms error of position (m)'\n",
      "y",
      "linespoints");
}

void horizon_and_digits(const Report& report, std::ostringstream& out) {
  Panel panel(out, 3);
  for (const Figures& figures : report.methods) {
    if (!figures.horizon) continue;
    const HorizonFigures& horizon = *figures.horizon;
    panel.curve(figures.method.name, figures.method.name + (horizon.at_least ? ", at least" : ""))
        .add(digits_of(*figures.method.arithmetic), horizon.collisions_per_disk);
  }
  panel.draw(
      "set title 'Horizon'\nset xlabel 'decimal digits of the arithmetic'\n"
      "set ylabel 'right collisions a disk'\n",
      "",
      "points");
}

void energy_and_collisions(const Report& report, std::ostringstream& out) {
  Panel panel(out, 4);
  for (const Figures* one : one_of_each(report)) {
    const Figures& figures = *one;
    Curve& curve = panel.curve(figures.method.name, label_of(figures.method));
    for (const Point& point : figures.points) {
      curve.add(static_cast<double>(point.collisions), point.energy_error);
    }
  }
  panel.draw("set title 'Energy'\nset xlabel 'collisions'\nset ylabel 'relative error of energy'\n",
             "xy",
             "linespoints");
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() > end.size() && text.substr(text.size() - end.size()) == end;
}

/// Runs gnuplot with `script` as its input. Returns its exit status.
int run_gnuplot(const std::string& script) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    dup2(ends[0], STDIN_FILENO);
    execlp("gnuplot", "gnuplot", "-", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[0]);
  for (std::size_t written = 0; written < script.size();) {
    const ssize_t n = write(ends[1], script.data() + written, script.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;  // its exit status tells why
    written += static_cast<std::size_t>(n);
  }
  close(ends[1]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

bool is_picture_path(const std::string& path) {
  return ends_with(path, ".svg") || ends_with(path, ".png");
}

bool has_gnuplot() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + "/gnuplot").c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::string picture_script(const Report& report, const std::string& path) {
  std::ostringstream out;
  const bool svg = ends_with(path, ".svg");
  out << "set terminal " << (svg ? "svg size 1400,900 font 'sans,13'" : "pngcairo size 1400,900")
      << " background '#FFFFFF'\n"
      << "set output " << quoted(path) << "\nset encoding utf8\nset grid lc rgb '#DDDDDD'\n"
      << "set format x '%g'\nset format y '%.0e'\n"
      << "set multiplot layout 2,2 title "
      << quoted(report.scene + ": " + std::to_string(report.disks) + " disks, reference " +
                report.reference)
      << " noenhanced\n";
  out << "set key noenhanced\nset format x '%.0e'\n";
  work_and_precision(report, out);
  out << "set format x '%g'\n";
  growth_of_error(report, out);
  out << "set format y '%g'\n";
  horizon_and_digits(report, out);
  out << "set format y '%.0e'\n";
  energy_and_collisions(report, out);
  out << "unset multiplot\nset output\n";
  return out.str();
}

void draw(const Report& report, const std::string& path) {
  if (std::FILE* const file = std::fopen(path.c_str(), "wb")) {
    std::fclose(file);
  } else {
    throw std::system_error(errno, std::generic_category(), path);
  }
  const int status = run_gnuplot(picture_script(report, path));
  if (status == 0) return;
  throw std::runtime_error("gnuplot failed on " + path +
                           (status == 127 ? ": it cannot be run; install the Debian package "
                                            "gnuplot-nox"
                                          : ""));
}

}  // namespace stoss::client::accuracy

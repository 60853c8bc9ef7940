// SPDX-License-Identifier: Apache-2.0
#include "cli/accuracy_text.hpp"

#include "cli/table.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace stoss::client::cli {
namespace {

using accuracy::Figures;
using accuracy::Point;
using accuracy::Report;

/// The parts of the run at which the table shows the error of position.
constexpr double kParts[] = {0.125, 0.25, 0.5, 1};

constexpr std::array kErrorColumns = {"T/8: m", "T/4: m", "T/2: m", "T: m"};
/// What follows those errors.
constexpr std::array kFaultColumns = {"wrong s", "right", "missed", "overlap", "energy"};

std::string text_of(double value, const char* format = "%.2g") {
  if (std::isnan(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string error_at(const Report& report, const Figures& figures, double part) {
  for (const Point& point : figures.points) {
    if (point.time_s >= part * report.until_s * (1 - 1e-9)) {
      return text_of(point.position_error_rms_m);
    }
  }
  return "-";
}

std::vector<std::string> method_cells(const Report& report, const Figures& figures) {
  const bool exact = figures.method.arithmetic.has_value();
  std::string name = figures.method.name;
  if (figures.method.substeps > 1) name += "/" + std::to_string(figures.method.substeps);
  std::vector<std::string> cells = {name,
                                    exact ? "-" : text_of(figures.method.step, "%.3g"),
                                    text_of(figures.cpu_s_per_s),
                                    text_of(figures.cpu_ratio, "%.3g"),
                                    text_of(figures.reached_s, "%.3g")};
  for (const double part : kParts) cells.push_back(error_at(report, figures, part));
  if (figures.points.empty()) {  // it came nowhere, so there is nothing to tell
    cells.insert(cells.end(), kFaultColumns.size(), "-");
    return cells;
  }
  cells.push_back(figures.first_wrong_s ? text_of(*figures.first_wrong_s, "%.4g") : "none");
  cells.push_back(text_of(figures.right_collisions_per_disk, "%.3g"));
  cells.push_back(figures.faults.missed ? std::to_string(*figures.faults.missed) : "-");
  cells.push_back(text_of(figures.faults.deepest));
  cells.push_back(text_of(figures.points.back().energy_error));
  return cells;
}

std::string method_table(const Report& report) {
  std::vector<std::string> heads = {"method", "step s", "CPU s/s", "ratio", "to s"};
  heads.insert(heads.end(), kErrorColumns.begin(), kErrorColumns.end());
  heads.insert(heads.end(), kFaultColumns.begin(), kFaultColumns.end());
  Table table(heads);
  for (const Figures& figures : report.methods) table.add(method_cells(report, figures));
  return table.text();
}

std::string horizon_table(const Report& report) {
  Table table({"arithmetic", "digits", "horizon s", "collisions", "a disk"});
  for (const Figures& figures : report.methods) {
    if (!figures.horizon) continue;
    const accuracy::HorizonFigures& horizon = *figures.horizon;
    const std::string sign = horizon.at_least ? ">= " : "";
    const bool endless = std::isinf(horizon.time_s);
    table.add({figures.method.name,
               text_of(accuracy::digits_of(*figures.method.arithmetic), "%.1f"),
               endless ? "no end" : sign + text_of(horizon.time_s, "%.4g"),
               sign + std::to_string(horizon.collisions),
               sign + text_of(horizon.collisions_per_disk, "%.1f")});
  }
  return table.text();
}

std::string notes(const Report& report) {
  std::string out;
  for (const std::string& note : report.notes) out += "note: " + note + "\n";
  bool cut_short = false;
  for (const Figures& figures : report.methods) {
    if (!figures.failure.empty()) {
      out += "note: " + figures.method.name;
      if (!figures.method.arithmetic) out += ", " + text_of(figures.method.step, "%.3g") + " s,";
      out += " could not go on: " + figures.failure + "\n";
    } else if (figures.reached_s < report.until_s * (1 - 1e-9)) {
      cut_short = true;
    }
  }
  if (cut_short) {
    out +=
        "note: where \"to s\" is less than the end, the run had used up its part of --budget; its "
        "row tells of\nwhat it reached\n";
  }
  return out;
}

}  // namespace

std::string accuracy_text(const Report& report) {
  std::string out = report.scene + ": " + std::to_string(report.disks) +
                    " dynamic disks, T = " + text_of(report.until_s, "%.4g") +
                    " s, compared with the exact engine in " + report.reference + "\n\n";
  out += method_table(report);
  out +=
      "\nstep: of the baseline. CPU: time for a simulated second; ratio: to double. to: how far "
      "the "
      "run came.\nm: rms error of position after T/8 to T. wrong: the first collision of the "
      "reference that does not\nhappen; right: collisions a disk before it. missed: contacts "
      "passed "
      "over. overlap: the deepest, as a\npart of the contact distance. energy: relative error at "
      "the "
      "end.\n\n";
  out += horizon_table(report);
  out +=
      "\nhorizon: up to there a run that starts one unit in the last place away has the same "
      "collisions.\n";
  const std::string remarks = notes(report);
  return remarks.empty() ? out : out + "\n" + remarks;
}

}  // namespace stoss::client::cli

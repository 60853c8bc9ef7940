// SPDX-License-Identifier: Apache-2.0
#include "accuracy/rows.hpp"

#include <stoss/client/decimal.hpp>

#include <cmath>
#include <functional>

namespace stoss::client::accuracy {
namespace {

/// A value as text, empty when it is not known; words are told from numbers for JSON.
struct Cell {
  std::string text;
  bool is_word = false;
};

Cell number(double value) {
  if (std::isnan(value)) return {};
  return {format_number(value), std::isinf(value)};
}
Cell count(std::uint64_t value) { return {std::to_string(value)}; }
Cell word(const std::string& value) { return {value, true}; }

struct Source {
  const Report& report;
  const Figures& figures;
  const Point& point;
};

struct Column {
  std::string name;
  std::function<Cell(const Source&)> cell;
};

template <class F>
Cell of_horizon(const Source& source, F&& cell) {
  return source.figures.horizon ? cell(*source.figures.horizon) : Cell{};
}

std::vector<Column> method_columns() {
  return {
      {"scene", [](const Source& s) { return word(s.report.scene); }},
      {"method", [](const Source& s) { return word(s.figures.method.name); }},
      {"step_s",
       [](const Source& s) {
         return s.figures.method.arithmetic ? Cell{} : number(s.figures.method.step);
       }},
      {"substeps",
       [](const Source& s) {
         return s.figures.method.arithmetic ? Cell{} : count(s.figures.method.substeps);
       }},
      {"digits",
       [](const Source& s) {
         const auto& arithmetic = s.figures.method.arithmetic;
         return arithmetic ? number(digits_of(*arithmetic)) : Cell{};
       }},
      {"disks", [](const Source& s) { return count(s.report.disks); }},
      {"reference", [](const Source& s) { return word(s.report.reference); }},
  };
}

std::vector<Column> point_columns() {
  return {
      {"time_s", [](const Source& s) { return number(s.point.time_s); }},
      {"collisions", [](const Source& s) { return count(s.point.collisions); }},
      {"position_error_rms_m",
       [](const Source& s) { return number(s.point.position_error_rms_m); }},
      {"position_error_max_m",
       [](const Source& s) { return number(s.point.position_error_max_m); }},
      {"energy_error", [](const Source& s) { return number(s.point.energy_error); }},
  };
}

std::vector<Column> whole_run_columns() {
  return {
      {"reached_s", [](const Source& s) { return number(s.figures.reached_s); }},
      {"cpu_s_per_s", [](const Source& s) { return number(s.figures.cpu_s_per_s); }},
      {"cpu_s_per_collision",
       [](const Source& s) { return number(s.figures.cpu_s_per_collision); }},
      {"cpu_ratio", [](const Source& s) { return number(s.figures.cpu_ratio); }},
      {"first_wrong_s",
       [](const Source& s) { return number(s.figures.first_wrong_s.value_or(kUnknown)); }},
      {"right_collisions", [](const Source& s) { return count(s.figures.right_collisions); }},
      {"right_collisions_per_disk",
       [](const Source& s) { return number(s.figures.right_collisions_per_disk); }},
      {"missed",
       [](const Source& s) {
         const auto& missed = s.figures.faults.missed;
         return missed ? count(*missed) : Cell{};
       }},
      {"deepest_overlap", [](const Source& s) { return number(s.figures.faults.deepest); }},
      {"horizon_s",
       [](const Source& s) {
         return of_horizon(s, [](const HorizonFigures& h) { return number(h.time_s); });
       }},
      {"horizon_collisions",
       [](const Source& s) {
         return of_horizon(s, [](const HorizonFigures& h) { return count(h.collisions); });
       }},
      {"horizon_collisions_per_disk",
       [](const Source& s) {
         return of_horizon(s,
                           [](const HorizonFigures& h) { return number(h.collisions_per_disk); });
       }},
      {"horizon_at_least",
       [](const Source& s) {
         return of_horizon(s, [](const HorizonFigures& h) { return count(h.at_least ? 1 : 0); });
       }},
  };
}

const std::vector<Column>& columns() {
  static const std::vector<Column> all = [] {
    std::vector<Column> list = method_columns();
    for (const auto& more : {point_columns(), whole_run_columns()}) {
      list.insert(list.end(), more.begin(), more.end());
    }
    return list;
  }();
  return all;
}

std::string quoted(const std::string& text, char escape) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || (escape == '\\' && c == '\\')) out += escape;
    out += c;
  }
  return out + '"';
}

std::string csv_cell(const Cell& cell) {
  const bool plain = cell.text.find_first_of(",\"\n\r") == std::string::npos;
  return plain ? cell.text : quoted(cell.text, '"');
}

/// Calls `visit` for every row. A method that came nowhere has none.
void for_each_row(const Report& report, const std::function<void(const Source&)>& visit) {
  for (const Figures& figures : report.methods) {
    for (const Point& point : figures.points) visit({report, figures, point});
  }
}

}  // namespace

const std::vector<std::string>& column_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Column& column : columns()) list.push_back(column.name);
    return list;
  }();
  return names;
}

std::string csv_text(const Report& report) {
  std::string out;
  for (const std::string& name : column_names()) out += (out.empty() ? "" : ",") + name;
  out += '\n';
  for_each_row(report, [&out](const Source& source) {
    bool first = true;
    for (const Column& column : columns()) {
      if (!first) out += ',';
      first = false;
      out += csv_cell(column.cell(source));
    }
    out += '\n';
  });
  return out;
}

std::string json_lines(const Report& report) {
  std::string out;
  for_each_row(report, [&out](const Source& source) {
    std::string line;
    for (const Column& column : columns()) {
      const Cell cell = column.cell(source);
      if (cell.text.empty()) continue;
      line += (line.empty() ? "{\"" : ",\"") + column.name + "\":";
      line += cell.is_word ? quoted(cell.text, '\\') : cell.text;
    }
    out += line + "}\n";
  });
  return out;
}

}  // namespace stoss::client::accuracy

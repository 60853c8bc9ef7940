// SPDX-License-Identifier: Apache-2.0
#pragma once

// The table of pinned digests: for each scene, for how long it is run, and what comes out.

#include "determinism/run_scene.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stoss::determinism {

struct Row {
  std::string scene;                       ///< file name without extension
  double until = 0;                        ///< s
  std::map<std::string, Digests> digests;  ///< by arithmetic: "double", "float"
};

/// The arithmetics that are pinned.
inline const std::map<std::string, engine::Arithmetic> kPinned = {
    {"double", engine::Arithmetic::Double}, {"float", engine::Arithmetic::Float}};

inline std::string hexadecimal(std::uint64_t word) {
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = "0123456789abcdef"[(word >> (4 * i)) & 15U];
  return text;
}

/// For GoogleTest's messages.
inline void PrintTo(const Digests& d, std::ostream* out) {
  *out << d.collisions << " collisions, log " << hexadecimal(d.log) << ", motions "
       << hexadecimal(d.motions) << ", state " << hexadecimal(d.state);
}

inline std::vector<Row> read_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  const nlohmann::json table = nlohmann::json::parse(file);
  std::vector<Row> rows;
  for (const auto& line : table) {
    Row row;
    row.scene = line.at("scene").get<std::string>();
    row.until = line.at("until").get<double>();
    for (const auto& [arithmetic, unused] : kPinned) {
      if (!line.contains(arithmetic)) continue;
      const auto& pinned = line.at(arithmetic);
      const auto word = [&](const char* key) {
        return std::stoull(pinned.at(key).get<std::string>(), nullptr, 16);
      };
      row.digests[arithmetic] = {pinned.at("collisions").get<std::uint64_t>(),
                                 word("log"),
                                 word("motions"),
                                 word("state")};
    }
    rows.push_back(row);
  }
  return rows;
}

/// One line of the table, as it stands in the file.
inline std::string to_line(const Row& row) {
  nlohmann::ordered_json line = {{"scene", row.scene}, {"until", row.until}};
  for (const auto& [arithmetic, d] : row.digests) {
    line[arithmetic] = {{"collisions", d.collisions},
                        {"log", hexadecimal(d.log)},
                        {"motions", hexadecimal(d.motions)},
                        {"state", hexadecimal(d.state)}};
  }
  return line.dump();
}

}  // namespace stoss::determinism

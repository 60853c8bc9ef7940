// SPDX-License-Identifier: Apache-2.0
#pragma once

// Columns that line up, for people; and the texts that verbs print of bodies and replies.

#include <stoss/client/command.hpp>
#include <stoss/client/query.hpp>
#include <stoss/client/status.hpp>
#include <stoss/engine/types.hpp>

#include <string>
#include <vector>

namespace stoss::client::cli {

/// Rows of cells; numbers to the right, the first column as wide as its widest cell, and so on.
class Table {
 public:
  explicit Table(std::vector<std::string> heads);
  void add(std::vector<std::string> cells);
  [[nodiscard]] bool empty() const { return rows_.size() == 1; }
  /// Every row with a line end.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A table of bodies, with angle and spin only when some body has them, and the distance when
/// asked.
[[nodiscard]] std::string body_table(const std::vector<FoundBody>& bodies, bool with_distance);
[[nodiscard]] std::string wall_table(const std::vector<engine::WallState>& walls);

/// "ids 5 6, at 12.5 s, tick 750" as a line, or the reply as a JSON object on a line.
[[nodiscard]] std::string reply_text(const Reply& reply, bool json);

/// The word of --scalar for what the world computes in.
[[nodiscard]] std::string arithmetic_name(const Status& status);
/// One JSON object on one line, in the field names of the Status type.
[[nodiscard]] std::string status_json(const Status& status);
/// One item a line.
[[nodiscard]] std::string status_text(const Status& status);

[[nodiscard]] const char* word(engine::BodyKind kind);
[[nodiscard]] const char* word(engine::ContactKind kind);

}  // namespace stoss::client::cli

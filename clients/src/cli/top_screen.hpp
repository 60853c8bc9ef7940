// SPDX-License-Identifier: Apache-2.0
#pragma once

// What `stoss top` shows, as text. Knows no terminal.

#include <stoss/client/feeds.hpp>
#include <stoss/client/status.hpp>

#include <optional>
#include <string>

namespace stoss::client::cli {

struct TopView {
  Status status;
  std::optional<Frame> frame;
  double collisions_per_second = 0;  ///< of real time
  double frames_per_second = 0;      ///< of real time
};

/// At most `rows` lines of at most `columns` characters: the world's health, then its fastest
/// disks.
[[nodiscard]] std::string top_screen(const TopView& view, int columns, int rows);

/// The same in one line, for logs and pipes.
[[nodiscard]] std::string top_line(const TopView& view);

}  // namespace stoss::client::cli

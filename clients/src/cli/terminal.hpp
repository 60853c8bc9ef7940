// SPDX-License-Identifier: Apache-2.0
#pragma once

// A terminal as a canvas: keys without Enter, a screen of its own, everything put back at the end.

#include <termios.h>

#include <optional>
#include <string>
#include <string_view>

namespace stoss::client::cli {

struct TerminalSize {
  int columns = 80;
  int rows = 24;
};

/// Whether standard input and output are both a terminal.
[[nodiscard]] bool is_terminal();

class Terminal {
 public:
  /// Takes the terminal over. REQUIRES: is_terminal()
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  [[nodiscard]] TerminalSize size() const;
  /// Replaces what is on the screen without flicker. Lines are divided by '\n'.
  void show(std::string_view text);
  /// A key that was pressed, if one was; does not wait.
  [[nodiscard]] std::optional<char> key();

 private:
  termios before_{};
};

}  // namespace stoss::client::cli

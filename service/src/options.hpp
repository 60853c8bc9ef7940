// SPDX-License-Identifier: Apache-2.0
// What stossd was asked to do.
#pragma once

#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace stoss::service {

struct Options {
  std::string scene;  ///< a file; empty: a world without bodies
  std::string world;  ///< empty: named after the scene
  std::uint32_t domain = 0;
  double tick_rate = 60;
  double speed = 1;  ///< infinity: as fast as possible
  bool paused = false;
  double frame_rate = 20;
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours;
  std::uint64_t verify = 0;  ///< events between two checks of the whole world; 0: none
  std::size_t bodies_max = 1'000'000;
  std::string interface = "lo";
  bool allow_network = false;
  std::string log_level = "info";
  bool check_config = false;
};

/// An exit status, after help or an error was printed.
struct Exit {
  int status = 0;
};

/// Reads the command line and the file that --config names. Prints help and errors itself.
[[nodiscard]] std::variant<Options, Exit> parse_options(int argc, const char* const* argv);

}  // namespace stoss::service

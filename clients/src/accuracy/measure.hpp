// SPDX-License-Identifier: Apache-2.0
#pragma once

// What accuracy costs in a scene: every method beside the others, against the widest arithmetic.
//
// Each method runs twice: once for its time, with nothing else done, and once to be looked at. The
// positions of the reference are those of the true motion up to the reference's own horizon, and
// nothing is said of positions after it.

#include "accuracy/method.hpp"

#include <stoss/engine/instant.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stoss::client::accuracy {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Options {
  std::optional<engine::Instant> until;  ///< as a duration; default: the horizon of double
  double budget_s = 60;                  ///< CPU time that all of it may take, about
  std::uint32_t samples = 32;            ///< instants to compare at, evenly spaced up to the end
  std::vector<double> steps;             ///< s, of the baselines; default: default_steps()
  std::uint32_t substeps = 8;
  std::vector<Method> others;  ///< to be set beside the engine's own
};

/// A method at an instant. Not a number: not known, or not to be known.
struct Point {
  double time_s = 0;                       ///< since the scene's start
  std::uint64_t collisions = 0;            ///< so far
  double position_error_rms_m = kUnknown;  ///< over the dynamic disks
  double position_error_max_m = kUnknown;
  double energy_error = kUnknown;  ///< relative
};

/// How far an arithmetic's answer can be trusted, from a run one unit in the last place away.
struct HorizonFigures {
  double time_s = 0;             ///< infinite: the collisions came to an end before the trust did
  std::uint64_t collisions = 0;  ///< up to then
  double collisions_per_disk = 0;
  bool at_least = false;  ///< no end was found within the budget
};

struct Figures {
  Method method;
  std::string failure;        ///< why it could not go on; empty: it could
  std::vector<Point> points;  ///< as far as it came
  double reached_s = 0;
  std::uint64_t collisions = 0;
  double cpu_s_per_s = kUnknown;  ///< CPU time for a simulated second
  double cpu_s_per_collision = kUnknown;
  double cpu_ratio = kUnknown;           ///< to double
  std::optional<double> first_wrong_s;   ///< nothing: none seen
  std::uint64_t right_collisions = 0;    ///< before the first wrong one
  double right_collisions_per_disk = 0;  ///< of two disks, both counted
  Faults faults;
  std::optional<HorizonFigures> horizon;
};

struct Report {
  std::string scene;
  std::string reference;  ///< name of the method
  std::size_t disks = 0;  ///< dynamic ones
  double until_s = 0;
  bool conserves_energy = true;  ///< nothing moves but dynamic disks
  std::vector<Figures> methods;
  std::vector<std::string> notes;  ///< what was cut short, and why
};

/// Runs everything. REQUIRES: bodies as the exact engine accepts them, with ids; a dynamic disk.
/// Throws std::runtime_error when the reference gets nowhere.
[[nodiscard]] Report measure(const std::string& scene,
                             const translate::SceneBodies& bodies,
                             const Options& options);

}  // namespace stoss::client::accuracy

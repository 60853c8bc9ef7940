// SPDX-License-Identifier: Apache-2.0
#pragma once

// The ways to advance a scene that are set beside each other.

#include "accuracy/run.hpp"

#include <stoss/translate/scene.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stoss::client::accuracy {

struct Method {
  std::string name;                              ///< as "long-double", "back-up"
  std::optional<engine::Arithmetic> arithmetic;  ///< of the exact engine
  double step = 0;                               ///< s; 0 for the exact engine
  std::uint32_t substeps = 1;
  std::uint64_t work = kStepsAtOnce;  ///< between two looks at the clock
  /// A run from the scene's start; `audited`: its faults are wanted, whatever time that takes.
  std::function<std::unique_ptr<Run>(bool audited)> start;
};

/// The exact engine in every arithmetic of this build, from the narrowest to the widest. `bodies`
/// must outlive the methods.
[[nodiscard]] std::vector<Method> exact_methods(const translate::SceneBodies& bodies);

/// The baselines detect, substeps and back-up, each with every step (s).
[[nodiscard]] std::vector<Method> stepped_methods(const translate::SceneBodies& bodies,
                                                  const std::vector<double>& steps,
                                                  std::uint32_t substeps);

/// Steps that suit a scene, from coarse to fine, each an eighth of the one before: in the first, a
/// body of the median speed at the start (of those that move) goes about the radius of the smallest
/// dynamic disk, and at least sixteen of it fit into the run. Powers of two, s. REQUIRES: a dynamic
/// disk.
[[nodiscard]] std::vector<double> default_steps(const translate::SceneBodies& bodies,
                                                double until_s);

/// Decimal digits of an arithmetic's significand.
[[nodiscard]] double digits_of(engine::Arithmetic arithmetic);

}  // namespace stoss::client::accuracy

// SPDX-License-Identifier: Apache-2.0
#include "accuracy/method.hpp"

#include "accuracy/exact_run.hpp"
#include "accuracy/stepped_run.hpp"

#include <stoss/translate/basics.hpp>
#include <stoss/wide/world.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

namespace stoss::client::accuracy {
namespace {

constexpr int kStepCount = 4;
constexpr double kStepRatio = 8;
constexpr double kStepsMin = 16;

Method stepped(const translate::SceneBodies& bodies,
               const std::string& name,
               const baseline::StepRule& rule) {
  return {.name = name,
          .arithmetic = {},
          .step = rule.step,
          .substeps = rule.substeps,
          .work = kStepsAtOnce,
          .start = [&bodies, rule](bool audited) {
            return std::make_unique<SteppedRun>(bodies, rule, audited);
          }};
}

}  // namespace

std::vector<Method> exact_methods(const translate::SceneBodies& bodies) {
  using engine::Arithmetic;
  std::vector<Method> methods;
  for (const Arithmetic arithmetic : {Arithmetic::Float,
                                      Arithmetic::Double,
                                      Arithmetic::LongDouble,
                                      Arithmetic::DoubleDouble,
                                      Arithmetic::Float128}) {
    if (!wide::is_available(arithmetic)) continue;
    methods.push_back({.name = std::string(translate::name_of(arithmetic)),
                       .arithmetic = arithmetic,
                       .step = 0,
                       .substeps = 1,
                       .work = kEventsAtOnce,
                       .start = [&bodies, arithmetic](bool) {
                         return std::make_unique<ExactRun>(bodies, arithmetic);
                       }});
  }
  return methods;
}

std::vector<Method> stepped_methods(const translate::SceneBodies& bodies,
                                    const std::vector<double>& steps,
                                    std::uint32_t substeps) {
  std::vector<Method> methods;
  for (const double step : steps) {
    methods.push_back(stepped(bodies, "detect", {.step = step}));
  }
  for (const double step : steps) {
    methods.push_back(stepped(bodies, "substeps", {.step = step, .substeps = substeps}));
  }
  for (const double step : steps) {
    methods.push_back(stepped(bodies, "back-up", {.step = step, .back_up = true}));
  }
  return methods;
}

std::vector<double> default_steps(const translate::SceneBodies& bodies, double until_s) {
  double radius = std::numeric_limits<double>::infinity();
  std::vector<double> speeds;
  for (const engine::DiskSpec& disk : bodies.disks) {
    if (disk.kind == engine::BodyKind::Dynamic) radius = std::min(radius, disk.radius);
    if (disk.velocity.norm() > 0) speeds.push_back(disk.velocity.norm());
  }
  for (const engine::WallSpec& wall : bodies.walls) {
    if (wall.velocity.norm() > 0) speeds.push_back(wall.velocity.norm());
  }
  std::sort(speeds.begin(), speeds.end());
  const double speed = speeds.empty() ? 1 : speeds[(speeds.size() - 1) / 2];
  // Speeds of 1e150 m/s are allowed; a step has to be a number that a clock can be advanced by.
  double step = std::clamp(std::min(radius / speed, until_s / kStepsMin), 0x1p-40, 0x1p40);
  step = std::exp2(std::floor(std::log2(step)));
  std::vector<double> steps;
  for (int i = 0; i < kStepCount; ++i, step /= kStepRatio) steps.push_back(step);
  return steps;
}

double digits_of(engine::Arithmetic arithmetic) {
  constexpr int kDoubleDoubleBits = 2 * DBL_MANT_DIG;
  constexpr int kFloat128Bits = 113;
  const double decimal = std::log10(2.0);
  switch (arithmetic) {
    case engine::Arithmetic::Float:
      return FLT_MANT_DIG * decimal;
    case engine::Arithmetic::Double:
      return DBL_MANT_DIG * decimal;
    case engine::Arithmetic::LongDouble:
      return LDBL_MANT_DIG * decimal;
    case engine::Arithmetic::DoubleDouble:
      return kDoubleDoubleBits * decimal;
    case engine::Arithmetic::Float128:
      return kFloat128Bits * decimal;
  }
  return 0;
}

}  // namespace stoss::client::accuracy

// SPDX-License-Identifier: Apache-2.0
// accuracy: what accuracy costs in a scene of the user's own.

#include "accuracy/measure.hpp"
#include "accuracy/picture.hpp"
#include "accuracy/rows.hpp"
#include "cli/accuracy_text.hpp"
#include "cli/common.hpp"
#include "cli/log_file.hpp"
#include "cli/scene_bodies.hpp"

#include <stoss/translate/scene.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stoss::client::cli {
namespace {

constexpr std::uint32_t kSubstepsMax = 1000;
constexpr double kBudgetMaxS = 1e6;

struct AccuracyTexts {
  std::string scene;
  std::string until;
  std::string csv;
  std::string plot;
  std::string steps;
  std::string substeps = "8";
  std::string budget = "60";
};

double positive(const std::string& option, const std::string& text) {
  const double value = number_of(option, text);
  if (!(value > 0) || std::isinf(value)) throw UsageError(option + ": must be above 0 and finite");
  return value;
}

std::vector<double> steps_of(const std::string& text) {
  std::vector<double> steps;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    steps.push_back(positive("--steps", part));
  }
  std::sort(steps.begin(), steps.end(), std::greater<>());
  return steps;
}

accuracy::Options options_of(const AccuracyTexts& texts) {
  accuracy::Options options;
  if (!texts.until.empty()) {
    options.until = instant_of("--until", texts.until);
    if (*options.until <= engine::Instant{}) throw UsageError("--until: must be above 0");
  }
  options.steps = steps_of(texts.steps);
  options.budget_s = positive("--budget", texts.budget);
  if (options.budget_s > kBudgetMaxS) throw UsageError("--budget: at most 1e6 seconds");
  const std::uint64_t substeps = count_of("--substeps", texts.substeps);
  if (substeps < 2 || substeps > kSubstepsMax) throw UsageError("--substeps: must be 2 to 1000");
  options.substeps = static_cast<std::uint32_t>(substeps);
  if (!texts.plot.empty() && !accuracy::is_picture_path(texts.plot)) {
    throw UsageError("--plot: \"" + texts.plot + "\" must end in .svg or .png");
  }
  return options;
}

/// The scene's bodies as the exact engine takes them, with the ids that it gives.
translate::SceneBodies checked_bodies(const std::string& path) {
  translate::SceneBodies bodies = scene_bodies(path);
  refuse_effects(bodies, "this study");
  translate::adopt_ids(bodies, value_or_refuse(translate::make_world(bodies, {})).ids);
  const bool moves = std::any_of(bodies.disks.begin(), bodies.disks.end(), [](const auto& disk) {
    return disk.kind == engine::BodyKind::Dynamic;
  });
  if (!moves) {
    throw RefusedError({.code = engine::Code::FailedPrecondition,
                        .field = {},
                        .reason = path + ": no dynamic disk, so there is nothing to compare"});
  }
  return bodies;
}

std::string file_name(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

accuracy::Report measured(const AccuracyTexts& texts, const accuracy::Options& options) {
  const translate::SceneBodies bodies = checked_bodies(texts.scene);
  try {
    return accuracy::measure(file_name(texts.scene), bodies, options);
  } catch (const std::runtime_error& error) {
    throw RefusedError({.code = engine::Code::FailedPrecondition,
                        .field = {},
                        .reason = texts.scene + ": " + error.what()});
  }
}

void tell_accuracy(const AccuracyTexts& texts, bool json) {
  const accuracy::Options options = options_of(texts);
  // Whatever cannot be written is told before a minute of work, not after it.
  if (!texts.plot.empty() && !accuracy::has_gnuplot()) {
    throw RefusedError({.code = engine::Code::Unavailable,
                        .field = {},
                        .reason = "--plot needs gnuplot; install the Debian package gnuplot-nox"});
  }
  std::optional<LogFile> csv;
  if (!texts.csv.empty()) csv.emplace(texts.csv);
  const accuracy::Report report = measured(texts, options);
  if (csv) {
    csv->buffer() = accuracy::csv_text(report);
    csv->flush();
  }
  if (json) {
    print(accuracy::json_lines(report));
  } else if (texts.csv != "-") {
    print(accuracy_text(report));
  }
  if (!texts.plot.empty()) accuracy::draw(report, texts.plot);
}

}  // namespace

void add_accuracy_verb(CLI::App& app, Invocation& invocation) {
  auto texts = std::make_shared<AccuracyTexts>();
  CLI::App* verb = add_verb(
      app,
      "accuracy",
      "What accuracy costs in a scene: every arithmetic and stepped baselines side by side",
      "stoss accuracy clients/scenes/pool-break.json --until 3 --csv costs.csv --plot costs.svg");
  verb->add_option("SCENE", texts->scene, "A .json, .textproto or .binpb file")->required();
  verb->add_option("--until",
                   texts->until,
                   "Simulated seconds from the scene's start (default: as far as double can be "
                   "trusted)");
  verb->add_option(
      "--csv", texts->csv, "Write every figure at every instant to this file; -: standard output");
  verb->add_option("--plot", texts->plot, "Draw four pictures to this .svg or .png file");
  verb->add_option("--steps",
                   texts->steps,
                   "Time steps of the baselines [s], as DT,DT,... (default: four that suit the "
                   "scene's radii and speeds)");
  verb->add_option("--substeps", texts->substeps, "Parts of a step, for the baseline substeps")
      ->capture_default_str();
  verb->add_option("--budget",
                   texts->budget,
                   "CPU seconds that all runs may take, about; what does not fit is cut short and "
                   "told")
      ->capture_default_str();
  verb->callback([&invocation, texts] {
    invocation.action = [&global = invocation.global, texts] {
      tell_accuracy(*texts, global.json);
    };
  });
}

}  // namespace stoss::client::cli

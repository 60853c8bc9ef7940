// SPDX-License-Identifier: Apache-2.0
// What accuracy costs in one scene, with Box2D and Chipmunk beside it: `stoss accuracy` for the
// study, which calls it for every scene.
//
//   study_scene SCENE CSV UNTIL BUDGET SAMPLES STEP,STEP,...
//
// UNTIL 0: up to the horizon of double. STEP 0: steps that suit the scene.

#include "accuracy/engines.hpp"
#include "accuracy/measure.hpp"
#include "accuracy/rows.hpp"
#include "cli/accuracy_text.hpp"
#include "cli/exit_code.hpp"
#include "cli/scene_bodies.hpp"

#include <stoss/translate/scene.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

using namespace stoss::client;

translate::SceneBodies bodies_of(const std::string& path) {
  translate::SceneBodies bodies = cli::scene_bodies(path);
  translate::adopt_ids(bodies, cli::value_or_refuse(translate::make_world(bodies, {})).ids);
  return bodies;
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> list;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) list.push_back(std::stod(part));
  return list;
}

int run(const std::vector<std::string>& arguments) {
  const std::filesystem::path scene = arguments[0];
  const translate::SceneBodies bodies = bodies_of(scene);
  accuracy::Options options;
  const double until = std::stod(arguments[2]);
  if (until > 0) options.until = engine::offset_by({}, until);
  options.budget_s = std::stod(arguments[3]);
  options.samples = static_cast<std::uint32_t>(std::stoul(arguments[4]));
  options.steps = numbers(arguments[5]);
  if (options.steps.empty() || options.steps[0] == 0) {
    options.steps = accuracy::default_steps(bodies, until > 0 ? until : 1);
  }
  for (const auto& methods :
       {box2d_methods(bodies, options.steps), chipmunk_methods(bodies, options.steps)}) {
    options.others.insert(options.others.end(), methods.begin(), methods.end());
  }
  const accuracy::Report report = accuracy::measure(scene.stem().string(), bodies, options);
  std::ofstream csv(arguments[1]);
  csv << accuracy::csv_text(report);
  if (!csv.flush()) throw std::runtime_error("cannot write " + arguments[1]);
  std::fputs(cli::accuracy_text(report).c_str(), stdout);
  return 0;
}

}  // namespace
}  // namespace stoss::tests

int main(int argc, char** argv) {
  constexpr int kArguments = 7;
  if (argc != kArguments) {
    std::fputs("study_scene SCENE CSV UNTIL BUDGET SAMPLES STEP,STEP,...\n", stderr);
    return 2;
  }
  try {
    return stoss::tests::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "study_scene: %s\n", error.what());
    return 1;
  }
}

// SPDX-License-Identifier: Apache-2.0
// Reads the cases and runs each as a test of its own.

#include "hard_cases/case.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace stoss::hard_cases {

void PrintTo(const Case& c, std::ostream* out) { *out << c.name(); }

namespace {

std::vector<Case> all_cases() {
  std::ifstream file(STOSS_HARD_CASES);
  const json document = json::parse(file);
  std::vector<Case> cases;
  for (const json& data : document.at("cases")) cases.emplace_back(data);
  return cases;
}

/// "flat_chain_no_ghost", "speed_1e_minus_300": letters, digits and underscores.
std::string test_name(const testing::TestParamInfo<Case>& tested) {
  std::string name;
  for (const char letter : tested.param.name()) {
    if (letter == '-') {
      name += "_minus_";
    } else if (letter != '+') {
      name += std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
    }
  }
  return name;
}

const std::map<std::string, std::string (*)(const Case&)> kRunners = {
    {"pair", run_pair},
    {"epoch_pair", run_epoch_pair},
    {"segment", run_segment},
    {"two_segments_simultaneous", run_two_segments},
    {"polyline_slide", run_polyline_slide},
    {"galperin", run_galperin},
    {"cradle", run_cradle},
    {"box_long_run", run_box_long_run},
    {"simultaneous_nonunique", run_simultaneous_nonunique},
    {"tie_order", run_tie_order},
    {"repeated_rule", run_repeated_rule},
    {"scene_events", run_scene_events},
    {"invalid_input", run_invalid_input},
    {"gravity_segment", run_gravity_segment},
    {"gravity_corner", run_gravity_corner},
    {"bounce_series", run_bounce_series},
    {"resting", run_resting},
    {"friction_pair", run_friction_pair},
    {"growing_pair", run_growing_pair},
    {"drag_pair", run_drag_pair}};

const std::map<std::string, std::string> kNeeds = {{"inside_circle", "arcs"}};

class HardCase : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Through, HardCase, testing::ValuesIn(all_cases()), test_name);

TEST_P(HardCase, World) {
  const Case& c = GetParam();
  if (kNeeds.contains(c.kind())) GTEST_SKIP() << c.name() << " needs " << kNeeds.at(c.kind());
  ASSERT_TRUE(kRunners.contains(c.kind())) << "a kind of case that nothing runs: " << c.kind();
  const std::string left_out = kRunners.at(c.kind())(c);
  if (!left_out.empty()) GTEST_SKIP() << c.name() << ": " << left_out;
}

}  // namespace
}  // namespace stoss::hard_cases

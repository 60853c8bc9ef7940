// SPDX-License-Identifier: Apache-2.0
// What the accuracy tool measures, on scenes whose answer is known.

#include "accuracy/measure.hpp"
#include "accuracy/picture.hpp"
#include "accuracy/rows.hpp"
#include "accuracy/story.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::client::accuracy {
namespace {

using engine::DiskSpec;

translate::SceneBodies head_on() {
  translate::SceneBodies bodies;
  bodies.disks = {{.id = 1, .position = {0, 0}, .velocity = {1, 0}, .radius = 0.5},
                  {.id = 2, .position = {3, 0}, .velocity = {-1, 0}, .radius = 0.5}};
  return bodies;
}

/// A disk of 1000 m/s and a wall at 3 m.
translate::SceneBodies bullet() {
  translate::SceneBodies bodies;
  bodies.disks = {{.id = 1, .position = {0, 0}, .velocity = {1000, 0}, .radius = 0.5}};
  bodies.walls = {{.id = 2, .start = {3, -1}, .end = {3, 1}}};
  return bodies;
}

Report report_of(const translate::SceneBodies& bodies, double until, double step) {
  Options options;
  options.until = engine::offset_by({}, until);
  options.steps = {step};
  options.samples = 4;
  options.budget_s = 5;
  return measure("a scene", bodies, options);
}

const Figures& figures_of(const Report& report, const std::string& name) {
  const auto found = std::find_if(report.methods.begin(),
                                  report.methods.end(),
                                  [&](const Figures& one) { return one.method.name == name; });
  if (found == report.methods.end()) throw std::runtime_error("no method " + name);
  return *found;
}

// The contact is at 1 s; steps of 3/64 s find it 1/32 s late, so both disks are 1/16 m off.
TEST(Accuracy, TellsErrorsThatAreKnown) {
  const Report report = report_of(head_on(), 1.5, 3.0 / 64);
  const Figures& exact = figures_of(report, "double");
  const Figures& detect = figures_of(report, "detect");
  const Figures& back_up = figures_of(report, "back-up");
  ASSERT_EQ(detect.points.size(), 4U);
  EXPECT_EQ(detect.points[1].position_error_rms_m, 0) << "before the contact";
  EXPECT_EQ(detect.points[3].position_error_rms_m, 1.0 / 16);
  EXPECT_EQ(detect.points[3].position_error_max_m, 1.0 / 16);
  EXPECT_EQ(detect.points[3].energy_error, 0);
  EXPECT_EQ(detect.points[3].collisions, 1U);
  EXPECT_NEAR(detect.faults.deepest, 1.0 / 16, 1e-15);
  EXPECT_LT(back_up.points[3].position_error_rms_m, 1e-14);
  EXPECT_LT(exact.points[3].position_error_rms_m, 1e-15);
  for (const Figures& figures : report.methods) {
    EXPECT_FALSE(figures.first_wrong_s) << figures.method.name;
    EXPECT_EQ(figures.right_collisions_per_disk, 1) << figures.method.name;
    EXPECT_EQ(figures.faults.missed, 0U) << figures.method.name;
    EXPECT_EQ(figures.reached_s, 1.5) << figures.method.name;
    EXPECT_GT(figures.cpu_s_per_s, 0) << figures.method.name;
  }
  EXPECT_EQ(exact.cpu_ratio, 1);
}

TEST(Accuracy, ASteppedWorldMissesACollisionThatAnExactOneDoesNot) {
  const Report report = report_of(bullet(), 0.5, 0.01);
  for (const Figures& figures : report.methods) {
    const bool exact = figures.method.arithmetic.has_value();
    EXPECT_EQ(figures.faults.missed, exact ? 0U : 1U) << figures.method.name;
    EXPECT_EQ(figures.first_wrong_s.has_value(), !exact) << figures.method.name;
    EXPECT_NEAR(figures.first_wrong_s.value_or(0), exact ? 0 : 0.0025, 1e-12);
    EXPECT_EQ(figures.collisions, exact ? 1U : 0U) << figures.method.name;
  }
}

TEST(Accuracy, WhereNothingCollidesAnyMoreTheHorizonHasNoEnd) {
  Options options;
  options.budget_s = 2;
  const Report report = measure("a scene", head_on(), options);
  EXPECT_NEAR(report.until_s, 1.2, 1e-12) << "1.25 times the last collision, two digits";
  EXPECT_FALSE(report.notes.empty()) << "the choice is told";
  const Figures& exact = figures_of(report, "double");
  ASSERT_TRUE(exact.horizon);
  EXPECT_TRUE(std::isinf(exact.horizon->time_s));
  EXPECT_EQ(exact.horizon->collisions, 1U);
}

TEST(Accuracy, WideArithmeticsAreToldApart) {
  translate::SceneBodies askew = head_on();
  askew.disks[0].position.y() = 0.3;
  askew.disks[1].velocity.y() = 0.1;
  const Report oblique = report_of(askew, 1.5, 0.1);
  if (oblique.reference == "double-double") GTEST_SKIP() << "nothing wider in this build";
  const auto error = [&](const char* name) {
    return figures_of(oblique, name).points.back().position_error_rms_m;
  };
  EXPECT_GT(error("float"), error("double"));
  EXPECT_GT(error("double"), 1e3 * error("double-double"));
  EXPECT_GT(error("long-double"), 1e3 * error("double-double"));
}

TEST(Accuracy, WithMovingWallsEnergyIsComparedWithTheReference) {
  translate::SceneBodies bodies = head_on();
  bodies.walls = {{.id = 3, .start = {-5, -1}, .end = {-5, 1}, .velocity = {1, 0}}};
  const Report report = report_of(bodies, 6, 1.0 / 64);
  EXPECT_FALSE(report.conserves_energy);
  EXPECT_EQ(figures_of(report, "double").points.back().energy_error, 0);
  EXPECT_TRUE(std::isnan(figures_of(report, report.reference).points.back().energy_error));
}

TEST(Story, ComparesWhomEachBodyMeetsInItsOwnOrder) {
  const auto story_of = [](const std::vector<std::pair<int, int>>& pairs) {
    Story story;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      engine::Collision collision;
      collision.a = static_cast<engine::Id>(pairs[i].first);
      collision.b = static_cast<engine::Id>(pairs[i].second);
      collision.instant = {static_cast<std::int64_t>(i), 0};
      story.on_collision(collision);
    }
    return story;
  };
  const Story truth = story_of({{1, 2}, {3, 4}, {1, 3}});
  EXPECT_FALSE(compare(truth, story_of({{3, 4}, {1, 2}, {1, 3}}), {9, 0}).first_wrong);
  const Agreement swapped = compare(truth, story_of({{1, 2}, {1, 3}, {3, 4}}), {9, 0});
  EXPECT_EQ(swapped.first_wrong, (engine::Instant{1, 0}));
  EXPECT_EQ(swapped.collisions, 1U);
  const Story stopped = story_of({{1, 2}, {3, 4}});
  EXPECT_EQ(compare(truth, stopped, {9, 0}).first_wrong, (engine::Instant{2, 0}));
  EXPECT_FALSE(compare(truth, stopped, {1, 0}).first_wrong) << "its end may be why";
}

TEST(AccuracyRows, EveryLineHasEveryColumn) {
  Report report = report_of(head_on(), 1.5, 0.1);
  report.scene = "a, \"b\"";
  std::istringstream lines(csv_text(report));
  std::string line;
  std::getline(lines, line);
  const auto columns = std::count(line.begin(), line.end(), ',') + 1;
  EXPECT_EQ(static_cast<std::size_t>(columns), column_names().size());
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    EXPECT_EQ(line.rfind("\"a, \"\"b\"\"\",", 0), 0U) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << "one within the name";
  }
  EXPECT_EQ(rows, report.methods.size() * 4);
}

TEST(AccuracyPicture, EveryMethodHasAMarkerOfItsOwnAndNamesCannotBreakTheScript) {
  Report report = report_of(head_on(), 1.5, 0.1);
  report.scene = "it's\n set output 'x";
  const std::string script = picture_script(report, "a.svg");
  EXPECT_NE(script.find("'it''s set output ''x"), std::string::npos) << script;
  for (const char* panel : {"Work and precision", "Growth of the error", "Horizon", "Energy"}) {
    EXPECT_NE(script.find(panel), std::string::npos) << panel;
  }
  EXPECT_TRUE(is_picture_path("a.png"));
  EXPECT_FALSE(is_picture_path("a.pdf"));
  EXPECT_FALSE(is_picture_path(".svg"));
}

}  // namespace
}  // namespace stoss::client::accuracy

// SPDX-License-Identifier: Apache-2.0
// `stoss accuracy` as a person calls it.

#include "accuracy/picture.hpp"
#include "clients/run_program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

std::string scene(const std::string& name) {
  return std::string(STOSS_SCENE_DIR) + "/" + name + ".json";
}

Finished accuracy(const std::string& name, const std::string& options) {
  return stoss_words("accuracy " + scene(name) + " --budget 2 " + options);
}

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(AccuracyVerb, PrintsATableOfMethodsAndOneOfHorizons) {
  const Finished run = accuracy("pool-break", "--until 0.5");
  ASSERT_EQ(run.status, 0) << run.error;
  for (const char* part : {"16 dynamic disks, T = 0.5 s",
                           "double-double",
                           "substeps/8",
                           "back-up",
                           "missed",
                           "horizon s",
                           "energy"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " in\n" << run.out;
  }
}

TEST(AccuracyVerb, TheCsvFileHasTheColumnsThatAreDocumented) {
  const Finished run = accuracy("pi-1", "--csv - --steps 0.01,0.001 --substeps 4");
  ASSERT_EQ(run.status, 0) << run.error;
  const std::vector<std::string> lines = lines_of(run.out);
  ASSERT_GT(lines.size(), 100U);
  EXPECT_EQ(lines[0],
            "scene,method,step_s,substeps,digits,disks,reference,time_s,collisions,"
            "position_error_rms_m,position_error_max_m,energy_error,reached_s,cpu_s_per_s,"
            "cpu_s_per_collision,cpu_ratio,first_wrong_s,right_collisions,"
            "right_collisions_per_disk,missed,deepest_overlap,horizon_s,horizon_collisions,"
            "horizon_collisions_per_disk,horizon_at_least");
  EXPECT_EQ(lines[1].rfind("pi-1.json,float,", 0), 0U) << lines[1];
  EXPECT_NE(run.out.find("\npi-1.json,substeps,0.001,4,"), std::string::npos);
}

TEST(AccuracyVerb, JsonRowsAreObjects) {
  const Finished run = accuracy("pi-1", "--json --steps 0.01");
  ASSERT_EQ(run.status, 0) << run.error;
  for (const std::string& line : lines_of(run.out)) {
    const auto row = nlohmann::json::parse(line);
    EXPECT_EQ(row["scene"], "pi-1.json");
    EXPECT_GT(row["time_s"].get<double>(), 0);
    EXPECT_GT(row["cpu_s_per_s"].get<double>(), 0);
  }
}

TEST(AccuracyVerb, DrawsAPicture) {
  const std::string path = testing::TempDir() + "/accuracy_verb.svg";
  const Finished run = accuracy("pi-2", "--plot " + path);
  if (!client::accuracy::has_gnuplot()) {
    EXPECT_EQ(run.status, 1);
    GTEST_SKIP() << "gnuplot is not installed";
  }
  ASSERT_EQ(run.status, 0) << run.error;
  const std::string picture = content(path);
  EXPECT_NE(picture.find("<svg"), std::string::npos);
  EXPECT_NE(picture.find("Growth of the error"), std::string::npos);
  EXPECT_NE(picture.find("</svg>"), std::string::npos) << "all of it";
}

TEST(AccuracyVerb, WithoutGnuplotThePackageIsNamedBeforeAnyWork) {
  const Finished run = run_program({"/usr/bin/env",
                                    "PATH=/nowhere",
                                    std::string(STOSS_BIN_DIR) + "/stoss",
                                    "accuracy",
                                    scene("gas-10000"),
                                    "--plot",
                                    "x.svg"},
                                   std::chrono::seconds(5));
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.error.find("gnuplot-nox"), std::string::npos) << run.error;
}

TEST(AccuracyVerb, BadUsageIsToldAsSuch) {
  for (const char* options : {"--until x",
                              "--until 0",
                              "--until -1",
                              "--plot picture.pdf",
                              "--steps 0",
                              "--steps 0.1,x",
                              "--steps 0.1,-1",
                              "--substeps 1",
                              "--substeps 1.5",
                              "--budget 0",
                              "--budget nan",
                              "--budget 1e7",
                              "--bogus"}) {
    const Finished run = accuracy("tutorial", options);
    EXPECT_EQ(run.status, 2) << options << ": " << run.error;
    EXPECT_FALSE(run.error.empty());
  }
  EXPECT_EQ(stoss({"accuracy"}).status, 2);
}

TEST(AccuracyVerb, WhatCannotBeReadOrWrittenIsNamed) {
  EXPECT_EQ(accuracy("no-such-scene", "").status, 1);
  const Finished csv = accuracy("tutorial", "--until 1 --csv /no/such/dir/x.csv");
  EXPECT_EQ(csv.status, 1);
  EXPECT_NE(csv.error.find("/no/such/dir/x.csv"), std::string::npos) << csv.error;
  const std::string path = testing::TempDir() + "/nothing_moves.json";
  std::ofstream(path) << R"({"walls":[{"start":{"x":0},"end":{"x":1}}]})";
  const Finished nothing = stoss({"accuracy", path});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_NE(nothing.error.find("no dynamic disk"), std::string::npos) << nothing.error;
}

}  // namespace
}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// The command line where no world is: help, usage, exit status.

#include "cli/top_screen.hpp"
#include "clients/run_program.hpp"

#include <stoss/engine/features.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stoss::tests {
namespace {

const std::vector<std::string> kVerbs = {
    "worlds", "status", "spawn",    "load",     "remove",   "set-velocity", "impulse",
    "get",    "list",   "region",   "nearest",  "ray",      "pause",        "resume",
    "reset",  "step",   "run-for",  "run-to",   "speed",    "states",       "collisions",
    "zones",  "top",    "simulate", "accuracy", "features", "effects"};

TEST(CliUsage, HelpListsEveryVerb) {
  const Finished help = stoss({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const std::string& verb : kVerbs) {
    EXPECT_NE(help.out.find("\n  " + verb), std::string::npos) << verb;
  }
}

TEST(CliUsage, EveryVerbHasHelpWithAnExample) {
  for (const std::string& verb : kVerbs) {
    const Finished help = stoss({verb, "--help"});
    EXPECT_EQ(help.status, 0) << verb;
    EXPECT_NE(help.out.find("Example: stoss " + verb), std::string::npos) << help.out;
  }
  for (const char* what : {"disk", "wall", "zone"}) {
    const Finished help = stoss({"spawn", what, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("Example: stoss spawn " + std::string(what)), std::string::npos);
  }
}

TEST(CliUsage, FeaturesAreListedWithoutAWorld) {
  const Finished text = stoss({"features"});
  EXPECT_EQ(text.status, 0) << text.error;
  const Finished object = stoss({"features", "--json"});
  EXPECT_EQ(object.status, 0) << object.error;
  for (const engine::EffectInfo& effect : engine::known_effects()) {
    EXPECT_NE(text.out.find(' ' + std::string(effect.name) + ' '), std::string::npos);
    EXPECT_NE(object.out.find("\"name\":\"" + std::string(effect.name) + '"'), std::string::npos);
  }
  for (const engine::Refusal& refusal : engine::refused_combinations()) {
    EXPECT_NE(text.out.find(std::string(refusal.reason)), std::string::npos) << refusal.effect;
    EXPECT_NE(object.out.find(std::string(refusal.reason)), std::string::npos) << refusal.effect;
  }
  EXPECT_EQ(object.out.find('\n'), object.out.size() - 1) << "one object on one line";
}

TEST(CliUsage, BadUsageIsExitStatusTwo) {
  for (const char* command : {"",
                              "fly",
                              "zone",
                              "predict 3",
                              "forecast",
                              "snapshot",
                              "restore",
                              "record",
                              "replay",
                              "spawn",
                              "spawn zone",
                              "spawn disk",
                              "spawn disk --position 0 --radius 1",
                              "spawn disk --position 0,0",
                              "spawn disk --position 0,0 --radius x",
                              "spawn disk --position 0,0 --radius 1 --kind soft",
                              "spawn wall --start 0,0",
                              "effects set",
                              "effects set gravity",
                              "effects set =1",
                              "effects off",
                              "effects on gravity",
                              "set-velocity 3 1",
                              "set-velocity x 1 2",
                              "set-velocity 3 1 2 4",
                              "set-velocity -3 1 2",
                              "impulse 3",
                              "get",
                              "get abc",
                              "get 1.5",
                              "remove",
                              "region --min 0,0",
                              "nearest 1",
                              "nearest 1,2 --count -1",
                              "ray --from 0,0",
                              "step -1",
                              "step 1.5",
                              "run-for",
                              "run-for x",
                              "run-to",
                              "run-to never",
                              "speed",
                              "speed fast",
                              "pause now",
                              "status --domain 1000",
                              "status --domain x",
                              "status --timeout 0",
                              "status --timeout x",
                              "status --bogus",
                              "--world",
                              "pause --at x",
                              "load",
                              "top --count x",
                              "status --world ../etc --domain 99 --timeout 0.1"}) {
    const Finished run = stoss_words(command);
    EXPECT_EQ(run.status, 2) << command << ": " << run.error;
    EXPECT_FALSE(run.error.empty()) << command;
    EXPECT_TRUE(run.out.empty()) << command << ": " << run.out;
  }
}

TEST(CliUsage, NobodyThereIsExitStatusThree) {
  for (const char* command : {"worlds",
                              "status",
                              "get 1",
                              "--world gas set-velocity 3 -1.5 -.5",
                              "spawn disk --position -1,-.5 --radius 1 --world gas",
                              "impulse 3 -inf 0",
                              "top",
                              "states",
                              "collisions --json"}) {
    const Finished run = stoss_words(std::string(command) + " --domain 99 --timeout 0.2");
    EXPECT_EQ(run.status, 3) << command << ": " << run.error;
    EXPECT_FALSE(run.error.empty()) << command;
  }
}

TEST(CliUsage, VersionIsPrinted) {
  const Finished version = stoss({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("stoss ", 0), 0U);
}

client::cli::TopView view_of_disks(std::size_t count) {
  client::cli::TopView view;
  view.status.world = "gas";
  view.status.state = idl::WorldState::kRunning;
  view.status.collisions = 123456;
  client::Frame frame;
  for (std::size_t i = 1; i <= count; ++i) {
    frame.bodies.push_back({.id = i, .velocity = {static_cast<double>(i), 0}});
  }
  view.frame = frame;
  return view;
}

TEST(TopScreen, FitsTheTerminalAndShowsTheFastestFirst) {
  for (const auto& [columns, rows] : std::vector<std::pair<int, int>>{{80, 24}, {40, 10}, {5, 2}}) {
    const std::string screen = client::cli::top_screen(view_of_disks(100), columns, rows);
    const std::vector<std::string> lines = lines_of(screen);
    EXPECT_LE(lines.size(), static_cast<std::size_t>(rows));
    for (const std::string& line : lines) {
      EXPECT_LE(line.size(), static_cast<std::size_t>(columns)) << line;
    }
  }
  const std::string screen = client::cli::top_screen(view_of_disks(100), 80, 24);
  EXPECT_NE(screen.find("world gas"), std::string::npos);
  EXPECT_NE(screen.find("123456"), std::string::npos);
  const std::size_t fastest = screen.find("\n       100 ");
  ASSERT_NE(fastest, std::string::npos) << screen;
  EXPECT_LT(fastest, screen.find("\n        99 "));
  EXPECT_EQ(lines_of(screen).size(), 24U);
}

TEST(TopScreen, ShowsTheArithmeticAndWhatTheVerificationFound) {
  client::cli::TopView view = view_of_disks(1);
  view.status.arithmetic = 4;
  EXPECT_NE(client::cli::top_screen(view, 80, 24).find("in float128"), std::string::npos);
  EXPECT_NE(client::cli::top_screen(view, 80, 24).find("verify off"), std::string::npos);
  view.status.verify_period = 100'000;
  view.status.verify_checks = 12;
  view.status.verify_worst_overlap = 3e-17;
  const std::string screen = client::cli::top_screen(view, 80, 24);
  EXPECT_NE(screen.find("12 x  overlaps 0  missed 0  deepest 3e-17  dE 0  dp 0"), std::string::npos)
      << screen;
}

}  // namespace
}  // namespace stoss::tests

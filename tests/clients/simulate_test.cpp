// SPDX-License-Identifier: Apache-2.0
// `stoss simulate` on the scenes of clients/scenes: the same bytes for every tick rate and broad
// phase, and JSON that Protobuf's own parser takes.

#include "clients/run_program.hpp"

#include <stoss/translate/basics.hpp>
#include <stoss/translate/scene.hpp>

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <scene.pb.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

std::string scene(const std::string& name) {
  return std::string(STOSS_SCENE_DIR) + "/" + name + ".json";
}

Finished simulate(const std::string& name, const std::string& options) {
  return stoss_words("simulate " + scene(name) + " " + options);
}

struct Case {
  const char* scene;
  const char* until;
};

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.scene; }

class SimulateScene : public testing::TestWithParam<Case> {};

TEST_P(SimulateScene, GivesTheSameBytesForEveryTickRateAndBroadPhase) {
  const Case run = GetParam();
  const std::string common = std::string("--collisions - --states - --until ") + run.until;
  const Finished leap = simulate(run.scene, common);
  ASSERT_EQ(leap.status, 0) << leap.error;
  ASSERT_FALSE(leap.out.empty());
  for (const char* other : {"--tick-rate 1",
                            "--tick-rate 60",
                            "--tick-rate 1000",
                            "--broad-phase all-pairs",
                            "--tick-rate 33.3 --broad-phase all-pairs"}) {
    const Finished again = simulate(run.scene, common + " " + other);
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_TRUE(again.out == leap.out) << run.scene << " differs with " << other;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         SimulateScene,
                         testing::Values(Case{"tutorial", "3"},
                                         Case{"newtons-cradle", "10"},
                                         Case{"pool-break", "4"},
                                         Case{"billiards", "3"},
                                         Case{"bullets", "0.01"},
                                         Case{"pi-0", "100"},
                                         Case{"pi-1", "100"},
                                         Case{"pi-2", "100"},
                                         Case{"pi-3", "100"},
                                         Case{"gas-10000", "0.03"},
                                         Case{"polydisperse", "0.1"}),
                         [](const testing::TestParamInfo<Case>& one) {
                           std::string name = one.param.scene;
                           for (char& c : name) {
                             if (c == '-') c = '_';
                           }
                           return name;
                         });

// A zone for a pocket: a ball that is in one has entered it once more than it has left it.
TEST(Simulate, BilliardsTellWhichBallsAreInThePockets) {
  const Finished run = simulate("billiards", "--until 60 --zones -");
  ASSERT_EQ(run.status, 0) << run.error;
  std::uint64_t sequence = 0;
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> inside;
  for (const std::string& line : lines_of(run.out)) {
    ZoneEvent event;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(line, &event).ok()) << line;
    EXPECT_EQ(event.sequence(), ++sequence);
    int& count = inside[{event.zone(), event.body()}];
    count += event.entered() ? 1 : -1;
    EXPECT_TRUE(count == 0 || count == 1) << line;
  }
  EXPECT_GT(sequence, 4U);
  EXPECT_EQ(simulate("billiards", "--until 60 --zones - --tick-rate 60").out, run.out);
  EXPECT_EQ(simulate("billiards", "--until 60 --zones - --broad-phase all-pairs").out, run.out);
  // By then every ball lies still, and all are on the table or in a pocket.
  const Finished states = simulate("billiards", "--until 60 --states -");
  for (const std::string& line : lines_of(states.out)) {
    BodyState state;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(line, &state).ok()) << line;
    EXPECT_EQ(state.velocity().x(), 0) << line;
    EXPECT_EQ(state.velocity().y(), 0) << line;
    EXPECT_LT(std::abs(state.position().x() - 1.27), 1.27 + 0.09) << line;
    EXPECT_LT(std::abs(state.position().y() - 0.635), 0.635 + 0.09) << line;
  }
  const Finished stepped =
      simulate("billiards", "--until 1 --method fixed-step --step 0.001 --states -");
  EXPECT_EQ(stepped.status, 1);
  EXPECT_NE(stepped.error.find("zones"), std::string::npos) << stepped.error;
}

TEST(Simulate, CountsTheDigitsOfPi) {
  const std::vector<std::string> digits = {"3", "31", "314", "3141", "31415"};
  for (std::size_t k = 0; k < digits.size(); ++k) {
    const Finished run = simulate("pi-" + std::to_string(k), "--until 1000 --stats");
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_EQ(nlohmann::json::parse(run.error)["collisions"].dump(), digits[k]);
  }
}

TEST(Simulate, EveryLineIsTheCanonicalJsonOfItsMessage) {
  const Finished run = simulate("pool-break", "--until 3 --collisions -");
  ASSERT_EQ(run.status, 0) << run.error;
  std::uint64_t sequence = 0;
  for (const std::string& line : lines_of(run.out)) {
    Collision collision;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(line, &collision).ok()) << line;
    EXPECT_EQ(collision.sequence(), ++sequence);
    EXPECT_GE(collision.impulse(), 0);
    EXPECT_GE(collision.approach_speed(), 0);
  }
  EXPECT_GT(sequence, 20U);
  const Finished states = simulate("pool-break", "--until 3 --states -");
  std::uint64_t id = 0;
  std::size_t disks = 0;
  for (const std::string& line : lines_of(states.out)) {
    BodyState state;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(line, &state).ok()) << line;
    EXPECT_GT(state.id(), id) << "in the order of ids";
    EXPECT_EQ(state.instant().seconds(), 3);
    EXPECT_GT(state.radius(), 0) << "disks only";
    id = state.id();
    ++disks;
  }
  EXPECT_EQ(disks, 16U);
}

TEST(Simulate, StopsRightAfterSoManyCollisions) {
  const Finished all = simulate("pi-2", "--until 100 --collisions -");
  const Finished some = simulate("pi-2", "--max-collisions 100 --collisions - --stats");
  ASSERT_EQ(some.status, 0) << some.error;
  const std::vector<std::string> lines = lines_of(some.out);
  ASSERT_EQ(lines.size(), 100U);
  EXPECT_EQ(all.out.rfind(some.out, 0), 0U) << "the beginning of the whole log";
  const Finished ticks =
      simulate("pi-2", "--max-collisions 100 --collisions - --until 100 --tick-rate 60");
  EXPECT_EQ(ticks.out, some.out);
}

TEST(Simulate, FewerCollisionsThanAskedForEndAtTheLastOne) {
  const Finished run = simulate("pi-1", "--max-collisions 1000 --collisions - --states -");
  ASSERT_EQ(run.status, 0) << run.error;
  const std::vector<std::string> lines = lines_of(run.out);
  ASSERT_EQ(lines.size(), 31U + 2U);
  const auto last = nlohmann::json::parse(lines[30]);
  const auto state = nlohmann::json::parse(lines[31]);
  EXPECT_EQ(last["instant"], state["instant"]);
}

TEST(Simulate, StatisticsTellWhatWasKept) {
  const Finished run = simulate("gas-10000", "--until 0.1 --stats");
  ASSERT_EQ(run.status, 0) << run.error;
  EXPECT_TRUE(run.out.empty()) << run.out;
  const auto stats = nlohmann::json::parse(run.error);
  EXPECT_GT(stats["collisions"].get<std::uint64_t>(), 100U);
  EXPECT_GT(stats["events_per_second"].get<double>(), 0);
  EXPECT_EQ(stats["disks"], 10000);
  EXPECT_EQ(stats["walls"], 4);
  EXPECT_EQ(stats["regularised"], 0);
  const double energy = stats["kinetic_energy_start"].get<double>();
  EXPECT_NEAR(stats["kinetic_energy_end"].get<double>(), energy, 1e-12 * energy);
  for (const char* key : {"other_events",
                          "wall_seconds",
                          "potential_energy_start",
                          "potential_energy_end",
                          "momentum_start",
                          "momentum_end"}) {
    EXPECT_TRUE(stats.contains(key)) << key;
  }
}

/// FNV-1a, as its authors give it.
std::string fnv1a(const std::string& text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  std::ostringstream out;
  out << std::hex << std::setw(16) << std::setfill('0') << hash;
  return out.str();
}

TEST(Simulate, TheDigestIsThatOfTheLogsBytes) {
  const Finished log = simulate("pi-2", "--until 100 --collisions -");
  const Finished hash = simulate("pi-2", "--until 100 --hash --json");
  ASSERT_EQ(hash.status, 0) << hash.error;
  const auto digests = nlohmann::json::parse(hash.out);
  EXPECT_EQ(digests["collision_log"], fnv1a(log.out));
  EXPECT_EQ(digests["state"].get<std::string>().size(), 16U);
  const Finished ticks = simulate("pi-2", "--until 100 --hash --json --tick-rate 60");
  EXPECT_EQ(ticks.out, hash.out);
}

TEST(Simulate, OtherArithmeticsRunAndDifferInTheLastPlaces) {
  const Finished twice = simulate("pool-break", "--until 0.2 --hash");
  std::set<std::string> outputs = {twice.out};
  const std::vector<engine::Arithmetic> all = translate::arithmetics();
  for (const engine::Arithmetic arithmetic : all) {
    if (arithmetic == engine::Arithmetic::Double) continue;
    const std::string scalar(translate::name_of(arithmetic));
    const Finished run = simulate("pool-break", "--until 0.2 --hash --scalar " + scalar);
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_TRUE(outputs.insert(run.out).second) << scalar;
  }
}

TEST(Simulate, VerifiesOnDemandWithoutChangingAByte) {
  const std::string common = "--until 2 --collisions - --states - --stats";
  const Finished plain = simulate("pool-break", common);
  EXPECT_EQ(nlohmann::json::parse(plain.error)["verify_checks"], 0);
  for (const char* verify : {" --verify 5", " --verify", " --verify 1 --tick-rate 60"}) {
    const Finished verified = simulate("pool-break", common + verify);
    ASSERT_EQ(verified.status, 0) << verified.error;
    EXPECT_EQ(verified.out, plain.out) << verify;
    const auto stats = nlohmann::json::parse(verified.error);
    EXPECT_GT(stats["verify_checks"], 0) << verify;
    EXPECT_EQ(stats["verify_overlaps"], 0);
    EXPECT_EQ(stats["verify_missed"], 0);
    EXPECT_LT(stats["verify_worst_overlap"], 1e-12);
    EXPECT_LT(stats["verify_energy_error"], 1e-15);
    EXPECT_LT(stats["verify_momentum_error"], 1e-14);
  }
  // The word behind it is the scene unless it is a number; and the figures are always told.
  const Finished before = stoss({"simulate", "--verify", scene("tutorial"), "--until", "1"});
  EXPECT_EQ(before.status, 0) << before.error;
  EXPECT_NE(before.error.find("0 overlaps, 0 missed contacts"), std::string::npos) << before.error;
}

TEST(Simulate, TheSteppedBaselineTakesTheSameScenes) {
  const Finished run =
      simulate("newtons-cradle", "--until 3 --method fixed-step --step 1e-4 --stats --states -");
  ASSERT_EQ(run.status, 0) << run.error;
  EXPECT_GT(nlohmann::json::parse(run.error)["collisions"].get<int>(), 0);
  const Finished bullet =
      simulate("tutorial", "--until 1 --method fixed-step --step 0.01 --collisions -");
  EXPECT_EQ(bullet.status, 0);
  for (const std::string& line : lines_of(bullet.out)) {
    EXPECT_NE(nlohmann::json::parse(line)["kind"], "DISK_WALL") << "it must tunnel in steps";
  }
}

TEST(Simulate, AScenesFaultIsNamed) {
  const std::string path = testing::TempDir() + "/bad_scene.json";
  std::ofstream(path) << R"({"disks":[{"id":7,"position":{"x":0,"y":0},"radius":-1}]})";
  const Finished run = stoss({"simulate", path, "--until", "1"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.error.rfind("INVALID_ARGUMENT: ", 0), 0U) << run.error;
  for (const char* part : {"bad_scene.json", "disks[0].radius", "7"}) {
    EXPECT_NE(run.error.find(part), std::string::npos) << part << " in " << run.error;
  }
  std::ofstream(path) << R"({"disks":[{"id":7,"position":{"x":0},"radius":1},)"
                         R"({"id":8,"position":{"x":1},"radius":1}]})";
  const Finished overlap = stoss({"simulate", path, "--until", "1"});
  EXPECT_EQ(overlap.status, 1);
  EXPECT_EQ(overlap.error.rfind("OVERLAP: ", 0), 0U) << overlap.error;
  std::ofstream(path) << R"({"effects":{"drag":{"rate":1},"growth":{"rate":1}}})";
  const Finished drag = stoss({"simulate", path, "--until", "1"});
  EXPECT_EQ(drag.status, 1);
  EXPECT_EQ(drag.error.rfind("UNIMPLEMENTED: ", 0), 0U) << drag.error;
  EXPECT_EQ(stoss({"simulate", path + ".json", "--until", "1"}).status, 1);
}

TEST(Simulate, EffectsActAndThoseThatCannotGoTogetherAreNamed) {
  const std::string path = testing::TempDir() + "effects_scene.json";
  std::ofstream(path) << R"({"disks":[{"id":1,"position":{"y":5.5},"velocity":{"x":0.25},)"
                         R"("radius":0.5}],"walls":[{"id":2,"start":{"x":-10},"end":{"x":10}}],)"
                         R"("effects":{"gravity":{"acceleration":{"y":-9.81}},)"
                         R"("restitution":{"coefficient":0.5}}})";
  const Finished falls = stoss({"simulate", path, "--until", "1.5", "--collisions", "-"});
  EXPECT_EQ(falls.status, 0) << falls.error;
  const std::vector<std::string> lines = lines_of(falls.out);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("4.95227220576575"), std::string::npos) << lines[0];
  const Finished stepped =
      stoss({"simulate", path, "--until", "1", "--method", "fixed-step", "--step", "0.01"});
  EXPECT_EQ(stepped.status, 1);
  EXPECT_NE(stepped.error.find("UNIMPLEMENTED"), std::string::npos) << stepped.error;
  std::ofstream(path) << R"({"effects":{"gravity":{"acceleration":{"y":-9.81}},)"
                         R"("floor_friction":{"deceleration":1}}})";
  const Finished refused = stoss({"simulate", path, "--until", "1"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.error.rfind("UNIMPLEMENTED: ", 0), 0U) << refused.error;
  EXPECT_NE(refused.error.find("effects.floor_friction"), std::string::npos) << refused.error;
}

TEST(Simulate, BadUsageIsToldAsSuch) {
  for (const char* options : {"",
                              "--until x",
                              "--until -1",
                              "--until 1e30",
                              "--until 1 --scalar half",
                              "--until 1 --verify 0",
                              "--until 1 --verify=x",
                              "--until 1 --method fixed-step --step 0.1 --verify",
                              "--until 1 --broad-phase magic",
                              "--until 1 --method exact --step 1",
                              "--until 1 --method fixed-step",
                              "--until 1 --method fixed-step --step 0",
                              "--until 1 --tick-rate 0",
                              "--until 1 --tick-rate nan",
                              "--until 1 --max-collisions -1",
                              "--until 1 --bogus",
                              "--max-collisions 3 --method fixed-step --step 0.1"}) {
    const Finished run = simulate("tutorial", options);
    EXPECT_EQ(run.status, 2) << options << ": " << run.error;
    EXPECT_FALSE(run.error.empty());
  }
  EXPECT_EQ(stoss({"simulate"}).status, 2);
}

TEST(Simulate, OutputThatCannotBeWrittenIsAnError) {
  const Finished full = simulate("gas-10000", "--until 0.2 --collisions /dev/full");
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.error.find("/dev/full"), std::string::npos) << full.error;
  EXPECT_EQ(simulate("tutorial", "--until 1 --states /no/such/dir/x").status, 1);
}

}  // namespace
}  // namespace stoss::tests

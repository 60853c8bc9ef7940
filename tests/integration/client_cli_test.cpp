// SPDX-License-Identifier: Apache-2.0
// The `stoss` command against a real stossd: what each verb prints, does and returns.
#include "clients/run_program.hpp"
#include "daemon_process.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

using nlohmann::json;

constexpr unsigned kDomain = 80;

/// A paused world without bodies.
class ClientCli : public testing::Test {
 protected:
  static Finished run(const std::string& command) {
    return stoss_words(command + " --domain " + std::to_string(kDomain) + " --world cli");
  }
  /// One that must succeed; what it printed.
  static std::string good(const std::string& command) {
    const Finished finished = run(command);
    EXPECT_EQ(finished.status, 0) << command << ": " << finished.error;
    EXPECT_TRUE(finished.error.empty()) << command << ": " << finished.error;
    return finished.out;
  }
  static std::vector<json> good_json(const std::string& command) {
    std::vector<json> objects;
    for (const std::string& line : lines_of(good(command + " --json"))) {
      objects.push_back(json::parse(line));
    }
    return objects;
  }
  static json status() { return good_json("status").at(0); }
  /// One that the world must refuse, with these words in what it says.
  static void refused(const std::string& command, const std::vector<std::string>& parts) {
    const std::string hash = status()["state_hash"];
    const Finished finished = run(command);
    EXPECT_EQ(finished.status, 1) << command << ": " << finished.out;
    for (const std::string& part : parts) {
      EXPECT_NE(finished.error.find(part), std::string::npos) << part << " in " << finished.error;
    }
    EXPECT_EQ(status()["state_hash"], hash) << command << " changed the world";
  }

  void SetUp() override { ASSERT_EQ(run("status --timeout 20").status, 0) << daemon_.log(); }
  void TearDown() override {
    daemon_.signal(SIGTERM);
    EXPECT_EQ(daemon_.wait(), 0) << daemon_.log();
  }

  Process daemon_{stossd(kDomain, {"--world", "cli", "--paused"})};
};

TEST_F(ClientCli, BodiesComeChangeAndGo) {
  EXPECT_EQ(good("spawn disk --position -1,.5 --radius 0.5 --velocity 1,-0.25 --mass 2"), "1\n");
  EXPECT_EQ(good("spawn wall --start -.5,-5 --end -.5,-4 --id 7"), "7\n");
  EXPECT_EQ(good("spawn disk --position 5,5 --radius 1 --kind STATIC --id 9"), "9\n");
  const json disk = good_json("get 1").at(0);
  EXPECT_EQ(disk["id"], "1");
  EXPECT_EQ(disk["position"]["x"], -1);
  EXPECT_EQ(disk["position"]["y"], 0.5);
  EXPECT_EQ(disk["velocity"]["y"], -0.25);
  EXPECT_EQ(disk["radius"], 0.5);
  good("set-velocity 1 -1.5 -.5");
  EXPECT_EQ(good_json("get 1").at(0)["velocity"]["x"], -1.5);
  good("impulse 1 -1 3");
  EXPECT_EQ(good_json("get 1").at(0)["velocity"]["x"], -2);
  EXPECT_EQ(good_json("get 1").at(0)["velocity"]["y"], 1);
  EXPECT_EQ(good_json("list").size(), 2U);
  EXPECT_EQ(good_json("list --walls").size(), 3U);
  const std::vector<std::string> table = lines_of(good("list"));
  ASSERT_EQ(table.size(), 4U);
  EXPECT_NE(table[0].find("radius"), std::string::npos);
  EXPECT_EQ(table[1].size(), table[2].size()) << "columns line up";
  good("remove 9 7");
  EXPECT_EQ(good_json("list --walls").size(), 1U);
}

TEST_F(ClientCli, ZonesReportWhoEntersAndLeaves) {
  good("spawn disk --position 0,0 --radius 0.25 --velocity 2,0 --id 1");
  EXPECT_EQ(good("spawn zone --center 3,0 --radius 1 --id 7 --name goal"), "7\n");
  EXPECT_EQ(status()["zones"], "1");
  EXPECT_EQ(good_json("list --walls").size(), 1U) << "a zone is no body";
  refused("spawn zone --center 3,0 --radius -1", {"INVALID_ARGUMENT: ", "radius"});
  refused("set-velocity 7 1 0", {"FAILED_PRECONDITION: ", "7"});
  good("run-to 1.75");
  const std::vector<json> events = good_json("zones --since 1 --count 1");
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0]["zone"], "7");
  EXPECT_EQ(events[0]["body"], "1");
  EXPECT_EQ(events[0]["entered"], true);
  EXPECT_EQ(events[0]["instant"]["seconds"], "1");
  EXPECT_EQ(events[0]["position"]["x"], 2);
  good("run-to 5");
  const std::vector<std::string> lines = lines_of(good("zones --since 1 --count 2"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1], "#2  t 2  body 1 leaves zone 7  at 4,0  velocity 2,0");
  EXPECT_EQ(status()["zone_number"], "2");
  good("remove 7");
  EXPECT_EQ(status()["zones"], "0");
}

TEST_F(ClientCli, RefusalsNameTheCodeTheFieldAndTheBodyAndChangeNothing) {
  good("spawn disk --position 0,0 --radius 1 --id 5");
  refused("spawn disk --position 1.5,0 --radius 1", {"OVERLAP: ", "5", "-0.5"});
  refused("spawn disk --position 9,9 --radius 1 --id 5", {"ALREADY_EXISTS: ", "id", "5"});
  refused("spawn disk --position 9,9 --radius 0", {"INVALID_ARGUMENT: ", "radius"});
  refused("spawn disk --position nan,9 --radius 1", {"INVALID_ARGUMENT: ", "position"});
  refused("spawn disk --position 9,9 --radius 1 --mass -1", {"INVALID_ARGUMENT: ", "mass"});
  refused("spawn wall --start 9,9 --end 9,9", {"INVALID_ARGUMENT: ", "walls"});
  refused("set-velocity 77 1 2", {"NOT_FOUND: ", "77"});
  refused("set-velocity 5 inf 2", {"INVALID_ARGUMENT: "});
  refused("get 77", {"NOT_FOUND: ", "77"});
  refused("pause --at -1", {"DEADLINE_PASSED: "});
  const Finished overlap = run("spawn disk --position 1.5,0 --radius 1 --json");
  const json object = json::parse(overlap.out);
  EXPECT_EQ(object["code"], "OVERLAP");
  EXPECT_EQ(object["other"], "5");
  EXPECT_EQ(object["clearance"], -0.5);
}

TEST_F(ClientCli, TimeIsStoppedSteppedAndRun) {
  EXPECT_EQ(status()["state"], "PAUSED");
  good("step");
  good("step 5");
  EXPECT_EQ(status()["tick"], "6");
  good("run-to 1.5");
  EXPECT_EQ(status()["instant"]["seconds"], "1");
  EXPECT_EQ(status()["instant"]["fraction"], std::to_string(std::uint64_t{1} << 63U));
  good("speed max");
  good("run-for 100.25");
  EXPECT_EQ(status()["instant"]["seconds"], "101");
  EXPECT_EQ(status()["state"], "PAUSED");
  EXPECT_EQ(status()["speed_asked"], "Infinity");
  good("speed 2");
  good("resume");
  EXPECT_EQ(status()["state"], "RUNNING");
  good("pause");
  EXPECT_EQ(status()["state"], "PAUSED");
  good("reset");
  EXPECT_EQ(status()["tick"], "0");
}

TEST_F(ClientCli, ACommandTakesEffectAtTheInstantGiven) {
  good("spawn disk --position 0,0 --radius 1 --id 1");
  good("resume");
  const json at = good_json("status").at(0)["instant"];
  const std::int64_t seconds =
      at.contains("seconds") ? std::stoll(at["seconds"].get<std::string>()) : 0;
  const std::string when = std::to_string(seconds + 2) + ".125";
  const json reply = good_json("set-velocity 1 -3 0 --at " + when).at(0);
  EXPECT_EQ(reply["code"], "OK");
  EXPECT_EQ(reply["instant"]["seconds"], std::to_string(seconds + 2));
  EXPECT_EQ(reply["instant"]["fraction"], std::to_string(std::uint64_t{1} << 61U));
}

TEST_F(ClientCli, EffectsAreSwitchedOnALiveWorld) {
  good("spawn disk --position 0,0 --radius 1 --velocity 1,0 --id 1");
  EXPECT_EQ(good("effects"), "no effects are on\n");
  good("speed max");
  good("run-for 1");
  good("effects set gravity.acceleration=0,-9.81 restitution.coefficient=0.9");
  const json on = good_json("effects").at(0);
  EXPECT_EQ(on["gravity.acceleration.y"], -9.81);
  EXPECT_EQ(on["restitution.wall_coefficient"], 0.9) << "by default the same";
  good("run-for 1");
  EXPECT_EQ(good_json("get 1").at(0)["velocity"]["y"], -9.81);
  EXPECT_EQ(good_json("get 1").at(0)["position"]["x"], 2);
  good("speed 1");
  good("resume");
  good("effects off gravity --at 5.5");
  good("pause");
  EXPECT_EQ(good_json("get 1").at(0)["velocity"]["y"], -9.81 * 4.5);
  EXPECT_FALSE(good_json("effects").at(0).contains("gravity.acceleration.y"));
  refused("effects set rough.friction=1", {"INVALID_ARGUMENT: ", "rough.tangential_restitution"});
  refused("effects set restitution.coefficient=1.5", {"restitution.coefficient", "[0, 1]"});
  refused("effects off gravity", {"INVALID_ARGUMENT: ", "gravity", "is not on"});
  EXPECT_EQ(run("effects set gravity").status, 2);
  EXPECT_EQ(run("effects set gravity.acceleration=0,down").status, 2);
  const auto words = good_json("features --live").at(0).get<std::vector<std::string>>();
  EXPECT_NE(std::find(words.begin(), words.end(), "setting:restitution.coefficient=0.9"),
            words.end());
  good("reset");
  EXPECT_EQ(good("effects"), "no effects are on\n");
}

TEST_F(ClientCli, QuestionsFindWhatIsThere) {
  good("spawn disk --position 0,0 --radius 1 --id 1");
  good("spawn disk --position 10,0 --radius 1 --id 2");
  good("spawn wall --start 20,-5 --end 20,5 --id 3");
  EXPECT_EQ(good_json("region --min -1,-1 --max 1,1").size(), 1U);
  const std::vector<json> near = good_json("nearest -5,0 --count 2");
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0]["id"], "1");
  EXPECT_EQ(near[0]["distance"], 4);
  const json hit = good_json("ray --from 5,0 --direction 2,0").at(0);
  EXPECT_EQ(hit["id"], "2");
  EXPECT_EQ(hit["distance"], 4);
  EXPECT_EQ(hit["point"]["x"], 9);
  EXPECT_EQ(hit["normal"]["x"], -1);
  EXPECT_TRUE(good_json("ray --from 5,0 --direction 0,1").empty());
  EXPECT_NE(good("nearest -5,0").find("distance"), std::string::npos);
  good("set-velocity 1 1 0");
  EXPECT_EQ(good_json("get 1 --at 3").at(0)["position"]["x"], 3);
}

TEST_F(ClientCli, StreamsGiveStatesAndCollisions) {
  good("spawn disk --position 0,0 --radius 1 --velocity 1,0 --id 1");
  good("spawn disk --position 4,0 --radius 1 --id 2");
  good("spawn wall --start 8,-5 --end 8,5 --id 3");
  EXPECT_NE(good("states --count 1").find("2 disks"), std::string::npos) << "also while paused";
  good("speed max");
  good("run-for 20");
  const std::vector<json> frame = good_json("states --count 1");
  ASSERT_EQ(frame.size(), 2U);
  EXPECT_EQ(frame[0]["instant"]["seconds"], "20");
  EXPECT_EQ(frame[0]["radius"], 1);
  EXPECT_EQ(good_json("states 2 --count 1").at(0)["id"], "2");
  refused("states 99 --count 1", {"NOT_FOUND"});
  // 1 meets 2 at 2 s, 2 the wall at 5 s, and 2 meets 1 again at 8 s.
  const std::vector<json> log = good_json("collisions --since 1 --count 3");
  ASSERT_EQ(log.size(), 3U);
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_EQ(log[i]["sequence"], std::to_string(i + 1));
    EXPECT_EQ(log[i]["instant"]["seconds"], std::to_string(2 + 3 * i));
  }
  EXPECT_EQ(log[1]["kind"], "DISK_WALL");
  EXPECT_EQ(log[1]["b"], "3");
  EXPECT_EQ(lines_of(good("collisions --since 2 --count 2")).size(), 2U);
}

TEST_F(ClientCli, ASceneIsLoadedInPiecesUpToTheFirstRefusal) {
  const std::string path = testing::TempDir() + "cli_scene.json";
  const auto write = [&path](int disks) {
    json scene;
    for (int i = 0; i < disks; ++i) {
      scene["disks"].push_back({{"position", {{"x", 3 * i}, {"y", 0}}}, {"radius", 1}});
    }
    std::ofstream(path) << scene;
  };
  write(2500);
  EXPECT_EQ(good("load " + path), "2500 bodies loaded\n");
  EXPECT_EQ(good_json("list").size(), 2500U);
  const std::string hash = status()["state_hash"];
  const Finished again = run("load " + path);
  EXPECT_EQ(again.status, 1);
  EXPECT_EQ(again.error.rfind("OVERLAP: ", 0), 0U) << again.error;
  EXPECT_NE(again.error.find("0 of 2500 bodies are in"), std::string::npos) << again.error;
  EXPECT_EQ(status()["state_hash"], hash);
  good("remove 2000");
  const Finished third = run("load " + std::string(STOSS_SCENE_DIR) + "/no-such.json");
  EXPECT_EQ(third.status, 1);
}

TEST_F(ClientCli, WorldsAreListedAndTheOnlyOneIsFound) {
  const Finished list = stoss_words("worlds --json --domain " + std::to_string(kDomain));
  ASSERT_EQ(list.status, 0) << list.error;
  EXPECT_EQ(json::parse(list.out)["world"], "cli");
  EXPECT_EQ(stoss_words("--domain " + std::to_string(kDomain) + " status").status, 0);
  Process second(stossd(kDomain, {"--world", "other", "--paused"}));
  const Finished named = stoss_words("status --world other --domain " + std::to_string(kDomain));
  ASSERT_EQ(named.status, 0) << named.error;
  const Finished both = stoss_words("worlds --domain " + std::to_string(kDomain));
  EXPECT_EQ(lines_of(both.out).size(), 3U) << both.out;
  const Finished unclear = stoss_words("status --domain " + std::to_string(kDomain));
  EXPECT_EQ(unclear.status, 2);
  EXPECT_NE(unclear.error.find("other"), std::string::npos) << unclear.error;
  second.signal(SIGTERM);
  EXPECT_EQ(second.wait(), 0);
}

TEST_F(ClientCli, TopPrintsALineASecondWithoutATerminal) {
  const std::vector<std::string> lines = lines_of(good("top --count 2"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].find("PAUSED"), std::string::npos);
  EXPECT_EQ(good_json("top --count 1").at(0)["world"], "cli");
}

TEST_F(ClientCli, EveryVerbSpeaksJson) {
  good("spawn disk --position 0,0 --radius 1 --id 1");
  for (const char* verb : {"worlds",
                           "status",
                           "spawn wall --start 50,0 --end 51,0",
                           "set-velocity 1 1 0",
                           "impulse 1 1 0",
                           "pause",
                           "step 2",
                           "run-for 0.1",
                           "run-to 3",
                           "speed 4",
                           "resume",
                           "reset",
                           "list",
                           "worlds",
                           "top --count 1"}) {
    for (const std::string& line : lines_of(good(std::string(verb) + " --json"))) {
      EXPECT_TRUE(json::accept(line)) << verb << ": " << line;
    }
  }
}

}  // namespace
}  // namespace stoss::tests

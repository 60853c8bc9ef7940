// SPDX-License-Identifier: Apache-2.0
// Scene files: what is refused and how the message names it; what is written reads back.
#include <stoss/idl/scene_file.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

namespace fs = std::filesystem;

// A folder of its own that goes when the test ends.
class SceneFile : public ::testing::Test {
 protected:
  SceneFile() {
    const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("stoss_scene_" + std::string(info->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  ~SceneFile() override {
    std::error_code none;
    fs::remove_all(folder_, none);
  }

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  fs::path folder_;
};

idl::SceneError error_in(std::variant<Scene, idl::SceneError> result) {
  EXPECT_TRUE(std::holds_alternative<idl::SceneError>(result)) << "no error";
  auto* const error = std::get_if<idl::SceneError>(&result);
  return error != nullptr ? *error : idl::SceneError{};
}

idl::SceneError json_error(const std::string& json) {
  return error_in(idl::parse_scene(json, idl::SceneFormat::kJson, "s.json"));
}

void expect_json_error(const std::string& json,
                       const std::string& field,
                       const std::string& reason) {
  const idl::SceneError error = json_error(json);
  EXPECT_EQ(error.code, idl::Code::kInvalidArgument);
  EXPECT_EQ(error.field, field) << json;
  EXPECT_NE(error.reason.find(reason), std::string::npos) << json << ": " << error.reason;
}

Scene sample_scene() {
  Scene scene;
  scene.set_name("box");
  scene.mutable_start()->set_seconds(5);
  Disk& disk = *scene.add_disks();
  disk.set_id(1);
  disk.set_name("red");
  disk.mutable_position()->set_x(0.1);
  disk.mutable_velocity()->set_y(-1.0 / 3);
  disk.set_radius(0.25);
  disk.set_mass(2);
  Wall& wall = *scene.add_walls();
  wall.set_id(2);
  wall.mutable_start();
  wall.mutable_end()->set_x(4);
  scene.mutable_effects()->mutable_restitution()->set_coefficient(0.5);
  scene.mutable_effects()->mutable_gravity()->mutable_acceleration()->set_y(-9.81);
  return scene;
}

TEST_F(SceneFile, EveryFormatReadsBackWhatItWrote) {
  const Scene scene = sample_scene();
  for (const char* const name : {"a.json", "a.textproto", "a.binpb"}) {
    const fs::path path = folder_ / name;
    EXPECT_FALSE(idl::save_scene(scene, path)) << name;
    const auto result = idl::load_scene(path);
    ASSERT_TRUE(std::holds_alternative<Scene>(result))
        << std::get<idl::SceneError>(result).message();
    EXPECT_EQ(std::get<Scene>(result).SerializeAsString(), scene.SerializeAsString()) << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3)
      << "a temporary file was left";
}

TEST_F(SceneFile, KindsAreTheWordsOfTheContract) {
  Scene scene = sample_scene();
  scene.mutable_disks(0)->set_kind(Disk::KINEMATIC);
  ASSERT_FALSE(idl::save_scene(scene, folder_ / "k.json"));
  std::ifstream in(folder_ / "k.json");
  std::ostringstream content;
  content << in.rdbuf();
  const std::string text = content.str();
  EXPECT_NE(text.find("\"kind\": \"KINEMATIC\""), std::string::npos) << text;
}

TEST_F(SceneFile, MissingFileIsNotFound) {
  const idl::SceneError error = error_in(idl::load_scene(folder_ / "none.json"));
  EXPECT_EQ(error.code, idl::Code::kNotFound);
  EXPECT_NE(error.message().find("none.json"), std::string::npos);
  EXPECT_NE(error.message().find("No such file"), std::string::npos);
}

TEST_F(SceneFile, FolderIsRefused) {
  fs::create_directories(folder_ / "d.json");
  EXPECT_NE(error_in(idl::load_scene(folder_ / "d.json")).reason.find("directory"),
            std::string::npos);
}

TEST_F(SceneFile, ExtensionTellsTheFormat) {
  EXPECT_EQ(idl::scene_format("x.json"), idl::SceneFormat::kJson);
  EXPECT_EQ(idl::scene_format("x.textproto"), idl::SceneFormat::kText);
  EXPECT_EQ(idl::scene_format("x.binpb"), idl::SceneFormat::kBinary);
  EXPECT_FALSE(idl::scene_format("x.yaml"));
  const idl::SceneError error = error_in(idl::load_scene("x.yaml"));
  EXPECT_NE(error.reason.find(".json, .textproto or .binpb"), std::string::npos);
  EXPECT_TRUE(idl::save_scene(Scene(), folder_ / "x.yaml"));
}

TEST_F(SceneFile, UnwritableFileIsReported) {
  const auto error = idl::save_scene(sample_scene(), folder_ / "no/such/folder/a.json");
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("No such file"), std::string::npos) << error->message();
}

TEST_F(SceneFile, MessageNamesFileLineFieldAndBody) {
  const fs::path path = write("bad.json",
                              "{\n \"disks\": [\n  {\"id\": \"7\", \"name\": \"red\",\n"
                              "   \"position\": {},\n   \"radius\": -1}\n ]\n}\n");
  const idl::SceneError error = error_in(idl::load_scene(path));
  EXPECT_EQ(error.line, 5U);
  EXPECT_EQ(error.column, 14U);
  EXPECT_EQ(error.id, 7U);
  EXPECT_EQ(error.body, "red");
  EXPECT_EQ(error.message(),
            path.string() +
                ":5:14: disks[0].radius (id 7, \"red\"): must be finite and "
                "greater than 0, but is -1");
}

TEST_F(SceneFile, SyntaxErrorNamesTheBodyToo) {
  const idl::SceneError error = json_error("{\"disks\":[{\"id\":3,\"radius\":\"wide\"}]}");
  EXPECT_EQ(error.field, "disks[0].radius");
  EXPECT_EQ(error.id, 3U);
  EXPECT_EQ(error.line, 1U);
}

TEST_F(SceneFile, TextFormatErrorsHavePlaces) {
  const auto read = [](const std::string& text) {
    return error_in(idl::parse_scene(text, idl::SceneFormat::kText, "s.textproto"));
  };
  idl::SceneError error = read("name: 'a'\ndisks { radios: 1 }\n");
  EXPECT_EQ(error.line, 2U);
  EXPECT_NE(error.reason.find("radios"), std::string::npos) << error.reason;
  error = read("name: 'a'\ndisks {\n  id: 4 position {}\n  radius: -1\n}\n");
  EXPECT_EQ(error.field, "disks[0].radius");
  EXPECT_EQ(error.line, 4U);
  EXPECT_EQ(error.id, 4U);
}

TEST_F(SceneFile, BinaryErrorsAreFound) {
  const auto read = [](const std::string& bytes) {
    return error_in(idl::parse_scene(bytes, idl::SceneFormat::kBinary, "s.binpb"));
  };
  EXPECT_NE(read("\xFF\xFF\xFF").reason.find("binary"), std::string::npos);
  // Field 100 of a disk, a number.
  Scene scene = sample_scene();
  scene.mutable_disks(0)
      ->GetReflection()
      ->MutableUnknownFields(scene.mutable_disks(0))
      ->AddVarint(100, 1);
  const idl::SceneError error = read(scene.SerializeAsString());
  EXPECT_EQ(error.field, "disks[0].field number 100");
  EXPECT_EQ(error.id, 1U);
}

TEST_F(SceneFile, UnknownFieldsAreFoundInTheLastDisksVectors) {
  const auto expect_found = [](const char* field, auto vector_of) {
    Scene scene = sample_scene();
    scene.add_disks()->CopyFrom(scene.disks(0));
    const int last = scene.disks_size() - 1;
    Vector2& vector = *vector_of(*scene.mutable_disks(last));
    vector.GetReflection()->MutableUnknownFields(&vector)->AddVarint(9, 1);
    const idl::SceneError error =
        error_in(idl::parse_scene(scene.SerializeAsString(), idl::SceneFormat::kBinary, "s.binpb"));
    EXPECT_EQ(error.field, "disks[" + std::to_string(last) + "]." + field + ".field number 9");
  };
  expect_found("position", [](Disk& disk) { return disk.mutable_position(); });
  expect_found("velocity", [](Disk& disk) { return disk.mutable_velocity(); });
}

TEST_F(SceneFile, DisksAreChecked) {
  expect_json_error(R"({"disks":[{"radius":1}]})", "disks[0].position", "missing");
  expect_json_error(R"({"disks":[{"position":{}}]})", "disks[0].radius", "missing");
  expect_json_error(R"({"disks":[{"position":{},"radius":0}]})", "disks[0].radius", "is 0");
  expect_json_error(R"({"disks":[{"position":{},"radius":"NaN"}]})", "disks[0].radius", "is nan");
  expect_json_error(R"({"disks":[{"position":{},"radius":"Infinity"}]})", "disks[0].radius", "inf");
  expect_json_error(
      R"({"disks":[{"position":{"x":"NaN"},"radius":1}]})", "disks[0].position", "finite");
  expect_json_error(R"({"disks":[{"position":{},"radius":1,"velocity":{"y":"-Infinity"}}]})",
                    "disks[0].velocity",
                    "finite");
  expect_json_error(R"({"disks":[{"position":{},"radius":1,"mass":0}]})", "disks[0].mass", "is 0");
  expect_json_error(R"({"disks":[{"position":{},"radius":1,"mass":-2}]})", "disks[0].mass", "-2");
  expect_json_error(
      R"({"disks":[{"position":{},"radius":1,"angle":"NaN"}]})", "disks[0].angle", "finite");
  expect_json_error(
      R"({"disks":[{"position":{},"radius":1,"spin":"NaN"}]})", "disks[0].spin", "finite");
  expect_json_error(R"({"disks":[{"position":{},"radius":1,"kind":"STATIC","velocity":{"x":1}}]})",
                    "disks[0].velocity",
                    "STATIC");
  expect_json_error(
      "{\"disks\":[{\"name\":\"" + std::string(65, 'x') + "\"}]}", "disks[0].name", "at most 64");
}

TEST_F(SceneFile, WallsAndZonesAreChecked) {
  expect_json_error(R"({"walls":[{"end":{"x":1}}]})", "walls[0].start", "missing");
  expect_json_error(R"({"walls":[{"start":{"x":1}}]})", "walls[0].end", "missing");
  expect_json_error(R"({"walls":[{"start":{"x":1},"end":{"x":1}}]})", "walls[0].end", "not be");
  expect_json_error(
      R"({"walls":[{"start":{"x":"NaN"},"end":{"x":1}}]})", "walls[0].start", "finite");
  expect_json_error(R"({"zones":[{"radius":1}]})", "zones[0].center", "missing");
  expect_json_error(R"({"zones":[{"center":{}}]})", "zones[0].radius", "missing");
  expect_json_error(R"({"zones":[{"center":{},"radius":-1}]})", "zones[0].radius", "-1");
}

TEST_F(SceneFile, IdsAreUniqueAcrossAllBodies) {
  expect_json_error(R"({"disks":[{"id":5,"position":{},"radius":1}],)"
                    R"("walls":[{"id":5,"start":{},"end":{"x":1}}]})",
                    "walls[0].id",
                    "which disks[0] has already");
  const auto result =
      idl::parse_scene(R"({"disks":[{"position":{},"radius":1},{"position":{"x":9},"radius":1}]})",
                       idl::SceneFormat::kJson,
                       "s.json");
  EXPECT_TRUE(std::holds_alternative<Scene>(result)) << "0 is no id and may be given often";
}

TEST_F(SceneFile, EffectsAndPeriodAreChecked) {
  expect_json_error(R"({"effects":{"gravity":{}}})", "effects.gravity.acceleration", "missing");
  expect_json_error(R"({"effects":{"drag":{"rate":-1}}})", "effects.drag.rate", "-1");
  expect_json_error(
      R"({"effects":{"floor_friction":{}}})", "effects.floor_friction.deceleration", "missing");
  expect_json_error(
      R"({"effects":{"restitution":{}}})", "effects.restitution.coefficient", "missing");
  expect_json_error(R"({"effects":{"restitution":{"coefficient":1.5}}})",
                    "effects.restitution.coefficient",
                    "between 0 and 1");
  expect_json_error(R"({"effects":{"restitution":{"coefficient":1,"wall_coefficient":-1}}})",
                    "effects.restitution.wall_coefficient",
                    "between");
  expect_json_error(R"({"effects":{"rough":{"tangential_restitution":-2,"friction":0}}})",
                    "effects.rough.tangential_restitution",
                    "between -1 and 1");
  expect_json_error(R"({"effects":{"growth":{"rate":"NaN"}}})", "effects.growth.rate", "nan");
  expect_json_error(
      R"({"effects":{"thermostat":{"rate":1}}})", "effects.thermostat.temperature", "missing");
  expect_json_error(R"({"period":{"y":-1}})", "period.y", "at least 0");
}

TEST_F(SceneFile, EffectsThatAreOnAreNamed) {
  EXPECT_EQ(idl::effect_names(sample_scene()),
            (std::vector<std::string>{"gravity", "restitution"}));
  EXPECT_TRUE(idl::effect_names(Scene()).empty());
}

TEST_F(SceneFile, ShippedScenesLoad) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(STOSS_SCENE_DIR)) {
    if (!idl::scene_format(entry.path())) continue;
    const auto result = idl::load_scene(entry.path());
    ++count;
    EXPECT_TRUE(std::holds_alternative<Scene>(result))
        << std::get<idl::SceneError>(result).message();
  }
  EXPECT_GT(count, 0);
}

// The bound is wide for busy machines and sanitizers; the figure is printed.
TEST_F(SceneFile, HundredThousandDisksLoadSoon) {
  Scene scene;
  for (unsigned i = 0; i < 100000; ++i) {
    Disk& disk = *scene.add_disks();
    disk.set_id(i + 1);
    disk.mutable_position()->set_x(i * 0.1234567);
    disk.mutable_position()->set_y(i / 7.0);
    disk.mutable_velocity()->set_x(1.0 / (i + 3));
    disk.set_radius(0.1);
  }
  ASSERT_FALSE(idl::save_scene(scene, folder_ / "big.json"));
  const auto begin = std::chrono::steady_clock::now();
  const auto result = idl::load_scene(folder_ / "big.json");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(std::holds_alternative<Scene>(result));
  EXPECT_EQ(std::get<Scene>(result).disks_size(), 100000);
  std::printf("100,000 disks of JSON in %.2f s\n", took.count());
  EXPECT_LT(took.count(), 20);
}

}  // namespace
}  // namespace stoss::tests

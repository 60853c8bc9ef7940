// SPDX-License-Identifier: Apache-2.0
// The JSON reader against Protobuf's: the same messages from well-formed input, errors for the
// rest.
#include "scene_json.hpp"

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <scene.pb.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

std::uint64_t seed() {
  const char* const given = std::getenv("STOSS_SEED");
  const std::uint64_t value = given != nullptr ? std::strtoull(given, nullptr, 10) : 4711;
  std::printf("seed %llu (STOSS_SEED)\n", static_cast<unsigned long long>(value));
  return value;
}

std::optional<Scene> ours(const std::string& json) {
  Scene scene;
  if (idl::read_json(json, scene)) return std::nullopt;
  return scene;
}

std::optional<Scene> theirs(const std::string& json) {
  Scene scene;
  if (!google::protobuf::util::JsonStringToMessage(json, &scene).ok()) return std::nullopt;
  return scene;
}

void expect_as_the_library(const std::string& json) {
  const auto wanted = theirs(json);
  const auto got = ours(json);
  ASSERT_TRUE(wanted) << json;
  ASSERT_TRUE(got) << json;
  EXPECT_EQ(got->SerializeAsString(), wanted->SerializeAsString()) << json;
}

void expect_error(const std::string& json, const std::string& field, const std::string& reason) {
  Scene scene;
  const auto error = idl::read_json(json, scene);
  ASSERT_TRUE(error) << json;
  EXPECT_EQ(error->place.field, field) << json;
  EXPECT_NE(error->reason.find(reason), std::string::npos) << json << ": " << error->reason;
  EXPECT_LE(error->place.offset, json.size());
}

TEST(SceneJson, ReadsWhatTheLibraryReads) {
  for (const char* const json :
       {"{}",
        " {\n\t} ",
        R"({"name":"box"})",
        R"({"disks":[]})",
        R"({"disks":[{}]})",
        R"({"name":null,"disks":null,"effects":null})",
        R"({"disks":[{"id":"18446744073709551615","radius":1}]})",
        R"({"disks":[{"id":12}]})",
        R"({"disks":[{"id":1e3}]})",
        R"({"disks":[{"id":"1"},{"id":"2"}]})",
        R"({"start":{"seconds":"-9223372036854775808","fraction":"1"}})",
        R"({"start":{"seconds":-5}})",
        R"({"disks":[{"kind":"STATIC"}]})",
        R"({"disks":[{"kind":1}]})",
        R"({"disks":[{"radius":"1.5"}]})",
        R"({"disks":[{"radius":"NaN"}]})",
        R"({"disks":[{"radius":"-Infinity"}]})",
        R"({"disks":[{"radius":0.1,"mass":1E+2,"angle":-1.5e-3,"spin":-0.0}]})",
        R"({"disks":[{"position":{"x":1,"y":-2.5}}]})",
        R"({"effects":{"gravity":{"acceleration":{"y":-9.81}},"floorFriction":{}}})",
        R"({"effects":{"floor_friction":{"deceleration":0}}})",
        R"({"name":"\u00e4\ud83d\ude00\n\t\"\\\/"})",
        "{\"name\":\"\xC3\xA4\xF0\x9F\x98\x80\"}",
        R"({"disks":[{"radius":4.9e-324}]})",
        R"({"disks":[{"radius":1.7976931348623157e308}]})",
        R"({"seed":"42","period":{"x":3}})"}) {
    expect_as_the_library(json);
  }
}

TEST(SceneJson, RandomScenesThatTheLibraryPrintsReadBack) {
  std::mt19937_64 generator(seed());
  const auto number = [&] {
    for (;;) {
      double value = 0;
      const std::uint64_t bits = generator();
      static_assert(sizeof value == sizeof bits);
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) return value;
    }
  };
  for (int round = 0; round < 300; ++round) {
    Scene scene;
    scene.set_seed(generator());
    scene.mutable_start()->set_seconds(static_cast<std::int64_t>(generator()));
    scene.mutable_start()->set_fraction(generator());
    for (unsigned i = 0; i < generator() % 5; ++i) {
      Disk& disk = *scene.add_disks();
      disk.set_id(generator());
      disk.set_name("\xC3\xA4 \"disk\"\n" + std::to_string(i));
      disk.set_kind(static_cast<Disk::Kind>(generator() % 3));
      disk.mutable_position()->set_x(number());
      disk.mutable_position()->set_y(number());
      if (generator() % 2 == 0) disk.set_mass(number());
      disk.set_radius(number());
      disk.set_spin(number());
    }
    for (unsigned i = 0; i < generator() % 3; ++i) {
      scene.add_walls()->mutable_end()->set_x(number());
    }
    if (generator() % 2 == 0) {
      scene.mutable_effects()->mutable_restitution()->set_coefficient(number());
    }
    google::protobuf::util::JsonPrintOptions options;
    options.preserve_proto_field_names = generator() % 2 == 0;
    options.add_whitespace = generator() % 2 == 0;
    options.always_print_primitive_fields = generator() % 2 == 0;
    std::string json;
    ASSERT_TRUE(google::protobuf::util::MessageToJsonString(scene, &json, options).ok());
    expect_as_the_library(json);
  }
}

// Whatever bytes come: no crash, and nothing accepted that the library's laxer reader refuses.
TEST(SceneJson, DamagedTextIsNeverTakenForMore) {
  std::mt19937_64 generator(seed());
  const std::string good =
      R"({"name":"b\u00e4","start":{"seconds":"1"},"disks":[{"id":"7","kind":"STATIC",)"
      R"("position":{"x":1.5,"y":-2e3},"radius":0.5,"mass":"2"},{"radius":1}],)"
      R"("effects":{"rough":{"friction":0.1}},"seed":3})";
  const std::string alphabet = "{}[],:\"\\0123456789eE+-.untrfalsxy \n\xC3\x80";
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = good;
    const std::uint64_t changes = 1 + generator() % 3;
    for (std::uint64_t i = 0; i < changes; ++i) {
      const std::size_t at = generator() % text.size();
      const char c = alphabet[generator() % alphabet.size()];
      switch (generator() % 3) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.erase(at, 1 + generator() % 4);
          break;
        default:
          text.insert(at, 1, c);
          break;
      }
    }
    const auto got = ours(text);
    if (!got) continue;
    ++accepted;
    const auto wanted = theirs(text);
    ASSERT_TRUE(wanted) << text;
    ASSERT_EQ(got->SerializeAsString(), wanted->SerializeAsString()) << text;
  }
  EXPECT_GT(accepted, 100);
}

TEST(SceneJson, WhatIsNoJsonIsRefused) {
  expect_error("", "", "the end of the file");
  expect_error("{", "", "expected a field's name");
  expect_error("{} x", "", "expected the end of the file");
  expect_error("[]", "", "to open an object");
  expect_error("{disks:[]}", "", "expected a field's name in quotes");
  expect_error("{'disks':[]}", "", "expected a field's name in quotes");
  expect_error(R"({"disks":[{"radius":1},]})", "disks[1]", "to open an object");
  expect_error(R"({"disks":{}})", "disks", "to open a list");
  expect_error(R"({"disks":[{"radius":1})", "disks", "after an element");
  expect_error(R"({"disks":[{"radius":01}]})", "disks[0]", "after a member");
  expect_error(R"({"disks":[{"radius":1.}]})", "disks[0].radius", "expected a digit");
  expect_error(R"({"disks":[{"radius":+1}]})", "disks[0].radius", "but found '+'");
  expect_error(R"({"disks":[{"radius":NaN}]})", "disks[0].radius", "but found 'N'");
  expect_error(R"({"disks":[null]})", "disks[0]", "to open an object");
  expect_error("{\"name\":\"a", "name", "not closed");
  expect_error("{\"name\":\"\xFF\"}", "name", "not UTF-8");
  expect_error("{\"name\":\"a\nb\"}", "name", "control character");
  expect_error(R"({"name":"\q"})", "name", "begins no escape");
  expect_error(R"({"name":"\ud800"})", "name", "surrogate");
  expect_error(R"({"name":"\u12"})", "name", "four hexadecimal digits");
}

TEST(SceneJson, WhatIsNoSceneIsRefusedWithItsPlace) {
  expect_error(R"({"disks":[{},{"radios":1}]})", "disks[1]", "\"radios\" is not a field of Disk");
  expect_error(R"({"disks":[{"radios":1}]})", "disks[0]", "radius, mass");
  expect_error(R"({"disks":[{"radius":1,"radius":2}]})", "disks[0].radius", "given twice");
  expect_error(R"({"disks":[{"radius":"x"}]})", "disks[0].radius", "\"x\" is not a number");
  expect_error(R"({"disks":[{"radius":1e999}]})", "disks[0].radius", "in the range of doubles");
  expect_error(R"({"disks":[{"radius":true}]})", "disks[0].radius", "expected a number");
  expect_error(R"({"disks":[{"id":-1}]})", "disks[0].id", "integer from 0");
  expect_error(R"({"disks":[{"id":1.5}]})", "disks[0].id", "integer from 0");
  expect_error(R"({"disks":[{"id":18446744073709551616}]})", "disks[0].id", "integer from 0");
  expect_error(R"({"disks":[{"kind":"FAST"}]})", "disks[0].kind", "DYNAMIC, KINEMATIC, STATIC");
  expect_error(R"({"disks":[{"kind":7}]})", "disks[0].kind", "none of");
  expect_error(R"({"name":3})", "name", "expected a string");
  expect_error(R"({"effects":{"wind":{}}})", "effects", "\"wind\" is not a field of Effects");
  expect_error(
      R"({"walls":[{"start":{"x":1,"z":2}}]})", "walls[0].start", "not a field of Vector2");
}

TEST(SceneJson, LocatesFieldsAndWhatEnclosesMissingOnes) {
  const std::string json = R"({"disks":[{"radius":1},{"radius":-2}],"period":{"x":1}})";
  const Scene scene;
  EXPECT_EQ(idl::locate_json(json, scene, "disks[1].radius"), json.find("-2"));
  EXPECT_EQ(idl::locate_json(json, scene, "disks[1].mass"), json.find(R"({"radius":-2)"));
  EXPECT_EQ(idl::locate_json(json, scene, "period.x"), json.find("1}}"));
  EXPECT_EQ(idl::locate_json(json, scene, "name"), 0U);
}

}  // namespace
}  // namespace stoss::tests

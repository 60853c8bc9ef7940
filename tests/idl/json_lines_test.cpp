// SPDX-License-Identifier: Apache-2.0
// The hand-written JSON Lines against Protobuf's own reader and printer.
#include <stoss/idl/json_lines.hpp>
#include <stoss/idl/sequence.hpp>

#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>
#include <scene.pb.h>

#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

constexpr std::uint64_t kSeed = 9001;

void set(Vector2* to, const idl::Pair& from) {
  to->set_x(from.x);
  to->set_y(from.y);
}

Collision message_of(const idl::CollisionLine& line) {
  Collision out;
  out.set_sequence(line.sequence);
  out.mutable_instant()->set_seconds(line.seconds);
  out.mutable_instant()->set_fraction(line.fraction);
  out.set_kind(static_cast<Collision::Kind>(line.kind));
  out.set_a(line.a);
  out.set_b(line.b);
  set(out.mutable_point(), line.point);
  set(out.mutable_normal(), line.normal);
  out.set_impulse(line.impulse);
  out.set_approach_speed(line.approach_speed);
  set(out.mutable_velocity_a(), line.velocity_a);
  set(out.mutable_velocity_b(), line.velocity_b);
  out.set_spin_a(line.spin_a);
  out.set_spin_b(line.spin_b);
  out.set_regularised(line.regularised);
  out.set_order_dependent(line.order_dependent);
  return out;
}

BodyState message_of(const idl::BodyStateLine& line) {
  BodyState out;
  out.set_id(line.id);
  out.mutable_instant()->set_seconds(line.seconds);
  out.mutable_instant()->set_fraction(line.fraction);
  set(out.mutable_position(), line.position);
  set(out.mutable_velocity(), line.velocity);
  out.set_angle(line.angle);
  out.set_spin(line.spin);
  out.set_radius(line.radius);
  return out;
}

ZoneEvent message_of(const idl::ZoneEventLine& line) {
  ZoneEvent out;
  out.set_sequence(line.sequence);
  out.mutable_instant()->set_seconds(line.seconds);
  out.mutable_instant()->set_fraction(line.fraction);
  out.set_zone(line.zone);
  out.set_body(line.body);
  out.set_entered(line.entered);
  set(out.mutable_position(), line.position);
  set(out.mutable_velocity(), line.velocity);
  return out;
}

template <class Message>
Message parsed(const std::string& json) {
  Message out;
  const auto status = google::protobuf::util::JsonStringToMessage(json, &out);
  EXPECT_TRUE(status.ok()) << status.ToString() << "\n" << json;
  return out;
}

// The same message bit for bit: -0 is not 0, and a NaN is a NaN.
template <class Message>
void expect_same(const Message& read, const Message& wanted, const std::string& json) {
  EXPECT_EQ(read.SerializeAsString(), wanted.SerializeAsString()) << json << "\n"
                                                                  << wanted.ShortDebugString();
}

void check(const idl::CollisionLine& line) {
  std::string json;
  idl::append_collision(json, line);
  expect_same(parsed<Collision>(json), message_of(line), json);
}

void check(const idl::ZoneEventLine& line) {
  std::string json;
  idl::append_zone_event(json, line);
  expect_same(parsed<ZoneEvent>(json), message_of(line), json);
}

void check(const idl::BodyStateLine& line) {
  std::string json;
  idl::append_body_state(json, line);
  expect_same(parsed<BodyState>(json), message_of(line), json);
}

// A double of random bits, but no NaN, whose payload JSON does not carry.
double any_double(std::mt19937_64& generator) {
  for (;;) {
    const double value = std::bit_cast<double>(generator());
    if (!std::isnan(value)) return value;
  }
}

TEST(JsonLines, DefaultsAreLeftOutAndMessagesStay) {
  std::string json;
  idl::append_collision(json, {});
  EXPECT_EQ(json, R"({"instant":{},"point":{},"normal":{},"velocity_a":{},"velocity_b":{}})");
  json.clear();
  idl::append_body_state(json, {});
  EXPECT_EQ(json, R"({"instant":{},"position":{},"velocity":{}})");
}

TEST(JsonLines, EveryFieldHasItsNameAndForm) {
  idl::CollisionLine line;
  line.sequence = 7;
  line.seconds = -2;
  line.fraction = UINT64_C(1) << 63U;
  line.kind = idl::CollisionKind::kDiskWallEnd;
  line.a = 1;
  line.b = UINT64_MAX;
  line.point = {0.1, 0};
  line.normal = {0, -1};
  line.impulse = 1e22;
  line.approach_speed = 1.0 / 3;
  line.velocity_a = {5e-324, 2};
  line.spin_b = -0.5;
  line.regularised = true;
  line.order_dependent = true;
  std::string json;
  idl::append_collision(json, line);
  EXPECT_EQ(json,
            R"({"sequence":"7","instant":{"seconds":"-2","fraction":"9223372036854775808"},)"
            R"("kind":"DISK_WALL_END","a":"1","b":"18446744073709551615","point":{"x":0.1},)"
            R"("normal":{"y":-1},"impulse":1e+22,"approach_speed":0.3333333333333333,)"
            R"("velocity_a":{"x":5e-324,"y":2},"velocity_b":{},"spin_b":-0.5,)"
            R"("regularised":true,"order_dependent":true})");
  check(line);
}

TEST(JsonLines, ZoneEventsHaveTheirNamesAndForms) {
  const idl::ZoneEventLine line{.sequence = 3,
                                .seconds = 1,
                                .fraction = 5,
                                .zone = 9,
                                .body = UINT64_MAX,
                                .entered = true,
                                .position = {0.1, -0.0},
                                .velocity = {-2, 1e-300}};
  std::string json;
  idl::append_zone_event(json, line);
  EXPECT_EQ(json,
            R"({"sequence":"3","instant":{"seconds":"1","fraction":"5"},"zone":"9",)"
            R"("body":"18446744073709551615","entered":true,"position":{"x":0.1,"y":-0.0},)"
            R"("velocity":{"x":-2,"y":1e-300}})");
  check(line);
  check(idl::ZoneEventLine{});
}

TEST(JsonLines, HardValuesReadBackToTheSameBits) {
  const std::vector<double> hard{0.0,
                                 -0.0,
                                 1e-300,
                                 -1e300,
                                 std::numeric_limits<double>::denorm_min(),
                                 std::numeric_limits<double>::min(),
                                 std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::lowest(),
                                 std::numeric_limits<double>::epsilon(),
                                 std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(),
                                 9007199254740993.0,
                                 123456789012345678.0,
                                 0.1 + 0.2,
                                 1e21,
                                 1e22,
                                 1e23};
  for (const double value : hard) {
    idl::BodyStateLine state;
    state.position = {value, -value};
    state.angle = value;
    state.radius = -value;
    check(state);
    idl::CollisionLine collision;
    collision.impulse = value;
    collision.velocity_b.y = value;
    check(collision);
  }
}

TEST(JsonLines, InstantsAtTheEndsOfTheirRanges) {
  for (const std::int64_t seconds : {INT64_MIN, std::int64_t{-1}, std::int64_t{0}, INT64_MAX}) {
    for (const std::uint64_t fraction :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 63U, UINT64_MAX}) {
      idl::BodyStateLine line;
      line.seconds = seconds;
      line.fraction = fraction;
      line.id = fraction;
      check(line);
    }
  }
}

TEST(JsonLines, NanIsNan) {
  std::string json;
  idl::BodyStateLine line;
  line.spin = std::numeric_limits<double>::quiet_NaN();
  idl::append_body_state(json, line);
  EXPECT_TRUE(std::isnan(parsed<BodyState>(json).spin()));
}

TEST(JsonLines, RandomLinesReadBackToTheSameBits) {
  std::mt19937_64 generator(kSeed);
  const auto pair = [&] { return idl::Pair{any_double(generator), any_double(generator)}; };
  for (int i = 0; i < 3000; ++i) {
    idl::CollisionLine line;
    line.sequence = generator();
    line.seconds = static_cast<std::int64_t>(generator());
    line.fraction = generator();
    line.kind = static_cast<idl::CollisionKind>(generator() % 3);
    line.a = generator();
    line.b = generator();
    line.point = pair();
    line.normal = pair();
    line.impulse = any_double(generator);
    line.approach_speed = any_double(generator);
    line.velocity_a = pair();
    line.velocity_b = pair();
    line.spin_a = any_double(generator);
    line.spin_b = any_double(generator);
    line.regularised = generator() % 2 == 0;
    line.order_dependent = generator() % 2 == 0;
    check(line);
    idl::BodyStateLine state;
    state.id = generator();
    state.position = pair();
    state.velocity = pair();
    state.radius = any_double(generator);
    check(state);
  }
}

TEST(JsonLines, NumbersAreInTheShortestForm) {
  std::mt19937_64 generator(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const double value = any_double(generator);
    if (std::isinf(value)) continue;
    std::string text;
    idl::append_number(text, value);
    double back = 0;
    ASSERT_EQ(std::from_chars(text.data(), text.data() + text.size(), back).ec, std::errc());
    ASSERT_EQ(back, value);
    char room[32];
    const auto exact = std::to_chars(room, room + sizeof room, value);
    EXPECT_LE(text.size(), static_cast<std::size_t>(exact.ptr - room));
  }
}

TEST(JsonLines, StringsAreEscaped) {
  std::string out;
  idl::append_string(out, "a\"b\\c\n\x01\xC3\xA4\xFF");
  EXPECT_EQ(out, "\"a\\\"b\\\\c\\u000a\\u0001\xC3\xA4\xEF\xBF\xBD\"");
  const std::string json = "{\"name\":" + out + "}";
  EXPECT_EQ(parsed<Disk>(json).name(), "a\"b\\c\n\x01\xC3\xA4\xEF\xBF\xBD");
}

TEST(JsonLines, BlocksBecomeLines) {
  const std::vector<double> numbers{1, 2};
  const std::vector<std::uint64_t> ids{10, 20};
  const std::vector<std::uint8_t> flags{0, idl::kRegularised | idl::kOrderDependent};
  idl::wire::CollisionBlock block{};
  idl::lend(block.a, std::span<const std::uint64_t>(ids));
  idl::lend(block.impulse, std::span<const double>(numbers));
  idl::lend(block.flags, std::span<const std::uint8_t>(flags));
  const idl::CollisionLine line = idl::collision_line(block, 100, 1);
  EXPECT_EQ(line.sequence, 101U);
  EXPECT_EQ(line.a, 20U);
  EXPECT_EQ(line.impulse, 2);
  EXPECT_EQ(line.spin_a, 0) << "an empty array means the default";
  EXPECT_TRUE(line.regularised);
  EXPECT_TRUE(line.order_dependent);

  idl::wire::StateBlock states{};
  idl::lend(states.id, std::span<const std::uint64_t>(ids));
  idl::lend(states.x, std::span<const double>(numbers));
  const idl::BodyStateLine state = idl::body_state_line(states, {5, 6}, 0);
  EXPECT_EQ(state.id, 10U);
  EXPECT_EQ(state.seconds, 5);
  EXPECT_EQ(state.fraction, 6U);
  EXPECT_EQ(state.position.x, 1);
}

// Not a gate, a figure: what a line costs here.
TEST(JsonLines, SpeedIsPrinted) {
  idl::CollisionLine line;
  std::mt19937_64 generator(kSeed);
  std::normal_distribution<double> normal;
  line.point = {normal(generator), normal(generator)};
  line.velocity_a = {normal(generator), normal(generator)};
  line.velocity_b = {normal(generator), normal(generator)};
  line.normal = {0.6, 0.8};
  line.impulse = normal(generator);
  std::string out;
  constexpr int kLines = 100000;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kLines; ++i) {
    out.clear();
    line.sequence = static_cast<std::uint64_t>(i);
    idl::append_collision(out, line);
  }
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  std::printf("%.0f ns a collision line of %zu bytes\n", took.count() / kLines, out.size());
}

}  // namespace
}  // namespace stoss::tests

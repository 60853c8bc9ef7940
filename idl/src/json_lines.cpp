// SPDX-License-Identifier: Apache-2.0
#include "utf8.hpp"

#include <stoss/idl/json_lines.hpp>
#include <stoss/idl/sequence.hpp>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>

namespace stoss::idl {
namespace {

// Enough for any 64-bit integer and any double in its shortest form.
constexpr std::size_t kNumberRoom = 32;

template <class Number>
void append_chars(std::string& out, Number value) {
  std::array<char, kNumberRoom> room;
  const std::to_chars_result end = std::to_chars(room.data(), room.data() + room.size(), value);
  out.append(room.data(), end.ptr);
}

// Protobuf's notion of a default is one of bits: -0 is a value of its own.
bool is_default(double value) noexcept { return std::bit_cast<std::uint64_t>(value) == 0; }

// Writes the members of one object, with commas between them and defaults left out.
class Object {
 public:
  explicit Object(std::string& out) : out_(out) { out_ += '{'; }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() { out_ += '}'; }

  void key(std::string_view name) {
    if (!first_) out_ += ',';
    first_ = false;
    out_ += '"';
    out_ += name;
    out_ += "\":";
  }
  void number(std::string_view name, double value) {
    if (is_default(value)) return;
    key(name);
    append_number(out_, value);
  }
  template <class Integer>
  void integer(std::string_view name, Integer value) {
    if (value == 0) return;
    key(name);
    out_ += '"';
    append_chars(out_, value);
    out_ += '"';
  }
  void pair(std::string_view name, const Pair& value) {
    key(name);
    Object object(out_);
    object.number("x", value.x);
    object.number("y", value.y);
  }
  void instant(std::string_view name, std::int64_t seconds, std::uint64_t fraction) {
    key(name);
    Object object(out_);
    object.integer("seconds", seconds);
    object.integer("fraction", fraction);
  }
  void flag(std::string_view name, bool value) {
    if (!value) return;
    key(name);
    out_ += "true";
  }
  void word(std::string_view name, std::string_view value) {
    key(name);
    out_ += '"';
    out_ += value;
    out_ += '"';
  }

 private:
  std::string& out_;
  bool first_ = true;
};

}  // namespace

void append_number(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "\"NaN\"";
  } else if (std::isinf(value)) {
    out += value > 0 ? "\"Infinity\"" : "\"-Infinity\"";
  } else if (value == 0) {
    // "-0" would be read as an integer, which has no such value.
    out += std::signbit(value) ? "-0.0" : "0";
  } else {
    append_chars(out, value);
  }
}

void append_string(std::string& out, std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  constexpr unsigned kFirstPrintable = 0x20U;
  out += '"';
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (length == 0) {
      out += "\xEF\xBF\xBD";
    } else if (byte == '"' || byte == '\\') {
      out += '\\';
      out += text.front();
    } else if (byte < kFirstPrintable) {
      out += "\\u00";
      out += kDigits[byte / 16U];
      out += kDigits[byte % 16U];
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  out += '"';
}

void append_collision(std::string& out, const CollisionLine& collision) {
  Object object(out);
  object.integer("sequence", collision.sequence);
  object.instant("instant", collision.seconds, collision.fraction);
  if (collision.kind != CollisionKind::kDiskDisk) object.word("kind", name_of(collision.kind));
  object.integer("a", collision.a);
  object.integer("b", collision.b);
  object.pair("point", collision.point);
  object.pair("normal", collision.normal);
  object.number("impulse", collision.impulse);
  object.number("approach_speed", collision.approach_speed);
  object.pair("velocity_a", collision.velocity_a);
  object.pair("velocity_b", collision.velocity_b);
  object.number("spin_a", collision.spin_a);
  object.number("spin_b", collision.spin_b);
  object.flag("regularised", collision.regularised);
  object.flag("order_dependent", collision.order_dependent);
}

void append_zone_event(std::string& out, const ZoneEventLine& event) {
  Object object(out);
  object.integer("sequence", event.sequence);
  object.instant("instant", event.seconds, event.fraction);
  object.integer("zone", event.zone);
  object.integer("body", event.body);
  object.flag("entered", event.entered);
  object.pair("position", event.position);
  object.pair("velocity", event.velocity);
}

void append_body_state(std::string& out, const BodyStateLine& state) {
  Object object(out);
  object.integer("id", state.id);
  object.instant("instant", state.seconds, state.fraction);
  object.pair("position", state.position);
  object.pair("velocity", state.velocity);
  object.number("angle", state.angle);
  object.number("spin", state.spin);
  object.number("radius", state.radius);
}

CollisionLine collision_line(const wire::CollisionBlock& block,
                             std::uint64_t first_number,
                             std::size_t i) {
  CollisionLine line;
  line.sequence = first_number + i;
  line.seconds = at_or(block.seconds, i, 0);
  line.fraction = at_or(block.fraction, i, 0);
  line.kind = static_cast<CollisionKind>(at_or(block.kind, i, 0));
  line.a = at_or(block.a, i, 0);
  line.b = at_or(block.b, i, 0);
  line.point = {at_or(block.point_x, i, 0), at_or(block.point_y, i, 0)};
  line.normal = {at_or(block.normal_x, i, 0), at_or(block.normal_y, i, 0)};
  line.impulse = at_or(block.impulse, i, 0);
  line.approach_speed = at_or(block.approach_speed, i, 0);
  line.velocity_a = {at_or(block.velocity_a_x, i, 0), at_or(block.velocity_a_y, i, 0)};
  line.velocity_b = {at_or(block.velocity_b_x, i, 0), at_or(block.velocity_b_y, i, 0)};
  line.spin_a = at_or(block.spin_a, i, 0);
  line.spin_b = at_or(block.spin_b, i, 0);
  const std::uint8_t flags = at_or(block.flags, i, 0);
  line.regularised = (flags & kRegularised) != 0;
  line.order_dependent = (flags & kOrderDependent) != 0;
  return line;
}

BodyStateLine body_state_line(const wire::StateBlock& block,
                              const wire::Instant& at,
                              std::size_t i) {
  BodyStateLine line;
  line.id = at_or(block.id, i, 0);
  line.seconds = at.seconds;
  line.fraction = at.fraction;
  line.position = {at_or(block.x, i, 0), at_or(block.y, i, 0)};
  line.velocity = {at_or(block.vx, i, 0), at_or(block.vy, i, 0)};
  line.angle = at_or(block.angle, i, 0);
  line.spin = at_or(block.spin, i, 0);
  line.radius = at_or(block.radius, i, 0);
  return line;
}

}  // namespace stoss::idl

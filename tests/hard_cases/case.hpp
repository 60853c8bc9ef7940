// SPDX-License-Identifier: Apache-2.0
#pragma once

// One hard case: inputs are exact doubles in C99 hexadecimal, expected values are decimal strings
// of 40 digits, compared in 400 bits.

#include "support/oracle.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stoss::hard_cases {

using nlohmann::json;
using test::Real;
using test::Real2;

class Case {
 public:
  explicit Case(json data) : data_(std::move(data)) {}

  std::string name() const { return data_.at("name").get<std::string>(); }
  std::string kind() const { return data_.at("kind").get<std::string>(); }

  const json& inputs() const { return data_.at("inputs_hex"); }
  const json& expected() const { return data_.at("expected"); }
  bool has(const char* key) const { return inputs().contains(key); }
  double number(const char* key) const { return number(inputs().at(key)); }
  engine::Vector2 vector(const char* key) const { return vector(inputs().at(key)); }

  static double number(const json& hex) {
    return std::strtod(hex.get_ref<const std::string&>().c_str(), nullptr);
  }
  static engine::Vector2 vector(const json& hex) { return {number(hex.at(0)), number(hex.at(1))}; }

  /// An expected value; some are plain zeros.
  static Real real(const json& value) {
    return value.is_string() ? Real(value.get_ref<const std::string&>())
                             : Real(value.get<double>());
  }
  static Real2 real2(const json& value) { return {real(value.at(0)), real(value.at(1))}; }

  /// The tolerance of that name; `otherwise` when the case has none.
  double tolerance(const char* key, double otherwise) const {
    return data_.at("tolerance").value(key, otherwise);
  }

 private:
  json data_;
};

// Each returns the reason for which a part of the case was left out; empty: none was.

std::string run_pair(const Case& c);
std::string run_epoch_pair(const Case& c);
std::string run_segment(const Case& c);
std::string run_two_segments(const Case& c);
std::string run_polyline_slide(const Case& c);
std::string run_galperin(const Case& c);
std::string run_cradle(const Case& c);
std::string run_box_long_run(const Case& c);
std::string run_simultaneous_nonunique(const Case& c);
std::string run_tie_order(const Case& c);
std::string run_repeated_rule(const Case& c);
std::string run_scene_events(const Case& c);
std::string run_invalid_input(const Case& c);
std::string run_gravity_segment(const Case& c);
std::string run_gravity_corner(const Case& c);
std::string run_bounce_series(const Case& c);
std::string run_resting(const Case& c);
std::string run_friction_pair(const Case& c);
std::string run_growing_pair(const Case& c);
std::string run_drag_pair(const Case& c);

/// Seconds between two instants, exactly.
inline Real seconds_from(const engine::Instant& start, const engine::Instant& t) {
  return test::exact(engine::difference<double>(t, start));
}

/// An instant holds multiples of 2^-64 s; no time can be better than half of that.
inline Real grid() { return Real(0x1p-65); }

/// The contact is when it should be: within t_rel (8 ulp when not given) of the time since `start`,
/// or t_abs.
inline void expect_time(const Case& c, const engine::Instant& start, const engine::Instant& at) {
  const Real truth = Case::real(c.expected().at("t"));
  const Real allowed =
      truth * Real(c.tolerance("t_rel", 0x1p-49)) + Real(c.tolerance("t_abs", 0)) + grid();
  EXPECT_LE(abs(seconds_from(start, at) - truth), allowed)
      << "contact at " << at.seconds << " s + " << at.fraction;
}

inline Real norm(const Real2& v) { return sqrt(test::dot(v, v)); }

/// The body's stored velocity, both words.
inline Real2 velocity_of(const engine::World& world, engine::Id id) {
  const engine::MotionRecord m = world.motion(id).value();
  return {Real(m.vx.high) + Real(m.vx.low), Real(m.vy.high) + Real(m.vy.low)};
}

/// Within v_rel of the larger of the expected speed and `scale`, or v_abs.
inline void expect_vector(const Case& c, const Real2& value, const Real2& truth, double scale) {
  const Real size = norm(truth) > Real(scale) ? norm(truth) : Real(scale);
  const Real allowed = size * Real(c.tolerance("v_rel", 0)) + Real(c.tolerance("v_abs", 0));
  EXPECT_LE(norm({value.x - truth.x, value.y - truth.y}), allowed)
      << value.x << ' ' << value.y << " should be " << truth.x << ' ' << truth.y;
}

/// The case's coefficient of restitution, if it has one.
inline engine::Effects effects_of(const Case& c) {
  engine::Effects effects;
  if (c.has("e") && c.number("e") != 1) {
    effects.restitution = engine::Restitution{c.number("e"), c.number("e"), 0, 0};
  }
  return effects;
}

inline engine::World world_of(const Case& c, const engine::Instant& start = {}) {
  return engine::World(engine::WorldOptions{.start = start, .effects = effects_of(c)});
}

/// The case's disk, with id 1.
inline engine::DiskSpec disk_of(const Case& c) {
  return test::disk(1, c.vector("p"), c.vector("v"), c.number("r"));
}

}  // namespace stoss::hard_cases

// SPDX-License-Identifier: Apache-2.0
// A disk and walls.

#include "contact_time/disk_wall.hpp"
#include "hard_cases/case.hpp"

namespace stoss::hard_cases {

namespace {

using engine::Collision;
using engine::ContactKind;
using engine::Instant;
using engine::Vector2;
using engine::WallSpec;
using engine::World;

WallSpec wall_of(const Case& c) {
  const Vector2 velocity = c.has("wall_velocity") ? c.vector("wall_velocity") : Vector2(0, 0);
  return test::wall(2, c.vector("a"), c.vector("b"), velocity);
}

// A wall of no length is refused; as a point, the kernel meets it.
std::string run_point(const Case& c) {
  World world = world_of(c);
  const WallSpec spec = wall_of(c);
  const auto outcome = world.spawn({{}, std::span(&spec, 1)});
  EXPECT_TRUE(!outcome.ok() && outcome.reject().code == engine::Code::InvalidArgument);
  const Vector2 p = c.vector("p") - c.vector("a");
  const Vector2 v = c.vector("v");
  const engine::RelativeMotion<double> motion{{{p.x(), 0}, {p.y(), 0}}, {{v.x(), 0}, {v.y(), 0}}};
  const auto t = engine::disk_point_contact(motion, c.number("r"));
  const Real truth = Case::real(c.expected().at("t"));
  EXPECT_TRUE(t && abs(test::exact(*t) - truth) <= truth * Real(c.tolerance("t_rel", 0)));
  return "through the kernel; the world refuses a wall of no length";
}

void expect_feature(const Case& c, const Collision& collision) {
  const auto feature = c.expected().at("feature").get<std::string>();
  if (feature == "interior") {
    EXPECT_EQ(collision.kind, ContactKind::DiskWall);
    return;
  }
  EXPECT_EQ(collision.kind, ContactKind::DiskWallEnd);
  const Vector2 end = c.vector(feature == "endpoint_a" ? "a" : "b");
  EXPECT_LT((collision.point - end).norm(), 1e-14);
}

}  // namespace

std::string run_segment(const Case& c) {
  if (c.vector("a") == c.vector("b")) return run_point(c);
  World world = world_of(c);
  const WallSpec spec = wall_of(c);
  test::must_spawn(world, {disk_of(c)}, std::span(&spec, 1));
  const auto log = test::run_until(world, Instant{std::int64_t{1} << 50, 0});
  const bool event = c.expected().at("event").get<bool>();
  EXPECT_EQ(log.size(), event ? 1U : 0U);
  if (!event || log.empty()) return "";
  expect_time(c, {}, log[0].instant);
  expect_feature(c, log[0]);
  const Real2 normal = Case::real2(c.expected().at("normal"));  // from the wall to the disk
  EXPECT_LE(norm({Real(log[0].normal.x()) + normal.x, Real(log[0].normal.y()) + normal.y}),
            Real(4e-15));
  expect_vector(c, velocity_of(world, 1), Case::real2(c.expected().at("v_after")), 0);
  return "";
}

std::string run_two_segments(const Case& c) {
  World world = world_of(c);
  std::vector<WallSpec> walls;
  for (const json& segment : c.inputs().at("segments")) {
    walls.push_back(
        test::wall(2 + walls.size(), Case::vector(segment.at(0)), Case::vector(segment.at(1))));
  }
  test::must_spawn(world, {disk_of(c)}, walls);
  const auto log = test::run_for(world, 5);
  EXPECT_EQ(log.size(), c.expected().at("n_reflections").get<std::size_t>());
  for (const Collision& collision : log) {
    expect_time(c, {}, collision.instant);
    EXPECT_FALSE(collision.order_dependent);
  }
  expect_vector(c, velocity_of(world, 1), Case::real2(c.expected().at("v_after")), 0);
  return "";
}

std::string run_polyline_slide(const Case& c) {
  World world = world_of(c);
  std::vector<Vector2> vertices;
  for (const json& point : c.inputs().at("points")) vertices.push_back(Case::vector(point));
  test::must_spawn(world, {disk_of(c)}, test::chain(2, vertices));
  const auto log = test::run_for(world, c.number("T"));
  EXPECT_EQ(log.size(), c.expected().at("events").get<std::size_t>());
  const engine::BodyState state = test::state(world, 1);
  const Real2 position = Case::real2(c.expected().at("p_final"));
  EXPECT_EQ(Real(state.position.x()), position.x);
  EXPECT_EQ(Real(state.position.y()), position.y);
  const Real2 velocity = Case::real2(c.expected().at("v_final"));
  EXPECT_EQ(Real(state.velocity.x()), velocity.x);
  EXPECT_EQ(Real(state.velocity.y()), velocity.y);
  return "";
}

}  // namespace stoss::hard_cases

// SPDX-License-Identifier: Apache-2.0
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/columns.hpp>

#include <algorithm>
#include <initializer_list>

namespace stoss::translate {
namespace {

using idl::at_or;

bool all_are(std::size_t rows, std::initializer_list<std::uint32_t> lengths) {
  return std::all_of(lengths.begin(), lengths.end(), [&](auto n) { return n == rows; });
}

bool all_are_or_empty(std::size_t rows, std::initializer_list<std::uint32_t> lengths) {
  return std::all_of(lengths.begin(), lengths.end(), [&](auto n) { return n == rows || n == 0; });
}

bool known_kind(std::uint8_t kind) {
  return kind == stoss_v1_KIND_WALL || body_kind_of(kind).has_value();
}

}  // namespace

bool consistent(const wire::StateBlock& block) {
  const std::size_t rows = block.id._length;
  return all_are(rows,
                 {block.kind._length,
                  block.x._length,
                  block.y._length,
                  block.vx._length,
                  block.vy._length,
                  block.radius._length}) &&
         all_are_or_empty(rows,
                          {block.angle._length, block.spin._length, block.distance._length}) &&
         std::ranges::all_of(idl::view(block.kind), known_kind);
}

bool consistent(const wire::WallBlock& block) {
  return all_are(block.id._length,
                 {block.start_x._length,
                  block.start_y._length,
                  block.end_x._length,
                  block.end_y._length}) &&
         all_are_or_empty(block.id._length, {block.vx._length, block.vy._length});
}

bool consistent(const wire::MotionBlock& block) {
  const std::size_t rows = block.id._length;
  return all_are(rows,
                 {block.change._length,
                  block.law._length,
                  block.x._length,
                  block.y._length,
                  block.x_low._length,
                  block.y_low._length,
                  block.vx._length,
                  block.vy._length,
                  block.vx_low._length,
                  block.vy_low._length,
                  block.seconds._length,
                  block.fraction._length}) &&
         all_are_or_empty(rows,
                          {block.angle._length,
                           block.spin._length,
                           block.ax._length,
                           block.ay._length,
                           block.ax_low._length,
                           block.ay_low._length,
                           block.rate._length}) &&
         std::ranges::all_of(idl::view(block.change),
                             [](std::uint8_t value) { return change_of(value).has_value(); }) &&
         std::ranges::all_of(idl::view(block.law),
                             [](std::uint8_t value) { return value <= stoss_v1_LAW_GROWING; });
}

bool consistent(const wire::StaticBlock& block) {
  const std::size_t rows = block.id._length;
  const auto kinds = idl::view(block.kind);
  const bool has_wall = std::ranges::find(kinds, stoss_v1_KIND_WALL) != kinds.end();
  const std::initializer_list<std::uint32_t> edges = {block.edge_x._length,
                                                      block.edge_y._length,
                                                      block.edge_x_low._length,
                                                      block.edge_y_low._length};
  return all_are(rows, {block.kind._length, block.radius._length, block.mass._length}) &&
         (has_wall ? all_are(rows, edges) : all_are_or_empty(rows, edges)) &&
         std::ranges::all_of(kinds, known_kind);
}

bool consistent(const wire::CollisionBlock& block) {
  const std::size_t rows = block.a._length;
  return all_are(rows,
                 {block.seconds._length,
                  block.fraction._length,
                  block.kind._length,
                  block.flags._length,
                  block.b._length,
                  block.point_x._length,
                  block.point_y._length,
                  block.normal_x._length,
                  block.normal_y._length,
                  block.impulse._length,
                  block.approach_speed._length,
                  block.velocity_a_x._length,
                  block.velocity_a_y._length,
                  block.velocity_b_x._length,
                  block.velocity_b_y._length}) &&
         all_are_or_empty(rows, {block.spin_a._length, block.spin_b._length}) &&
         std::ranges::all_of(idl::view(block.kind),
                             [](std::uint8_t value) { return contact_kind_of(value).has_value(); });
}

bool consistent(const wire::ZoneEventBlock& block) {
  return all_are(block.zone._length,
                 {block.seconds._length,
                  block.fraction._length,
                  block.body._length,
                  block.entered._length,
                  block.x._length,
                  block.y._length,
                  block.vx._length,
                  block.vy._length});
}

bool consistent(const wire::HitBlock& block) {
  return all_are(block.id._length,
                 {block.distance._length,
                  block.x._length,
                  block.y._length,
                  block.normal_x._length,
                  block.normal_y._length});
}

engine::MotionRecord motion_at(const wire::MotionBlock& block, std::size_t i) {
  const std::uint8_t law = block.law._buffer[i];
  const bool grows = law == stoss_v1_LAW_GROWING;
  const engine::SplitNumber ax{at_or(block.ax, i, 0), at_or(block.ax_low, i, 0)};
  const double rate = at_or(block.rate, i, 0);
  return {.id = block.id._buffer[i],
          .x = {block.x._buffer[i], block.x_low._buffer[i]},
          .y = {block.y._buffer[i], block.y_low._buffer[i]},
          .vx = {block.vx._buffer[i], block.vx_low._buffer[i]},
          .vy = {block.vy._buffer[i], block.vy_low._buffer[i]},
          .since = {block.seconds._buffer[i], block.fraction._buffer[i]},
          .angle = at_or(block.angle, i, 0),
          .spin = at_or(block.spin, i, 0),
          .ax = grows ? engine::SplitNumber{} : ax,
          .ay = {at_or(block.ay, i, 0), at_or(block.ay_low, i, 0)},
          .drag = law == stoss_v1_LAW_DRAGGED ? rate : 0,
          .radius = grows ? ax : engine::SplitNumber{},
          .growth = grows ? rate : 0};
}

engine::Change change_at(const wire::MotionBlock& block, std::size_t i) {
  return {block.id._buffer[i],
          change_of(block.change._buffer[i]).value_or(engine::ChangeKind::Moved)};
}

engine::BodyRecord body_at(const wire::StaticBlock& block, std::size_t i) {
  const bool is_wall = block.kind._buffer[i] == stoss_v1_KIND_WALL;
  return {.id = block.id._buffer[i],
          .is_wall = is_wall,
          .kind = body_kind_of(block.kind._buffer[i]).value_or(engine::BodyKind::Dynamic),
          .radius = block.radius._buffer[i],
          .mass = block.mass._buffer[i],
          .edge_x = {at_or(block.edge_x, i, 0), at_or(block.edge_x_low, i, 0)},
          .edge_y = {at_or(block.edge_y, i, 0), at_or(block.edge_y_low, i, 0)}};
}

engine::BodyState state_at(const wire::StateBlock& block,
                           const engine::Instant& at,
                           std::size_t i) {
  return {.id = block.id._buffer[i],
          .kind = body_kind_of(block.kind._buffer[i]).value_or(engine::BodyKind::Dynamic),
          .instant = at,
          .position = {block.x._buffer[i], block.y._buffer[i]},
          .velocity = {block.vx._buffer[i], block.vy._buffer[i]},
          .angle = at_or(block.angle, i, 0),
          .spin = at_or(block.spin, i, 0),
          .radius = block.radius._buffer[i]};
}

engine::WallState wall_at(const wire::WallBlock& block, const engine::Instant& at, std::size_t i) {
  return {.id = block.id._buffer[i],
          .instant = at,
          .start = {block.start_x._buffer[i], block.start_y._buffer[i]},
          .end = {block.end_x._buffer[i], block.end_y._buffer[i]},
          .velocity = {at_or(block.vx, i, 0), at_or(block.vy, i, 0)}};
}

engine::Collision collision_at(const wire::CollisionBlock& block,
                               std::uint64_t first_number,
                               std::size_t i) {
  const unsigned flags = block.flags._buffer[i];
  return {.sequence = first_number + i,
          .instant = {block.seconds._buffer[i], block.fraction._buffer[i]},
          .kind = contact_kind_of(block.kind._buffer[i]).value_or(engine::ContactKind::DiskDisk),
          .regularised = (flags & idl::kRegularised) != 0,
          .order_dependent = (flags & idl::kOrderDependent) != 0,
          .a = block.a._buffer[i],
          .b = block.b._buffer[i],
          .point = {block.point_x._buffer[i], block.point_y._buffer[i]},
          .normal = {block.normal_x._buffer[i], block.normal_y._buffer[i]},
          .impulse = block.impulse._buffer[i],
          .approach_speed = block.approach_speed._buffer[i],
          .velocity_a = {block.velocity_a_x._buffer[i], block.velocity_a_y._buffer[i]},
          .velocity_b = {block.velocity_b_x._buffer[i], block.velocity_b_y._buffer[i]},
          .spin_a = at_or(block.spin_a, i, 0),
          .spin_b = at_or(block.spin_b, i, 0)};
}

engine::ZoneEvent zone_event_at(const wire::ZoneEventBlock& block,
                                std::uint64_t first_number,
                                std::size_t i) {
  return {.sequence = first_number + i,
          .instant = {block.seconds._buffer[i], block.fraction._buffer[i]},
          .zone = block.zone._buffer[i],
          .body = block.body._buffer[i],
          .entered = block.entered._buffer[i],
          .position = {block.x._buffer[i], block.y._buffer[i]},
          .velocity = {block.vx._buffer[i], block.vy._buffer[i]}};
}

engine::RayHit hit_at(const wire::HitBlock& block, std::size_t i) {
  return {.id = block.id._buffer[i],
          .distance = block.distance._buffer[i],
          .point = {block.x._buffer[i], block.y._buffer[i]},
          .normal = {block.normal_x._buffer[i], block.normal_y._buffer[i]}};
}

}  // namespace stoss::translate

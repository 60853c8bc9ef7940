// SPDX-License-Identifier: Apache-2.0
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/columns.hpp>

#include <algorithm>
#include <span>

namespace stoss::translate {
namespace {

// Rows [first, first + count) of a column; nothing of an empty one.
template <class T>
std::span<const T> rows(const std::vector<T>& column, std::size_t first, std::size_t count) {
  if (column.empty()) return {};
  return std::span<const T>(column).subspan(first, count);
}

constexpr std::uint8_t kWall = stoss_v1_KIND_WALL;

std::uint8_t flags_of(const engine::Collision& collision) {
  unsigned flags = 0;
  if (collision.regularised) flags |= idl::kRegularised;
  if (collision.order_dependent) flags |= idl::kOrderDependent;
  return static_cast<std::uint8_t>(flags);
}

idl::Law law_of(const engine::MotionRecord& motion) {
  if (motion.radius.high != 0) return idl::Law::kGrowing;
  if (motion.drag != 0) return idl::Law::kDragged;
  const bool is_uniform = motion.ax.high == 0 && motion.ay.high == 0;
  return is_uniform ? idl::Law::kUniform : idl::Law::kAccelerated;
}

}  // namespace

void StateColumns::append(const engine::BodyState& state) {
  angle_.append(size(), state.angle);
  spin_.append(size(), state.spin);
  id_.push_back(state.id);
  kind_.push_back(idl::wire_value(to_wire(state.kind)));
  x_.push_back(state.position.x());
  y_.push_back(state.position.y());
  vx_.push_back(state.velocity.x());
  vy_.push_back(state.velocity.y());
  radius_.push_back(state.radius);
}

void StateColumns::append(const engine::WallState& wall) {
  id_.push_back(wall.id);
  kind_.push_back(kWall);
  x_.push_back(wall.start.x());
  y_.push_back(wall.start.y());
  vx_.push_back(wall.velocity.x());
  vy_.push_back(wall.velocity.y());
  radius_.push_back(0);
}

void StateColumns::append(const engine::BodyState& state, double distance) {
  append(state);
  distance_.push_back(distance);
}

void StateColumns::append(const engine::WallState& wall, double distance) {
  append(wall);
  distance_.push_back(distance);
}

void StateColumns::clear() { *this = StateColumns(); }

void StateColumns::reserve(std::size_t count) {
  id_.reserve(count);
  kind_.reserve(count);
  for (auto* column : {&x_, &y_, &vx_, &vy_, &radius_}) column->reserve(count);
}

void StateColumns::lend(wire::StateBlock& block, std::size_t first, std::size_t count) {
  idl::lend(block.id, rows(id_, first, count));
  idl::lend(block.kind, rows(kind_, first, count));
  idl::lend(block.x, rows(x_, first, count));
  idl::lend(block.y, rows(y_, first, count));
  idl::lend(block.vx, rows(vx_, first, count));
  idl::lend(block.vy, rows(vy_, first, count));
  idl::lend(block.angle, rows(angle_.padded(size()), first, count));
  idl::lend(block.spin, rows(spin_.padded(size()), first, count));
  idl::lend(block.radius, rows(radius_, first, count));
  idl::lend(block.distance, rows(distance_, first, count));
}

void WallColumns::append(const engine::WallState& wall) {
  append(engine::WallSpec{wall.id, wall.start, wall.end, wall.velocity});
}

void WallColumns::append(const engine::WallSpec& wall) {
  id_.push_back(wall.id);
  start_x_.push_back(wall.start.x());
  start_y_.push_back(wall.start.y());
  end_x_.push_back(wall.end.x());
  end_y_.push_back(wall.end.y());
  vx_.push_back(wall.velocity.x());
  vy_.push_back(wall.velocity.y());
}

void WallColumns::clear() { *this = WallColumns(); }

void WallColumns::lend(wire::WallBlock& block, std::size_t first, std::size_t count) const {
  idl::lend(block.id, rows(id_, first, count));
  idl::lend(block.start_x, rows(start_x_, first, count));
  idl::lend(block.start_y, rows(start_y_, first, count));
  idl::lend(block.end_x, rows(end_x_, first, count));
  idl::lend(block.end_y, rows(end_y_, first, count));
  idl::lend(block.vx, rows(vx_, first, count));
  idl::lend(block.vy, rows(vy_, first, count));
}

void MotionColumns::append(engine::ChangeKind change, const engine::MotionRecord& motion) {
  angle_.append(size(), motion.angle);
  spin_.append(size(), motion.spin);
  const idl::Law law = law_of(motion);
  const engine::SplitNumber& ax = law == idl::Law::kGrowing ? motion.radius : motion.ax;
  ax_.append(size(), ax.high);
  ay_.append(size(), motion.ay.high);
  ax_low_.append(size(), ax.low);
  ay_low_.append(size(), motion.ay.low);
  rate_.append(size(), law == idl::Law::kGrowing ? motion.growth : motion.drag);
  id_.push_back(motion.id);
  change_.push_back(idl::wire_value(to_wire(change)));
  law_.push_back(idl::wire_value(law));
  x_.push_back(motion.x.high);
  y_.push_back(motion.y.high);
  x_low_.push_back(motion.x.low);
  y_low_.push_back(motion.y.low);
  vx_.push_back(motion.vx.high);
  vy_.push_back(motion.vy.high);
  vx_low_.push_back(motion.vx.low);
  vy_low_.push_back(motion.vy.low);
  seconds_.push_back(motion.since.seconds);
  fraction_.push_back(motion.since.fraction);
}

void MotionColumns::clear() {
  for (auto* column : {&id_, &fraction_}) column->clear();
  for (auto* column : {&change_, &law_}) column->clear();
  for (auto* column : {&x_, &y_, &x_low_, &y_low_, &vx_, &vy_, &vx_low_, &vy_low_}) {
    column->clear();
  }
  seconds_.clear();
  for (auto* column : {&angle_, &spin_, &ax_, &ay_, &ax_low_, &ay_low_, &rate_}) {
    column->clear();
  }
}

void MotionColumns::reserve(std::size_t count) {
  for (auto* column : {&id_, &fraction_}) column->reserve(count);
  for (auto* column : {&change_, &law_}) column->reserve(count);
  for (auto* column : {&x_, &y_, &x_low_, &y_low_, &vx_, &vy_, &vx_low_, &vy_low_}) {
    column->reserve(count);
  }
  seconds_.reserve(count);
}

void MotionColumns::lend(wire::MotionBlock& block, std::size_t first, std::size_t count) {
  idl::lend(block.id, rows(id_, first, count));
  idl::lend(block.change, rows(change_, first, count));
  idl::lend(block.law, rows(law_, first, count));
  idl::lend(block.x, rows(x_, first, count));
  idl::lend(block.y, rows(y_, first, count));
  idl::lend(block.x_low, rows(x_low_, first, count));
  idl::lend(block.y_low, rows(y_low_, first, count));
  idl::lend(block.vx, rows(vx_, first, count));
  idl::lend(block.vy, rows(vy_, first, count));
  idl::lend(block.vx_low, rows(vx_low_, first, count));
  idl::lend(block.vy_low, rows(vy_low_, first, count));
  idl::lend(block.seconds, rows(seconds_, first, count));
  idl::lend(block.fraction, rows(fraction_, first, count));
  idl::lend(block.angle, rows(angle_.padded(size()), first, count));
  idl::lend(block.spin, rows(spin_.padded(size()), first, count));
  idl::lend(block.ax, rows(ax_.padded(size()), first, count));
  idl::lend(block.ay, rows(ay_.padded(size()), first, count));
  idl::lend(block.ax_low, rows(ax_low_.padded(size()), first, count));
  idl::lend(block.ay_low, rows(ay_low_.padded(size()), first, count));
  idl::lend(block.rate, rows(rate_.padded(size()), first, count));
}

void StaticColumns::append(const engine::BodyRecord& body) {
  edge_x_.append(size(), body.edge_x.high);
  edge_y_.append(size(), body.edge_y.high);
  edge_x_low_.append(size(), body.edge_x.low);
  edge_y_low_.append(size(), body.edge_y.low);
  has_wall_ = has_wall_ || body.is_wall;
  id_.push_back(body.id);
  kind_.push_back(body.is_wall ? kWall : idl::wire_value(to_wire(body.kind)));
  radius_.push_back(body.radius);
  mass_.push_back(body.mass);
}

void StaticColumns::clear() {
  id_.clear();
  kind_.clear();
  radius_.clear();
  mass_.clear();
  for (auto* column : {&edge_x_, &edge_y_, &edge_x_low_, &edge_y_low_}) column->clear();
  has_wall_ = false;
}

void StaticColumns::reserve(std::size_t count) {
  id_.reserve(count);
  kind_.reserve(count);
  radius_.reserve(count);
  mass_.reserve(count);
}

void StaticColumns::lend(wire::StaticBlock& block, std::size_t first, std::size_t count) {
  idl::lend(block.id, rows(id_, first, count));
  idl::lend(block.kind, rows(kind_, first, count));
  idl::lend(block.radius, rows(radius_, first, count));
  idl::lend(block.mass, rows(mass_, first, count));
  // The four go together: all there as soon as one wall is among the rows.
  const std::size_t edges = has_wall_ ? size() : 0;
  idl::lend(block.edge_x, rows(edge_x_.filled(edges), first, count));
  idl::lend(block.edge_y, rows(edge_y_.filled(edges), first, count));
  idl::lend(block.edge_x_low, rows(edge_x_low_.filled(edges), first, count));
  idl::lend(block.edge_y_low, rows(edge_y_low_.filled(edges), first, count));
}

void CollisionColumns::append(const engine::Collision& collision) {
  spin_a_.append(size(), collision.spin_a);
  spin_b_.append(size(), collision.spin_b);
  seconds_.push_back(collision.instant.seconds);
  fraction_.push_back(collision.instant.fraction);
  kind_.push_back(idl::wire_value(to_wire(collision.kind)));
  flags_.push_back(flags_of(collision));
  a_.push_back(collision.a);
  b_.push_back(collision.b);
  point_x_.push_back(collision.point.x());
  point_y_.push_back(collision.point.y());
  normal_x_.push_back(collision.normal.x());
  normal_y_.push_back(collision.normal.y());
  impulse_.push_back(collision.impulse);
  approach_speed_.push_back(collision.approach_speed);
  velocity_a_x_.push_back(collision.velocity_a.x());
  velocity_a_y_.push_back(collision.velocity_a.y());
  velocity_b_x_.push_back(collision.velocity_b.x());
  velocity_b_y_.push_back(collision.velocity_b.y());
}

void CollisionColumns::clear() {
  seconds_.clear();
  for (auto* column : {&fraction_, &a_, &b_}) column->clear();
  for (auto* column : {&kind_, &flags_}) column->clear();
  for (auto* column : {&point_x_,
                       &point_y_,
                       &normal_x_,
                       &normal_y_,
                       &impulse_,
                       &approach_speed_,
                       &velocity_a_x_,
                       &velocity_a_y_,
                       &velocity_b_x_,
                       &velocity_b_y_}) {
    column->clear();
  }
  spin_a_.clear();
  spin_b_.clear();
}

void CollisionColumns::lend(wire::CollisionBlock& block, std::size_t first, std::size_t count) {
  idl::lend(block.seconds, rows(seconds_, first, count));
  idl::lend(block.fraction, rows(fraction_, first, count));
  idl::lend(block.kind, rows(kind_, first, count));
  idl::lend(block.flags, rows(flags_, first, count));
  idl::lend(block.a, rows(a_, first, count));
  idl::lend(block.b, rows(b_, first, count));
  idl::lend(block.point_x, rows(point_x_, first, count));
  idl::lend(block.point_y, rows(point_y_, first, count));
  idl::lend(block.normal_x, rows(normal_x_, first, count));
  idl::lend(block.normal_y, rows(normal_y_, first, count));
  idl::lend(block.impulse, rows(impulse_, first, count));
  idl::lend(block.approach_speed, rows(approach_speed_, first, count));
  idl::lend(block.velocity_a_x, rows(velocity_a_x_, first, count));
  idl::lend(block.velocity_a_y, rows(velocity_a_y_, first, count));
  idl::lend(block.velocity_b_x, rows(velocity_b_x_, first, count));
  idl::lend(block.velocity_b_y, rows(velocity_b_y_, first, count));
  idl::lend(block.spin_a, rows(spin_a_.padded(size()), first, count));
  idl::lend(block.spin_b, rows(spin_b_.padded(size()), first, count));
}

void ZoneEventColumns::append(const engine::ZoneEvent& event) {
  seconds_.push_back(event.instant.seconds);
  fraction_.push_back(event.instant.fraction);
  zone_.push_back(event.zone);
  body_.push_back(event.body);
  entered_.push_back({event.entered});
  x_.push_back(event.position.x());
  y_.push_back(event.position.y());
  vx_.push_back(event.velocity.x());
  vy_.push_back(event.velocity.y());
}

void ZoneEventColumns::lend(wire::ZoneEventBlock& block,
                            std::size_t first,
                            std::size_t count) const {
  idl::lend(block.seconds, rows(seconds_, first, count));
  idl::lend(block.fraction, rows(fraction_, first, count));
  idl::lend(block.zone, rows(zone_, first, count));
  idl::lend(block.body, rows(body_, first, count));
  const auto entered = rows(entered_, first, count);
  static_assert(sizeof(Flag) == sizeof(bool));
  idl::lend(block.entered, {entered.empty() ? nullptr : &entered.data()->on, entered.size()});
  idl::lend(block.x, rows(x_, first, count));
  idl::lend(block.y, rows(y_, first, count));
  idl::lend(block.vx, rows(vx_, first, count));
  idl::lend(block.vy, rows(vy_, first, count));
}

void HitColumns::append(const engine::RayHit& hit) {
  id_.push_back(hit.id);
  distance_.push_back(hit.distance);
  x_.push_back(hit.point.x());
  y_.push_back(hit.point.y());
  normal_x_.push_back(hit.normal.x());
  normal_y_.push_back(hit.normal.y());
}

void HitColumns::lend(wire::HitBlock& block, std::size_t first, std::size_t count) const {
  idl::lend(block.id, rows(id_, first, count));
  idl::lend(block.distance, rows(distance_, first, count));
  idl::lend(block.x, rows(x_, first, count));
  idl::lend(block.y, rows(y_, first, count));
  idl::lend(block.normal_x, rows(normal_x_, first, count));
  idl::lend(block.normal_y, rows(normal_y_, first, count));
}

}  // namespace stoss::translate

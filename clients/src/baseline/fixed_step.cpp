// SPDX-License-Identifier: Apache-2.0
#include "baseline/fixed_step.hpp"

#include "baseline/closest_point.hpp"

#include <stoss/engine/instant.hpp>

#include <algorithm>
#include <cmath>

namespace stoss::client::baseline {
namespace {

using engine::Vector2;

double inverse_mass(const engine::DiskSpec& disk) {
  return disk.kind == engine::BodyKind::Dynamic ? 1 / disk.mass : 0;
}

template <class Spec>
std::vector<Spec> by_id(std::span<const Spec> specs) {
  std::vector<Spec> sorted(specs.begin(), specs.end());
  std::stable_sort(
      sorted.begin(), sorted.end(), [](const Spec& x, const Spec& y) { return x.id < y.id; });
  return sorted;
}

/// Equation (3) for bodies that overlap and approach.
double time_since_contact(const Vector2& p, const Vector2& v, double reach) {
  const double b = -p.dot(v);
  const double c = p.squaredNorm() - reach * reach;
  return -c / (b + std::sqrt(b * b - v.squaredNorm() * c));
}

void move_wall(engine::WallSpec& wall, double dt) {
  wall.start += wall.velocity * dt;
  wall.end += wall.velocity * dt;
}

}  // namespace

FixedStep::FixedStep(std::span<const engine::DiskSpec> disks,
                     std::span<const engine::WallSpec> walls,
                     const engine::Instant& start,
                     double step)
    : FixedStep(disks, walls, start, StepRule{.step = step}, false) {}

FixedStep::FixedStep(std::span<const engine::DiskSpec> disks,
                     std::span<const engine::WallSpec> walls,
                     const engine::Instant& start,
                     const StepRule& rule,
                     bool audited)
    : disks_(by_id(disks)),
      walls_(by_id(walls)),
      start_(start),
      now_(start),
      rule_(rule),
      audited_(audited) {}

engine::Instant FixedStep::end_of_next_step(const engine::Instant& otherwise) const {
  // Multiplied, not summed, so that the clock at least is as good as a stepped clock can be.
  return engine::offset_by(start_, static_cast<double>(steps_ + 1) * rule_.step)
      .value_or(otherwise);
}

void FixedStep::advance_to(const engine::Instant& until,
                           engine::CollisionSink* sink,
                           std::uint64_t max_collisions) {
  sink_ = sink;
  while (now_ < until && collisions_ < max_collisions) {
    const engine::Instant next = end_of_next_step(until);
    const bool whole = next <= until;
    const engine::Instant target = whole ? next : until;
    const bool full = whole && !within_step_;
    take_step(target, full ? rule_.step : engine::seconds_between(now_, target));
    if (whole) ++steps_;
    within_step_ = !whole;
  }
}

bool FixedStep::step_up_to(const engine::Instant& until,
                           engine::CollisionSink* sink,
                           std::uint64_t max_steps) {
  sink_ = sink;
  for (; max_steps > 0; --max_steps) {
    const engine::Instant next = end_of_next_step(engine::Instant::never());
    if (next > until) return true;
    take_step(next, rule_.step);
    ++steps_;
  }
  return end_of_next_step(engine::Instant::never()) > until;
}

void FixedStep::take_step(const engine::Instant& end, double dt) {
  const engine::Instant begin = now_;
  if (rule_.substeps > 1) find_candidates(dt);
  part_ = dt / rule_.substeps;
  for (std::uint32_t i = 1; i <= rule_.substeps; ++i) {
    if (audited_) audit_.look_ahead(disks_, walls_, part_);
    move(part_);
    now_ = i == rule_.substeps ? end : engine::offset_by(begin, i * part_).value_or(end);
    meet_disks();
    meet_walls();
  }
}

void FixedStep::find_candidates(double dt) {
  double speed = 0;
  for (const engine::DiskSpec& disk : disks_) speed = std::max(speed, disk.velocity.norm());
  const double margin = speed * dt;
  grid_.build(disks_, margin);
  candidates_.clear();
  grid_.for_each_pair([&](std::size_t a, std::size_t b) {
    const double reach = disks_[a].radius + disks_[b].radius + 2 * margin;
    if ((disks_[a].position - disks_[b].position).squaredNorm() < reach * reach) {
      candidates_.emplace_back(a, b);
    }
  });
}

void FixedStep::move(double dt) {
  for (engine::DiskSpec& disk : disks_) {
    disk.position += disk.velocity * dt;
    disk.angle += disk.spin * dt;
  }
  for (engine::WallSpec& wall : walls_) move_wall(wall, dt);
}

void FixedStep::meet_disks() {
  if (rule_.substeps > 1) {
    for (const auto& [a, b] : candidates_) meet(a, b);
    return;
  }
  grid_.build(disks_);
  grid_.for_each_pair([this](std::size_t a, std::size_t b) { meet(a, b); });
}

void FixedStep::meet_walls() {
  for (engine::WallSpec& wall : walls_) {
    for (std::size_t disk = 0; disk < disks_.size(); ++disk) meet_wall(disk, wall);
  }
}

void FixedStep::meet(std::size_t a_index, std::size_t b_index) {
  engine::DiskSpec& a = disks_[a_index];
  engine::DiskSpec& b = disks_[b_index];
  const Vector2 offset = b.position - a.position;
  const double reach = a.radius + b.radius;
  const double distance2 = offset.squaredNorm();
  if (!(distance2 < reach * reach) || distance2 == 0) return;
  const Vector2 velocity = b.velocity - a.velocity;
  if (!(offset.dot(velocity) < 0) || inverse_mass(a) + inverse_mass(b) == 0) return;
  if (!rule_.back_up) return resolve(a, b, 0);
  const double back = std::min(time_since_contact(offset, velocity, reach), part_);
  a.position -= a.velocity * back;
  b.position -= b.velocity * back;
  resolve(a, b, back);
  a.position += a.velocity * back;
  b.position += b.velocity * back;
}

void FixedStep::resolve(engine::DiskSpec& a, engine::DiskSpec& b, double back) {
  const Vector2 normal = (b.position - a.position).normalized();
  const double approach = (a.velocity - b.velocity).dot(normal);
  const double impulse = 2 * approach / (inverse_mass(a) + inverse_mass(b));
  a.velocity -= impulse * inverse_mass(a) * normal;
  b.velocity += impulse * inverse_mass(b) * normal;
  engine::Collision collision{
      .instant = {}, .kind = engine::ContactKind::DiskDisk, .a = a.id, .b = b.id};
  collision.point = a.position + a.radius * normal;
  collision.normal = normal;
  collision.impulse = impulse;
  collision.approach_speed = approach;
  collision.velocity_a = a.velocity;
  collision.velocity_b = b.velocity;
  collision.spin_a = a.spin;
  collision.spin_b = b.spin;
  report(collision, back);
}

void FixedStep::meet_wall(std::size_t disk_index, engine::WallSpec& wall) {
  engine::DiskSpec& disk = disks_[disk_index];
  if (disk.kind != engine::BodyKind::Dynamic) return;
  const Vector2 edge = wall.end - wall.start;
  const Vector2 place = disk.position - wall.start;
  const Vector2 foot = closest_point(edge, place);
  const Vector2 offset = foot - place;
  const double distance2 = offset.squaredNorm();
  if (!(distance2 < disk.radius * disk.radius) || distance2 == 0) return;
  const Vector2 velocity = wall.velocity - disk.velocity;
  if (!(offset.dot(velocity) < 0)) return;
  if (!rule_.back_up) return bounce(disk, wall, 0);
  const bool at_end = foot == Vector2::Zero() || foot == edge;
  const double distance = std::sqrt(distance2);
  const double since = at_end ? time_since_contact(offset, velocity, disk.radius)
                              : (disk.radius - distance) * distance / -offset.dot(velocity);
  const double back = std::min(since, part_);
  disk.position -= disk.velocity * back;
  move_wall(wall, -back);
  bounce(disk, wall, back);
  disk.position += disk.velocity * back;
  move_wall(wall, back);
}

void FixedStep::bounce(engine::DiskSpec& disk, const engine::WallSpec& wall, double back) {
  const Vector2 edge = wall.end - wall.start;
  const Vector2 foot = closest_point(edge, disk.position - wall.start);
  const Vector2 point = wall.start + foot;
  const Vector2 normal = (point - disk.position).normalized();
  const double approach = (disk.velocity - wall.velocity).dot(normal);
  disk.velocity -= 2 * approach * normal;
  const bool at_end = foot == Vector2::Zero() || foot == edge;
  engine::Collision collision{
      .instant = {},
      .kind = at_end ? engine::ContactKind::DiskWallEnd : engine::ContactKind::DiskWall,
      .a = disk.id,
      .b = wall.id};
  collision.point = point;
  collision.normal = normal;
  collision.impulse = 2 * approach * disk.mass;
  collision.approach_speed = approach;
  collision.velocity_a = disk.velocity;
  collision.velocity_b = wall.velocity;
  collision.spin_a = disk.spin;
  report(collision, back);
}

void FixedStep::report(engine::Collision& collision, double back) {
  collision.sequence = ++collisions_;
  if (sink_ == nullptr) return;
  collision.instant = engine::offset_by(now_, -back).value_or(now_);
  sink_->on_collision(collision);
}

engine::Conserved FixedStep::conserved() const {
  engine::Conserved sums;
  for (const engine::DiskSpec& disk : disks_) {
    if (disk.kind != engine::BodyKind::Dynamic) continue;
    sums.kinetic_energy += 0.5 * disk.mass * disk.velocity.squaredNorm();
    sums.momentum += disk.mass * disk.velocity;
  }
  return sums;
}

void FixedStep::for_each_disk(const std::function<void(const engine::BodyState&)>& visit) const {
  for (const engine::DiskSpec& disk : disks_) {
    visit({disk.id,
           disk.kind,
           now_,
           disk.position,
           disk.velocity,
           disk.angle,
           disk.spin,
           disk.radius});
  }
}

}  // namespace stoss::client::baseline

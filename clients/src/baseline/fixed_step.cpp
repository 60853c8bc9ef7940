// SPDX-License-Identifier: Apache-2.0
#include "baseline/fixed_step.hpp"

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

}  // namespace

FixedStep::FixedStep(std::span<const engine::DiskSpec> disks,
                     std::span<const engine::WallSpec> walls,
                     const engine::Instant& start,
                     double step)
    : disks_(by_id(disks)), walls_(by_id(walls)), start_(start), now_(start), step_(step) {}

void FixedStep::advance_to(const engine::Instant& until,
                           engine::CollisionSink* sink,
                           std::uint64_t max_collisions) {
  sink_ = sink;
  while (now_ < until && collisions_ < max_collisions) {
    // Multiplied, not summed, so that the clock at least is as good as a stepped clock can be.
    const auto next =
        engine::offset_by(start_, static_cast<double>(steps_ + 1) * step_).value_or(until);
    const bool whole = next <= until;
    const engine::Instant target = whole ? next : until;
    move(whole ? step_ : engine::seconds_between(now_, target));
    now_ = target;
    if (whole) ++steps_;
    meet_disks();
    meet_walls();
  }
}

void FixedStep::move(double dt) {
  for (engine::DiskSpec& disk : disks_) {
    disk.position += disk.velocity * dt;
    disk.angle += disk.spin * dt;
  }
  for (engine::WallSpec& wall : walls_) {
    wall.start += wall.velocity * dt;
    wall.end += wall.velocity * dt;
  }
}

void FixedStep::meet_disks() {
  grid_.build(disks_);
  grid_.for_each_pair([this](std::size_t a, std::size_t b) { meet(a, b); });
}

void FixedStep::meet_walls() {
  for (const engine::WallSpec& wall : walls_) {
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
  const Vector2 normal = offset / std::sqrt(distance2);
  const double approach = (a.velocity - b.velocity).dot(normal);
  const double weight = inverse_mass(a) + inverse_mass(b);
  if (!(approach > 0) || weight == 0) return;
  const double impulse = 2 * approach / weight;
  a.velocity -= impulse * inverse_mass(a) * normal;
  b.velocity += impulse * inverse_mass(b) * normal;
  engine::Collision collision{
      .instant = now_, .kind = engine::ContactKind::DiskDisk, .a = a.id, .b = b.id};
  collision.point = a.position + a.radius * normal;
  collision.normal = normal;
  collision.impulse = impulse;
  collision.approach_speed = approach;
  collision.velocity_a = a.velocity;
  collision.velocity_b = b.velocity;
  collision.spin_a = a.spin;
  collision.spin_b = b.spin;
  report(collision);
}

void FixedStep::meet_wall(std::size_t disk_index, const engine::WallSpec& wall) {
  engine::DiskSpec& disk = disks_[disk_index];
  const Vector2 edge = wall.end - wall.start;
  const double along = (disk.position - wall.start).dot(edge) / edge.squaredNorm();
  const Vector2 point = wall.start + std::clamp(along, 0.0, 1.0) * edge;
  const Vector2 offset = point - disk.position;
  const double distance2 = offset.squaredNorm();
  if (!(distance2 < disk.radius * disk.radius) || distance2 == 0) return;
  const Vector2 normal = offset / std::sqrt(distance2);
  const double approach = (disk.velocity - wall.velocity).dot(normal);
  if (!(approach > 0) || disk.kind != engine::BodyKind::Dynamic) return;
  disk.velocity -= 2 * approach * normal;
  const bool on_face = along > 0 && along < 1;
  engine::Collision collision{
      .instant = now_,
      .kind = on_face ? engine::ContactKind::DiskWall : engine::ContactKind::DiskWallEnd,
      .a = disk.id,
      .b = wall.id};
  collision.point = point;
  collision.normal = normal;
  collision.impulse = 2 * approach * disk.mass;
  collision.approach_speed = approach;
  collision.velocity_a = disk.velocity;
  collision.velocity_b = wall.velocity;
  collision.spin_a = disk.spin;
  report(collision);
}

void FixedStep::report(engine::Collision& collision) {
  collision.sequence = ++collisions_;
  if (sink_ != nullptr) sink_->on_collision(collision);
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

// SPDX-License-Identifier: Apache-2.0
#include "baseline/step_audit.hpp"

#include "baseline/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::client::baseline {
namespace {

using engine::Vector2;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Contacts nearer than this to the end of a step (as a part of it) may be rounding.
constexpr double kLastPart = 1e-6;

/// Equation (1); never, when they do not meet or overlap already.
double contact_time(const Vector2& p, const Vector2& v, double reach) {
  const double b = p.dot(v);
  const double c = p.squaredNorm() - reach * reach;
  const double discriminant = b * b - v.squaredNorm() * c;
  if (!(b < 0) || c < 0 || !(discriminant > 0)) return kNever;
  return c / (-b + std::sqrt(discriminant));
}

/// When a disk first touches a segment's face, in the segment's frame; never, from within.
double face_time(const Vector2& p, const Vector2& v, const Vector2& edge, double radius) {
  const double length = edge.norm();
  const Vector2 normal = Vector2(-edge.y(), edge.x()) / length;
  const double height = normal.dot(p);
  const double gap = std::abs(height) - radius;
  const double closing = height > 0 ? -normal.dot(v) : normal.dot(v);
  if (gap < 0 || !(closing > 0)) return kNever;
  const double t = gap / closing;
  const double along = (p + v * t).dot(edge) / (length * length);
  return along >= 0 && along <= 1 ? t : kNever;
}

bool can_move(const engine::DiskSpec& disk) { return disk.kind == engine::BodyKind::Dynamic; }

double fastest(std::span<const engine::DiskSpec> disks) {
  double speed = 0;
  for (const engine::DiskSpec& disk : disks) speed = std::max(speed, disk.velocity.norm());
  return speed;
}

}  // namespace

void StepAudit::look_ahead(std::span<const engine::DiskSpec> disks,
                           std::span<const engine::WallSpec> walls,
                           double dt) {
  grid_.build(disks, fastest(disks) * dt);
  grid_.for_each_pair([&](std::size_t a, std::size_t b) {
    if (can_move(disks[a]) || can_move(disks[b])) judge(disks[a], disks[b], dt);
  });
  for (const engine::WallSpec& wall : walls) {
    for (const engine::DiskSpec& disk : disks) {
      if (can_move(disk)) judge(disk, wall, dt);
    }
  }
}

void StepAudit::note(bool began, double end_distance, double contact_distance, bool approaching) {
  const double depth = (contact_distance - end_distance) / contact_distance;
  deepest_ = std::max(deepest_, depth);
  if (began && !(depth > 0 && approaching)) ++missed_;
}

void StepAudit::judge(const engine::DiskSpec& a, const engine::DiskSpec& b, double dt) {
  const Vector2 p = b.position - a.position;
  const Vector2 v = b.velocity - a.velocity;
  const double reach = a.radius + b.radius;
  const Vector2 end = p + v * dt;
  note(contact_time(p, v, reach) < dt * (1 - kLastPart), end.norm(), reach, end.dot(v) < 0);
}

void StepAudit::judge(const engine::DiskSpec& disk, const engine::WallSpec& wall, double dt) {
  const Vector2 edge = wall.end - wall.start;
  const Vector2 p = disk.position - wall.start;
  const Vector2 v = disk.velocity - wall.velocity;
  const Vector2 start_offset = closest_point(edge, p) - p;
  const Vector2 end = p + v * dt;
  const Vector2 end_offset = closest_point(edge, end) - end;
  double t = kNever;
  if (start_offset.norm() >= disk.radius) {
    t = std::min({face_time(p, v, edge, disk.radius),
                  contact_time(p, v, disk.radius),
                  contact_time(p - edge, v, disk.radius)});
  }
  note(t<dt*(1 - kLastPart), end_offset.norm(), disk.radius, end_offset.dot(v)> 0);
}

}  // namespace stoss::client::baseline

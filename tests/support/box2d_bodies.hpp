// SPDX-License-Identifier: Apache-2.0
#pragma once

// Disks and walls in Box2D, set up to be as exact as it can be: no friction, full restitution at
// every speed (by default it drops restitution below 1 m/s), disks that do not turn.

#include <stoss/engine/types.hpp>

#include <box2d/box2d.h>

#include <cstdint>
#include <numbers>

namespace stoss::test {

// As its manual recommends.
inline constexpr int kBox2DVelocityIterations = 8;
inline constexpr int kBox2DPositionIterations = 3;

inline b2Vec2 to_box2d(const engine::Vector2& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

inline b2BodyType box2d_type_of(engine::BodyKind kind) {
  switch (kind) {
    case engine::BodyKind::Dynamic:
      return b2_dynamicBody;
    case engine::BodyKind::Kinematic:
      return b2_kinematicBody;
    case engine::BodyKind::Static:
      return b2_staticBody;
  }
  return b2_staticBody;
}

inline b2FixtureDef box2d_fixture(const b2Shape& shape, std::uintptr_t tag) {
  b2FixtureDef definition;
  definition.shape = &shape;
  definition.friction = 0;
  definition.restitution = 1;
  definition.restitutionThreshold = 0;
  definition.userData.pointer = tag;
  return definition;
}

struct Box2DDisk {
  bool is_bullet = true;  ///< swept against other disks, too, and not against walls alone
  bool may_sleep = false;
  std::uintptr_t tag = 0;  ///< the fixture's user data
};

inline b2Body* add_to_box2d(b2World& world, const engine::DiskSpec& disk, const Box2DDisk& how) {
  b2BodyDef definition;
  definition.type = box2d_type_of(disk.kind);
  definition.position = to_box2d(disk.position);
  definition.linearVelocity = to_box2d(disk.velocity);
  definition.bullet = how.is_bullet;
  definition.allowSleep = how.may_sleep;
  definition.awake = !how.may_sleep || disk.velocity != engine::Vector2::Zero();
  definition.fixedRotation = true;
  b2Body* const body = world.CreateBody(&definition);
  b2CircleShape circle;
  circle.m_radius = static_cast<float>(disk.radius);
  b2FixtureDef part = box2d_fixture(circle, how.tag);
  part.density = static_cast<float>(disk.mass / (std::numbers::pi * disk.radius * disk.radius));
  body->CreateFixture(&part);
  return body;
}

inline void add_to_box2d(b2World& world, const engine::WallSpec& wall, std::uintptr_t tag) {
  b2BodyDef definition;
  const bool moves = wall.velocity.norm() > 0;
  definition.type = moves ? b2_kinematicBody : b2_staticBody;
  definition.linearVelocity = to_box2d(wall.velocity);
  b2Body* const body = world.CreateBody(&definition);
  b2EdgeShape edge;
  edge.SetTwoSided(to_box2d(wall.start), to_box2d(wall.end));
  const b2FixtureDef part = box2d_fixture(edge, tag);
  body->CreateFixture(&part);
}

}  // namespace stoss::test

// SPDX-License-Identifier: Apache-2.0
#include "accuracy/engine_run.hpp"
#include "accuracy/engines.hpp"

#include <box2d/box2d.h>

#include <memory>
#include <numbers>
#include <set>

namespace stoss::tests {
namespace {

// As its manual recommends.
constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 to_box2d(const engine::Vector2& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

b2BodyType type_of(engine::BodyKind kind) {
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

/// What a fixture's user data points at.
struct Tag {
  engine::Id id = engine::kNoId;
  bool is_wall = false;
};

class Box2DRun final : public EngineRun, private b2ContactListener {
 public:
  Box2DRun(const translate::SceneBodies& bodies, double step, bool audited)
      : EngineRun(bodies, step, audited), world_(b2Vec2(0, 0)) {
    world_.SetAllowSleeping(false);
    world_.SetContinuousPhysics(true);
    world_.SetContactListener(this);
    tags_.reserve(disks_.size() + walls_.size());
    for (const engine::DiskSpec& disk : disks_) add(disk);
    for (const engine::WallSpec& wall : walls_) add(wall);
  }

 private:
  void take_step(double dt) override {
    world_.Step(static_cast<float>(dt), kVelocityIterations, kPositionIterations);
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      const b2Vec2 place = made_[i]->GetPosition();
      const b2Vec2 velocity = made_[i]->GetLinearVelocity();
      disks_[i].position = {place.x, place.y};
      disks_[i].velocity = {velocity.x, velocity.y};
    }
    for (engine::WallSpec& wall : walls_) {
      wall.start += wall.velocity * dt;
      wall.end += wall.velocity * dt;
    }
  }

  // A contact may last for several steps; it is a collision when it first pushes.
  void EndContact(b2Contact* contact) override { pushing_.erase(contact); }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    if (!(impulse->normalImpulses[0] > 0) || !pushing_.insert(contact).second) return;
    const Tag* a = tag_of(contact->GetFixtureA());
    const Tag* b = tag_of(contact->GetFixtureB());
    if (a->is_wall) std::swap(a, b);
    collided(
        a->id, b->id, b->is_wall ? engine::ContactKind::DiskWall : engine::ContactKind::DiskDisk);
  }

  static const Tag* tag_of(b2Fixture* fixture) {
    return reinterpret_cast<const Tag*>(fixture->GetUserData().pointer);
  }

  b2FixtureDef fixture(const b2Shape& shape, const Tag& tag) {
    b2FixtureDef definition;
    definition.shape = &shape;
    definition.friction = 0;
    definition.restitution = 1;
    definition.restitutionThreshold = 0;
    definition.userData.pointer = reinterpret_cast<uintptr_t>(&tags_.emplace_back(tag));
    return definition;
  }

  void add(const engine::DiskSpec& disk) {
    b2BodyDef definition;
    definition.type = type_of(disk.kind);
    definition.position = to_box2d(disk.position);
    definition.linearVelocity = to_box2d(disk.velocity);
    definition.bullet = true;
    definition.allowSleep = false;
    definition.fixedRotation = true;
    b2Body* const body = world_.CreateBody(&definition);
    b2CircleShape circle;
    circle.m_radius = static_cast<float>(disk.radius);
    b2FixtureDef part = fixture(circle, {disk.id, false});
    part.density = static_cast<float>(disk.mass / (std::numbers::pi * disk.radius * disk.radius));
    body->CreateFixture(&part);
    made_.push_back(body);
  }

  void add(const engine::WallSpec& wall) {
    b2BodyDef definition;
    const bool moves = wall.velocity.norm() > 0;
    definition.type = moves ? b2_kinematicBody : b2_staticBody;
    definition.linearVelocity = to_box2d(wall.velocity);
    b2Body* const body = world_.CreateBody(&definition);
    b2EdgeShape edge;
    edge.SetTwoSided(to_box2d(wall.start), to_box2d(wall.end));
    const b2FixtureDef part = fixture(edge, {wall.id, true});
    body->CreateFixture(&part);
  }

  b2World world_;
  std::vector<b2Body*> made_;  ///< of the disks, in their order
  std::vector<Tag> tags_;      ///< never grows beyond what is reserved: fixtures point into it
  std::set<b2Contact*> pushing_;
};

}  // namespace

std::vector<client::accuracy::Method> box2d_methods(const translate::SceneBodies& bodies,
                                                    const std::vector<double>& steps) {
  std::vector<client::accuracy::Method> methods;
  for (const double step : steps) {
    client::accuracy::Method method;
    method.name = "Box2D";
    method.step = step;
    method.start = [&bodies, step](bool audited) {
      return std::make_unique<Box2DRun>(bodies, step, audited);
    };
    methods.push_back(method);
  }
  return methods;
}

}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
#include "accuracy/engine_run.hpp"
#include "accuracy/engines.hpp"
#include "support/box2d_bodies.hpp"

#include <box2d/box2d.h>

#include <memory>
#include <set>

namespace stoss::tests {
namespace {

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
    for (const engine::DiskSpec& disk : disks_) {
      made_.push_back(test::add_to_box2d(world_, disk, {.tag = tag_for({disk.id, false})}));
    }
    for (const engine::WallSpec& wall : walls_) {
      test::add_to_box2d(world_, wall, tag_for({wall.id, true}));
    }
  }

 private:
  void take_step(double dt) override {
    world_.Step(
        static_cast<float>(dt), test::kBox2DVelocityIterations, test::kBox2DPositionIterations);
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

  std::uintptr_t tag_for(const Tag& tag) {
    return reinterpret_cast<std::uintptr_t>(&tags_.emplace_back(tag));
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

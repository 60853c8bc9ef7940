// SPDX-License-Identifier: Apache-2.0
#include "bench/peer.hpp"
#include "support/box2d_bodies.hpp"

#include <box2d/box2d.h>

namespace stoss::bench {
namespace {

class Box2DPeer final : public Peer, private b2ContactListener {
 public:
  Box2DPeer(const BenchScene& scene, bool bullets) : world_(b2Vec2(0, 0)) {
    world_.SetAllowSleeping(scene.is_at_rest);
    world_.SetContinuousPhysics(true);
    world_.SetContactListener(this);
    const test::Box2DDisk how{.is_bullet = bullets, .may_sleep = scene.is_at_rest, .tag = kDiskTag};
    for (const engine::DiskSpec& disk : scene.disks) {
      bodies_.push_back(test::add_to_box2d(world_, disk, how));
    }
    for (const engine::WallSpec& wall : scene.walls) test::add_to_box2d(world_, wall, kWallTag);
  }

  void step(double dt) override {
    world_.Step(
        static_cast<float>(dt), test::kBox2DVelocityIterations, test::kBox2DPositionIterations);
  }

  void read(std::vector<engine::DiskSpec>& disks) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const b2Vec2 place = bodies_[i]->GetPosition();
      const b2Vec2 velocity = bodies_[i]->GetLinearVelocity();
      disks[i].position = {place.x, place.y};
      disks[i].velocity = {velocity.x, velocity.y};
    }
  }

 private:
  static constexpr std::uintptr_t kDiskTag = 0;
  static constexpr std::uintptr_t kWallTag = 1;

  void BeginContact(b2Contact* contact) override {
    count_contact(contact->GetFixtureA()->GetUserData().pointer == kWallTag ||
                  contact->GetFixtureB()->GetUserData().pointer == kWallTag);
  }

  b2World world_;
  std::vector<b2Body*> bodies_;
};

PeerKind kind(const char* name, bool bullets) {
  return {name, [bullets](const BenchScene& scene) {
            return std::make_unique<Box2DPeer>(scene, bullets);
          }};
}

}  // namespace

std::vector<PeerKind> box2d_kinds() { return {kind("Box2D", false), kind("Box2D-bullet", true)}; }

}  // namespace stoss::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/peer.hpp"
#include "support/chipmunk_bodies.hpp"

namespace stoss::bench {
namespace {

/// With its default ten iterations and its default index, a tree of boxes, which was the faster of
/// its two here.
class ChipmunkPeer final : public Peer {
 public:
  explicit ChipmunkPeer(const BenchScene& scene) {
    cpCollisionHandler* const handler = cpSpaceAddDefaultCollisionHandler(space_.get());
    handler->beginFunc = &ChipmunkPeer::begin;
    handler->userData = this;
    for (const engine::DiskSpec& disk : scene.disks) space_.add(disk, nullptr);
    for (const engine::WallSpec& wall : scene.walls) space_.add(wall, nullptr);
    disks_ = scene.disks.size();
    if (!scene.is_at_rest) return;  // all but the first
    cpSpaceSetSleepTimeThreshold(space_.get(), kSecondsToSleep);
    // It looks for a body from the front of its list and fills the gap with the last one: in this
    // order each is found at once.
    cpBodySleep(space_.body(1));
    for (std::size_t i = disks_ - 1; i > 1; --i) cpBodySleep(space_.body(i));
  }

  void step(double dt) override { cpSpaceStep(space_.get(), dt); }

  void read(std::vector<engine::DiskSpec>& disks) const override {
    for (std::size_t i = 0; i < disks_; ++i) {
      const cpVect place = cpBodyGetPosition(space_.body(i));
      const cpVect velocity = cpBodyGetVelocity(space_.body(i));
      disks[i].position = {place.x, place.y};
      disks[i].velocity = {velocity.x, velocity.y};
    }
  }

 private:
  static constexpr double kSecondsToSleep = 0.5;  // as Box2D's

  static cpBool begin(cpArbiter* arbiter, cpSpace*, cpDataPointer data) {
    cpShape* a = nullptr;
    cpShape* b = nullptr;
    cpArbiterGetShapes(arbiter, &a, &b);
    static_cast<ChipmunkPeer*>(data)->count_contact(test::ChipmunkSpace::is_wall(a) ||
                                                    test::ChipmunkSpace::is_wall(b));
    return cpTrue;
  }

  test::ChipmunkSpace space_;
  std::size_t disks_ = 0;
};

}  // namespace

std::vector<PeerKind> chipmunk_kinds() {
  return {
      {"Chipmunk", [](const BenchScene& scene) { return std::make_unique<ChipmunkPeer>(scene); }}};
}

}  // namespace stoss::bench

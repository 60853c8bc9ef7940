// SPDX-License-Identifier: Apache-2.0
#include "accuracy/engine_run.hpp"
#include "accuracy/engines.hpp"
#include "support/chipmunk_bodies.hpp"

#include <chipmunk/chipmunk.h>

#include <memory>

namespace stoss::tests {
namespace {

class ChipmunkRun final : public EngineRun {
 public:
  ChipmunkRun(const translate::SceneBodies& bodies, double step, bool audited)
      : EngineRun(bodies, step, audited) {
    cpCollisionHandler* const handler = cpSpaceAddDefaultCollisionHandler(space_.get());
    handler->postSolveFunc = &ChipmunkRun::post_solve;
    handler->userData = this;
    for (const engine::DiskSpec& disk : disks_) space_.add(disk, tag_for(disk.id));
    for (const engine::WallSpec& wall : walls_) space_.add(wall, tag_for(wall.id));
  }

 private:
  void take_step(double dt) override {
    cpSpaceStep(space_.get(), dt);
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      const cpVect place = cpBodyGetPosition(space_.body(i));
      const cpVect velocity = cpBodyGetVelocity(space_.body(i));
      disks_[i].position = {place.x, place.y};
      disks_[i].velocity = {velocity.x, velocity.y};
    }
    for (engine::WallSpec& wall : walls_) {
      wall.start += wall.velocity * dt;
      wall.end += wall.velocity * dt;
    }
  }

  static void post_solve(cpArbiter* arbiter, cpSpace*, cpDataPointer data) {
    if (!cpArbiterIsFirstContact(arbiter)) return;
    cpShape* a = nullptr;
    cpShape* b = nullptr;
    cpArbiterGetShapes(arbiter, &a, &b);
    if (test::ChipmunkSpace::is_wall(a)) std::swap(a, b);
    const auto id = [](cpShape* shape) {
      return static_cast<engine::Id>(reinterpret_cast<std::uintptr_t>(cpShapeGetUserData(shape)));
    };
    static_cast<ChipmunkRun*>(data)->collided(id(a),
                                              id(b),
                                              test::ChipmunkSpace::is_wall(b)
                                                  ? engine::ContactKind::DiskWall
                                                  : engine::ContactKind::DiskDisk);
  }

  static cpDataPointer tag_for(engine::Id id) {
    return reinterpret_cast<cpDataPointer>(static_cast<std::uintptr_t>(id));
  }

  test::ChipmunkSpace space_;
};

}  // namespace

std::vector<client::accuracy::Method> chipmunk_methods(const translate::SceneBodies& bodies,
                                                       const std::vector<double>& steps) {
  std::vector<client::accuracy::Method> methods;
  for (const double step : steps) {
    client::accuracy::Method method;
    method.name = "Chipmunk";
    method.step = step;
    method.start = [&bodies, step](bool audited) {
      return std::make_unique<ChipmunkRun>(bodies, step, audited);
    };
    methods.push_back(method);
  }
  return methods;
}

}  // namespace stoss::tests

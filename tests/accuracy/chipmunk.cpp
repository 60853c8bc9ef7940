// SPDX-License-Identifier: Apache-2.0
#include "accuracy/engine_run.hpp"
#include "accuracy/engines.hpp"

#include <chipmunk/chipmunk.h>

#include <limits>
#include <memory>

namespace stoss::tests {
namespace {

cpVect to_chipmunk(const engine::Vector2& v) { return cpv(v.x(), v.y()); }

struct FreeSpace {
  void operator()(cpSpace* space) const { cpSpaceFree(space); }
};
struct FreeBody {
  void operator()(cpBody* body) const { cpBodyFree(body); }
};
struct FreeShape {
  void operator()(cpShape* shape) const { cpShapeFree(shape); }
};

class ChipmunkRun final : public EngineRun {
 public:
  ChipmunkRun(const translate::SceneBodies& bodies, double step, bool audited)
      : EngineRun(bodies, step, audited), space_(cpSpaceNew()) {
    // Its default, a tenth of a length unit, is meant for pixels.
    cpSpaceSetCollisionSlop(space_.get(), 0);
    cpCollisionHandler* const handler = cpSpaceAddDefaultCollisionHandler(space_.get());
    handler->postSolveFunc = &ChipmunkRun::post_solve;
    handler->userData = this;
    for (const engine::DiskSpec& disk : disks_) add(disk);
    for (const engine::WallSpec& wall : walls_) add(wall);
  }
  ~ChipmunkRun() override {
    for (const auto& shape : shapes_) cpSpaceRemoveShape(space_.get(), shape.get());
    for (const auto& body : made_) cpSpaceRemoveBody(space_.get(), body.get());
  }
  ChipmunkRun(const ChipmunkRun&) = delete;
  ChipmunkRun& operator=(const ChipmunkRun&) = delete;

 private:
  void take_step(double dt) override {
    cpSpaceStep(space_.get(), dt);
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      const cpVect place = cpBodyGetPosition(made_[i].get());
      const cpVect velocity = cpBodyGetVelocity(made_[i].get());
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
    const auto is_wall = [](cpShape* shape) { return cpShapeGetCollisionType(shape) != 0; };
    if (is_wall(a)) std::swap(a, b);
    const auto id = [](cpShape* shape) {
      return static_cast<engine::Id>(reinterpret_cast<std::uintptr_t>(cpShapeGetUserData(shape)));
    };
    static_cast<ChipmunkRun*>(data)->collided(
        id(a), id(b), is_wall(b) ? engine::ContactKind::DiskWall : engine::ContactKind::DiskDisk);
  }

  cpBody* new_body(bool is_dynamic, bool is_static, double mass) {
    constexpr double no_turning = std::numeric_limits<double>::infinity();
    cpBody* const body = is_dynamic  ? cpBodyNew(mass, no_turning)
                         : is_static ? cpBodyNewStatic()
                                     : cpBodyNewKinematic();
    made_.emplace_back(body);
    return cpSpaceAddBody(space_.get(), body);
  }

  void put(cpShape* shape, engine::Id id, bool is_wall) {
    shapes_.emplace_back(shape);
    cpShapeSetElasticity(shape, 1);
    cpShapeSetFriction(shape, 0);
    cpShapeSetCollisionType(shape, is_wall ? 1 : 0);
    cpShapeSetUserData(shape, reinterpret_cast<cpDataPointer>(static_cast<std::uintptr_t>(id)));
    cpSpaceAddShape(space_.get(), shape);
  }

  void add(const engine::DiskSpec& disk) {
    cpBody* const body = new_body(
        disk.kind == engine::BodyKind::Dynamic, disk.kind == engine::BodyKind::Static, disk.mass);
    cpBodySetPosition(body, to_chipmunk(disk.position));
    cpBodySetVelocity(body, to_chipmunk(disk.velocity));
    put(cpCircleShapeNew(body, disk.radius, cpvzero), disk.id, false);
  }

  void add(const engine::WallSpec& wall) {
    cpBody* const body = new_body(false, wall.velocity.norm() == 0, 0);
    cpBodySetVelocity(body, to_chipmunk(wall.velocity));
    put(cpSegmentShapeNew(body, to_chipmunk(wall.start), to_chipmunk(wall.end), 0), wall.id, true);
  }

  std::unique_ptr<cpSpace, FreeSpace> space_;
  std::vector<std::unique_ptr<cpBody, FreeBody>> made_;  ///< disks first, in their order
  std::vector<std::unique_ptr<cpShape, FreeShape>> shapes_;
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

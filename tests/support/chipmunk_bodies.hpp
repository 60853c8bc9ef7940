// SPDX-License-Identifier: Apache-2.0
#pragma once

// Disks and walls in Chipmunk, set up to be as exact as it can be: no friction, full restitution,
// no overlap allowed for (its default, a tenth of a length unit, is meant for pixels), disks that
// do not turn.

#include <stoss/engine/types.hpp>

#include <chipmunk/chipmunk.h>

#include <limits>
#include <memory>
#include <vector>

namespace stoss::test {

inline cpVect to_chipmunk(const engine::Vector2& v) { return cpv(v.x(), v.y()); }

/// A space and all that is in it.
class ChipmunkSpace {
 public:
  ChipmunkSpace() : space_(cpSpaceNew()) { cpSpaceSetCollisionSlop(space_.get(), 0); }
  [[nodiscard]] cpSpace* get() const { return space_.get(); }
  /// The i-th that was added.
  [[nodiscard]] cpBody* body(std::size_t i) const { return bodies_[i].get(); }

  void add(const engine::DiskSpec& disk, cpDataPointer tag) {
    constexpr double kNoTurning = std::numeric_limits<double>::infinity();
    cpBody* const body =
        keep(disk.kind == engine::BodyKind::Dynamic  ? cpBodyNew(disk.mass, kNoTurning)
             : disk.kind == engine::BodyKind::Static ? cpBodyNewStatic()
                                                     : cpBodyNewKinematic());
    cpBodySetPosition(body, to_chipmunk(disk.position));
    cpBodySetVelocity(body, to_chipmunk(disk.velocity));
    put(cpCircleShapeNew(body, disk.radius, cpvzero), tag, false);
  }

  void add(const engine::WallSpec& wall, cpDataPointer tag) {
    cpBody* const body = keep(wall.velocity.norm() == 0 ? cpBodyNewStatic() : cpBodyNewKinematic());
    cpBodySetVelocity(body, to_chipmunk(wall.velocity));
    put(cpSegmentShapeNew(body, to_chipmunk(wall.start), to_chipmunk(wall.end), 0), tag, true);
  }

  static bool is_wall(cpShape* shape) { return cpShapeGetCollisionType(shape) != 0; }

 private:
  struct Free {
    void operator()(cpSpace* space) const { cpSpaceFree(space); }
    void operator()(cpBody* body) const { cpBodyFree(body); }
    void operator()(cpShape* shape) const { cpShapeFree(shape); }
  };

  cpBody* keep(cpBody* body) {
    bodies_.emplace_back(body);
    return cpSpaceAddBody(space_.get(), body);
  }

  void put(cpShape* shape, cpDataPointer tag, bool is_wall) {
    shapes_.emplace_back(shape);
    cpShapeSetElasticity(shape, 1);
    cpShapeSetFriction(shape, 0);
    cpShapeSetCollisionType(shape, is_wall ? 1 : 0);
    cpShapeSetUserData(shape, tag);
    cpSpaceAddShape(space_.get(), shape);
  }

  std::vector<std::unique_ptr<cpBody, Free>> bodies_;
  std::vector<std::unique_ptr<cpShape, Free>> shapes_;
  // Goes first: taking a shape out of a space that lives on looks at every contact.
  std::unique_ptr<cpSpace, Free> space_;
};

}  // namespace stoss::test

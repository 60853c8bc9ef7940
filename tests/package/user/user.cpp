// SPDX-License-Identifier: Apache-2.0
// One ball meets another, with the engine alone.

#include <stoss/engine/world.hpp>

#include <cstdio>

namespace engine = stoss::engine;

struct Printer : engine::CollisionSink {
  void on_collision(const engine::Collision& c) override {
    std::printf(
        "at %g s: %d meets %d\n", engine::seconds_between({}, c.instant), int(c.a), int(c.b));
  }
};

int main() {
  engine::World world;
  const engine::DiskSpec balls[] = {
      {.id = 1, .position = {0, 0}, .velocity = {1, 0}, .radius = 0.5},
      {.id = 2, .position = {3, 0}, .radius = 0.5}};
  Printer printer;
  if (!world.spawn({.disks = balls}).ok()) return 1;
  if (!world.advance_to({.seconds = 3}, &printer).ok()) return 1;
  for (const engine::Id id : world.ids()) {
    const engine::BodyState ball = world.state(id).value();
    std::printf("%d: x = %g m, v = %g m/s\n", int(id), ball.position.x(), ball.velocity.x());
  }
}

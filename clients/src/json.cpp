// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/json.hpp>
#include <stoss/idl/json_lines.hpp>
#include <stoss/translate/basics.hpp>

namespace stoss::client {
namespace {

idl::Pair pair(const engine::Vector2& v) { return {v.x(), v.y()}; }

}  // namespace

void append_json(std::string& out, const engine::Collision& collision) {
  idl::append_collision(out,
                        {.sequence = collision.sequence,
                         .seconds = collision.instant.seconds,
                         .fraction = collision.instant.fraction,
                         .kind = translate::to_wire(collision.kind),
                         .a = collision.a,
                         .b = collision.b,
                         .point = pair(collision.point),
                         .normal = pair(collision.normal),
                         .impulse = collision.impulse,
                         .approach_speed = collision.approach_speed,
                         .velocity_a = pair(collision.velocity_a),
                         .velocity_b = pair(collision.velocity_b),
                         .spin_a = collision.spin_a,
                         .spin_b = collision.spin_b,
                         .regularised = collision.regularised,
                         .order_dependent = collision.order_dependent});
}

void append_json(std::string& out, const engine::ZoneEvent& event) {
  idl::append_zone_event(out,
                         {.sequence = event.sequence,
                          .seconds = event.instant.seconds,
                          .fraction = event.instant.fraction,
                          .zone = event.zone,
                          .body = event.body,
                          .entered = event.entered,
                          .position = pair(event.position),
                          .velocity = pair(event.velocity)});
}

void append_json(std::string& out, const engine::BodyState& state) {
  idl::append_body_state(out,
                         {.id = state.id,
                          .seconds = state.instant.seconds,
                          .fraction = state.instant.fraction,
                          .position = pair(state.position),
                          .velocity = pair(state.velocity),
                          .angle = state.angle,
                          .spin = state.spin,
                          .radius = state.radius});
}

void append_json(std::string& out, const engine::WallState& wall) {
  idl::append_body_state(out,
                         {.id = wall.id,
                          .seconds = wall.instant.seconds,
                          .fraction = wall.instant.fraction,
                          .position = pair(wall.start),
                          .velocity = pair(wall.velocity)});
}

}  // namespace stoss::client

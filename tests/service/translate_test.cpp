// SPDX-License-Identifier: Apache-2.0
// Between the engine's words and the wire's: whatever goes over comes back the same.
#include <stoss/idl/scene_file.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/basics.hpp>
#include <stoss/translate/columns.hpp>
#include <stoss/translate/command.hpp>
#include <stoss/translate/query.hpp>
#include <stoss/translate/scene.hpp>

#include <gtest/gtest.h>
#include <scene.pb.h>

#include <limits>

namespace stoss::translate {
namespace {

using engine::Code;

TEST(Translate, EveryWordComesBackTheSame) {
  for (int value = 0; value <= 10; ++value) {
    const auto code = static_cast<Code>(value);
    EXPECT_EQ(idl::wire_value(to_wire(code)), value);
    EXPECT_EQ(code_of(static_cast<std::uint16_t>(value)), code);
    EXPECT_EQ(idl::name_of(to_wire(code)), engine::to_string(code));
  }
  EXPECT_FALSE(code_of(11));
  for (int value = 0; value <= 4; ++value) {
    const auto arithmetic = static_cast<engine::Arithmetic>(value);
    EXPECT_EQ(arithmetic_of(idl::wire_value(to_wire(arithmetic))), arithmetic);
    EXPECT_EQ(arithmetic_of(name_of(arithmetic)), arithmetic);
  }
  EXPECT_FALSE(arithmetic_of(std::uint8_t{5}));
  for (int value = 0; value <= 2; ++value) {
    const auto kind = static_cast<engine::BodyKind>(value);
    EXPECT_EQ(body_kind_of(idl::wire_value(to_wire(kind))), kind);
    const auto change = static_cast<engine::ChangeKind>(value);
    EXPECT_EQ(change_of(idl::wire_value(to_wire(change))), change);
    const auto contact = static_cast<engine::ContactKind>(value);
    EXPECT_EQ(contact_kind_of(idl::wire_value(to_wire(contact))), contact);
  }
  EXPECT_FALSE(body_kind_of(stoss_v1_KIND_WALL));
  EXPECT_EQ(wire_field("disks[12].radius"), "disks.radius");
  EXPECT_EQ(broad_phase_of(name_of(engine::BroadPhaseKind::AllPairs)),
            engine::BroadPhaseKind::AllPairs);
}

TEST(Translate, RefusalsComeBackTheSame) {
  const engine::Reject reject{.code = Code::Overlap,
                              .field = "disks[3]",
                              .index = 3,
                              .body = 9,
                              .other = 4,
                              .clearance = -0.5,
                              .reason = "overlaps body 4"};
  wire::Reply reply{};
  put_reject(reply, reject);
  const engine::Reject back = reject_of(reply);
  EXPECT_EQ(back.code, reject.code);
  EXPECT_EQ(back.field, "disks");
  EXPECT_EQ(back.index, reject.index);
  EXPECT_EQ(back.body, reject.body);
  EXPECT_EQ(back.other, reject.other);
  EXPECT_EQ(back.clearance, reject.clearance);
  EXPECT_EQ(back.reason, reject.reason);
}

TEST(Translate, MotionsComeBackBitForBit) {
  MotionColumns columns;
  std::vector<engine::MotionRecord> records;
  for (std::uint64_t i = 1; i <= 5; ++i) {
    const double v = static_cast<double>(i);
    records.push_back({.id = i,
                       .x = {v / 3, v * 1e-18},
                       .y = {-v, 0},
                       .vx = {1 / v, 1e-20},
                       .vy = {-0.0, 0},
                       .since = {static_cast<std::int64_t>(i) - 3, i << 60U},
                       .angle = i == 3 ? 0.25 : 0,
                       .spin = i == 4 ? -2.0 : 0});
    columns.append(engine::ChangeKind::Moved, records.back());
  }
  wire::MotionBlock block{};
  columns.lend(block, 0, columns.size());
  ASSERT_TRUE(consistent(block));
  for (std::size_t i = 0; i < records.size(); ++i) {
    const engine::MotionRecord back = motion_at(block, i);
    EXPECT_EQ(back.id, records[i].id);
    EXPECT_EQ(back.x.high, records[i].x.high);
    EXPECT_EQ(back.x.low, records[i].x.low);
    EXPECT_EQ(back.since, records[i].since);
    EXPECT_EQ(back.angle, records[i].angle);
    EXPECT_EQ(back.spin, records[i].spin);
    EXPECT_EQ(std::signbit(back.vy.high), true);
  }
  columns.lend(block, 1, 3);
  EXPECT_EQ(block.angle._length, 3U);
  EXPECT_EQ(motion_at(block, 1).angle, 0.25);
  block.y._length = 2;
  EXPECT_FALSE(consistent(block));
}

TEST(Translate, ColumnsThatAreAllZeroAreLeftOut) {
  StateColumns states;
  engine::BodyState state;
  state.id = 1;
  states.append(state);
  wire::StateBlock block{};
  states.lend(block, 0, 1);
  EXPECT_EQ(block.angle._length, 0U);
  EXPECT_TRUE(consistent(block));
  StaticColumns statics;
  statics.append({.id = 1, .radius = 1, .mass = 2, .edge_x = {}, .edge_y = {}});
  wire::StaticBlock disks{};
  statics.lend(disks, 0, 1);
  EXPECT_EQ(disks.edge_x._length, 0U);
  statics.append({.id = 2, .is_wall = true, .edge_x = {}, .edge_y = {3, 1e-20}});
  wire::StaticBlock mixed{};
  statics.lend(mixed, 0, 2);
  ASSERT_TRUE(consistent(mixed));
  EXPECT_EQ(mixed.edge_x._length, 2U);
  EXPECT_TRUE(body_at(mixed, 1).is_wall);
  EXPECT_EQ(body_at(mixed, 1).edge_y.low, 1e-20);
}

TEST(Translate, CollisionsComeBackTheSame) {
  engine::Collision collision;
  collision.sequence = 42;
  collision.instant = {7, 9};
  collision.kind = engine::ContactKind::DiskWallEnd;
  collision.regularised = true;
  collision.a = 1;
  collision.b = 2;
  collision.impulse = 0.1;
  collision.velocity_b = {3, 4};
  CollisionColumns columns;
  columns.append(collision);
  wire::CollisionBlock block{};
  columns.lend(block, 0, 1);
  ASSERT_TRUE(consistent(block));
  const engine::Collision back = collision_at(block, 42, 0);
  EXPECT_EQ(back.sequence, 42U);
  EXPECT_EQ(back.instant, collision.instant);
  EXPECT_EQ(back.kind, collision.kind);
  EXPECT_TRUE(back.regularised);
  EXPECT_FALSE(back.order_dependent);
  EXPECT_EQ(back.velocity_b, collision.velocity_b);
}

TEST(Translate, SpawnsComeBackTheSameAndMayLeaveOutDefaults) {
  const DiskColumns disks(
      {{.id = 3, .kind = engine::BodyKind::Kinematic, .radius = 0.5, .mass = 2}});
  wire::Command command{};
  command.protocol = idl::kProtocol;
  command.op = idl::wire_value(idl::Op::kSpawn);
  disks.lend(command.disks);
  auto spec = command_of(command);
  ASSERT_TRUE(spec.ok());
  ASSERT_EQ(spec.value().disks.size(), 1U);
  EXPECT_EQ(spec.value().disks[0].kind, engine::BodyKind::Kinematic);
  EXPECT_EQ(spec.value().disks[0].mass, 2);
  for (auto* column : {&command.disks.mass, &command.disks.vx, &command.disks.vy}) {
    column->_length = 0;
  }
  command.disks.kind._length = 0;
  command.disks.id._length = 0;
  spec = command_of(command);
  ASSERT_TRUE(spec.ok());
  EXPECT_EQ(spec.value().disks[0].mass, 1);
  EXPECT_EQ(spec.value().disks[0].kind, engine::BodyKind::Dynamic);
  command.disks.radius._length = 0;
  spec = command_of(command);
  ASSERT_FALSE(spec.ok());
  EXPECT_EQ(spec.reject().field, "disks.radius");
}

TEST(Translate, EveryEffectOfTheSceneFormatIsEitherInTheEngineOrRefusedByName) {
  Scene empty;
  EXPECT_FALSE(unsupported(empty));
  const auto* const effects = Effects::descriptor();
  for (int i = 0; i < effects->field_count(); ++i) {
    Scene scene;
    scene.mutable_effects()->GetReflection()->MutableMessage(scene.mutable_effects(),
                                                             effects->field(i));
    const std::string name = effects->field(i)->name();
    const auto known = engine_effects();
    const bool has = std::find(known.begin(), known.end(), name) != known.end();
    const auto reject = unsupported(scene);
    EXPECT_EQ(reject.has_value(), !has) << name;
    if (reject) {
      EXPECT_EQ(reject->code, Code::Unimplemented);
      EXPECT_EQ(reject->field, "effects." + name);
    }
  }
}

TEST(Translate, ASceneBecomesItsWorld) {
  const auto loaded = idl::load_scene(std::string(STOSS_SCENE_DIR) + "/tutorial.json");
  ASSERT_TRUE(std::holds_alternative<Scene>(loaded));
  const auto& scene = std::get<Scene>(loaded);
  const auto bodies = bodies_of(scene);
  ASSERT_TRUE(bodies.ok());
  EXPECT_EQ(bodies.value().disk_names[1], "bullet");
  const auto world = make_world(scene, {});
  ASSERT_TRUE(world.ok());
  EXPECT_EQ(world.value().disk_count(), 2U);
  EXPECT_EQ(world.value().wall(3).value().end, engine::Vector2(4, 1));
  Scene zoned = scene;
  Zone& zone = *zoned.add_zones();
  zone.set_name("goal");
  zone.mutable_center()->set_x(2);
  zone.set_radius(0.5);
  const auto with_zone = bodies_of(zoned);
  ASSERT_TRUE(with_zone.ok());
  EXPECT_EQ(with_zone.value().name_of(3), "goal");
  const auto made = make_world(zoned, {});
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(made.value().zone_count(), 1U);
  EXPECT_EQ(made.value().inside(4).value(), std::vector<engine::Id>{2});
  Scene periodic = scene;
  periodic.mutable_period()->set_x(10);
  const auto repeating = make_world(periodic, {});
  ASSERT_TRUE(repeating.ok());
  EXPECT_EQ(repeating.value().period(), engine::Vector2(10, 0));
  periodic.mutable_period()->set_y(1e-30);
  EXPECT_EQ(make_world(periodic, {}).reject().field, "period.y");
}

}  // namespace
}  // namespace stoss::translate

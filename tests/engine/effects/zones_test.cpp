// SPDX-License-Identifier: Apache-2.0
// Zones: who is inside, exact instants under every motion law, nothing missed and nothing moved.
#include "support/campaign.hpp"
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace stoss::engine {
namespace {

using test::seconds;

ZoneSpec zone(Id id, Vector2 center, double radius) { return {id, center, radius}; }

WorldOptions taking_zones(BroadPhaseKind kind = BroadPhaseKind::Neighbours) {
  WorldOptions options;
  options.effects.zones = true;
  options.broad_phase = kind;
  return options;
}

/// Everything that happens, in order.
struct Diary final : CollisionSink {
  void on_collision(const Collision& collision) override { collisions.push_back(collision); }
  void on_zone_event(const ZoneEvent& event) override { events.push_back(event); }
  std::vector<Collision> collisions;
  std::vector<ZoneEvent> events;
};

std::vector<ZoneEvent> events_until(World& world, double until) {
  Diary diary;
  EXPECT_TRUE(world.advance_to(seconds(until), &diary).ok());
  return diary.events;
}

std::vector<Id> must_spawn_zones(World& world,
                                 std::initializer_list<ZoneSpec> zones,
                                 std::initializer_list<DiskSpec> disks = {},
                                 std::span<const WallSpec> walls = {}) {
  auto made = world.spawn(
      {std::span(disks.begin(), disks.size()), walls, std::span(zones.begin(), zones.size())});
  if (!made) {
    ADD_FAILURE() << made.reject().field << ' ' << made.reject().reason;
    return {};
  }
  return std::move(made).value();
}

std::vector<Id> inside(const World& world, Id zone) {
  auto disks = world.inside(zone);
  EXPECT_TRUE(disks.ok());
  return disks.ok() ? std::move(disks).value() : std::vector<Id>{};
}

TEST(Zones, ReportEnteringAndLeavingAtTheirInstants) {
  World world(taking_zones());
  must_spawn_zones(world, {zone(7, {3, 0}, 1)}, {test::disk(1, {0, 0}, {2, 0}, 0.25)});
  const auto events = events_until(world, 10);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].sequence, 1U);
  EXPECT_EQ(events[0].instant, seconds(1));
  EXPECT_EQ(events[0].zone, 7U);
  EXPECT_EQ(events[0].body, 1U);
  EXPECT_TRUE(events[0].entered);
  EXPECT_EQ(events[0].position, Vector2(2, 0));
  EXPECT_EQ(events[0].velocity, Vector2(2, 0));
  EXPECT_EQ(events[1].sequence, 2U);
  EXPECT_EQ(events[1].instant, seconds(2));
  EXPECT_FALSE(events[1].entered);
  EXPECT_EQ(world.counters().zone_events, 2U);
}

TEST(Zones, KnowWhoIsInside) {
  World world(taking_zones());
  must_spawn_zones(world,
                   {zone(10, {0, 0}, 2), zone(11, {1, 0}, 1)},
                   {test::disk(1, {0, 0}, {0, 0}, 0.1),
                    test::disk(2, {2, 0}, {-1, 0}, 0.1),
                    test::static_disk(3, {0, 1}, 0.1),
                    test::kinematic_disk(4, {0, 3}, {0, -1}, 0.1)});
  // 1 is on the rim of 11, 2 on those of both, which it enters at once.
  EXPECT_EQ(inside(world, 10), (std::vector<Id>{1, 3}));
  EXPECT_EQ(inside(world, 11), std::vector<Id>{});
  const auto at_once = events_until(world, 0);
  ASSERT_EQ(at_once.size(), 2U);
  EXPECT_EQ(at_once[0].zone, 10U);
  EXPECT_EQ(at_once[1].zone, 11U);
  events_until(world, 1.5);
  EXPECT_EQ(inside(world, 10), (std::vector<Id>{1, 2, 3, 4}));
  EXPECT_EQ(world.inside(1).reject().code, Code::NotFound);
  EXPECT_EQ(world.zone(10).value(), (ZoneState{10, {0, 0}, 2}));
  EXPECT_EQ(world.zone(2).reject().code, Code::NotFound);
}

TEST(Zones, AreNoBodies) {
  World world(taking_zones());
  must_spawn_zones(world, {zone(7, {0, 0}, 5)}, {test::disk(1, {9, 0}, {0, 0}, 0.5)});
  EXPECT_EQ(world.disk_count(), 1U);
  EXPECT_EQ(world.wall_count(), 0U);
  EXPECT_EQ(world.zone_count(), 1U);
  EXPECT_EQ(world.ids(), std::vector<Id>{1});
  EXPECT_EQ(world.state(7).reject().code, Code::NotFound);
  EXPECT_EQ(world.motion(7).reject().code, Code::NotFound);
  EXPECT_EQ(world.body(7).reject().code, Code::NotFound);
  EXPECT_TRUE(world.region({-1, -1}, {1, 1}).empty());
  EXPECT_EQ(world.nearest({0, 0}, 5).size(), 1U);
  EXPECT_EQ(world.ray({-9, 0}, {1, 0}, 100).value().id, 1U);
  const VectorFor push{7, {1, 0}};
  EXPECT_EQ(world.set_velocity({&push, 1}).reject().code, Code::FailedPrecondition);
  EXPECT_EQ(world.apply_impulse({&push, 1}).reject().code, Code::FailedPrecondition);
  EXPECT_TRUE(world.contains(7));
}

TEST(Zones, RefuseWhatIsNoCircleAndWhatIsTaken) {
  World world(taking_zones());
  must_spawn_zones(world, {zone(7, {0, 0}, 5)});
  const auto before = test::fingerprint(world);
  const auto refusal = [&](const ZoneSpec& spec) {
    return world.spawn({{}, {}, std::span(&spec, 1)}).reject();
  };
  EXPECT_EQ(refusal(zone(8, {0, 0}, 0)).field, "zones[0].radius");
  EXPECT_EQ(refusal(zone(8, {0, 0}, std::nan(""))).code, Code::InvalidArgument);
  EXPECT_EQ(refusal(zone(8, {0, HUGE_VAL}, 1)).field, "zones[0].center");
  EXPECT_EQ(refusal(zone(7, {0, 0}, 1)).code, Code::AlreadyExists);
  EXPECT_EQ(test::fingerprint(world), before);
  const Id seven = 7;
  ASSERT_TRUE(world.remove({&seven, 1}).ok());
  EXPECT_EQ(refusal(zone(7, {0, 0}, 1)).code, Code::AlreadyExists);
  EXPECT_EQ(world.zone_count(), 0U);
}

// Until the first zone comes the world is plain; then it is of another kind, with the same bodies.
TEST(Zones, ComeIntoAPlainWorld) {
  World world;
  test::must_spawn(world,
                   {test::disk(1, {0, 0}, {1, 0.1}, 0.25), test::disk(2, {4, 0.2}, {0, 0}, 0.25)});
  const World without = world;
  events_until(world, 1);
  const auto before = test::fingerprint(world);
  const ZoneSpec bad = zone(7, {0, 0}, -1);
  EXPECT_EQ(world.spawn({{}, {}, {&bad, 1}}).reject().field, "zones[0].radius");
  EXPECT_EQ(test::fingerprint(world), before);
  must_spawn_zones(world, {zone(7, {6, 0}, 1)});
  EXPECT_TRUE(world.effects().zones);
  World plain = without;
  Diary with_zone, plainly;
  ASSERT_TRUE(world.advance_to(seconds(20), &with_zone).ok());
  ASSERT_TRUE(plain.advance_to(seconds(20), &plainly).ok());
  EXPECT_EQ(test::difference(with_zone.collisions, plainly.collisions), "");
  EXPECT_EQ(with_zone.events.size(), 2U);
}

TEST(Zones, OutlastASwitchOfEffects) {
  World world;
  must_spawn_zones(world, {zone(7, {3, 0}, 1)}, {test::disk(1, {0, 0}, {2, 0}, 0.25)});
  EXPECT_EQ(events_until(world, 1.5).size(), 1U);
  Effects falling;
  falling.gravity = Gravity{{-8, 0}};
  ASSERT_TRUE(world.set_effects(falling).ok());
  EXPECT_EQ(inside(world, 7), std::vector<Id>{1});
  const auto events = events_until(world, 5);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].sequence, 2U);
  EXPECT_FALSE(events[0].entered);
  ASSERT_TRUE(world.set_effects({}).ok());
  EXPECT_EQ(world.zone_count(), 1U);
  const Id seven = 7;
  ASSERT_TRUE(world.remove({&seven, 1}).ok());
  ASSERT_TRUE(world.set_effects({}).ok());
  EXPECT_EQ(world.effects(), Effects{});
  EXPECT_EQ(world.counters().zone_events, 2U);
  EXPECT_TRUE(World::deserialise(world.serialise()).ok());
}

// A second has 2^64 parts, a passage of 1 mm at 10^9 m/s takes a picosecond.
TEST(Zones, MissNoBulletHoweverFast) {
  World world(taking_zones());
  must_spawn_zones(
      world,
      {zone(7, {1e6, 0}, 5e-4), zone(8, {1e6, 6e-4}, 5e-4), zone(9, {2e9, 4e-4}, 5e-4)},
      {test::disk(1, {0, 0}, {1e9, 0}, 1e-3)});
  const auto events = events_until(world, 10);
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[0].instant, seconds((1e6 - 5e-4) / 1e9));
  for (const ZoneEvent& event : events) {
    const ZoneState circle = world.zone(event.zone).value();
    EXPECT_NEAR((event.position - circle.center).norm(), circle.radius, 4e-7);
  }
  EXPECT_EQ(events[3].zone, 9U);
  EXPECT_NEAR(seconds_between(events[2].instant, events[3].instant), 6e-13, 1e-18);
}

TEST(Zones, ComeAndGoWhileTheWorldRuns) {
  World world(taking_zones());
  must_spawn_zones(world, {}, {test::disk(1, {0, 0}, {1, 0}, 0.25)});
  events_until(world, 3);
  must_spawn_zones(world, {zone(7, {2, 0}, 1), zone(8, {3, 0}, 2), zone(9, {9, 0}, 1)});
  EXPECT_TRUE(inside(world, 7).empty());  // on its rim, leaving
  EXPECT_EQ(inside(world, 8), std::vector<Id>{1});
  const auto events = events_until(world, 9);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].zone, 8U);
  EXPECT_FALSE(events[0].entered);
  EXPECT_EQ(events[0].instant, seconds(5));
  EXPECT_EQ(events[1].zone, 9U);
  const Id nine = 9;
  ASSERT_TRUE(world.remove({&nine, 1}).ok());
  EXPECT_TRUE(events_until(world, 99).empty());
  World again = World::deserialise(world.serialise()).value();
  EXPECT_EQ(again.state_hash(), world.state_hash());
}

// From wall to wall through two zones, of which one holds a wall.
TEST(Zones, FollowABodyThatTurnsRound) {
  World world(taking_zones());
  const std::vector<WallSpec> walls{test::wall(20, {-5, -5}, {-5, 5}),
                                    test::wall(21, {5, -5}, {5, 5})};
  must_spawn_zones(world,
                   {zone(10, {0, 0}, 1), zone(11, {5, 0}, 2)},
                   {test::disk(1, {0, 0}, {1, 0}, 0.5)},
                   walls);
  const auto events = events_until(world, 18 * 100);
  // Out, in, out, in a round of 18 s: -1..1 twice, 11 in at 3 and out again at 3 on the way back.
  ASSERT_EQ(events.size(), 600U);
  const double when[] = {1, 3, 6, 8, 10, 17};
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].instant, seconds(18.0 * static_cast<double>(i / 6) + when[i % 6])) << i;
    EXPECT_EQ(events[i].entered, i % 6 % 2 == 1) << i;
  }
}

World gas_with_zones(const WorldOptions& options, bool with_zones) {
  World world(options);
  test::Random random(11);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 100; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(test::disk(static_cast<Id>(i + 1),
                               {1.2 * (i % 10) + 1, 1.2 * (i / 10) + 1},
                               velocity,
                               0.2 + 0.1 * (i % 3),
                               1 + i % 2));
  }
  disks.push_back(test::static_disk(900, {6.4, 12.8}, 0.3));
  disks.push_back(test::kinematic_disk(901, {-9, 15}, {1, 0}, 0.3));
  test::must_spawn(world, disks, test::box(1'000, {0, 0}, {13.4, 13.4}));
  if (!with_zones) return world;
  const ZoneSpec zones[] = {zone(2'000, {0, 0}, 3),
                            zone(2'001, {6.4, 12.8}, 0.3),
                            zone(2'002, {6.7, 6.7}, 5),
                            zone(2'003, {3, 3}, 0.01),
                            zone(2'004, {3, 15}, 2)};
  EXPECT_TRUE(world.spawn({{}, {}, zones}).ok());
  return world;
}

struct Law {
  const char* name;
  void (*set)(WorldOptions& options);
  WorldOptions options(BroadPhaseKind kind) const {
    WorldOptions made = taking_zones(kind);
    set(made);
    return made;
  }
};
constexpr Law kLaws[] = {
    {"uniform motion", [](WorldOptions&) {}},
    {"gravity",
     [](WorldOptions& o) {
       o.effects.gravity = Gravity{{0.3, -2}};
     }},
    {"floor friction", [](WorldOptions& o) { o.effects.floor_friction = FloorFriction{0.02}; }},
    {"drag", [](WorldOptions& o) { o.effects.drag = Drag{0.05}; }},
    {"drag and gravity",
     [](WorldOptions& o) {
       o.effects.drag = Drag{0.2};
       o.effects.gravity = Gravity{{0.3, -2}};
     }},
    {"growth", [](WorldOptions& o) { o.effects.growth = Growth{0.002}; }},
    {"a thermostat",
     [](WorldOptions& o) {
       o.effects.thermostat = Thermostat{1, 0.5, 7};
     }},
};

TEST(Zones, MoveNothing) {
  for (const Law law : kLaws) {
    SCOPED_TRACE(law.name);
    const WorldOptions options = law.options(BroadPhaseKind::Neighbours);
    World with = gas_with_zones(options, true);
    World without = gas_with_zones(options, false);
    Diary a, b;
    ASSERT_TRUE(with.advance_to(seconds(10), &a).ok());
    ASSERT_TRUE(without.advance_to(seconds(10), &b).ok());
    EXPECT_GT(a.events.size(), 50U);
    EXPECT_EQ(b.events.size(), 0U);
    EXPECT_EQ(test::difference(a.collisions, b.collisions), "");
    without.for_each_disk([&](const BodyState& disk) {
      EXPECT_EQ(test::state(with, disk.id).position, disk.position);
    });
  }
}

TEST(Zones, MoveAPlainWorldsBodiesLikeAPlainWorld) {
  World with = gas_with_zones(taking_zones(), true);
  World plain = gas_with_zones({}, false);
  Diary a, b;
  ASSERT_TRUE(with.advance_to(seconds(10), &a).ok());
  ASSERT_TRUE(plain.advance_to(seconds(10), &b).ok());
  EXPECT_EQ(test::difference(a.collisions, b.collisions), "");
}

// The books agree with the picture: whoever is inside by the events is inside by geometry.
TEST(Zones, AgreeWithThePictureAtEveryTick) {
  for (const Law law : kLaws) {
    SCOPED_TRACE(law.name);
    World world = gas_with_zones(law.options(BroadPhaseKind::Neighbours), true);
    std::map<std::pair<Id, Id>, bool> books;
    world.for_each_zone([&](const ZoneState& circle) {
      for (const Id id : inside(world, circle.id)) books[{circle.id, id}] = true;
    });
    std::uint64_t number = 0;
    for (int tick = 1; tick <= 300; ++tick) {
      for (const ZoneEvent& event : events_until(world, tick / 10.0)) {
        EXPECT_EQ(event.sequence, ++number);
        bool& is_inside = books[{event.zone, event.body}];
        EXPECT_NE(is_inside, event.entered);
        is_inside = event.entered;
      }
      world.for_each_zone([&](const ZoneState& circle) {
        std::vector<Id> by_books;
        world.for_each_disk([&](const BodyState& disk) {
          const double height = (disk.position - circle.center).norm() - circle.radius;
          const bool is_inside = books[{circle.id, disk.id}];
          if (is_inside) by_books.push_back(disk.id);
          if (std::abs(height) > 1e-12) {
            EXPECT_EQ(is_inside, height < 0) << disk.id;
          }
        });
        EXPECT_EQ(by_books, inside(world, circle.id));
      });
    }
    EXPECT_GT(number, 40U);
  }
}

TEST(Zones, TellOneStoryWhateverTheTicksTheBroadPhaseAndAPauseInBytes) {
  for (const Law law : kLaws) {
    SCOPED_TRACE(law.name);
    const auto gas = [law](BroadPhaseKind kind) { return gas_with_zones(law.options(kind), true); };
    const World world = test::expect_one_story(gas, 5, 250, 5);
    EXPECT_GT(world.counters().zone_events, 40U);
  }
}

TEST(Zones, ReportTheSameAtEveryTickRate) {
  const auto told = [](int ticks) {
    World world = gas_with_zones(taking_zones(), true);
    std::vector<ZoneEvent> all;
    for (int i = 1; i <= ticks; ++i) {
      const auto events = events_until(world, 10.0 * i / ticks);
      all.insert(all.end(), events.begin(), events.end());
    }
    return all;
  };
  const auto leap = told(1);
  const auto slow = told(997);
  ASSERT_EQ(leap.size(), slow.size());
  for (std::size_t i = 0; i < leap.size(); ++i) {
    ASSERT_EQ(leap[i].sequence, slow[i].sequence);
    ASSERT_EQ(leap[i].instant, slow[i].instant);
    ASSERT_EQ(leap[i].zone, slow[i].zone);
    ASSERT_EQ(leap[i].body, slow[i].body);
    ASSERT_EQ(leap[i].entered, slow[i].entered);
    ASSERT_EQ(leap[i].position, slow[i].position);
    ASSERT_EQ(leap[i].velocity, slow[i].velocity);
  }
}

// A ball thrown up through a ring comes down through it: four crossings of one stored motion.
TEST(Zones, FollowAParabolaThroughTwice) {
  WorldOptions options = taking_zones();
  options.effects.gravity = Gravity{{0, -8}};
  World world(options);
  must_spawn_zones(world, {zone(7, {0, 0}, 1)}, {test::disk(1, {0, -3}, {0, 10}, 0.1)});
  const auto events = events_until(world, 10);
  ASSERT_EQ(events.size(), 4U);
  // y = -3 + 10 t - 4 t^2
  EXPECT_NEAR(seconds_between({}, events[0].instant), (10 - std::sqrt(68)) / 8, 1e-15);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(events[i].entered, i % 2 == 0);
  EXPECT_NEAR(seconds_between(events[0].instant, events[3].instant), std::sqrt(68) / 4, 1e-15);
}

// Friction 1 m/s^2 from 2 m/s: it stops after 2 m, on the rim of one zone and inside another.
TEST(Zones, ASlidingDiskStopsWhereItStops) {
  WorldOptions options = taking_zones();
  options.effects.floor_friction = FloorFriction{1};
  World world(options);
  must_spawn_zones(world,
                   {zone(7, {3, 0}, 1), zone(8, {3, 0}, 1.5), zone(9, {2, 0}, 0.5)},
                   {test::disk(1, {0, 0}, {2, 0}, 0.1)});
  const auto events = events_until(world, 100);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].zone, 8U);
  EXPECT_EQ(events[1].zone, 9U);
  EXPECT_EQ(events[0].instant, events[1].instant);
  EXPECT_EQ(events[0].instant, seconds(1));
  EXPECT_TRUE(inside(world, 7).empty());
}

WorldOptions periodic(BroadPhaseKind kind, const Vector2& period) {
  WorldOptions options;
  options.broad_phase = kind;
  options.period = period;
  return options;
}

/// Disks among the images of two zones, of which one lies across a corner of the cell.
World periodic_gas_with_zones(const WorldOptions& options, bool with_zones) {
  World world(options);
  test::Random random(5);
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 36; ++i) {
    const Vector2 velocity(random.uniform(-1, 1), random.uniform(-1, 1));
    disks.push_back(test::disk(
        static_cast<Id>(i + 1), {1.6 * (i % 6) + 0.8, 1.6 * (i / 6) + 0.8}, velocity, 0.4));
  }
  test::must_spawn(world, disks);
  if (!with_zones) return world;
  const ZoneSpec zones[] = {zone(100, {0.3, 9.4}, 1.5), zone(101, {5, 5}, 4.7)};
  EXPECT_TRUE(world.spawn({{}, {}, zones}).ok());
  return world;
}

TEST(Zones, HaveImagesInAPeriodicWorld) {
  World world(periodic(BroadPhaseKind::Neighbours, {10, 0}));
  must_spawn_zones(world, {zone(7, {9.5, 0}, 1)}, {test::disk(1, {3, 0}, {1, 0}, 0.25)});
  const auto events = events_until(world, 28);
  // In at 8.5 and out at 10.5, a period of 10 m over and over.
  ASSERT_EQ(events.size(), 6U);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double when = (i % 2 == 0 ? 5.5 : 7.5) + 10.0 * static_cast<double>(i / 2);
    EXPECT_EQ(events[i].instant, seconds(when));
    EXPECT_EQ(events[i].entered, i % 2 == 0);
    EXPECT_EQ(events[i].position, Vector2(i % 2 == 0 ? 8.5 : 0.5, 0));
  }
  const auto refused = [&](double radius) {
    const ZoneSpec spec = zone(8, {0, 0}, radius);
    return !world.spawn({{}, {}, {&spec, 1}}).ok();
  };
  EXPECT_TRUE(refused(5));
  EXPECT_FALSE(refused(4.99));
}

TEST(Zones, AgreeWithThePictureInAPeriodicWorld) {
  for (const double period_y : {9.6, 0.0}) {
    World world =
        periodic_gas_with_zones(periodic(BroadPhaseKind::Neighbours, {9.6, period_y}), true);
    std::uint64_t number = 0;
    for (int tick = 1; tick <= 200; ++tick) {
      for (const ZoneEvent& event : events_until(world, tick / 10.0)) {
        EXPECT_EQ(event.sequence, ++number);
      }
      world.for_each_zone([&](const ZoneState& circle) {
        std::vector<Id> seen;
        world.for_each_disk([&](const BodyState& disk) {
          double nearest = HUGE_VAL;
          for (const int i : {-1, 0, 1}) {
            for (const int j : {-1, 0, 1}) {
              const Vector2 image = circle.center + Vector2(9.6 * i, period_y * j);
              nearest = std::min(nearest, (disk.position - image).norm());
            }
          }
          if (nearest < circle.radius) seen.push_back(disk.id);
        });
        EXPECT_EQ(seen, inside(world, circle.id));
      });
    }
    EXPECT_GT(number, 40U);
  }
}

TEST(Zones, TellOneStoryInAPeriodicWorld) {
  const auto gas = [](BroadPhaseKind kind) {
    return periodic_gas_with_zones(periodic(kind, {9.6, 9.6}), true);
  };
  const World world = test::expect_one_story(gas, 5, 250, 5);
  World without = periodic_gas_with_zones(periodic(BroadPhaseKind::Neighbours, {9.6, 9.6}), false);
  test::run_for(without, 10);
  without.for_each_disk([&](const BodyState& disk) {
    EXPECT_EQ(test::state(world, disk.id).position, disk.position);
  });
}

TEST(Zones, RunInEveryArithmetic) {
  for (const Arithmetic arithmetic :
       {Arithmetic::Float, Arithmetic::Double, Arithmetic::LongDouble}) {
    WorldOptions options = taking_zones();
    options.arithmetic = arithmetic;
    World world(options);
    must_spawn_zones(world, {zone(7, {3, 0}, 1)}, {test::disk(1, {0, 0}, {2, 0}, 0.25)});
    const auto events = events_until(world, 10);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].instant, seconds(1));
    EXPECT_EQ(events[1].instant, seconds(2));
  }
}

TEST(Zones, DamagedPassagesAreRefused) {
  World world(taking_zones());
  must_spawn_zones(world, {zone(7, {3, 0}, 1)}, {test::disk(1, {3, 0}, {2, 0}, 0.25)});
  const std::vector<std::byte> bytes = world.serialise();
  ASSERT_TRUE(World::deserialise(bytes).ok());
  // The disk's passage: of zone 7, inside.
  std::vector<std::byte> passage(16);
  passage[0] = std::byte{7};
  passage[8] = std::byte{1};
  const auto found = std::search(bytes.begin(), bytes.end(), passage.begin(), passage.end());
  ASSERT_NE(found, bytes.end());
  const auto at = static_cast<std::size_t>(found - bytes.begin());
  const auto accepts = [&](std::size_t place, int value) {
    std::vector<std::byte> damaged = bytes;
    damaged[place] = static_cast<std::byte>(value);
    return World::deserialise(damaged).ok();
  };
  EXPECT_FALSE(accepts(at, 1));       // no zone
  EXPECT_FALSE(accepts(at, 8));       // nothing
  EXPECT_FALSE(accepts(at + 8, 2));   // neither in nor out
  EXPECT_FALSE(accepts(at + 16, 1));  // since a second from now
}

}  // namespace
}  // namespace stoss::engine

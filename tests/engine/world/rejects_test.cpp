// SPDX-License-Identifier: Apache-2.0
// Every refusal: its code, the field and the body it names, and that nothing has changed.

#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::disk;
using test::fingerprint;
using test::must_spawn;
using test::seconds;
using test::wall;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A world in flight: disks 1 (moving), 2 (static), 3 (kinematic), walls 4 and 5, disk 6 retired.
World sample_world(Arithmetic arithmetic = Arithmetic::Double) {
  World world(WorldOptions{.start = seconds(10), .arithmetic = arithmetic});
  const std::vector<DiskSpec> disks = {disk(1, {0, 0}, {1, 0.25}, 0.5),
                                       test::static_disk(2, {5, 0}, 1),
                                       test::kinematic_disk(3, {0, 5}, {0.5, 0}, 0.25),
                                       disk(6, {50, 50}, {0, 0}, 1)};
  const std::vector<WallSpec> walls = {wall(4, {-10, -10}, {10, -10}), wall(5, {8, -1}, {8, 9})};
  must_spawn(world, disks, walls);
  const Id retired[] = {6};
  EXPECT_TRUE(world.remove(retired).ok());
  EXPECT_TRUE(world.advance_to(seconds(11)).ok());
  return world;
}

/// Holds a world to what it was, and to the id that it would assign next.
class Unchanged {
 public:
  explicit Unchanged(const World& world) : world_(world), before_(fingerprint(world)) {}
  ~Unchanged() {
    EXPECT_EQ(fingerprint(world_), before_);
    EXPECT_EQ(next_id(), 7U);
  }
  Unchanged(const Unchanged&) = delete;
  Unchanged& operator=(const Unchanged&) = delete;

 private:
  Id next_id() const {
    World fork = world_;
    const DiskSpec spec = disk(kNoId, {1000, 1000}, {0, 0}, 1);
    const auto made = fork.spawn({std::span(&spec, 1), {}});
    return made.ok() ? made.value().front() : kNoId;
  }

  const World& world_;
  test::Fingerprint before_;
};

struct Expected {
  Code code;
  std::string field;
  Id body = kNoId;
};

template <class T>
void expect_reject(const Outcome<T>& outcome, const Expected& expected) {
  ASSERT_FALSE(outcome.ok());
  const Reject& reject = outcome.reject();
  EXPECT_EQ(reject.code, expected.code) << reject.reason;
  EXPECT_EQ(reject.field, expected.field);
  EXPECT_EQ(reject.body, expected.body);
  EXPECT_FALSE(reject.reason.empty());
}

/// Spawning the disk after a good one is refused for its `field`, and the good one is not left.
void expect_disk_refused(const DiskSpec& bad, Code code, const std::string& member) {
  SCOPED_TRACE(member);
  World world = sample_world();
  const Unchanged unchanged(world);
  const std::vector<DiskSpec> disks = {disk(kNoId, {-5, 0}, {0, 1}, 0.5), bad};
  expect_reject(world.spawn({disks, {}}), {code, "disks[1]" + member, bad.id});
}

DiskSpec good_disk() { return disk(20, {20, 20}, {1, 1}, 0.5); }

TEST(Rejects, DisksThatAreNotFinite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    DiskSpec spec = good_disk();
    spec.position.x() = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".position");
    spec = good_disk();
    spec.position.y() = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".position");
    spec = good_disk();
    spec.velocity.x() = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".velocity");
    spec = good_disk();
    spec.velocity.y() = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".velocity");
    spec = good_disk();
    spec.radius = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".radius");
    spec = good_disk();
    spec.mass = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".mass");
    spec = good_disk();
    spec.angle = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".angle");
    spec = good_disk();
    spec.spin = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".spin");
  }
}

TEST(Rejects, DisksWithoutARadiusOrAMass) {
  for (const double bad : {0.0, -0.0, -1.0, -std::numeric_limits<double>::denorm_min()}) {
    DiskSpec spec = good_disk();
    spec.radius = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".radius");
    spec = good_disk();
    spec.mass = bad;
    expect_disk_refused(spec, Code::InvalidArgument, ".mass");
  }
}

TEST(Rejects, DisksBeyondTheRangeOfTheArithmetic) {
  DiskSpec spec = good_disk();
  spec.position.x() = 1.1e150;
  expect_disk_refused(spec, Code::InvalidArgument, ".position");
  spec = good_disk();
  spec.velocity.y() = -1.1e150;
  expect_disk_refused(spec, Code::InvalidArgument, ".velocity");
  spec = good_disk();
  spec.radius = 1.1e150;
  expect_disk_refused(spec, Code::InvalidArgument, ".radius");
}

TEST(Rejects, AStaticDiskThatMoves) {
  DiskSpec spec = good_disk();
  spec.kind = BodyKind::Static;
  spec.velocity = {0, 1e-300};
  expect_disk_refused(spec, Code::InvalidArgument, ".velocity");
}

TEST(Rejects, AKindThatDoesNotExist) {
  DiskSpec spec = good_disk();
  spec.kind = static_cast<BodyKind>(3);
  expect_disk_refused(spec, Code::InvalidArgument, ".kind");
}

TEST(Rejects, IdsInUseRetiredOrKept) {
  for (const Id id : {Id{1}, Id{4}, Id{6}}) {
    DiskSpec spec = good_disk();
    spec.id = id;
    expect_disk_refused(spec, Code::AlreadyExists, ".id");
  }
  DiskSpec spec = good_disk();
  spec.id = std::numeric_limits<Id>::max();
  expect_disk_refused(spec, Code::InvalidArgument, ".id");
}

TEST(Rejects, AnIdAskedForTwiceInOneSpawn) {
  World world = sample_world();
  const Unchanged unchanged(world);
  const std::vector<DiskSpec> disks = {disk(20, {20, 20}, {0, 0}, 1),
                                       disk(21, {30, 20}, {0, 0}, 1)};
  const std::vector<WallSpec> walls = {wall(20, {40, 0}, {41, 0})};
  const auto outcome = world.spawn({disks, walls});
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.reject().code, Code::AlreadyExists);
  EXPECT_EQ(outcome.reject().body, 20U);
}

void expect_wall_refused(const WallSpec& bad, Code code, const std::string& member) {
  SCOPED_TRACE(member);
  World world = sample_world();
  const Unchanged unchanged(world);
  const std::vector<DiskSpec> disks = {disk(kNoId, {-5, 0}, {0, 1}, 0.5)};
  const std::vector<WallSpec> walls = {wall(kNoId, {30, 0}, {31, 1}), bad};
  expect_reject(world.spawn({disks, walls}), {code, "walls[1]" + member, bad.id});
}

TEST(Rejects, WallsThatAreNotFiniteOrBeyondTheRange) {
  for (const double bad : {kNan, kInf, -kInf, 1.1e150}) {
    expect_wall_refused(wall(20, {bad, 0}, {1, 1}), Code::InvalidArgument, ".start");
    expect_wall_refused(wall(20, {0, 30}, {1, bad}), Code::InvalidArgument, ".end");
    expect_wall_refused(wall(20, {0, 30}, {1, 30}, {0, bad}), Code::InvalidArgument, ".velocity");
  }
}

TEST(Rejects, AWallOfNoLength) {
  expect_wall_refused(wall(20, {30, 3}, {30, 3}), Code::InvalidArgument, ".end");
  expect_wall_refused(wall(20, {0.0, 30}, {-0.0, 30}), Code::InvalidArgument, ".end");
}

TEST(Rejects, WallsWhoseIdIsTaken) {
  for (const Id id : {Id{1}, Id{5}, Id{6}}) {
    expect_wall_refused(wall(id, {30, 0}, {30, 3}), Code::AlreadyExists, ".id");
  }
}

/// A refusal for overlap: `body` is in the way of `other` by `clearance` < 0.
void expect_overlap(World& world,
                    const SpawnRequest& request,
                    const std::string& field,
                    Id body,
                    Id other,
                    double clearance) {
  const auto before = fingerprint(world);
  const auto outcome = world.spawn(request);
  expect_reject(outcome, {Code::Overlap, field, body});
  EXPECT_EQ(outcome.reject().other, other);
  EXPECT_NEAR(outcome.reject().clearance, clearance, 4e-16 * 10);
  EXPECT_EQ(fingerprint(world), before);
}

TEST(Rejects, ADiskInADiskSaysWhichAndByHowMuch) {
  World world(WorldOptions{});
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 2), disk(2, {10, 0}, {0, 0}, 1)});
  const DiskSpec spec = disk(7, {3, 4}, {0, 0}, 3.25);  // 5 m from disk 1
  expect_overlap(world, {std::span(&spec, 1), {}}, "disks[0]", 7, 1, -0.25);
}

TEST(Rejects, ADiskOnAWallsFaceSaysWhichAndByHowMuch) {
  World world(WorldOptions{});
  const std::vector<WallSpec> walls = {wall(1, {0, 0}, {8, 6})};
  must_spawn(world, {}, walls);
  const DiskSpec spec = disk(7, {1, 7}, {0, 0}, 5.5);  // 5 m from the line, beside (4, 3)
  expect_overlap(world, {std::span(&spec, 1), {}}, "disks[0]", 7, 1, -0.5);
}

TEST(Rejects, ADiskOnAWallsEndSaysWhichAndByHowMuch) {
  World world(WorldOptions{});
  const std::vector<WallSpec> walls = {wall(1, {0, 0}, {8, 0})};
  must_spawn(world, {}, walls);
  const DiskSpec at_start = disk(7, {-3, 4}, {0, 0}, 5.125);
  expect_overlap(world, {std::span(&at_start, 1), {}}, "disks[0]", 7, 1, -0.125);
  const DiskSpec at_end = disk(7, {11, -4}, {0, 0}, 6);
  expect_overlap(world, {std::span(&at_end, 1), {}}, "disks[0]", 7, 1, -1);
}

TEST(Rejects, AWallThroughADiskSaysWhichAndByHowMuch) {
  World world(WorldOptions{});
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 2), disk(2, {0, 10}, {0, 0}, 1)});
  const WallSpec spec = wall(kNoId, {-5, 1.5}, {5, 1.5});
  expect_overlap(world, {{}, std::span(&spec, 1)}, "walls[0]", kNoId, 1, -0.5);
}

TEST(Rejects, TheDeepestOverlapIsNamedAndTiesByTheLowerId) {
  World world(WorldOptions{});
  must_spawn(world,
             {disk(5, {-2, 0}, {0, 0}, 1), disk(3, {2, 0}, {0, 0}, 1), disk(4, {0, 3}, {0, 0}, 1)});
  const DiskSpec spec = disk(kNoId, {0, 0}, {0, 0}, 1.5);
  expect_overlap(world, {std::span(&spec, 1), {}}, "disks[0]", kNoId, 3, -0.5);
  const DiskSpec towards_5 = disk(kNoId, {-0.5, 0}, {0, 0}, 1.5);
  expect_overlap(world, {std::span(&towards_5, 1), {}}, "disks[0]", kNoId, 5, -1);
}

TEST(Rejects, OverlapOfTwoBodiesOfTheSameSpawn) {
  World world(WorldOptions{});
  const std::vector<DiskSpec> disks = {
      disk(1, {0, 0}, {0, 0}, 1), disk(2, {5, 0}, {0, 0}, 1), disk(3, {1.5, 0}, {0, 0}, 1)};
  expect_overlap(world, {disks, {}}, "disks[2]", 3, 1, -0.5);
  EXPECT_EQ(world.disk_count(), 0U);
}

TEST(Rejects, OverlapWithWhatHasMovedHere) {
  World world(WorldOptions{});
  must_spawn(world, {disk(1, {-10, 0}, {2, 0}, 1)});
  ASSERT_TRUE(world.advance_to(seconds(5)).ok());
  const DiskSpec spec = disk(2, {1, 0}, {0, 0}, 1);
  expect_overlap(world, {std::span(&spec, 1), {}}, "disks[0]", 2, 1, -1);
}

TEST(Rejects, RoundingIsNoOverlap) {
  World world(WorldOptions{});
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 0.5)});
  const DiskSpec within = disk(2, {1 - 0.9e-9, 0}, {0, 0}, 0.5);
  EXPECT_TRUE(world.spawn({std::span(&within, 1), {}}).ok());
  const DiskSpec beyond = disk(3, {-1 + 1.1e-9, 0}, {0, 0}, 0.5);
  EXPECT_FALSE(world.spawn({std::span(&beyond, 1), {}}).ok());
}

TEST(Rejects, RemovingWhatIsNotThereOrTwice) {
  World world = sample_world();
  const Unchanged unchanged(world);
  const Id unknown[] = {1, 99};
  expect_reject(world.remove(unknown), {Code::NotFound, "ids[1]", 99});
  const Id retired[] = {4, 6};
  expect_reject(world.remove(retired), {Code::NotFound, "ids[1]", 6});
  const Id none[] = {kNoId};
  expect_reject(world.remove(none), {Code::NotFound, "ids[0]", kNoId});
  const Id twice[] = {1, 4, 1};
  const auto outcome = world.remove(twice);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.reject().code, Code::InvalidArgument);
  EXPECT_EQ(outcome.reject().body, 1U);
}

TEST(Rejects, VelocitiesOfWhatIsUnknownStaticNotFiniteOrNamedTwice) {
  World world = sample_world();
  const Unchanged unchanged(world);
  const auto set = [&](std::vector<VectorFor> velocities) {
    return world.set_velocity(velocities);
  };
  expect_reject(set({{1, {1, 1}}, {99, {1, 1}}}), {Code::NotFound, "velocities[1].id", 99});
  expect_reject(set({{1, {1, 1}}, {2, {0, 0}}}), {Code::FailedPrecondition, "velocities[1].id", 2});
  for (const double bad : {kNan, kInf, -kInf, 1.1e150}) {
    expect_reject(set({{1, {1, 1}}, {3, {0, bad}}}),
                  {Code::InvalidArgument, "velocities[1].value", 3});
  }
  const auto twice = set({{1, {1, 1}}, {3, {0, 1}}, {1, {1, 1}}});
  ASSERT_FALSE(twice.ok());
  EXPECT_EQ(twice.reject().code, Code::InvalidArgument);
  EXPECT_EQ(twice.reject().body, 1U);
}

TEST(Rejects, ImpulsesOnWhatDoesNotAnswerToThem) {
  World world = sample_world();
  const Unchanged unchanged(world);
  const auto push = [&](std::vector<VectorFor> impulses) { return world.apply_impulse(impulses); };
  expect_reject(push({{1, {1, 1}}, {99, {1, 1}}}), {Code::NotFound, "impulses[1].id", 99});
  for (const Id fixed : {Id{2}, Id{3}, Id{4}}) {  // static, kinematic, wall
    expect_reject(push({{1, {1, 1}}, {fixed, {1, 0}}}),
                  {Code::FailedPrecondition, "impulses[1].id", fixed});
  }
  for (const double bad : {kNan, kInf, -kInf}) {
    expect_reject(push({{1, {bad, 1}}}), {Code::InvalidArgument, "impulses[0].value", 1});
  }
  const auto twice = push({{1, {1, 1}}, {1, {1, 1}}});
  ASSERT_FALSE(twice.ok());
  EXPECT_EQ(twice.reject().code, Code::InvalidArgument);
}

TEST(Rejects, AnImpulseThatWouldMakeAVelocityLeaveTheRange) {
  World world(WorldOptions{});
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 1, 1e-10)});
  const auto before = fingerprint(world);
  const VectorFor impulse{1, {1e149, 0}};
  expect_reject(world.apply_impulse(std::span(&impulse, 1)),
                {Code::InvalidArgument, "impulses[0].value", 1});
  EXPECT_EQ(fingerprint(world), before);
}

TEST(Rejects, InstantsInThePastOrBeyondTheEndOfTime) {
  World world = sample_world();
  const Unchanged unchanged(world);
  const Instant almost_now = instant_from_ticks(ticks(world.now()) - 1);
  expect_reject(world.advance_to(almost_now), {Code::DeadlinePassed, "instant"});
  expect_reject(world.advance_to(Instant{kSecondsMax, 0}), {Code::InvalidArgument, "instant"});
  expect_reject(world.advance_to(Instant::never()), {Code::InvalidArgument, "instant"});
  EXPECT_EQ(world.now(), seconds(11));
}

TEST(Rejects, QuestionsAboutWhatIsNotThere) {
  const World world = sample_world();
  expect_reject(world.state(99), {Code::NotFound, "id", 99});
  expect_reject(world.state(4), {Code::NotFound, "id", 4});  // a wall has no disk's state
  expect_reject(world.wall(1), {Code::NotFound, "id", 1});
  expect_reject(world.motion(6), {Code::NotFound, "id", 6});
  expect_reject(world.body(kNoId), {Code::NotFound, "id", kNoId});
}

TEST(Rejects, NothingIsLeftOfARefusedBatchForTheFutureEither) {
  World world = sample_world();
  World untouched = world;
  const std::vector<DiskSpec> disks = {disk(kNoId, {3, 0.5}, {0, 0}, 0.25),  // in disk 1's way
                                       disk(kNoId, {5, 0}, {0, 0}, 0.5)};    // in static disk 2
  const std::vector<WallSpec> walls = {wall(kNoId, {8, 9}, {2, 9})};
  ASSERT_FALSE(world.spawn({disks, walls}).ok());
  EXPECT_EQ(test::difference(test::run_for(world, 60), test::run_for(untouched, 60)), "");
  EXPECT_EQ(fingerprint(world), fingerprint(untouched));
}

TEST(Rejects, IdsThatRunOut) {
  World world(WorldOptions{});
  must_spawn(world, {disk(std::numeric_limits<Id>::max() - 2, {0, 0}, {0, 0}, 1)});
  const DiskSpec unnamed[] = {disk(kNoId, {10, 0}, {0, 0}, 1), disk(kNoId, {20, 0}, {0, 0}, 1)};
  const auto before = fingerprint(world);
  expect_reject(world.spawn({unnamed, {}}), {Code::ResourceExhausted, "id"});
  EXPECT_EQ(fingerprint(world), before);
  EXPECT_EQ(must_spawn(world, {unnamed[0]}), (std::vector<Id>{std::numeric_limits<Id>::max() - 1}));
  expect_reject(world.spawn({std::span(unnamed + 1, 1), {}}), {Code::ResourceExhausted, "id"});
  EXPECT_EQ(must_spawn(world, {disk(5, {20, 0}, {0, 0}, 1)}), (std::vector<Id>{5}));
}

TEST(Rejects, AFloatWorldRefusesWhatAFloatCannotHold) {
  const auto refused = [](const DiskSpec& spec) {
    World world = sample_world(Arithmetic::Float);
    const auto before = fingerprint(world);
    const auto outcome = world.spawn({std::span(&spec, 1), {}});
    EXPECT_EQ(fingerprint(world), before);
    return !outcome.ok() && outcome.reject().code == Code::InvalidArgument;
  };
  EXPECT_TRUE(refused(disk(20, {1e60, 0}, {0, 0}, 1)));
  EXPECT_TRUE(refused(disk(20, {20, 0}, {0, 1e60}, 1)));
  EXPECT_TRUE(refused(disk(20, {20, 0}, {0, 0}, 1e60)));
  EXPECT_TRUE(refused(disk(20, {20, 0}, {0, 0}, 1e-60)));
  EXPECT_TRUE(refused(disk(20, {20, 0}, {0, 0}, 1, 1e60)));
  EXPECT_TRUE(refused(disk(20, {20, 0}, {0, 0}, 1, 1e-60)));
  World world = sample_world(Arithmetic::Float);
  const auto before = fingerprint(world);
  const VectorFor fast{1, {1e60, 0}};
  expect_reject(world.set_velocity(std::span(&fast, 1)),
                {Code::InvalidArgument, "velocities[0].value", 1});
  const WallSpec far = wall(20, {0, 20}, {1e60, 20});
  EXPECT_FALSE(world.spawn({{}, std::span(&far, 1)}).ok());
  EXPECT_EQ(fingerprint(world), before);
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The verifier: it changes no byte, its books balance whatever moves, and it sees what is wrong.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/verify.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

namespace stoss::engine {
namespace {

using test::disk;
using test::kinematic_disk;
using test::must_spawn;
using test::static_disk;
using test::wall;

/// A box with a slow piston for a lid, a kinematic and a static disk, and a gas between them.
World engine_room(Arithmetic arithmetic = Arithmetic::Double) {
  World world(WorldOptions{.start = {}, .arithmetic = arithmetic});
  test::Random random(test::seed_of_run());
  std::vector<DiskSpec> disks;
  for (int i = 0; i < 36; ++i) {
    disks.push_back(disk(static_cast<Id>(i + 1),
                         {1.5 * (i % 6) + 1, 1.5 * (i / 6) + 1},
                         {random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)},
                         0.25,
                         random.decades(-2, 2)));
  }
  disks.push_back(kinematic_disk(50, {4.75, 9.6}, {0.1, -0.05}, 0.25));
  disks.push_back(static_disk(51, {1.75, 9.6}, 0.25));
  std::vector<WallSpec> walls = test::box(100, {0, 0}, {9.5, 30});
  walls.push_back(wall(110, {-1, 20}, {10.5, 20}, {0, -0.25}));
  must_spawn(world, disks, walls);
  return world;
}

class Book final : public CollisionSink {
 public:
  explicit Book(Verifier& verifier) : verifier_(&verifier) {}
  void on_collision(const Collision& collision) override { verifier_->on_collision(collision); }

 private:
  Verifier* verifier_;
};

/// As programs do it: in slices that end where a check is due.
void advance(World& world, Verifier& verifier, const Instant& until) {
  Book book(verifier);
  for (;;) {
    const AdvanceReport report = world.advance_to(until, &book, verifier.events_left()).value();
    verifier.count_events(report.events);
    if (verifier.events_left() == 0) verifier.check(world);
    ASSERT_NE(report.stop, Stop::Stalled);
    if (report.stop == Stop::Reached) return;
  }
}

TEST(Verifier, ChangesNoByte) {
  World plain = engine_room();
  World verified = engine_room();
  Verifier verifier(7);
  verifier.begin(verified);
  advance(verified, verifier, test::seconds(20));
  ASSERT_TRUE(plain.advance_to(test::seconds(20)).ok());
  EXPECT_GT(verifier.found().checks, 100U);
  EXPECT_EQ(verified.serialise(), plain.serialise());
}

// The piston and the kinematic disk change the energy by a multiple; the books know why.
TEST(Verifier, BooksTheWorkOfWhatMovesAndTheMomentumOfWhatStands) {
  for (const Arithmetic arithmetic :
       {Arithmetic::Float, Arithmetic::Double, Arithmetic::LongDouble}) {
    World world = engine_room(arithmetic);
    const double before = world.conserved().kinetic_energy;
    Verifier verifier(100);
    verifier.begin(world);
    advance(world, verifier, test::seconds(30));
    EXPECT_GT(world.conserved().kinetic_energy, 1.1 * before);
    const Verification& found = verifier.found();
    EXPECT_TRUE(is_healthy(found, arithmetic));
    EXPECT_EQ(found.overlaps, 0U);
    EXPECT_EQ(found.missed, 0U);
    // A few thousand impulses of one rounding each.
    const double rounding = arithmetic == Arithmetic::Float ? 1e-5 : 2e-14;
    EXPECT_LT(found.energy_error, rounding);
    EXPECT_LT(found.momentum_error, rounding);
  }
}

TEST(Verifier, BooksCommands) {
  World world = engine_room();
  Verifier verifier(50);
  verifier.begin(world);
  const std::array<Id, 3> ids{3, 50, 110};
  for (int i = 1; i <= 10; ++i) {
    advance(world, verifier, test::seconds(i));
    verifier.take_out(world, ids);
    const double speed = 0.5 * i;
    const std::vector<VectorFor> velocities{{3, {speed, 1}}, {50, {0.01 * i, 0}}, {110, {0, 0}}};
    ASSERT_TRUE(world.set_velocity(velocities).ok());
    verifier.put_in(world, ids);
  }
  const std::array<Id, 2> gone{4, 51};
  verifier.take_out(world, gone);
  ASSERT_TRUE(world.remove(gone).ok());
  verifier.put_in(world, gone);
  const auto come =
      must_spawn(world, {disk(0, {4, 25}, {1, 7}, 0.25, 1000), static_disk(0, {2, 25}, 0.5)});
  verifier.put_in(world, come);
  advance(world, verifier, test::seconds(20));
  verifier.check(world);
  EXPECT_TRUE(is_healthy(verifier.found(), Arithmetic::Double));
  EXPECT_LT(verifier.found().energy_error, 1e-14);
  EXPECT_LT(verifier.found().momentum_error, 1e-14);
}

TEST(Verifier, SeesEnergyThatNobodyBooked) {
  World world = engine_room();
  Verifier verifier(50);
  verifier.begin(world);
  advance(world, verifier, test::seconds(1));
  const std::vector<VectorFor> kick{{3, {1e-3, 0}}};
  ASSERT_TRUE(world.apply_impulse(kick).ok());
  verifier.check(world);
  EXPECT_FALSE(is_healthy(verifier.found(), Arithmetic::Double));
  EXPECT_GT(verifier.found().momentum_error, 1e-7);
  verifier.begin(world);
  advance(world, verifier, test::seconds(2));
  EXPECT_FALSE(is_healthy(verifier.found(), Arithmetic::Double)) << "a fault is not forgotten";
}

TEST(Verifier, CountsOverlapsAtEveryCheckUntilTheyAreGone) {
  World world;
  must_spawn(world, {disk(1, {0, 0}, {0, 0}, 0.5), disk(2, {4, 0}, {0, 0}, 0.5)});
  std::vector<std::byte> bytes = world.serialise();
  // 4 m as a double, and then 2^-510 m: one disk upon the other.
  const std::array<std::byte, 2> four{std::byte{0x10}, std::byte{0x40}};
  const auto place = std::search(bytes.begin(), bytes.end(), four.begin(), four.end());
  ASSERT_NE(place, bytes.end());
  *(place + 1) = std::byte{0x3f};
  World damaged = World::deserialise(bytes).value();
  ASSERT_EQ(damaged.census().overlaps, 1U);
  Verifier verifier(10);
  verifier.begin(damaged);
  verifier.check(damaged);
  verifier.check(damaged);
  EXPECT_EQ(verifier.found().checks, 2U);
  EXPECT_EQ(verifier.found().overlaps, 2U);
  EXPECT_GT(verifier.found().deepest, 0.4);
  EXPECT_FALSE(is_healthy(verifier.found(), Arithmetic::Double));
}

TEST(Verifier, OfAnEmptyWorldAndOneAtRestFindsNothing) {
  World world;
  Verifier verifier(1);
  verifier.begin(world);
  verifier.check(world);
  const auto ids = must_spawn(world, {disk(1, {0, 0}, {0, 0}, 0.5)});
  verifier.put_in(world, ids);
  verifier.check(world);
  EXPECT_TRUE(is_healthy(verifier.found(), Arithmetic::Double));
  EXPECT_EQ(verifier.found().energy_error, 0);
}

}  // namespace
}  // namespace stoss::engine

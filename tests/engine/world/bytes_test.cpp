// SPDX-License-Identifier: Apache-2.0
// Canonical bytes and the state hash.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace stoss::engine {
namespace {

using test::disk;
using test::must_spawn;
using test::run_until;
using test::seconds;
using test::wall;

using Bytes = std::vector<std::byte>;

std::vector<DiskSpec> sample_disks() {
  DiskSpec turning = disk(5, {3, 0.1}, {1, 2}, 0.5, 3);
  turning.angle = 0.5;
  turning.spin = 2;
  return {disk(2, {0.1, 0}, {3, 1}, 0.5),
          turning,
          test::static_disk(7, {-3, -3}, 0.5),
          test::kinematic_disk(3, {20, 0}, {0, -1}, 1)};
}

World sample_world(Arithmetic arithmetic = Arithmetic::Double,
                   BroadPhaseKind broad_phase = BroadPhaseKind::Neighbours) {
  World world(
      WorldOptions{.start = seconds(3), .arithmetic = arithmetic, .broad_phase = broad_phase});
  must_spawn(world, sample_disks(), test::box(10, {-5, -5}, {5, 5}));
  must_spawn(world, {disk(40, {100, 100}, {0, 0}, 1), disk(42, {110, 100}, {0, 0}, 1)});
  EXPECT_TRUE(world.remove(std::vector<Id>{40, 42}).ok());
  return world;
}

TEST(Bytes, DoNotDependOnTheOrderOfInsertion) {
  World forwards;
  World backwards;
  auto disks = sample_disks();
  auto walls = test::box(10, {-5, -5}, {5, 5});
  must_spawn(forwards, disks, walls);
  std::reverse(disks.begin(), disks.end());
  std::reverse(walls.begin(), walls.end());
  for (const WallSpec& w : walls) must_spawn(backwards, {}, std::vector<WallSpec>{w});
  for (const DiskSpec& d : disks) must_spawn(backwards, {d});
  EXPECT_EQ(test::fingerprint(forwards), test::fingerprint(backwards));
}

TEST(Bytes, DoNotDependOnTicksForksOrTheBroadPhase) {
  World once = sample_world();
  World ticked = sample_world(Arithmetic::Double, BroadPhaseKind::AllPairs);
  run_until(once, seconds(23));
  for (int i = 1; i <= 2000; ++i) {
    run_until(ticked, seconds(3 + i / 100.0));
    if (i % 100 == 0) ticked = World(ticked);
  }
  EXPECT_EQ(test::fingerprint(once), test::fingerprint(ticked));
}

TEST(Bytes, MinusZeroIsZero) {
  World plus;
  World minus;
  must_spawn(plus, {disk(1, {0.0, 0.0}, {0.0, 0.0}, 1)});
  must_spawn(minus, {disk(1, {-0.0, -0.0}, {-0.0, -0.0}, 1)});
  EXPECT_EQ(test::fingerprint(plus), test::fingerprint(minus));
  const VectorFor velocity{1, {-0.0, -0.0}};
  ASSERT_TRUE(plus.set_velocity(std::span(&velocity, 1)).ok());
  const VectorFor zero{1, {0.0, 0.0}};
  ASSERT_TRUE(minus.set_velocity(std::span(&zero, 1)).ok());
  EXPECT_EQ(test::fingerprint(plus), test::fingerprint(minus));
}

TEST(Bytes, AreReadBackToTheByteInEveryArithmeticAndBroadPhase) {
  for (const Arithmetic arithmetic :
       {Arithmetic::Float, Arithmetic::Double, Arithmetic::LongDouble}) {
    World world = sample_world(arithmetic);
    run_until(world, seconds(17.3));
    const Bytes bytes = world.serialise();
    for (const BroadPhaseKind kind : {BroadPhaseKind::Neighbours, BroadPhaseKind::AllPairs}) {
      const auto read = World::deserialise(bytes, kind);
      ASSERT_TRUE(read.ok());
      EXPECT_EQ(read.value().broad_phase(), kind);
      EXPECT_EQ(read.value().now(), world.now());
      EXPECT_EQ(test::fingerprint(read.value()), test::fingerprint(world));
    }
  }
}

TEST(Bytes, TheHashFollowsPhysicalEventsAndNotThePresent) {
  World world = sample_world();
  const std::uint64_t before = world.state_hash();
  run_until(world, seconds(3.125));
  EXPECT_EQ(world.state_hash(), before);
  EXPECT_FALSE(run_until(world, seconds(10)).empty());
  EXPECT_NE(world.state_hash(), before);
}

TEST(Bytes, TheHashTellsEveryFieldApart) {
  std::vector<std::uint64_t> hashes;
  const auto add = [&](const DiskSpec& spec) {
    World world;
    must_spawn(world, {spec});
    hashes.push_back(world.state_hash());
  };
  const DiskSpec base = disk(1, {1, 2}, {3, 4}, 1, 2);
  add(base);
  for (int field = 0; field < 9; ++field) {
    DiskSpec other = base;
    double* const fields[] = {&other.position.x(),
                              &other.position.y(),
                              &other.velocity.x(),
                              &other.velocity.y(),
                              &other.radius,
                              &other.mass,
                              &other.angle,
                              &other.spin};
    if (field < 8) {
      *fields[field] = std::nextafter(*fields[field], 10);
    } else {
      other.id = 2;
    }
    add(other);
  }
  DiskSpec kinematic = base;
  kinematic.kind = BodyKind::Kinematic;
  add(kinematic);
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

void expect_damaged(const Bytes& bytes) {
  const auto read = World::deserialise(bytes);
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.reject().code, Code::InvalidArgument);
  EXPECT_EQ(read.reject().field, "bytes");
}

TEST(Bytes, TruncatedOrWithBytesLeftOverAreRefused) {
  const Bytes bytes = sample_world().serialise();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    expect_damaged(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)));
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  expect_damaged(longer);
  longer.resize(bytes.size() + 8);
  expect_damaged(longer);
}

TEST(Bytes, OfAnotherFormatOrArithmeticAreRefused) {
  const Bytes bytes = sample_world().serialise();
  for (const std::size_t word : {0U, 1U, 2U}) {
    Bytes foreign = bytes;
    foreign[8 * word] ^= std::byte{0x10};
    expect_damaged(foreign);
  }
}

void set_word(Bytes& bytes, std::size_t word, std::uint64_t value) {
  for (std::size_t i = 0; i < 8; ++i) {
    bytes[8 * word + i] = static_cast<std::byte>(value >> (8 * i));
  }
}

/// Damaged bytes are refused, or are another world's: one that can be written, read and run.
void expect_refused_or_sound(const Bytes& bytes) {
  auto read = World::deserialise(bytes);
  if (!read.ok()) {
    EXPECT_EQ(read.reject().code, Code::InvalidArgument);
    return;
  }
  World world = std::move(read).value();
  EXPECT_TRUE(world.serialise() == bytes) << "accepted, but not written as it was read";
  const Instant later = instant_from_ticks(ticks(world.now()) + (Int128{2} << 64));
  const auto report = world.advance_to(later, nullptr, 1000);
  EXPECT_TRUE(report.ok() || !in_range(later));
  const DiskSpec spec = disk(kNoId, {1000, 1000}, {0, 0}, 1);
  const auto made = world.spawn({std::span(&spec, 1), {}});
  EXPECT_TRUE(!made.ok() || made.value().front() != kNoId);
}

TEST(Bytes, DamagedAnywhereTheyAreRefusedOrAnotherWorlds) {
  World world = sample_world();
  run_until(world, seconds(5));
  const Bytes bytes = world.serialise();
  test::Random random(test::seed_of_run());
  const std::uint64_t nasty[] = {0,
                                 1,
                                 ~std::uint64_t{0},
                                 std::uint64_t{1} << 63,
                                 std::bit_cast<std::uint64_t>(std::nan("")),
                                 std::bit_cast<std::uint64_t>(HUGE_VAL),
                                 std::bit_cast<std::uint64_t>(-1.0),
                                 std::bit_cast<std::uint64_t>(1e300),
                                 std::bit_cast<std::uint64_t>(5e-324)};
  for (std::size_t word = 0; word < bytes.size() / 8; ++word) {
    SCOPED_TRACE(word);
    for (const std::uint64_t value : nasty) {
      Bytes damaged = bytes;
      set_word(damaged, word, value);
      expect_refused_or_sound(damaged);
    }
    Bytes flipped = bytes;
    flipped[8 * word + random.below(8)] ^= static_cast<std::byte>(1U << random.below(8));
    expect_refused_or_sound(flipped);
  }
}

}  // namespace
}  // namespace stoss::engine

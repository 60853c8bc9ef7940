// SPDX-License-Identifier: Apache-2.0
// The census finds what is wrong, and nothing where nothing is.

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace {

using namespace stoss::engine;

World gas(std::uint64_t seed) {
  World world;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> component;
  std::vector<DiskSpec> disks(400);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    disks[i].position = {static_cast<double>(i % 20) * 1.2, static_cast<double>(i / 20) * 1.2};
    disks[i].velocity = {component(random), component(random)};
    disks[i].radius = i % 7 == 0 ? 0.55 : 0.3;
  }
  EXPECT_TRUE(world.spawn({disks, {}}).ok());
  return world;
}

TEST(Census, OfARunningGasIsClean) {
  World world = gas(3);
  for (int second = 1; second <= 10; ++second) {
    ASSERT_TRUE(world.advance_to({.seconds = second}).ok());
    const Census census = world.census();
    EXPECT_EQ(census.overlaps, 0U);
    EXPECT_EQ(census.missed, 0U);
    EXPECT_LT(census.deepest, 1e-12);
  }
}

TEST(Census, LooksAtEveryPairOfATouchingRow) {
  World world;
  std::vector<DiskSpec> disks(10);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    disks[i].position = {static_cast<double>(i), 0};
    disks[i].radius = 0.5;
  }
  ASSERT_TRUE(world.spawn({disks, {}}).ok());
  EXPECT_EQ(world.census().pairs, 9U);
}

// Bytes are the one way into a state that no command leads to: two disks laid over each other.
TEST(Census, CountsAnOverlapThatDamagedBytesBroughtIn) {
  World world;
  std::vector<DiskSpec> disks(2);
  disks[0].radius = disks[1].radius = 0.5;
  disks[1].position = {4, 0};
  ASSERT_TRUE(world.spawn({disks, {}}).ok());
  std::vector<std::byte> bytes = world.serialise();
  const std::vector<std::byte> four{std::byte{0},
                                    std::byte{0},
                                    std::byte{0},
                                    std::byte{0},
                                    std::byte{0},
                                    std::byte{0},
                                    std::byte{0x10},
                                    std::byte{0x40}};
  const auto place = std::search(bytes.begin(), bytes.end(), four.begin(), four.end());
  ASSERT_NE(place, bytes.end());
  *(place + 7) = std::byte{0x3f};  // 4 m becomes 2^-510 m: one disk upon the other
  const auto damaged = World::deserialise(bytes);
  ASSERT_TRUE(damaged.ok());
  EXPECT_EQ(damaged.value().census().overlaps, 1U);
  EXPECT_GT(damaged.value().census().deepest, 0.4);
}

}  // namespace

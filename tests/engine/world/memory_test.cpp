// SPDX-License-Identifier: Apache-2.0
// What a world takes of memory, counted where it is asked for.
#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdlib>
#include <new>
#include <vector>

namespace {

std::size_t bytes_in_use = 0;

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  bytes_in_use += malloc_usable_size(memory);
  return memory;
}
void give_back(void* memory) {
  bytes_in_use -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }

namespace stoss::engine {
namespace {

constexpr std::size_t kColumns = 150;
constexpr std::size_t kDisks = kColumns * kColumns;
constexpr std::size_t kAim = 256;  // bytes a body

/// Disks of diameter 1 m with walls around them.
World disks_in_rows(double pitch) {
  std::vector<DiskSpec> disks(kDisks);
  test::Random random(5);
  for (std::size_t i = 0; i < kDisks; ++i) {
    disks[i].position = {pitch * static_cast<double>(i % kColumns),
                         pitch * static_cast<double>(i / kColumns)};
    disks[i].velocity = {random.uniform(-1, 1), random.uniform(-1, 1)};
    disks[i].radius = 0.5;
  }
  const double low = -pitch, high = pitch * static_cast<double>(kColumns);
  const std::vector<WallSpec> walls{{.start = {low, low}, .end = {high, low}},
                                    {.start = {high, low}, .end = {high, high}},
                                    {.start = {high, high}, .end = {low, high}},
                                    {.start = {low, high}, .end = {low, low}}};
  World world;
  test::must_spawn(world, disks, walls);
  return world;
}

std::size_t bytes_a_body(std::size_t before) { return (bytes_in_use - before) / kDisks; }

TEST(Memory, OfABodyIsBounded) {
  const std::size_t before = bytes_in_use;
  World world = disks_in_rows(1.5);
  EXPECT_GT(bytes_a_body(before), sizeof(DiskSpec));  // or nothing is counted
  EXPECT_LE(bytes_a_body(before), kAim);
  EXPECT_TRUE(world.advance_to({1000, 0}, nullptr, 4 * kDisks).ok());
  EXPECT_LE(bytes_a_body(before), kAim);
}

// Far apart almost every disk stands in a block of cells by itself, until those are too small.
TEST(Memory, OfCellsThatWereTooSmallIsGivenBack) {
  const std::size_t before = bytes_in_use;
  World world = disks_in_rows(6);
  EXPECT_GT(bytes_a_body(before), 500U);
  EXPECT_TRUE(world.advance_to({1000, 0}, nullptr, 16 * kDisks).ok());
  EXPECT_LE(bytes_a_body(before), kAim);
}

TEST(Memory, OfTheHashIsTakenWhenItIsAskedFor) {
  World world = disks_in_rows(1.5);
  EXPECT_TRUE(world.advance_to({1000, 0}, nullptr, 4 * kDisks).ok());
  const std::size_t before = bytes_in_use;
  static_cast<void>(world.state_hash());
  EXPECT_GT(bytes_in_use - before, 0U);
  EXPECT_LT(bytes_a_body(before), 10U);
}

}  // namespace
}  // namespace stoss::engine

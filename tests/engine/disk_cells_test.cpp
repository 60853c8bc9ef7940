// SPDX-License-Identifier: Apache-2.0
// Disks in cells: nobody is overlooked, and cells suit those that stand in them.
#include "broad_phase/disk_cells.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;

constexpr std::int32_t kDisks = 300;

struct Disk {
  double radius = 0;
  DiskCells::Cage cage;
};

Aabb reach_of(const Disk& disk) {
  const double half = disk.cage.half + disk.radius;
  return {disk.cage.x - half, disk.cage.y - half, disk.cage.x + half, disk.cage.y + half};
}

std::set<std::int32_t> around(const DiskCells& cells, std::int32_t disk) {
  std::vector<std::int32_t> room(kDisks + 1);
  const std::int32_t* const end = cells.collect_around(disk, room.data());
  return {room.cbegin(), room.cbegin() + (end - room.data())};
}

// Whom a disk must know: all of its level that its cage reaches, and by find() all others.
void expect_known(const DiskCells& cells,
                  const std::map<std::int32_t, Disk>& disks,
                  std::int32_t disk) {
  const Disk& own = disks.at(disk);
  const auto near = around(cells, disk);
  std::set<std::int32_t> found;
  cells.find(reach_of(own), own.cage.cell.level, [&](std::int32_t other) {
    ASSERT_TRUE(found.insert(other).second);
  });
  for (const auto& [number, other] : disks) {
    if (number == disk || !overlaps(reach_of(own), reach_of(other))) continue;
    const bool same_level = other.cage.cell.level == own.cage.cell.level;
    // In cells side by side cages overlap; farther off they need not be known.
    const double apart =
        std::max(std::abs(own.cage.x - other.cage.x), std::abs(own.cage.y - other.cage.y));
    const double reach = own.cage.half + other.cage.half + own.radius + other.radius;
    if (same_level && apart < reach * (1 - 1e-12)) {
      ASSERT_TRUE(near.contains(number)) << disk << " does not know " << number;
    }
    if (!same_level) {
      ASSERT_TRUE(found.contains(number)) << disk << " does not find " << number;
    }
  }
}

TEST(DiskCells, OverlookNobodyUnderRandomWork) {
  Random random(test::seed_of_run());
  DiskCells cells;
  std::map<std::int32_t, Disk> disks;
  int moved = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto disk = static_cast<std::int32_t>(random.below(kDisks));
    const double x = random.uniform(-12, 12), y = random.uniform(-12, 12);
    ASSERT_EQ(cells.contains(disk), disks.contains(disk));
    if (!disks.contains(disk)) {
      const double radius = random.one_in(3) ? 0.9 : random.uniform(0.4, 0.5);
      const auto cage = cells.enter(disk, x, y, radius, 0);
      if (!cage) continue;
      disks[disk] = {radius, *cage};
    } else if (random.one_in(3)) {
      cells.leave(disk);
      disks.erase(disk);
      continue;
    } else {
      const DiskCells::Cell before = cells.cell_of(disk);
      const auto known = around(cells, disk);
      const auto cage = cells.move(disk, x, y);
      if (!cage) continue;
      ++moved;
      disks[disk].cage = *cage;
      std::vector<std::int32_t> room(kDisks + 1);
      const std::int32_t* const end = cells.collect_new_around(disk, before, room.data());
      std::set<std::int32_t> all(room.cbegin(), room.cbegin() + (end - room.data()));
      for (const std::int32_t newcomer : all) EXPECT_TRUE(around(cells, disk).contains(newcomer));
      all.insert(known.begin(), known.end());
      for (const std::int32_t other : around(cells, disk)) ASSERT_TRUE(all.contains(other));
    }
    const DiskCells::Cage& cage = disks[disk].cage;
    ASSERT_LT(std::abs(x - cage.x), cage.half);
    ASSERT_LT(std::abs(y - cage.y), cage.half);
    ASSERT_NO_FATAL_FAILURE(expect_known(cells, disks, disk));
  }
  EXPECT_GT(moved, 1000);
}

// Two disks that touch stand in cells side by side, wherever in their cages they are.
TEST(DiskCells, CagesApartByTwoCellsLeaveRoomForTwoDisks) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 1000; ++i) {
    DiskCells cells;
    const double radius = random.decades(-9, 9);
    const double far = radius * random.decades(0, 11);
    const auto a = cells.enter(0, far, 0, radius, 0);
    ASSERT_TRUE(a.has_value());
    const auto b = cells.enter(1, a->x + 4 * a->half, 0, radius, 0);
    ASSERT_TRUE(b.has_value());
    if (b->cell.x - a->cell.x != 2) continue;
    EXPECT_GT(b->x - b->half - (a->x + a->half), 2 * radius);
  }
}

TEST(DiskCells, GrowWhereDisksFlyFar) {
  DiskCells cells;
  double x = 0;
  const auto first = cells.enter(0, x, 0, 0.5, 0);
  ASSERT_TRUE(first.has_value());
  double half = first->half;
  for (int i = 0; i < 3000; ++i) {
    x += 2 * half;
    auto cage = cells.move(0, x, 0);
    if (!cage) {  // its level is given up
      cells.leave(0);
      cage = cells.enter(0, x, 0, 0.5, 0);
      ASSERT_TRUE(cage.has_value());
    }
    half = cage->half;
  }
  EXPECT_GT(half, 10 * first->half);
}

TEST(DiskCells, RefuseWhatDoesNotSuitThem) {
  DiskCells cells;
  EXPECT_FALSE(cells.enter(0, 1e13, 0, 0.5, 0).has_value());  // beyond their numbers
  EXPECT_FALSE(cells.contains(0));
  EXPECT_FALSE(cells.enter(0, 0, 0, 0.5, 1).has_value());  // too fast for them
  for (std::int32_t disk = 1; disk < 10; ++disk) {
    EXPECT_TRUE(cells.enter(disk, 3.0 * disk, 0, 0.5, 0).has_value());
  }
  EXPECT_FALSE(cells.enter(0, 0, 0, 50, 0).has_value());  // much larger than most
  EXPECT_TRUE(cells.enter(0, 0, 0, 0.4, 0).has_value());
}

}  // namespace
}  // namespace stoss::engine

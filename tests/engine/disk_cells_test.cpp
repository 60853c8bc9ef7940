// SPDX-License-Identifier: Apache-2.0
// Disks in cells: nobody is overlooked, and cells suit those that stand in them.
#include "broad_phase/disk_cells.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;

constexpr std::int32_t kDisks = 300;

struct Disk {
  double radius = 0;
  DiskCells::Cage cage;
  std::int32_t level = 0;
};
Disk disk_in(const DiskCells& cells, std::int32_t disk, double radius) {
  return {radius, cells.cage_of(disk), cells.cell_of(disk).level};
}

Aabb reach_of(const Disk& disk) {
  const double half = disk.cage.half + disk.radius;
  return {disk.cage.x - half, disk.cage.y - half, disk.cage.x + half, disk.cage.y + half};
}

std::set<std::int32_t> around(const DiskCells& cells, std::int32_t disk) {
  std::vector<std::int32_t> room(kDisks + kWrittenBeyond);
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
  cells.find(reach_of(own), own.level, [&](std::int32_t other) {
    ASSERT_TRUE(found.insert(other).second);
  });
  for (const auto& [number, other] : disks) {
    if (number == disk || !overlaps(reach_of(own), reach_of(other))) continue;
    const bool same_level = other.level == own.level;
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
    double x = random.uniform(-12, 12), y = random.uniform(-12, 12);
    ASSERT_EQ(cells.contains(disk), disks.contains(disk));
    if (!disks.contains(disk)) {
      const double radius = random.one_in(3) ? 0.9 : random.uniform(0.4, 0.5);
      if (!cells.enter(disk, x, y, radius, 0)) continue;
      disks[disk] = disk_in(cells, disk, radius);
    } else if (random.one_in(3)) {
      cells.leave(disk);
      disks.erase(disk);
      continue;
    } else {
      const auto known = around(cells, disk);
      const bool is_near = random.one_in(2);
      const DiskCells::Cage cage = cells.cage_of(disk);
      if (is_near) x = cage.x + random.uniform(-2, 2) * cage.half;
      if (is_near) y = cage.y + random.uniform(-2, 2) * cage.half;
      const auto step = cells.move(disk, x, y);
      if (!step) continue;
      ++moved;
      disks[disk] = disk_in(cells, disk, disks[disk].radius);
      std::vector<std::int32_t> room(kDisks + kWrittenBeyond);
      const std::int32_t* const end = cells.collect_new_around(disk, *step, room.data());
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

// Brings one disk so many cages far, in steps as long as its cage: cells grow.
void fly(DiskCells& cells, std::int32_t disk, double radius, int steps) {
  double x = cells.cage_of(disk).x;
  for (int i = 0; i < steps; ++i) {
    x += 2 * cells.cage_of(disk).half;
    if (cells.move(disk, x, 0)) continue;
    cells.leave(disk);  // its level is given up
    ASSERT_TRUE(cells.enter(disk, x, 0, radius, 0));
  }
}

// Two disks that touch stand in cells side by side, wherever in their cages they are, and however
// large the cells have become.
TEST(DiskCells, CagesApartByTwoCellsLeaveRoomForTwoDisks) {
  Random random(test::seed_of_run());
  int apart = 0;
  for (int i = 0; i < 1000; ++i) {
    DiskCells cells;
    const double radius = random.decades(-9, 9);
    const double far = radius * random.decades(0, 11);
    ASSERT_TRUE(cells.enter(0, far, 0, radius, 0));
    if (random.one_in(2)) fly(cells, 0, radius, static_cast<int>(random.below(2000)));
    const DiskCells::Cage a = cells.cage_of(0);
    ASSERT_TRUE(cells.enter(1, a.x + random.uniform(2, 4) * a.half, 0, radius, 0));
    const DiskCells::Cage b = cells.cage_of(1);
    if (cells.cell_of(1).level != cells.cell_of(0).level) continue;
    if (cells.cell_of(1).x - cells.cell_of(0).x != 2) continue;
    ++apart;
    EXPECT_GT(b.x - b.half - (a.x + a.half), 2 * radius);
  }
  EXPECT_GT(apart, 100);
}

TEST(DiskCells, GrowWhereDisksFlyFar) {
  DiskCells cells;
  ASSERT_TRUE(cells.enter(0, 0, 0, 0.5, 0));
  const double first = cells.cage_of(0).half;
  fly(cells, 0, 0.5, 3000);
  EXPECT_GT(cells.cage_of(0).half, 10 * first);
}

TEST(DiskCells, RefuseWhatDoesNotSuitThem) {
  DiskCells cells;
  EXPECT_FALSE(cells.enter(0, 1e13, 0, 0.5, 0));  // beyond their numbers
  EXPECT_FALSE(cells.contains(0));
  EXPECT_FALSE(cells.enter(0, 0, 0, 0.5, 1));  // too fast for them
  for (std::int32_t disk = 1; disk < 10; ++disk) {
    EXPECT_TRUE(cells.enter(disk, 3.0 * disk, 0, 0.5, 0));
  }
  EXPECT_FALSE(cells.enter(0, 0, 0, 50, 0));  // much larger than most
  EXPECT_TRUE(cells.enter(0, 0, 0, 0.4, 0));
}

// A disk that hardly moves does not hold a level back that has been given up.
TEST(DiskCells, NameStragglersUntilTheirLevelIsEmpty) {
  DiskCells cells;
  ASSERT_TRUE(cells.enter(10, 0, 9, 5, 0));
  EXPECT_EQ(cells.straggler(), -1);
  for (std::int32_t disk = 11; disk < 40; ++disk) {  // the large one is one of few now
    ASSERT_TRUE(cells.enter(disk, 3.0 * disk, 0, 0.5, 0));
  }
  std::int32_t straggler = -1;
  for (int i = 0; i < 100 && straggler < 0; ++i) straggler = cells.straggler();
  ASSERT_EQ(straggler, 10);
  EXPECT_FALSE(cells.move(10, 0, 9).has_value());
  cells.leave(10);
  EXPECT_FALSE(cells.enter(10, 0, 9, 5, 0));
  for (int i = 0; i < 100; ++i) ASSERT_EQ(cells.straggler(), -1);
}

/// Boxes in no cell, of which some are filled along their diagonal alone.
struct Bystanders {
  std::map<std::int32_t, Aabb> boxes;
  mutable int asked = 0;

  void find(const Aabb& area, std::vector<std::int32_t>& found) const {
    ++asked;
    for (const auto& [number, box] : boxes) {
      if (overlaps(box, area)) found.push_back(number);
    }
  }
  Aabb box_of(std::int32_t number) const { return boxes.at(number); }
  bool may_come_to(std::int32_t number, const Aabb& box) const {
    if (number % 3 != 0) return true;
    const Aabb& own = boxes.at(number);
    const double low = box.low_y - box.high_x, high = box.high_y - box.low_x;
    const double diagonal = own.low_y - own.low_x;
    return low <= diagonal && diagonal <= high;
  }
  bool is_met_in(std::int32_t number, const Aabb& box) const {
    return overlaps(boxes.at(number), box) && may_come_to(number, box);
  }
  /// A random one comes, or goes if it is there.
  void change(Random& random, DiskCells& cells) {
    const auto number = static_cast<std::int32_t>(random.below(40));
    if (boxes.contains(number)) {
      cells.note_bystander(boxes[number]);
      boxes.erase(number);
      return;
    }
    const double x = random.uniform(-12, 12), y = random.uniform(-12, 12);
    const double half = random.one_in(10) ? 1e6 : random.decades(-3, 1);
    boxes[number] = {x - half, y - half, x + half, y + half};
    cells.note_bystander(boxes[number]);
  }
};

/// Whom the disk is told to have beside it; none if that is not told.
std::optional<std::vector<std::int32_t>> told(DiskCells& cells,
                                              std::int32_t disk,
                                              const Bystanders& all) {
  std::vector<std::int32_t> known;
  const bool is_told =
      cells.for_each_bystander(disk, all, [&](std::int32_t number) { known.push_back(number); });
  std::sort(known.begin(), known.end());
  return is_told ? std::optional(known) : std::nullopt;
}

// Bystanders are all that may come to the disk's own box, however they came, and few are asked for
// twice. Where a disk is said to have no others than before a step, it has none.
TEST(DiskCells, KnowWhoeverStandsBesideThem) {
  Random random(test::seed_of_run());
  DiskCells cells;
  std::vector<std::int32_t> disks;
  for (std::int32_t disk = 0; disk < 60; ++disk) {
    const double x = random.uniform(-12, 12), y = random.uniform(-12, 12);
    if (cells.enter(disk, x, y, 0.45, 0)) disks.push_back(disk);
  }
  Bystanders all;
  constexpr int kTries = 5000;
  int kept = 0;
  for (int i = 0; i < kTries; ++i) {
    if (random.one_in(5)) all.change(random, cells);
    const std::int32_t disk = disks[random.below(disks.size())];
    const auto before = told(cells, disk, all);
    if (random.one_in(3)) {
      cells.move(disk, random.uniform(-12, 12), random.uniform(-12, 12));
    } else {
      const DiskCells::Cage cage = cells.cage_of(disk);
      const double way = 3 * cage.half;
      const double x = cage.x + random.uniform(-way, way);
      cells.move(disk, x, cage.y + random.uniform(-way, way));
    }
    const bool keeps = before && cells.has_bystanders(disk, *before);
    kept += keeps ? 1 : 0;
    const auto known = told(cells, disk, all);
    ASSERT_TRUE(known || !keeps);
    if (!known) continue;
    ASSERT_TRUE(!keeps || *known == *before);
    ASSERT_TRUE(cells.has_bystanders(disk, *known) || cells.has_other_levels());
    for (const auto& [number, box] : all.boxes) {
      const bool is_known = std::binary_search(known->begin(), known->end(), number);
      ASSERT_TRUE(is_known || !all.is_met_in(number, cells.box_of(disk)));
      ASSERT_TRUE(!is_known || all.may_come_to(number, cells.box_of(disk)));
    }
  }
  EXPECT_GT(kept, kTries / 50);
  EXPECT_LT(all.asked, kTries / 2);
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The lists of neighbours against a search through all boxes.
#include "broad_phase/neighbours.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;

constexpr Slot kSlots = 120;

Role role_of(Slot slot) {
  if (slot % 7 == 0) return Role::Wall;
  return slot % 5 == 0 ? Role::FixedDisk : Role::DynamicDisk;
}

bool interact(Slot a, Slot b) {
  return a != b && (role_of(a) == Role::DynamicDisk || role_of(b) == Role::DynamicDisk);
}

void expect_lists_of(const Neighbours& neighbours, const std::map<Slot, Aabb>& boxes) {
  for (const auto& [slot, box] : boxes) {
    if (role_of(slot) != Role::DynamicDisk) continue;
    std::vector<Slot> expected;
    for (const auto& [other, other_box] : boxes) {
      if (interact(slot, other) && overlaps(box, other_box)) expected.push_back(other);
    }
    std::vector<Slot> list(neighbours.of(slot).begin(), neighbours.of(slot).end());
    std::sort(list.begin(), list.end());
    ASSERT_EQ(list, expected) << "of slot " << slot;
  }
}

TEST(Neighbours, ListsHoldAllNeighboursAndNobodyTwiceUnderRandomWork) {
  Random random(test::seed_of_run());
  Neighbours neighbours;
  std::map<Slot, Aabb> boxes;
  for (int i = 0; i < 4'000; ++i) {
    const auto slot = static_cast<Slot>(random.below(kSlots));
    if (boxes.contains(slot) && random.one_in(4)) {
      neighbours.remove(slot);
      boxes.erase(slot);
    } else {
      const double x = random.uniform(-20, 20), y = random.uniform(-20, 20);
      const double half = random.one_in(20) ? 15 : random.uniform(0, 3);
      const double length = role_of(slot) == Role::Wall ? random.uniform(0, 30) : 0;
      const Aabb tight{x - half, y - half, x + half + length, y + half};
      Glance here;
      here.x = x;
      here.y = y;
      const double margin = random.uniform(0, 2);
      neighbours.renew(slot, role_of(slot), tight, here, margin, [slot](Slot other) {
        return interact(slot, other);
      });
      boxes[slot] = grown(tight, margin);
      EXPECT_EQ(neighbours.margin(slot), margin);
      EXPECT_NEAR(neighbours.anchor(slot).x + neighbours.anchor(slot).x_low, x, 1e-13);
    }
    expect_lists_of(neighbours, boxes);
  }
}

}  // namespace
}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The lists of neighbours against a search through all boxes.
#include "broad_phase/neighbours.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// Every dynamic disk knows all whom its box reaches, and nobody twice.
void expect_neighbours(const Neighbours& neighbours, const std::vector<Slot>& slots) {
  for (const Slot slot : slots) {
    if (role_of(slot) != Role::DynamicDisk) continue;
    const auto span = neighbours.of(slot);
    std::vector<Slot> known(span.begin(), span.end());
    std::sort(known.begin(), known.end());
    ASSERT_EQ(std::adjacent_find(known.begin(), known.end()), known.end()) << "of slot " << slot;
    for (const Slot other : known) ASSERT_TRUE(interact(slot, other));
    for (const Slot other : slots) {
      if (!interact(slot, other)) continue;
      if (!overlaps(neighbours.box_of(slot), neighbours.box_of(other))) continue;
      ASSERT_TRUE(std::binary_search(known.begin(), known.end(), other))
          << "slot " << slot << " does not know " << other;
    }
  }
}

/// A body is as large whenever it is renewed.
struct Body {
  Aabb tight;
  Glance here;
};
Body random_body(Random& random, Slot slot) {
  const double x = random.uniform(-20, 20), y = random.uniform(-20, 20);
  const double half = slot % 20 == 3 ? 15 : slot % 2 == 0 ? 0.8 : 0.1 * (1 + slot % 30);
  const double length = role_of(slot) == Role::Wall ? random.uniform(0, 30) : 0;
  Body body;
  body.tight = {x - half, y - half, x + half + length, y + half};
  body.here.x = x;
  body.here.y = y;
  return body;
}

void expect_everybody_known(bool in_cells) {
  Random random(test::seed_of_run());
  Neighbours neighbours;
  std::vector<Slot> slots;
  for (int i = 0; i < 4'000; ++i) {
    const auto slot = static_cast<Slot>(random.below(kSlots));
    const auto known = std::find(slots.begin(), slots.end(), slot);
    if (known != slots.end() && random.one_in(4)) {
      neighbours.remove(slot);
      slots.erase(known);
    } else {
      const Body body = random_body(random, slot);
      const bool is_known = known != slots.end();
      if (!is_known) slots.push_back(slot);
      const Margin margin{random.uniform(0, 2), 1e-6, in_cells};
      const auto interacts = [slot](Slot other, const Aabb&) { return interact(slot, other); };
      if (!is_known || !neighbours.cross(slot, body.here.x, body.here.y, interacts)) {
        neighbours.renew(slot, role_of(slot), body.tight, body.here, margin, interacts);
      }
      if (random.one_in(3)) neighbours.note_event(slot);
      const auto [anchor, leeway] = neighbours.leeway(slot);
      EXPECT_LE(std::abs(anchor.x + anchor.x_low - body.here.x), leeway + 1e-13);
      EXPECT_LE(std::abs(anchor.y + anchor.y_low - body.here.y), leeway + 1e-13);
    }
    ASSERT_NO_FATAL_FAILURE(expect_neighbours(neighbours, slots));
  }
}

TEST(Neighbours, AreAllKnownAndNobodyTwiceUnderRandomWork) {
  expect_everybody_known(/*in_cells=*/true);
}

TEST(Neighbours, AreAllKnownWhereNobodyMayStandInCells) {
  expect_everybody_known(/*in_cells=*/false);
}

// A disk that has only gone from one cell to the next is told whom it has not known before.
TEST(Neighbours, NewcomersAreThoseThatWereNotKnown) {
  Random random(test::seed_of_run());
  Neighbours neighbours;
  const auto interacts_with = [](Slot slot) {
    return [slot](Slot other, const Aabb&) { return other != slot; };
  };
  const auto renew = [&](Slot slot, double x, double y) {
    Glance here;
    here.x = x;
    here.y = y;
    neighbours.renew(slot,
                     Role::DynamicDisk,
                     {x - 0.5, y - 0.5, x + 0.5, y + 0.5},
                     here,
                     {0.5, 1e-6, true},
                     interacts_with(slot));
    neighbours.note_event(slot);
  };
  for (Slot slot = 0; slot < 60; ++slot) {
    renew(slot, random.uniform(-5, 5), random.uniform(-5, 5));
  }
  int crossings = 0;
  for (int i = 0; i < 2'000; ++i) {
    const auto slot = static_cast<Slot>(random.below(60));
    const auto before = neighbours.of(slot);
    const std::vector<Slot> known(before.begin(), before.end());
    const auto [at, margin] = neighbours.leeway(slot);
    const double x = at.x + random.uniform(-2, 2) * margin;
    const double y = at.y + random.uniform(-2, 2) * margin;
    if (!neighbours.cross(slot, x, y, interacts_with(slot))) {
      renew(slot, x, y);
      continue;
    }
    ++crossings;
    const auto newcomers = neighbours.newcomers(slot);
    for (const Slot other : neighbours.of(slot)) {
      const bool is_new = std::find(known.begin(), known.end(), other) == known.end();
      const bool is_told = std::find(newcomers.begin(), newcomers.end(), other) != newcomers.end();
      ASSERT_EQ(is_new, is_told);
    }
  }
  EXPECT_GT(crossings, 1'000);
}

}  // namespace
}  // namespace stoss::engine

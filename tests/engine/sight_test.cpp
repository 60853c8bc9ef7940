// SPDX-License-Identifier: Apache-2.0
// What a prediction sees, against the kernel: never later than the contact, and hardly sooner.
#include "sight.hpp"

#include "contact_time/disk_disk.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace stoss::engine {
namespace {

using test::Random;

constexpr double kNever = std::numeric_limits<double>::infinity();

DoubleWord<double> word(double x) { return {x, 0}; }

/// A disk somewhere near `place`, that has been under way since some time before `now`.
Motion<double> random_motion(Random& random, const Instant& now, double place, double scale) {
  Motion<double> motion;
  motion.velocity = {word(random.uniform(-1, 1)), word(random.uniform(-1, 1))};
  motion.since = *later_by(now, scale * random.uniform(0, 4), 0.0);
  motion.position = {word(place + scale * random.uniform(-3, 3)),
                     word(-place + scale * random.uniform(-3, 3))};
  return motion;
}

/// By the kernel, s after `now`; infinity if never.
double exact_contact(const Motion<double>& a,
                     const Motion<double>& b,
                     double reach,
                     const Instant& now) {
  const RelativeMotion<double> relative{
      position_at(b, now) - position_at(a, now), b.velocity - a.velocity, 0};
  const auto after = disk_disk_contact<double>(relative, word(reach));
  return after ? after->hi : kNever;
}

TEST(Sight, BoundsEveryContactFromBelowAndClosely) {
  Random random(test::seed_of_run());
  int contacts = 0;
  int loose = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double scale = random.decades(-3, 3);
    const double place = random.one_in(4) ? scale * random.decades(0, 6) : 0;
    const Instant begin{static_cast<std::int64_t>(random.below(1000)) - 500, 0};
    const Motion<double> a = random_motion(random, begin, place, scale);
    const Motion<double> b = random_motion(random, begin, place, scale);
    const Instant now = *later_by(begin, 5 * scale, 0.0);
    const Epoch<double> epoch{begin, 8 * scale};
    const double radius = scale * random.uniform(0.01, 1);
    const Sight see_a = sight_of(a, radius, BodyType::Dynamic, epoch);
    const Sight see_b = sight_of(b, radius, BodyType::Dynamic, epoch);
    const double soonest =
        soonest_contact(see_a, see_b, rough_seconds(now, begin), kScreenSlack<double>);
    const double exact = exact_contact(a, b, 2 * radius, now);
    ASSERT_LE(soonest, exact) << "case " << i;
    if (exact == kNever) continue;
    ++contacts;
    if (soonest < exact * (1 - 1e-6) - 1e-6 * scale) ++loose;
  }
  EXPECT_GT(contacts, 5'000);
  EXPECT_LT(loose, contacts / 1000);  // those that all but graze
}

TEST(Sight, SeesThatDisksRecedeOrPassBy) {
  const Epoch<double> epoch;
  const auto see = [&](double x, double y, double vx, double vy) {
    const Motion<double> motion{{word(x), word(y)}, {word(vx), word(vy)}, {}};
    return sight_of(motion, 0.5, BodyType::Dynamic, epoch);
  };
  const Sight here = see(0, 0, 0, 0);
  EXPECT_EQ(soonest_contact(here, see(3, 0, 1, 0), 0, kScreenSlack<double>), kNever);
  EXPECT_EQ(soonest_contact(here, see(3, 1.001, -1, 0), 0, kScreenSlack<double>), kNever);
  EXPECT_NEAR(soonest_contact(here, see(3, 0, -1, 0), 0, kScreenSlack<double>), 2, 1e-7);
  EXPECT_EQ(soonest_contact(here, see(0.9, 0, -1, 0), 0, kScreenSlack<double>), 0);
}

/// The sight of the same body as a world with such sights has it.
template <class AnySight>
AnySight shown_as(const Sight& sight) {
  if constexpr (std::is_same_v<AnySight, Sight>) {
    return sight;
  } else {
    PlainSight plain;
    static_cast<Look&>(plain) = sight;
    plain.size = is_like(sight) ? sight.radius : -sight.radius;
    return plain;
  }
}

/// Against soonest_contact(), for random sights and lists.
template <class AnySight, class Common>
void expect_four_at_a_time_as_one_by_one(const Common& common) {
  Random random(test::seed_of_run());
  const Epoch<double> epoch{{}, 8};
  std::vector<AnySight> sights;
  for (int i = 0; i < 200; ++i) {
    const auto type = random.one_in(8) ? BodyType::Static : BodyType::Dynamic;
    const double radius = random.decades(-3, 0);
    sights.push_back(
        shown_as<AnySight>(sight_of(random_motion(random, {}, 0, 1), radius, type, epoch)));
  }
  constexpr double kNow = 5;
  constexpr double kSizeMin = 0.01;
  for (int i = 0; i < 5'000; ++i) {
    const auto slot = static_cast<Slot>(random.below(sights.size()));
    std::vector<Slot> room(32);  // beyond the list, too, are slots
    for (Slot& other : room) other = static_cast<Slot>(random.below(sights.size()));
    const std::span<const Slot> list(room.data(), random.below(30));
    std::vector<PassedOver> others(room.size());
    const auto found = soonest_contacts(
        slot, list, sights, kSizeMin, kNow, kScreenSlack<double>, common, others.data());
    SoonestTwo expected;
    std::vector<PassedOver> passed_over;
    for (std::size_t j = 0; j < list.size(); ++j) {
      const AnySight& sight = sights[static_cast<std::size_t>(list[j])];
      const double soonest = soonest_contact(
          sights[static_cast<std::size_t>(slot)], sight, kNow, kScreenSlack<double>, common);
      if (sight.size >= kSizeMin) {
        expected.note(list[j], soonest);
      } else if (!is_like(sight)) {
        passed_over.push_back({list[j], -1});
      } else if (soonest < kNever) {
        passed_over.push_back({list[j], soonest});
      }
    }
    ASSERT_EQ(found.first, expected.first);
    ASSERT_EQ(found.second, expected.second);
    ASSERT_EQ(static_cast<std::size_t>(found.passed_over), passed_over.size());
    for (std::size_t j = 0; j < passed_over.size(); ++j) {
      ASSERT_EQ(others[j].slot, passed_over[j].slot);
      ASSERT_EQ(others[j].soonest, passed_over[j].soonest);
    }
    if (expected.first < expected.second) {
      ASSERT_EQ(found.partner, expected.partner);
    }
  }
}

TEST(Sight, FourAtATimeAreTheSameAsOneByOne) {
  expect_four_at_a_time_as_one_by_one<PlainSight>(Steady{});
  expect_four_at_a_time_as_one_by_one<Sight>(Steady{});
  expect_four_at_a_time_as_one_by_one<Sight>(Growing{0.25, 0.5});
}

// Images of one disk by which another is seen through a border, or many, are that disk.
TEST(Sight, LooksAtTheNearestImage) {
  Random random(test::seed_of_run());
  const Epoch<double> epoch{{}, 8};
  const Repeating<Steady> around{{}, 32, 64};
  const Repeating<Steady> along_x{{}, 32, 0};
  int meetings = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Motion<double> a = random_motion(random, {}, 0, 1);
    const Motion<double> b = random_motion(random, {}, 0, 1);
    const double across_x = 32 * (static_cast<double>(random.below(2'000)) - 1'000);
    const double across_y = 64 * (static_cast<double>(random.below(2'000)) - 1'000);
    const auto seen_from_a = [&](double x, double y, const auto& common) {
      const Motion<double> image{{b.position.x + x, b.position.y + y}, b.velocity, b.since};
      return soonest_contact(sight_of(a, 0.3, BodyType::Dynamic, epoch),
                             sight_of(image, 0.3, BodyType::Dynamic, epoch),
                             5.0,
                             kScreenSlack<double>,
                             common);
    };
    const double plainly = seen_from_a(0, 0, Steady{});
    const double across = seen_from_a(across_x, across_y, around);
    if (plainly < kNever && across < kNever) {
      ++meetings;
      ASSERT_NEAR(across, plainly, 1e-4 * (1 + plainly));
    }
    ASSERT_EQ(seen_from_a(0, 0, around), plainly);
    ASSERT_LE(across, exact_contact(a, b, 0.6, {5, 0}));
    ASSERT_LE(seen_from_a(across_x, 0, along_x), exact_contact(a, b, 0.6, {5, 0}));
  }
  EXPECT_GT(meetings, 1'000);
}

TEST(Sight, AnInstantRoughlyLaterIsNotLaterThanThat) {
  Random random(test::seed_of_run());
  for (int i = 0; i < 100'000; ++i) {
    const Instant from{static_cast<std::int64_t>(random.below(2'000'000)) - 1'000'000,
                       random.below(std::numeric_limits<std::uint64_t>::max())};
    const double seconds = random.decades(-18, 9);
    const Instant later = roughly_later(from, seconds);
    ASSERT_GE(later, from);
    ASSERT_LE(later, *later_by(from, seconds, 0.0));
    ASSERT_GE(difference<double>(later, from).hi, seconds * (1 - 1e-15) - 0x1p-62);
  }
  EXPECT_EQ(roughly_later(Instant{}, kNever), Instant::never());
}

}  // namespace
}  // namespace stoss::engine

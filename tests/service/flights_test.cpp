// SPDX-License-Identifier: Apache-2.0
// What frames read of a picture is what the picture itself says, to the bit.
#include "flights.hpp"

#include "picture.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace stoss::service {
namespace {

using engine::Arithmetic;
using engine::Instant;
using engine::MotionRecord;
using test::Random;

constexpr Instant kNow{1'000'000, 0x123456789abcdef0U};

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Two words that overlap by no bit, and sometimes a zero of either sign.
engine::SplitNumber split(Random& random, double size) {
  if (random.one_in(8)) return {random.one_in(2) ? -0.0 : 0.0, 0};
  const double high = random.uniform(-size, size);
  return {high, high * 0x1p-54 * random.uniform(-1, 1)};
}

BodyChange disk(engine::Id id, Random& random) {
  BodyChange change;
  change.kind = engine::ChangeKind::Spawned;
  change.motion.id = change.body.id = id;
  change.motion.x = split(random, 1e3);
  change.motion.y = split(random, 1e-3);
  change.motion.vx = split(random, 10);
  change.motion.vy = split(random, 1e6);
  change.motion.since = {kNow.seconds - static_cast<std::int64_t>(random.uniform(-5, 1e6)),
                         static_cast<std::uint64_t>(random.uniform(0, 1e19))};
  change.body.radius = 0.5;
  return change;
}

std::vector<BodyChange> disks(std::size_t count, Random& random) {
  std::vector<BodyChange> all;
  for (engine::Id id = 1; id <= count; ++id) all.push_back(disk(id, random));
  return all;
}

Picture picture_of(std::vector<BodyChange> bodies, Arithmetic arithmetic = Arithmetic::Double) {
  EpochRecord record;
  record.moment.at = kNow;
  record.bodies = std::move(bodies);
  Picture picture(arithmetic);
  picture.begin(record);
  return picture;
}

struct States {
  std::array<double, kFlightsAtOnce> x, y, vx, vy;
};

/// False when states_at() is.
bool states_of(const Picture& picture, States& states) {
  const std::span<const Flight> flights(picture.flights());
  return states_at(flights.first<kFlightsAtOnce>(),
                   picture.moment().at,
                   {states.x, states.y, states.vx, states.vy},
                   flights.subspan(kFlightsAtOnce / 2));
}

void expect_states_of(const Picture& picture) {
  States states;
  ASSERT_TRUE(states_of(picture, states));
  for (std::size_t i = 0; i < kFlightsAtOnce; ++i) {
    const engine::BodyState state = picture.state_of(picture.body(i));
    EXPECT_EQ(picture.ids()[i], state.id);
    EXPECT_EQ(bits(states.x[i]), bits(state.position.x()));
    EXPECT_EQ(bits(states.y[i]), bits(state.position.y()));
    EXPECT_EQ(bits(states.vx[i]), bits(state.velocity.x()));
    EXPECT_EQ(bits(states.vy[i]), bits(state.velocity.y()));
    EXPECT_EQ(state.angle, 0);
    EXPECT_EQ(state.spin, 0);
  }
}

bool tells_flight(const BodyChange& change,
                  Arithmetic arithmetic = Arithmetic::Double,
                  const engine::Vector2& period = engine::Vector2::Zero()) {
  return is_flight(flight_of(change.motion, change.body, arithmetic, period));
}

TEST(Flights, HaveTheStatesOfThePicture) {
  Random random(20);
  for (const Arithmetic arithmetic : {Arithmetic::Double, Arithmetic::LongDouble}) {
    for (int round = 0; round < 300; ++round) {
      expect_states_of(picture_of(disks(kFlightsAtOnce, random), arithmetic));
    }
  }
}

TEST(Flights, HaveThemWhereverTheyBegin) {
  Random random(24);
  constexpr std::int64_t kTwo21 = std::int64_t{1} << 21;  // s; from there on another form holds
  constexpr std::uint64_t kLast = 0xffffffffffffffff;
  for (const std::int64_t seconds : {std::int64_t{0},
                                     std::int64_t{1},
                                     std::int64_t{-1},
                                     kTwo21 - 1,
                                     kTwo21,
                                     -kTwo21,
                                     -kTwo21 - 1,
                                     std::int64_t{1} << 40,
                                     -(std::int64_t{1} << 60)}) {
    for (const std::uint64_t fraction : {std::uint64_t{0},
                                         std::uint64_t{1},
                                         std::uint64_t{1} << 32,
                                         kNow.fraction - 1,
                                         kNow.fraction,
                                         kNow.fraction + 1,
                                         kLast}) {
      std::vector<BodyChange> bodies = disks(kFlightsAtOnce, random);
      for (std::size_t i = 0; i < kFlightsAtOnce; i += 3) {
        bodies[i].motion.since = {kNow.seconds - seconds, fraction};
        if (i % 2 == 0) bodies[i].motion.x = {-0.0, -0.0};  // stays so at its own instant alone
      }
      expect_states_of(picture_of(bodies));
    }
  }
}

TEST(Flights, AreNotWhatHasMoreToTell) {
  Random random(21);
  const BodyChange plain = disk(1, random);
  EXPECT_TRUE(tells_flight(plain));
  EXPECT_FALSE(tells_flight(plain, Arithmetic::Float));
  EXPECT_FALSE(tells_flight(plain, Arithmetic::Double, {0, 20}));
  BodyChange wall = plain;
  wall.body.is_wall = true;
  EXPECT_FALSE(tells_flight(wall));
  for (auto field : {&MotionRecord::angle, &MotionRecord::spin, &MotionRecord::drag}) {
    BodyChange other = plain;
    other.motion.*field = 0.1;
    EXPECT_FALSE(tells_flight(other));
  }
  for (auto field : {&MotionRecord::ax, &MotionRecord::ay, &MotionRecord::radius}) {
    BodyChange other = plain;
    (other.motion.*field).high = 0.1;
    EXPECT_FALSE(tells_flight(other));
  }
}

TEST(Flights, AreRefusedTogetherWhenOneIsNone) {
  Random random(22);
  const std::vector<BodyChange> all = disks(kFlightsAtOnce, random);
  States states;
  EXPECT_TRUE(states_of(picture_of(all), states));
  for (std::size_t i = 0; i < kFlightsAtOnce; ++i) {
    std::vector<BodyChange> others = all;
    others[i].motion.spin = 1;
    EXPECT_FALSE(states_of(picture_of(others), states));
  }
}

TEST(Flights, StandBesideTheirBodiesWhileBodiesComeAndGo) {
  Random random(23);
  std::vector<BodyChange> bodies = disks(40, random);
  bodies[4].body.is_wall = true;
  Picture picture = picture_of(bodies);
  EXPECT_EQ(picture.disk_count(), 39U);
  engine::Id next = 41;
  for (int round = 0; round < 200; ++round) {
    TickRecord record;
    record.moment.at = kNow;
    BodyChange& change = record.changes.emplace_back(disk(next, random));
    if (random.one_in(2)) {
      change.body.is_wall = random.one_in(4);
      ++next;
    } else {
      change.kind = engine::ChangeKind::Removed;
      change.motion.id = static_cast<engine::Id>(random.uniform(1, static_cast<double>(next)));
    }
    picture.apply(record);
    ASSERT_EQ(picture.flights().size(), picture.size());
    ASSERT_EQ(picture.ids().size(), picture.size());
    std::size_t walls = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const Picture::Body body = picture.body(i);
      if (body.record.is_wall) ++walls;
      EXPECT_EQ(picture.ids()[i], body.motion.id);
      EXPECT_EQ(is_flight(picture.flights()[i]), !body.record.is_wall);
    }
    EXPECT_EQ(picture.disk_count() + walls, picture.size());
  }
}

/// Are they one body in all that changes here?
void expect_same(const Picture::Body& body, const BodyChange& change) {
  const auto same = [](const engine::SplitNumber& a, const engine::SplitNumber& b) {
    return bits(a.high) == bits(b.high) && bits(a.low) == bits(b.low);
  };
  EXPECT_EQ(body.motion.id, change.motion.id);
  EXPECT_TRUE(same(body.motion.x, change.motion.x));
  EXPECT_TRUE(same(body.motion.y, change.motion.y));
  EXPECT_TRUE(same(body.motion.vx, change.motion.vx));
  EXPECT_TRUE(same(body.motion.vy, change.motion.vy));
  EXPECT_EQ(body.motion.since, change.motion.since);
  EXPECT_EQ(bits(body.motion.angle), bits(change.motion.angle));
  EXPECT_EQ(bits(body.motion.spin), bits(change.motion.spin));
  EXPECT_TRUE(same(body.motion.ax, change.motion.ax));
  EXPECT_EQ(body.record.id, change.body.id);
  EXPECT_EQ(body.record.radius, change.body.radius);
  EXPECT_EQ(body.record.is_wall, change.body.is_wall);
}

TEST(Flights, LeaveTheirBodiesWhatTheLastChangesMadeThem) {
  Random random(25);
  constexpr engine::Id kBodies = 50;
  std::vector<BodyChange> last = disks(kBodies, random);
  Picture picture = picture_of(last);
  for (int round = 0; round < 300; ++round) {
    TickRecord record;
    record.moment.at = kNow;
    if (random.one_in(20)) record.effects.emplace();
    for (int i = 0; i < 20; ++i) {
      const auto id = static_cast<engine::Id>(random.uniform(1, kBodies));
      BodyChange change = disk(id, random);
      change.kind = engine::ChangeKind::Moved;
      change.body.radius = last[id - 1].body.radius;
      if (record.effects) change.body.radius *= 1.25;
      if (random.one_in(4)) change.motion.spin = random.one_in(2) ? -0.0 : 1;
      if (random.one_in(8)) change.motion.ax = {0, -0.0};
      record.changes.push_back(change);
      last[id - 1] = change;
    }
    picture.apply(record);
    for (const BodyChange& change : last) {
      const auto body = picture.find(change.motion.id);
      ASSERT_TRUE(body);
      expect_same(*body, change);
    }
  }
}

}  // namespace
}  // namespace stoss::service

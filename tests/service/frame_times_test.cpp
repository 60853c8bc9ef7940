// SPDX-License-Identifier: Apache-2.0
// When frames are sent, beside ticks that come a little sooner or later than they should.
#include "frame_times.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace stoss::service {
namespace {

constexpr Nanoseconds kInterval{1'000'000};
constexpr Nanoseconds kStep{1'000};

/// The frames in 1000 intervals, each of which has so many ticks at this phase of it, late by up to
/// `jitter`.
int frames_beside(int ticks, Nanoseconds phase, Nanoseconds jitter) {
  test::Random random(30);
  FrameTimes times(kInterval, Nanoseconds(0));
  const Nanoseconds apart = kInterval / ticks;
  const auto late = [&] {
    return Nanoseconds(
        static_cast<std::int64_t>(random.uniform(0, static_cast<double>(jitter.count()))));
  };
  Nanoseconds tick = phase;
  Nanoseconds comes = tick + late();
  bool is_news = false;
  int frames = 0;
  for (Nanoseconds now{0}; now < 1000 * kInterval; now += kStep) {
    if (now >= comes) {
      is_news = true;
      tick += apart;
      comes = tick + late();
    }
    if (!times.take(now, is_news)) continue;
    if (is_news) ++frames;
    is_news = false;
  }
  EXPECT_EQ(times.late(), 0U);
  return frames;
}

TEST(FrameTimes, LoseNoTickOfTheirOwnRate) {
  for (const int phase : {0, 1, 50, 500, 950, 999}) {
    EXPECT_NEAR(frames_beside(1, phase * kStep, 100 * kStep), 1000, 1) << phase;
  }
}

TEST(FrameTimes, KeepTheirRateBesideMoreTicks) {
  for (const int phase : {0, 90, 330}) {
    EXPECT_NEAR(frames_beside(3, phase * kStep, 100 * kStep), 1000, 1) << phase;
  }
}

TEST(FrameTimes, WaitForNewsOneInterval) {
  FrameTimes times(kInterval, Nanoseconds(0));
  EXPECT_FALSE(times.take(Nanoseconds(0), false));
  EXPECT_FALSE(times.take(kInterval / 2, false));
  EXPECT_TRUE(times.take(kInterval, false));  // for those who have come meanwhile
  EXPECT_FALSE(times.take(kInterval + kStep, false));
  EXPECT_TRUE(times.take(kInterval + 2 * kStep, true));
  EXPECT_FALSE(times.take(kInterval + 3 * kStep, true));  // not before its time
  EXPECT_TRUE(times.take(2 * kInterval, true));
  EXPECT_EQ(times.next(), 3 * kInterval);
}

TEST(FrameTimes, LeaveOutWhatIsLate) {
  FrameTimes times(kInterval, Nanoseconds(0));
  EXPECT_TRUE(times.take(5 * kInterval, true));
  EXPECT_EQ(times.late(), 1U);
  EXPECT_FALSE(times.take(5 * kInterval + kStep, true));
  EXPECT_EQ(times.next(), 6 * kInterval);
}

}  // namespace
}  // namespace stoss::service

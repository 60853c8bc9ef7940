// SPDX-License-Identifier: Apache-2.0
#include "flights.hpp"

#include "lanes.hpp"

#include <cmath>

namespace stoss::service {
namespace {

using engine::DoubleWord;
using engine::DoubleWord2;

/// What a flight leaves out must be what a record has by itself, the sign of a zero included.
bool is_plain_zero(double number) { return number == 0 && !std::signbit(number); }
bool is_plain_zero(const engine::SplitNumber& number) {
  return is_plain_zero(number.high) && is_plain_zero(number.low);
}

/// Up to so many seconds of either sign engine::difference() is exact in the form below.
constexpr std::uint64_t kElapsedMax = std::uint64_t{1} << 21;

struct Elapsed {
  DoubleWord<Lanes> seconds;
  FourWords is_long;  ///< not zero: kElapsedMax or more, and `seconds` is void
};

/// engine::difference() between an instant and the beginnings of four flights: the seconds and the
/// first half of the fraction fit into the first word of it, the second half into the second.
[[gnu::always_inline]] inline Elapsed elapsed_since(const Flight* flights,
                                                    const engine::Instant& at) {
  constexpr std::uint64_t kLowHalf = 0xffffffff;
  const auto seconds_of = [flights](std::size_t i) {
    return static_cast<std::uint64_t>(flights[i].motion.since.seconds);
  };
  const auto fraction_of = [flights](std::size_t i) { return flights[i].motion.since.fraction; };
  const FourWords seconds{seconds_of(0), seconds_of(1), seconds_of(2), seconds_of(3)};
  const FourWords fraction{fraction_of(0), fraction_of(1), fraction_of(2), fraction_of(3)};
  const FourWords borrow = reinterpret_cast<FourWords>(fraction > at.fraction);  // -1 or 0
  const FourWords rest = at.fraction - fraction;
  // Lifted, so that none is negative.
  const FourWords lifted = static_cast<std::uint64_t>(at.seconds) + kElapsedMax - seconds + borrow;
  const Lanes whole{to_doubles(lifted).of - static_cast<double>(kElapsedMax)};
  const Lanes high{to_doubles(rest >> 32).of * 0x1p-32};
  const Lanes low{to_doubles(rest & kLowHalf).of * 0x1p-64};
  return {engine::quick_two_sum(whole + high, low), lifted & ~(2 * kElapsedMax - 1)};
}

/// Equation (1) of engine/motion.hpp, rounded once. At its own instant a motion is its position as
/// it stands, the sign of a zero included.
[[gnu::always_inline]] inline Lanes place(const DoubleWord<Lanes>& position,
                                          const DoubleWord<Lanes>& velocity,
                                          const DoubleWord<Lanes>& elapsed) {
  const Lanes later = engine::to_scalar(position + velocity * elapsed);
  return {elapsed.hi.of == 0 ? engine::to_scalar(position).of : later.of};
}

/// Asks for the cache lines that four flights lie in.
[[gnu::always_inline]] inline void prefetch(const Flight* flights) {
  constexpr std::size_t kLine = 64;
  const auto* const bytes = reinterpret_cast<const char*>(flights);
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kLanes * sizeof(Flight); i += kLine) __builtin_prefetch(bytes + i);
}

/// What states_at() does, for flights of any length.
bool states_one_by_one(std::span<const Flight, kFlightsAtOnce> flights,
                       const engine::Instant& at,
                       const FlightStates& states) {
  for (std::size_t i = 0; i < kFlightsAtOnce; ++i) {
    if (!is_flight(flights[i])) return false;
    const engine::Motion<double>& motion = flights[i].motion;
    const DoubleWord2<double> position = engine::position_at(motion, at);
    states.x[i] = engine::to_scalar(position.x);
    states.y[i] = engine::to_scalar(position.y);
    states.vx[i] = engine::to_scalar(motion.velocity.x);
    states.vy[i] = engine::to_scalar(motion.velocity.y);
  }
  return true;
}

}  // namespace

Flight flight_of(const engine::MotionRecord& motion,
                 const engine::BodyRecord& body,
                 engine::Arithmetic arithmetic,
                 const engine::Vector2& period) {
  const bool is_straight =
      is_plain_zero(motion.ax) && is_plain_zero(motion.ay) && is_plain_zero(motion.drag);
  const bool is_steady = is_plain_zero(motion.angle) && is_plain_zero(motion.spin) &&
                         is_plain_zero(motion.radius) && is_plain_zero(motion.growth);
  const bool is_open = period.x() == 0 && period.y() == 0;
  if (body.is_wall || !is_straight || !is_steady || !is_open ||
      arithmetic == engine::Arithmetic::Float) {
    return {};
  }
  return {engine::from_record<double>(motion)};
}

bool states_at(std::span<const Flight, kFlightsAtOnce> flights,
               const engine::Instant& at,
               const FlightStates& states,
               std::span<const Flight> soon) {
  FourWords is_long{};
  for (std::size_t i = 0; i < kFlightsAtOnce; i += kLanes) {
    if (i + kLanes <= soon.size()) prefetch(soon.data() + i);
    const Flight* const four = flights.data() + i;
    const Elapsed elapsed = elapsed_since(four, at);
    is_long |= elapsed.is_long;
    const DoubleWord2<Lanes> position = side_by_side(four[0].motion.position,
                                                     four[1].motion.position,
                                                     four[2].motion.position,
                                                     four[3].motion.position);
    const DoubleWord2<Lanes> velocity = side_by_side(four[0].motion.velocity,
                                                     four[1].motion.velocity,
                                                     four[2].motion.velocity,
                                                     four[3].motion.velocity);
    store(&states.x[i], place(position.x, velocity.x, elapsed.seconds));
    store(&states.y[i], place(position.y, velocity.y, elapsed.seconds));
    store(&states.vx[i], engine::to_scalar(velocity.x));
    store(&states.vy[i], engine::to_scalar(velocity.y));
  }
  return !any(is_long) || states_one_by_one(flights, at, states);
}

}  // namespace stoss::service

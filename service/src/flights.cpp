// SPDX-License-Identifier: Apache-2.0
#include "flights.hpp"

namespace stoss::service {
namespace {

using engine::DoubleWord;

using Column = std::array<double, kFlightsAtOnce>;

/// Double words by columns, so that the compiler takes several flights into one register.
struct Words {
  Column hi, lo;

  void set(std::size_t i, const DoubleWord<double>& word) {
    hi[i] = word.hi;
    lo[i] = word.lo;
  }
  [[nodiscard]] DoubleWord<double> operator[](std::size_t i) const { return {hi[i], lo[i]}; }
};

/// Equation (1) of engine/motion.hpp along one axis. Inline and with a column of its own: that no
/// two columns overlap must be plain, or the compiler takes one flight at a time.
[[gnu::always_inline]] inline Column places(const Words& position,
                                            const Words& velocity,
                                            const Words& elapsed) {
  Column place;
  for (std::size_t i = 0; i < kFlightsAtOnce; ++i) {
    place[i] = engine::to_scalar(position[i] + velocity[i] * elapsed[i]);
  }
  return place;
}

bool is_zero(const engine::SplitNumber& number) { return number.high == 0 && number.low == 0; }

}  // namespace

Flight flight_of(const engine::MotionRecord& motion,
                 const engine::BodyRecord& body,
                 engine::Arithmetic arithmetic,
                 const engine::Vector2& period) {
  const bool is_straight = is_zero(motion.ax) && is_zero(motion.ay) && motion.drag == 0;
  const bool is_steady = motion.angle == 0 && motion.spin == 0 && motion.radius.high == 0;
  const bool is_open = period.x() == 0 && period.y() == 0;
  if (body.is_wall || !is_straight || !is_steady || !is_open ||
      arithmetic == engine::Arithmetic::Float) {
    return {};
  }
  return {engine::from_record<double>(motion), motion.id};
}

bool states_at(std::span<const Flight, kFlightsAtOnce> flights,
               const engine::Instant& at,
               FlightStates& states) {
  Words x, y, vx, vy, elapsed;
  bool is_plain = true;
  for (std::size_t i = 0; i < kFlightsAtOnce; ++i) {
    const engine::Motion<double>& motion = flights[i].motion;
    elapsed.set(i, engine::difference<double>(at, motion.since));
    x.set(i, motion.position.x);
    y.set(i, motion.position.y);
    vx.set(i, motion.velocity.x);
    vy.set(i, motion.velocity.y);
    states.id[i] = flights[i].id;
    states.vx[i] = engine::to_scalar(motion.velocity.x);
    states.vy[i] = engine::to_scalar(motion.velocity.y);
    // At its own instant a motion is its position as it stands, the sign of a zero included.
    is_plain = is_plain && flights[i].id != engine::kNoId && elapsed.hi[i] != 0;
  }
  if (!is_plain) return false;
  states.x = places(x, vx, elapsed);
  states.y = places(y, vy, elapsed);
  return true;
}

}  // namespace stoss::service

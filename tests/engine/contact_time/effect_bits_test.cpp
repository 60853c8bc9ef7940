// SPDX-License-Identifier: Apache-2.0
// The kernels that effects need give the same bits with every compiler, at every level of
// optimisation: a fingerprint of their answers to cases that are drawn without the mathematical
// library. A new fingerprint is a change of results: it needs a reason.
#include "contact_time/accelerated_disk_disk.hpp"
#include "contact_time/accelerated_disk_wall.hpp"
#include "contact_time/drag.hpp"
#include "contact_time/drag_face.hpp"
#include "contact_time/growing.hpp"
#include "elementary.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

namespace stoss::engine {
namespace {

using test::Random;

class Fingerprint {
 public:
  template <class S>
  void add(S x) {
    using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
    hash_ = (hash_ ^ std::bit_cast<Bits>(x)) * 0x100000001b3U;  // FNV-1a, by words
    hash_ ^= hash_ >> 32U;
  }

  template <class S>
  void add(const std::optional<Duration<S>>& t) {
    add(t ? t->hi : S(-1));
    add(t ? t->lo : S(-1));
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// A number in [-1, 1) times a power of two down to 2^-40, every other time with a low word.
template <class S>
DoubleWord<S> draw(Random& random) {
  double x = random.uniform(-1, 1);
  const std::uint64_t bits = random.bits();
  for (std::uint64_t i = (bits & 7U) == 0 ? (bits >> 8U) % 40U : 0U; i > 0; --i) x *= 0.5;
  const S hi = static_cast<S>(x);
  const S low = (bits & 8U) != 0 ? static_cast<S>(random.uniform(-1, 1)) : S(0);
  return two_sum(hi, S(low * hi * std::numeric_limits<S>::epsilon() * S(0.25)));
}

template <class S>
DoubleWord2<S> draw_vector(Random& random) {
  const DoubleWord<S> x = draw<S>(random);
  return {x, draw<S>(random)};
}

template <class S>
void add_case(Fingerprint& print, Random& random) {
  const DoubleWord2<S> position = draw_vector<S>(random), velocity = draw_vector<S>(random);
  const DoubleWord2<S> acceleration = draw_vector<S>(random), edge = draw_vector<S>(random);
  const AcceleratedMotion<S> curved{position, velocity, acceleration, S(0)};
  const RelativeMotion<S> straight{position, velocity, S(0)};
  const S radius = detail::magnitude(draw<S>(random).hi) * S(0.5);
  const S rate = detail::magnitude(draw<S>(random).hi);
  const S forever = std::numeric_limits<S>::infinity();
  const DoubleWord<S> reach{radius, S(0)};
  print.add(accelerated_disk_contact(curved, reach, forever));
  print.add(accelerated_disk_contact(curved, reach, S(1)));
  print.add(accelerated_face_contact(curved, edge, radius, forever));
  print.add(growing_disk_contact(straight, GrowingReach<S>{reach, {rate, S(0)}}));
  print.add(growing_face_contact(straight, edge, GrowingReach<S>{reach, {rate, S(0)}}));
  print.add(drag_disk_contact(straight, reach, rate));
  print.add(drag_face_contact(curved, edge, radius, rate, forever));
  const S x = S(16) * position.x.hi;
  print.add(rounded_exp(x));
  print.add(rounded_expm1(x));
  print.add(rounded_log1p(S(position.y.hi)));
  print.add(rounded_decay_mean(x));
}

template <class S>
std::uint64_t fingerprint() {
  Fingerprint print;
  Random random(1);
  for (int i = 0; i < 5000; ++i) add_case<S>(print, random);
  return print.value();
}

TEST(EffectBits, DoubleIsTheSameEverywhere) {
  EXPECT_EQ(fingerprint<double>(), 0xa2fcf875cfd1f8d0U);
}

TEST(EffectBits, FloatIsTheSameEverywhere) { EXPECT_EQ(fingerprint<float>(), 0xa4888ac1f65a91f9U); }

}  // namespace
}  // namespace stoss::engine

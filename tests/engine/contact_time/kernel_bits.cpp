// SPDX-License-Identifier: Apache-2.0
// One build of the fingerprint; STOSS_KERNEL_BITS names its function. Builds with other
// instructions than the test's live in a shared library with hidden symbols, so that the linker
// cannot take one build's template instances for another's.
#include "kernel_bits.hpp"

#include "contact_law/elastic.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace {

using stoss::engine::DoubleWord;
using stoss::engine::DoubleWord2;
using stoss::engine::Duration;
using stoss::test::KernelInput;

class Fingerprint {
 public:
  template <class S>
  void add(S x) {
    using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
    hash_ = (hash_ ^ std::bit_cast<Bits>(x)) * 0x100000001b3U;  // FNV-1a, by words
    hash_ ^= hash_ >> 32U;
  }

  template <class S>
  void add(const DoubleWord<S>& x) {
    add(x.hi);
    add(x.lo);
  }

  template <class S>
  void add(const DoubleWord2<S>& a) {
    add(a.x);
    add(a.y);
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

template <class S>
DoubleWord2<S> words(const double (&x)[4]) {
  return {stoss::engine::quick_two_sum(static_cast<S>(x[0]), static_cast<S>(x[1])),
          stoss::engine::quick_two_sum(static_cast<S>(x[2]), static_cast<S>(x[3]))};
}

template <class S>
void add_case(Fingerprint& print, const KernelInput& input) {
  const stoss::engine::RelativeMotion<S> motion{words<S>(input.position), words<S>(input.velocity)};
  const DoubleWord2<S> edge = words<S>(input.edge);
  const S radius = static_cast<S>(input.radius);
  for (const std::optional<Duration<S>>& t :
       {stoss::engine::disk_disk_contact(motion, stoss::engine::two_sum(radius, radius)),
        stoss::engine::disk_point_contact(motion, radius),
        stoss::engine::disk_wall_face_contact(motion, edge, radius)}) {
    print.add(t ? S(1) : S(0));
    if (!t) continue;
    print.add(t->hi);
    print.add(t->lo);
    print.add(stoss::engine::displacement_at(motion, *t));
    print.add(stoss::engine::projects_inside(motion, edge, *t) ? S(1) : S(0));
  }
  const auto impulse = stoss::engine::elastic_impulse(
      motion.position, motion.velocity, radius, false, S(0.3), false);
  print.add(impulse.delta_a);
  print.add(impulse.delta_b);
  print.add(impulse.impulse);
  print.add(impulse.normal_x);
  print.add(sqrt(square_norm(edge)) / radius);
}

}  // namespace

extern "C" [[gnu::visibility("default")]] std::uint64_t STOSS_KERNEL_BITS(const KernelInput* cases,
                                                                          std::size_t count) {
  Fingerprint print;
  for (std::size_t i = 0; i < count; ++i) {
    add_case<double>(print, cases[i]);
    add_case<float>(print, cases[i]);
  }
  return print.value();
}

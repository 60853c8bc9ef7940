// SPDX-License-Identifier: Apache-2.0
#include "sight.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace stoss::engine {
namespace {

/// The soonest two, lane by lane, of those that stood in it.
struct SoonestByLane {
  Four first = Four{} + std::numeric_limits<double>::infinity();
  Four second = first;
  FourWords partner = FourWords{} - 1;

  [[gnu::always_inline]] void note(const FourWords& others, const Four& soonest) {
    const FourWords is_first = soonest < first;
    const Four later = is_first ? first : soonest;
    second = later < second ? later : second;
    first = is_first ? soonest : first;
    partner = is_first ? others : partner;
  }

  // Without a branch, for which lane is first is random.
  SoonestTwo over_all() const {
    SoonestTwo all{first[0], second[0]};
    int soonest = 0;
    for (int lane = 1; lane < 4; ++lane) {
      const double later = std::max(all.first, first[lane]);
      all.second = std::min(all.second, std::min(second[lane], later));
      soonest = first[lane] < all.first ? lane : soonest;
      all.first = std::min(all.first, first[lane]);
    }
    all.partner = static_cast<Slot>(partner[soonest]);
    return all;
  }
};

/// Four sights as columns.
struct Columns {
  SightsOf<Four> of;
  Four size;
};
template <class AnySight>
[[gnu::always_inline]] inline Columns gathered(const AnySight& a,
                                               const AnySight& b,
                                               const AnySight& c,
                                               const AnySight& d) {
  const auto from = [](const double& first) {
    Four four;
    std::memcpy(&four, &first, sizeof four);
    return four;
  };
  Four x = from(a.x), y = from(b.x), vx = from(c.x), vy = from(d.x);
  Four since = from(a.since), size = from(b.since), off = from(c.since), radius = from(d.since);
  lanes::transpose(x, y, vx, vy);
  lanes::transpose(since, size, off, radius);
  if constexpr (std::is_same_v<AnySight, PlainSight>) radius = lanes::magnitude(size);
  return {{x, y, vx, vy, since, radius, off}, size};
}

/// Writes those of four that count; returns where it has stopped.
PassedOver* noted(const Slot* four,
                  const FourWords& counts,
                  const Four& soonest,
                  PassedOver* others) {
  for (unsigned left = lanes::below_zero(counts); left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    *others++ = {four[lane], soonest[lane]};
  }
  return others;
}

}  // namespace

template <class AnySight, class Common>
SoonestTwo soonest_contacts(Slot slot,
                            std::span<const Slot> list,
                            const std::vector<AnySight>& sights,
                            double size_min,
                            double now,
                            double slack,
                            const Common& common,
                            PassedOver* others) {
  const Present own = present_of(sights[static_cast<std::size_t>(slot)], now);
  const Four never = Four{} + std::numeric_limits<double>::infinity();
  SoonestByLane found;
  PassedOver* const first_other = others;
  const AnySight* const see = sights.data();
  for (std::size_t i = 0; i < list.size(); i += 4) {
    // Beyond its end a list has room for four, with slots that it held once.
    const Slot* four = list.data() + i;
    const auto count = static_cast<std::int64_t>(list.size() - i);
    const Columns there = gathered(see[four[0]], see[four[1]], see[four[2]], see[four[3]]);
    const Four soonest = soonest_contact<Four>(own, there.of, now, slack, common);
    const FourWords is_other = ~(there.size >= size_min);
    const FourWords is_beyond = FourWords{0, 1, 2, 3} >= count;
    if (lanes::below_zero(is_other & ~is_beyond) != 0) [[unlikely]] {
      const FourWords is_unlike = there.size < 0;
      const FourWords counts = is_other & ~is_beyond & (is_unlike | (soonest < never));
      others = noted(four, counts, is_unlike ? Four{} - 1 : soonest, others);
    }
    found.note(FourWords{four[0], four[1], four[2], four[3]},
               (is_other | is_beyond) ? never : soonest);
  }
  SoonestTwo all = found.over_all();
  all.passed_over = static_cast<int>(others - first_other);
  return all;
}

template <class AnySight, class Common>
using SoonestContacts = SoonestTwo(Slot,
                                   std::span<const Slot>,
                                   const std::vector<AnySight>&,
                                   double,
                                   double,
                                   double,
                                   const Common&,
                                   PassedOver*);
template SoonestContacts<PlainSight, Steady> soonest_contacts<PlainSight, Steady>;
template SoonestContacts<Sight, Steady> soonest_contacts<Sight, Steady>;
template SoonestContacts<Sight, Growing> soonest_contacts<Sight, Growing>;
template SoonestContacts<Sight, Repeating<Steady>> soonest_contacts<Sight, Repeating<Steady>>;
template SoonestContacts<Sight, Repeating<Growing>> soonest_contacts<Sight, Repeating<Growing>>;

}  // namespace stoss::engine

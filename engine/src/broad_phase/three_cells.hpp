// SPDX-License-Identifier: Apache-2.0
#pragma once

// The items of three cells, which have places for two each: those that are there, written one
// behind the other without a branch. Where the processor moves eight numbers at once all six places
// are read, judged and written together; what is written, and in which order, is the same.

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace stoss::engine {

/// What an empty place holds.
inline constexpr std::int32_t kNoItem = -1;
/// take_three() may write so many numbers behind where it stops.
inline constexpr std::size_t kWrittenBeyond = 8;

/// Writes what a place holds, unless that is nothing or the one item; returns where it has stopped.
/// May write one number behind that.
[[gnu::always_inline]] inline std::int32_t* take_one(std::int32_t item,
                                                     std::int32_t but_for,
                                                     std::int32_t* to) {
  *to = item;
  return to + (static_cast<int>(item >= 0) & static_cast<int>(item != but_for));
}

#if defined(__AVX2__)

namespace detail {

using Eight = std::int32_t __attribute__((vector_size(32)));
/// For every set of six lanes those lanes, lowest first.
struct alignas(32) Lanes {
  std::array<std::int32_t, 8> in_order{};
};
inline constexpr std::array<Lanes, 64> kLanesOf = [] {
  std::array<Lanes, 64> all{};
  for (std::size_t set = 0; set < all.size(); ++set) {
    std::size_t at = 0;
    for (std::int32_t lane = 0; lane < 6; ++lane) {
      if ((set >> lane & 1U) != 0) all[set].in_order[at++] = lane;
    }
  }
  return all;
}();

}  // namespace detail

/// Writes the items in the places of three cells, but for one item; returns where it has stopped.
[[gnu::always_inline]] inline std::int32_t* take_three(const std::int32_t* first,
                                                       const std::int32_t* second,
                                                       const std::int32_t* third,
                                                       std::int32_t but_for,
                                                       std::int32_t* to) {
  using detail::Eight;
  const auto two_of = [](const std::int32_t* places) {
    std::int64_t two;
    std::memcpy(&two, places, sizeof two);
    return two;
  };
  using Words = std::int64_t __attribute__((vector_size(32)));
  const Eight items =
      reinterpret_cast<Eight>(Words{two_of(first), two_of(second), two_of(third), -1});
  const Eight left_out = items | (items == but_for);  // below zero; the last two are
  const auto set = ~static_cast<unsigned>(__builtin_ia32_movmskps256(
                       reinterpret_cast<float __attribute__((vector_size(32)))>(left_out))) &
                   0x3fU;
  Eight lanes;
  std::memcpy(&lanes, &detail::kLanesOf[set], sizeof lanes);
  const Eight taken = __builtin_ia32_permvarsi256(items, lanes);
  std::memcpy(to, &taken, sizeof taken);
  return to + std::popcount(set);
}

#else

/// Writes the items in the places of three cells, but for one item; returns where it has stopped.
inline std::int32_t* take_three(const std::int32_t* first,
                                const std::int32_t* second,
                                const std::int32_t* third,
                                std::int32_t but_for,
                                std::int32_t* to) {
  for (const std::int32_t* const cell : {first, second, third}) {
    for (int place = 0; place < 2; ++place) to = take_one(cell[place], but_for, to);
  }
  return to;
}

#endif

}  // namespace stoss::engine

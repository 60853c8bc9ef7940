// SPDX-License-Identifier: Apache-2.0
#pragma once

// A world that repeats itself along one axis or both: images of bodies, and where a body is shown.
//
//   (1) x_k = x + k L          the image k of what is at x; L: period [m], k: a whole number
//   (2) w(x) = x - floor(x / L) L, in [0, L)          the one image that is shown
//
// A stored motion knows nothing of (2): it runs on across the border and is never rewritten there.
// So bodies drift away from the origin while they are shown near it, and two of them are as near to
// each other as the difference of their positions plus the right k L.
//
// Source: minimum images, Alder and Wainwright, J. Chem. Phys. 31 (1959) 459. Deviation: there a
//   pair has one image, the nearest; here it has each that comes within reach, for walls are long.
// Accuracy: k L is an exact product of two double words; differences (apart()) carry a third word
//   and are rounded once to two, so an image is no less exact than the body itself. In wide
//   arithmetics k L is rounded once. tests/engine/effects/periodic_test.cpp measures (1) against
//   images that stand in open space.
// Preconditions: |k| <= kPeriodsMax.

#include "broad_phase/aabb.hpp"
#include "broad_phase/neighbours.hpp"
#include "screen.hpp"
#include "stored.hpp"

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/types.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace stoss::engine {

/// So many periods a body may be away from the origin: positions then still resolve 2^-20 of a
/// period or better. Chosen; no unit.
template <class S>
inline constexpr double kPeriodsMax = 0x1p32;
template <>
inline constexpr double kPeriodsMax<float> = 0x1p24;

/// Which image of a body: (1) along both axes.
struct Image {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const Image&, const Image&) = default;
  friend Image operator-(const Image& k) { return {-k.x, -k.y}; }
  friend Image operator+(const Image& a, const Image& b) { return {a.x + b.x, a.y + b.y}; }
  friend Image operator-(const Image& a, const Image& b) { return a + -b; }
};

/// In a world without images the body itself.
struct OneImage {
  friend bool operator==(const OneImage&, const OneImage&) = default;
  friend OneImage operator-(const OneImage&) { return {}; }
};

namespace detail {

/// A whole number in words of S, exactly. REQUIRES: |k| < 2^48.
template <class S>
DoubleWord<S> whole(std::int64_t k) {
  const S high(static_cast<S>(static_cast<double>(k)));
  if constexpr (kCompensated<S>) {
    return {high, static_cast<S>(static_cast<double>(k) - static_cast<double>(high))};
  } else {
    return {high, S(0)};
  }
}

/// x + k period, the sum exact to a third word.
template <class S>
DoubleWord<S> image_of(const DoubleWord<S>& x, std::int64_t k, const DoubleWord<S>& period) {
  if (k == 0) return x;
  LongSum<S> sum;
  sum.add(x);
  sum.add_product(whole<S>(k), period);
  return sum.two_words();
}

/// x - from + k period likewise; for k = 0 the plain difference.
template <class S>
DoubleWord<S> apart(const DoubleWord<S>& x,
                    const DoubleWord<S>& from,
                    std::int64_t k,
                    const DoubleWord<S>& period) {
  if (k == 0) return x - from;
  LongSum<S> sum;
  sum.add(x);
  sum.add(-from);
  sum.add_product(whole<S>(k), period);
  return sum.two_words();
}

template <class S>
double rough(const DoubleWord<S>& x) {
  return static_cast<double>(x.hi) + static_cast<double>(x.lo);
}

/// The k of (2), -floor(x / L), exactly, or one less where (2) would round up to L; 0 along an open
/// axis.
template <class S>
std::int64_t shown_image(const DoubleWord<S>& x, const DoubleWord<S>& period) {
  if (!(period.hi > S(0))) return 0;
  // Off by one at most, where x is within rounding of a border.
  auto k = static_cast<std::int64_t>(-std::floor(rough(x) / rough(period)));
  if (sign(image_of(x, k, period)) < 0) ++k;
  if (static_cast<double>(to_scalar(image_of(x, k, period))) >= rough(period)) --k;
  return k;
}

/// (2) in double; along an open axis x itself. What would round up to L is shown at 0.
template <class S>
double shown(const DoubleWord<S>& x, const DoubleWord<S>& period) {
  const auto place = static_cast<double>(to_scalar(image_of(x, shown_image(x, period), period)));
  return place <= 0 && period.hi > S(0) ? 0.0 : place;
}

template <class S>
Vector2 shown(const DoubleWord2<S>& position, const DoubleWord2<S>& period) {
  return {shown(position.x, period.x), shown(position.y, period.y)};
}

/// The image whose start is shown; its end follows from there.
template <class S>
WallState shown_wall(Id id,
                     const Instant& instant,
                     const DoubleWord2<S>& start,
                     const DoubleWord2<S>& edge,
                     const DoubleWord2<S>& velocity,
                     const DoubleWord2<S>& period) {
  const auto home = [](const DoubleWord<S>& x, const DoubleWord<S>& length) {
    return image_of(x, shown_image(x, length), length);
  };
  const auto rounded = [](const DoubleWord<S>& x) { return static_cast<double>(to_scalar(x)); };
  const DoubleWord2<S> there{home(start.x, period.x), home(start.y, period.y)};
  return {id,
          instant,
          shown(start, period),
          {rounded(there.x + edge.x), rounded(there.y + edge.y)},
          {rounded(velocity.x), rounded(velocity.y)}};
}

/// Nearest whole number of periods in x; 0 along an open axis.
inline std::int64_t periods_in(double x, double period) {
  return period > 0 ? static_cast<std::int64_t>(std::nearbyint(x / period)) : 0;
}

/// Images, from first to last, of an interval b that meet an interval a along an axis.
struct ImageRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};
inline ImageRange images_that_meet(
    double low_a, double high_a, double low_b, double high_b, double period) {
  if (!(period > 0)) return {0, low_a <= high_b && low_b <= high_a ? 0 : -1};
  constexpr double kRounding = 1e-9;  // of a period; chosen: one image too many does no harm
  // Mostly both lie together, and nothing has to be divided.
  const double within = period * (1 - kRounding);
  const double up = high_a - low_b;
  const double down = high_b - low_a;
  if (up >= 0 && down >= 0 && up < within && down < within) return {0, 0};
  return {static_cast<std::int64_t>(std::ceil(-down / period - kRounding)),
          static_cast<std::int64_t>(std::floor(up / period + kRounding))};
}

}  // namespace detail

/// Where a body may go before it renews its box, and which of its images that box holds.
struct Cage {
  Aabb box;                   ///< around the image `home`
  Image home;                 ///< the image that was in [0, L) when the box was made
  Neighbours::Anchor anchor;  ///< of the body itself, when the box was made
  double margin = 0;          ///< m
};

/// The images that a resting disk's ids name, as seen from the disk.
struct RestImages {
  Image support;
  Image second_support;
  Image slid_off;
};

/// Nothing is periodic in a plain world, and nothing is kept.
struct OpenSpace {
  explicit OpenSpace(const Vector2&) {}
};

/// The periods of a world, and the cages of its bodies if it has any.
template <class S>
struct PeriodicSpace {
  explicit PeriodicSpace(const Vector2& asked)
      : as_asked(asked),
        period(detail::stored<S>(asked)),
        length_x(detail::rough(period.x)),
        length_y(detail::rough(period.y)) {}

  bool is_periodic() const { return length_x > 0 || length_y > 0; }
  double smallest() const {
    if (!(length_x > 0)) return length_y;
    if (!(length_y > 0)) return length_x;
    return std::min(length_x, length_y);
  }

  /// Is a place more than so many periods from the origin along a periodic axis?
  bool is_beyond(const Vector2& place, double periods) const {
    const auto beyond = [periods](double x, double length) {
      return length > 0 && !(std::abs(x) <= periods * length);
    };
    return beyond(place.x(), length_x) || beyond(place.y(), length_y);
  }

  Vector2 way(const Image& k) const {
    return {static_cast<double>(k.x) * length_x, static_cast<double>(k.y) * length_y};
  }

  /// `g` of another image.
  Glance image_of(const Glance& g, const Image& k) const {
    Glance other = g;
    const auto shift = [](double& x, double& low, std::int64_t count, double length) {
      if (count == 0) return;
      const auto way = two_prod(static_cast<double>(count), length);
      const auto sum = two_sum(x, way.hi);
      x = sum.hi;
      low += sum.lo + way.lo;
    };
    shift(other.x, other.x_low, k.x, length_x);
    shift(other.y, other.y_low, k.y, length_y);
    return other;
  }

  /// Calls visit(image) for the images of `b`, as seen from the image `home_a` that `a` holds, that
  /// meet `a`. `home_b`: the image that `b` holds.
  template <class Visit>
  void for_each_meeting(
      const Aabb& a, const Image& home_a, const Aabb& b, const Image& home_b, Visit&& visit) const {
    const auto in_x = detail::images_that_meet(a.low_x, a.high_x, b.low_x, b.high_x, length_x);
    const auto in_y = detail::images_that_meet(a.low_y, a.high_y, b.low_y, b.high_y, length_y);
    for (std::int64_t x = in_x.first; x <= in_x.last; ++x) {
      for (std::int64_t y = in_y.first; y <= in_y.last; ++y) {
        visit(Image{x, y} + home_b - home_a);
      }
    }
  }

  /// Calls visit(box) for the images of `box` that may meet any body's box.
  template <class Visit>
  void for_each_copy(const Aabb& box, Visit&& visit) const {
    for_each_meeting(bounds, {}, box, {}, [&](const Image& k) {
      const Vector2 by = way(k);
      visit(grown(
          {box.low_x + by.x(), box.low_y + by.y(), box.high_x + by.x(), box.high_y + by.y()}, 0));
    });
  }

  /// A box whose images cover what those of [low, high] cover, at most a period wide.
  Aabb in_one_cell(const Vector2& low, const Vector2& high) const {
    Aabb box{low.x(), low.y(), high.x(), high.y()};
    const auto reduce = [](double& from, double& to, double length) {
      if (!(length > 0) || !(from <= to)) return;
      if (!(to - from < length)) {
        from = 0;
        to = length;
        return;
      }
      const double by = std::floor(from / length) * length;
      from -= by;
      to -= by;
    };
    reduce(box.low_x, box.high_x, length_x);
    reduce(box.low_y, box.high_y, length_y);
    return box;
  }

  std::size_t index(std::int32_t slot) const { return static_cast<std::size_t>(slot); }
  const Cage& cage(std::int32_t slot) const { return cages[index(slot)]; }

  Vector2 as_asked;
  DoubleWord2<S> period;  ///< m; 0: open
  double length_x;        ///< the same in double, exactly but in wide arithmetics
  double length_y;
  std::vector<Cage> cages;
  std::vector<RestImages> rests;  ///< up to the last slot that ever rested
  Aabb bounds;                    ///< of all boxes there have been
};

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// Adversarial contacts: seeded families of pairs and of disks and walls, each hard in one way. A
// case is built to 400 bits and then rounded to one or two words; the rounded words are the case.
// Environment: STOSS_CASES (cases per family), STOSS_SEED.
#pragma once

#include "support/campaign.hpp"
#include "support/oracle.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace stoss::test {

/// A million in long runs, as the tolerances are judged by; STOSS_CASES overrules both.
inline std::uint64_t cases_per_family(std::uint64_t otherwise) {
  return environment_number("STOSS_CASES", campaign(otherwise, 1'000'000));
}

template <class S>
struct PairCase {
  engine::RelativeMotion<S> motion;
  engine::DoubleWord<S> reach;
};

/// A pair by its shape: `ahead` along the relative flight and `aside` of it (in metres, as seen by
/// the disk that flies), reach in metres, speed in metres per second.
struct PairShape {
  Real ahead, aside;
  double reach = 1;
  double speed = 1;
};

struct PairFamily {
  std::string name;
  std::function<PairShape(Random&)> shape;
};

/// Rounds a shape, turned by a random angle, to S.
template <class S>
PairCase<S> make_pair(const PairShape& shape, Random& random, bool low_words) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const Real2 flight{Real(shape.speed) * std::cos(angle), Real(shape.speed) * std::sin(angle)};
  const engine::DoubleWord2<S> velocity = rounded<S>(flight, low_words);
  const Real2 v = exact(velocity);
  const Real speed = sqrt(dot(v, v));
  const Real2 unit{v.x / speed, v.y / speed};
  const engine::DoubleWord<S> reach =
      rounded<S>(low_words ? Real(Real(shape.reach) * (1 + Real(random.uniform(-1, 1)) * 0x1p-40))
                           : Real(shape.reach),
                 low_words);
  // The rounded reach differs from the shape's: keep the shape's relative gap and depth.
  const Real scale = exact(reach) / Real(shape.reach);
  const Real ahead = shape.ahead * scale, aside = shape.aside * scale;
  const Real2 position{-ahead * unit.x + aside * unit.y, -ahead * unit.y - aside * unit.x};
  return {{rounded<S>(position, low_words), velocity}, reach};
}

/// What a scalar can stand: decades of distance, of speed and of size.
struct Decades {
  double finest, far, slow, fast, sizes;
};
template <class S>
inline constexpr Decades kDecades{-17, 14, -300, 150, 30};
template <>
inline constexpr Decades kDecades<float>{-9, 6, -30, 18, 8};

namespace detail {

inline double unit_reach(Random& random) { return random.uniform(0.5, 2); }

// Braces, for they evaluate the draws in order with every compiler; arguments do not.
struct Approach {
  double reach;
  Real distance;  ///< in reaches
  double cosine;  ///< of the angle between the flight and the line of centres
};

inline PairShape seen_under(const Approach& a, Random& random) {
  const Real distance = a.distance * a.reach;
  const Real sine = sqrt(Real(1) - Real(a.cosine) * a.cosine);
  return {distance * a.cosine, distance * sine * random.either_sign(1), a.reach, 1};
}

struct Pass {
  Real ahead;  ///< in reaches
  Real aside;  ///< in reaches
  double reach;
};

inline PairShape passing(const Pass& pass, Random& random) {
  return {pass.ahead * pass.reach, pass.aside * pass.reach * random.either_sign(1), pass.reach, 1};
}

}  // namespace detail

/// The families of pairs for a scalar with these decades.
inline std::vector<PairFamily> pair_families(const Decades& decades) {
  using detail::passing;
  using detail::seen_under;
  using detail::unit_reach;
  const double finest = decades.finest;
  std::vector<PairFamily> families;
  families.push_back({"generic", [](Random& r) {
                        return passing({r.uniform(1, 10), r.uniform(0, 1.5), unit_reach(r)}, r);
                      }});
  families.push_back(
      {"near touching", [=](Random& r) {
         return seen_under({unit_reach(r), 1 + Real(r.decades(finest, 0)), r.uniform(0, 1)}, r);
       }});
  families.push_back(
      {"grazing hit", [=](Random& r) {
         return passing({r.uniform(1, 10), 1 - Real(r.decades(finest, -1)), unit_reach(r)}, r);
       }});
  families.push_back(
      {"grazing miss", [=](Random& r) {
         return passing({r.uniform(1, 10), 1 + Real(r.decades(finest, -1)), unit_reach(r)}, r);
       }});
  families.push_back(
      {"far bullets", [=](Random& r) {
         return passing({r.decades(0, decades.far), r.uniform(0, 1.2), unit_reach(r)}, r);
       }});
  families.push_back(
      {"extreme speeds", [=](Random& r) {
         PairShape shape = passing({r.uniform(1, 10), r.uniform(0, 1.2), unit_reach(r)}, r);
         shape.speed = r.decades(decades.slow, decades.fast);
         return shape;
       }});
  families.push_back(
      {"overlap, approaching", [=](Random& r) {
         return seen_under(
             {unit_reach(r), 1 - Real(r.decades(finest, finest / 2)), r.uniform(0, 1)}, r);
       }});
  families.push_back(
      {"near touching and grazing", [=](Random& r) {
         return seen_under(
             {unit_reach(r), 1 + Real(r.decades(finest, 0)), r.decades(finest / 2, 0)}, r);
       }});
  families.push_back(
      {"all mixed", [=](Random& r) {
         const double d = r.decades(-decades.sizes, decades.sizes);
         const Real distance = 1 + Real(r.decades(finest, decades.far / 2));
         const Real aside = 1 + Real(r.either_sign(r.decades(finest, 0)));
         const Real ahead2 = distance * distance - aside * aside;
         PairShape shape = passing({ahead2 > 0 ? Real(sqrt(ahead2)) : distance, aside, d}, r);
         shape.speed = r.decades(decades.slow / 3, decades.fast / 3);
         return shape;
       }});
  return families;
}

template <class S>
struct WallCase {
  engine::RelativeMotion<S> motion;  ///< of the disk's centre from the wall's start
  engine::DoubleWord2<S> edge;
  S radius{};
};

/// A disk and a wall by their shape: the gap to the line and the place of the contact on it, the
/// slope of the flight (1: straight at the wall), all lengths in metres.
struct WallShape {
  Real gap;
  double place = 0.5;  ///< of the contact along the edge, 0..1
  double slope = 1;    ///< closing speed / speed
  double length = 4;
  double radius = 0.5;
  double speed = 1;
};

struct WallFamily {
  std::string name;
  std::function<WallShape(Random&)> shape;
};

template <class S>
WallCase<S> make_wall(const WallShape& shape, Random& random, bool low_words) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const Real2 wanted{Real(shape.length) * std::cos(angle), Real(shape.length) * std::sin(angle)};
  WallCase<S> result;
  result.edge = rounded<S>(wanted, low_words);
  result.radius = static_cast<S>(shape.radius);
  const Real2 edge = exact(result.edge);
  const Real length = sqrt(dot(edge, edge));
  const Real2 along{edge.x / length, edge.y / length};
  const double side = random.either_sign(1);
  const Real2 up{-along.y * side, along.x * side};
  const Real slide =
      Real(shape.speed) * sqrt(Real(1) - Real(shape.slope) * shape.slope) * random.either_sign(1);
  const Real close = Real(shape.speed) * shape.slope;
  const Real2 velocity{slide * along.x - close * up.x, slide * along.y - close * up.y};
  result.motion.velocity = rounded<S>(velocity, low_words);
  const Real height = shape.gap + Real(result.radius);
  const Real back = shape.slope > 0 ? Real(slide * (shape.gap / close)) : Real(0);
  const Real from_start = Real(shape.place) * length - back;
  const Real2 position{from_start * along.x + height * up.x, from_start * along.y + height * up.y};
  result.motion.position = rounded<S>(position, low_words);
  return result;
}

/// The families of disks and walls for a scalar with these decades.
inline std::vector<WallFamily> wall_families(const Decades& decades) {
  const double finest = decades.finest;
  std::vector<WallFamily> families;
  families.push_back({"generic", [](Random& r) {
                        return WallShape{Real(r.uniform(0, 10)),
                                         r.uniform(-0.2, 1.2),
                                         r.uniform(0, 1),
                                         r.uniform(1, 10),
                                         r.uniform(0.1, 2)};
                      }});
  families.push_back({"near touching", [=](Random& r) {
                        return WallShape{Real(r.decades(finest, 0)),
                                         r.uniform(0.01, 0.99),
                                         r.uniform(0, 1),
                                         r.uniform(1, 10),
                                         r.uniform(0.5, 2)};
                      }});
  families.push_back({"nearly parallel", [=](Random& r) {
                        const double slope = r.decades(finest, 0);
                        return WallShape{Real(slope * r.uniform(0, 4)),
                                         r.uniform(0.01, 0.99),
                                         slope,
                                         r.uniform(1, 10),
                                         r.uniform(0.5, 2)};
                      }});
  families.push_back({"long walls", [=](Random& r) {
                        return WallShape{Real(r.uniform(0, 10)),
                                         r.uniform(0.01, 0.99),
                                         r.uniform(0.1, 1),
                                         r.decades(2, decades.far * 9 / 14),
                                         r.uniform(0.1, 2)};
                      }});
  families.push_back({"overlap, approaching", [=](Random& r) {
                        return WallShape{-Real(r.decades(finest, finest / 2)),
                                         r.uniform(0.01, 0.99),
                                         r.uniform(0.001, 1),
                                         r.uniform(1, 10),
                                         r.uniform(0.5, 2)};
                      }});
  families.push_back({"far bullets", [=](Random& r) {
                        return WallShape{Real(r.decades(0, decades.far)),
                                         r.uniform(0.01, 0.99),
                                         r.uniform(0.5, 1),
                                         r.uniform(1, 10),
                                         r.uniform(0.1, 2)};
                      }});
  families.push_back({"extreme speeds", [=](Random& r) {
                        return WallShape{Real(r.uniform(0, 10)),
                                         r.uniform(0.01, 0.99),
                                         r.uniform(0.1, 1),
                                         r.uniform(1, 10),
                                         r.uniform(0.1, 2),
                                         r.decades(decades.slow, decades.fast)};
                      }});
  families.push_back({"all mixed", [=](Random& r) {
                        const double size = r.decades(-decades.sizes, decades.sizes);
                        const double slope = r.decades(finest / 2, 0);
                        return WallShape{Real(size) * r.decades(finest, 2),
                                         r.uniform(0.01, 0.99),
                                         slope,
                                         size * r.decades(0, 4),
                                         size * r.uniform(0.1, 2),
                                         r.decades(decades.slow / 3, decades.fast / 3)};
                      }});
  return families;
}

}  // namespace stoss::test

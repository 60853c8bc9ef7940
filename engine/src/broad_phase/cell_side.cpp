// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/cell_side.hpp"

#include <cmath>

namespace stoss::engine {
namespace {

/// In (2).
constexpr double kSteps = 1.6;

/// Between the side over which a disk comes in and that over which it would go back, m.
double room_to_return(double radius_max, double side) {
  return 2 * beyond_cell(radius_max, side) * side;
}

double crossings_a_search(double way, double radius_max, double side) {
  return way * way / (side * (kSteps * way + room_to_return(radius_max, side)));
}

/// The way for which that is q.
double way_between_searches(double q, double radius_max, double side) {
  const double half = kSteps * q * side / 2;
  return half + std::sqrt(half * half + q * side * room_to_return(radius_max, side));
}

}  // namespace

double best_side(double radius_max, double side, const CellWork& work) {
  const double searches = work.searches + 1;
  const double way = way_between_searches(work.crossings / searches, radius_max, side);
  const double found = work.looks / searches;
  const auto cost = [&](double larger) {
    const double area = larger * larger;
    const double q = crossings_a_search(way, radius_max, larger * side);
    return q * (kCrossingLooks + area * found / 3) + area * found;
  };
  constexpr double kStep = 1.05;
  double best = std::max(0.5, least_side(radius_max) / side);
  double least = cost(best);
  for (double larger = best * kStep; larger < 4; larger *= kStep) {
    const double its = cost(larger);
    if (its < least) best = larger;
    least = std::min(least, its);
  }
  return best * side;
}

}  // namespace stoss::engine

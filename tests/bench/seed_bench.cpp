// SPDX-License-Identifier: Apache-2.0
// What exactness costs: the engine's processor time per collision, with its own double-word
// kernels, with the textbook contact formulas, and with the textbook impulse as well. All three are
// the same engine in one program, and take turns, so that what else the machine does falls on all.
//
//   seed_bench [--check] [--rounds N]
//
// --check: exit status 1 if a ratio to the textbook contact formulas is above 1.25.

#include "bench/gas_run.hpp"
#include "bench/processor_time.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace stoss {
namespace engine_exact {
bench::Advance make_gas_run(int columns, double area_fraction);
}
namespace engine_seed {
bench::Advance make_gas_run(int columns, double area_fraction);
}
namespace engine_seed_law {
bench::Advance make_gas_run(int columns, double area_fraction);
}
}  // namespace stoss

namespace {

using stoss::bench::processor_seconds;

constexpr double kRatioMax = 1.25;
constexpr std::size_t kEngines = 3;

/// ns per collision of each engine, in each round.
using Rounds = std::vector<std::array<double, kEngines>>;

Rounds measure(int columns, double area_fraction, int rounds) {
  const std::array<stoss::bench::Advance, kEngines> engines{
      stoss::engine_exact::make_gas_run(columns, area_fraction),
      stoss::engine_seed::make_gas_run(columns, area_fraction),
      stoss::engine_seed_law::make_gas_run(columns, area_fraction)};
  constexpr std::uint64_t kEvents = 40'000;
  Rounds result(static_cast<std::size_t>(rounds));
  for (std::size_t round = 0; round < result.size(); ++round) {
    for (std::size_t turn = 0; turn < kEngines; ++turn) {
      const std::size_t i = (turn + round) % kEngines;  // nobody always comes first
      const double begun = processor_seconds();
      const std::uint64_t collisions = engines[i](kEvents);
      result[round][i] = 1e9 * (processor_seconds() - begun) / static_cast<double>(collisions);
    }
  }
  return result;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median over the rounds of what `of` makes of each.
template <class Of>
double median_of(const Rounds& rounds, const Of& of) {
  std::vector<double> values;
  for (const auto& round : rounds) values.push_back(of(round));
  return median(values);
}

}  // namespace

int main(int argc, char** argv) {
  bool check = false;
  int rounds = 41;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--check") == 0) check = true;
    if (std::strcmp(argv[i], "--rounds") == 0 && i + 1 < argc) rounds = std::atoi(argv[i + 1]);
  }
  std::printf("processor time per collision [ns], medians of %d rounds\n", rounds);
  std::printf("%7s %9s %9s %9s %9s | %9s %9s\n",
              "disks",
              "fraction",
              "exact",
              "seed",
              "seed+law",
              "/ seed",
              "/ seed+law");
  double worst = 0;
  for (const int columns : {10, 32, 100}) {
    for (const double area_fraction : {0.05, 0.2, 0.5, 0.69}) {
      const Rounds found = measure(columns, area_fraction, std::max(rounds, 1));
      const double ratio = median_of(found, [](const auto& r) { return r[0] / r[1]; });
      std::printf("%7d %9.2f %9.0f %9.0f %9.0f | %9.3f %9.3f\n",
                  columns * columns,
                  area_fraction,
                  median_of(found, [](const auto& r) { return r[0]; }),
                  median_of(found, [](const auto& r) { return r[1]; }),
                  median_of(found, [](const auto& r) { return r[2]; }),
                  ratio,
                  median_of(found, [](const auto& r) { return r[0] / r[2]; }));
      std::fflush(stdout);
      worst = std::max(worst, ratio);
    }
  }
  std::printf("largest ratio to the seed formula: %.3f (at most %.2f)\n", worst, kRatioMax);
  return check && worst > kRatioMax ? 1 : 0;
}

// SPDX-License-Identifier: Apache-2.0
// Cost of one contact prediction and of one contact law, in nanoseconds, against the textbook root.
// The mixes: "easy" are pairs several reaches apart, as neighbour lists of a dilute gas hold them;
// "hits" are those of them that meet, "hard" are pairs near touching or grazing that meet.
#include "contact_law/elastic.hpp"
#include "contact_time/disk_disk.hpp"
#include "contact_time/disk_wall.hpp"
#include "support/contact_cases.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stoss::engine {
namespace {

using test::PairCase;
using test::PairFamily;
using test::Random;
using test::WallCase;
using test::WallFamily;

constexpr std::size_t kCases = 4096;

std::vector<PairCase<double>> pairs_of(const std::string& name, bool low_words, bool only_hits) {
  std::vector<PairCase<double>> cases;
  Random random(1);
  for (const PairFamily& family : test::pair_families(test::kDecades<double>)) {
    if (family.name != name) continue;
    while (cases.size() < kCases) {
      const PairCase<double> c = test::make_pair<double>(family.shape(random), random, low_words);
      if (!only_hits || disk_disk_contact(c.motion, c.reach)) cases.push_back(c);
    }
  }
  return cases;
}

/// Pairs at random: half of them recede, most others pass by.
std::vector<PairCase<double>> gas_pairs() {
  std::vector<PairCase<double>> cases;
  Random random(2);
  while (cases.size() < kCases) {
    const double x = random.uniform(-4, 4), y = random.uniform(-4, 4);
    if (x * x + y * y < 1) continue;
    cases.push_back({{{{x, x * 0x1p-55}, {y, y * -0x1p-56}},
                      {{random.uniform(-1, 1), 0x1p-60}, {random.uniform(-1, 1), 0x1p-61}}},
                     {1, 0}});
  }
  return cases;
}

std::optional<double> textbook(const RelativeMotion<double>& m, double reach) {
  const double px = m.position.x.hi, py = m.position.y.hi;
  const double vx = m.velocity.x.hi, vy = m.velocity.y.hi;
  const double b = px * vx + py * vy;
  if (!(b < 0)) return std::nullopt;
  const double vv = vx * vx + vy * vy;
  const double d = b * b - vv * (px * px + py * py - reach * reach);
  if (!(d >= 0)) return std::nullopt;
  return (-b - std::sqrt(d)) / vv;
}

template <class Cases, class Kernel>
void run(benchmark::State& state, const Cases& cases, const Kernel& kernel) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernel(cases[i]));
    i = (i + 1) % kCases;
  }
}

void textbook_pair(benchmark::State& state, const std::vector<PairCase<double>>& cases) {
  run(state, cases, [](const auto& c) { return textbook(c.motion, c.reach.hi); });
}

void exact_pair(benchmark::State& state, const std::vector<PairCase<double>>& cases) {
  run(state, cases, [](const auto& c) { return disk_disk_contact(c.motion, c.reach); });
}

void exact_end(benchmark::State& state, const std::vector<PairCase<double>>& cases) {
  run(state, cases, [](const auto& c) { return disk_point_contact(c.motion, c.reach.hi); });
}

void elastic_law(benchmark::State& state, const std::vector<PairCase<double>>& cases) {
  run(state, cases, [](const auto& c) {
    return elastic_impulse(c.motion.position, c.motion.velocity, 1.0, false, 3.0, false);
  });
}

std::vector<WallCase<double>> walls_of(const std::string& name) {
  std::vector<WallCase<double>> cases;
  Random random(3);
  for (const WallFamily& family : test::wall_families(test::kDecades<double>)) {
    if (family.name != name) continue;
    while (cases.size() < kCases) {
      cases.push_back(test::make_wall<double>(family.shape(random), random, true));
    }
  }
  return cases;
}

void exact_face(benchmark::State& state, const std::vector<WallCase<double>>& cases) {
  run(state, cases, [](const auto& c) {
    return disk_wall_face_contact(c.motion, c.edge, c.radius);
  });
}

void product_by_splitting(benchmark::State& state) {
  const std::vector<double> x(kCases, 1.1);
  run(state, x, [](double a) { return detail::two_prod_by_splitting(a, a + 1); });
}

void product_by_fma(benchmark::State& state) {
  const std::vector<double> x(kCases, 1.1);
  run(state, x, [](double a) {
    const double product = a * (a + 1);
    return DoubleWord<double>{product, std::fma(a, a + 1, -product)};
  });
}

void register_all() {
  const auto gas = gas_pairs();
  benchmark::RegisterBenchmark("pair/textbook/gas", textbook_pair, gas);
  benchmark::RegisterBenchmark("pair/exact/gas", exact_pair, gas);
  for (const char* name :
       {"generic", "near touching", "grazing hit", "far bullets", "near touching and grazing"}) {
    const auto cases = pairs_of(name, true, true);
    benchmark::RegisterBenchmark(
        (std::string("pair/textbook/hits ") + name).c_str(), textbook_pair, cases);
    benchmark::RegisterBenchmark(
        (std::string("pair/exact/hits ") + name).c_str(), exact_pair, cases);
  }
  for (const char* name : {"generic", "near touching", "far bullets"}) {
    benchmark::RegisterBenchmark(
        (std::string("wall face/exact/") + name).c_str(), exact_face, walls_of(name));
  }
  benchmark::RegisterBenchmark("wall end/exact/gas", exact_end, gas);
  benchmark::RegisterBenchmark("law/elastic", elastic_law, pairs_of("generic", true, true));
  benchmark::RegisterBenchmark("two_prod/splitting", product_by_splitting);
  benchmark::RegisterBenchmark("two_prod/std::fma", product_by_fma);
}

}  // namespace
}  // namespace stoss::engine

int main(int argc, char** argv) {
  stoss::engine::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// The worlds of the bench, as small as all pairs can run them: the same bytes from all pairs,
// ticked, as from neighbours in one leap.

#include "bench/scenes.hpp"
#include "determinism/table.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace stoss::determinism {
namespace {

struct Case {
  std::string name;
  std::function<bench::BenchScene()> make;
  double until = 0;                    ///< s
  std::uint64_t collisions_least = 0;  ///< so that something has happened
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

std::vector<Case> cases() {
  constexpr std::size_t kDisks = 400;
  std::vector<Case> all;
  for (const int percent : {10, 30, 50, 70}) {
    all.push_back({"gas_" + std::to_string(percent),
                   [percent] { return bench::gas(kDisks, percent / 100.0); },
                   20,
                   4 * kDisks});
  }
  all.push_back({"mixture_10", [] { return bench::mixture(kDisks, 0.3, 10); }, 60, kDisks});
  all.push_back({"mixture_100", [] { return bench::mixture(kDisks, 0.3, 100); }, 400, kDisks});
  all.push_back({"maze", [] { return bench::maze(kDisks, kDisks / 10, 0.3); }, 20, 4 * kDisks});
  all.push_back({"burst", [] { return bench::burst(kDisks, 0.3); }, 20, kDisks});
  all.push_back({"bullet", [] { return bench::bullet(kDisks, 0.3); }, 20, 10});
  return all;
}

class BenchScene : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bench, BenchScene, testing::ValuesIn(cases()), [](const auto& tested) {
  return tested.param.name;
});

TEST_P(BenchScene, GivesTheBytesOfAllPairsTicked) {
  const bench::BenchScene scene = GetParam().make();
  const Bodies bodies{.start = {}, .disks = scene.disks, .walls = scene.walls};
  const Digests neighbours = run_scene(bodies, GetParam().until);
  EXPECT_GE(neighbours.collisions, GetParam().collisions_least);
  EXPECT_EQ(run_scene(bodies,
                      GetParam().until,
                      {.broad_phase = engine::BroadPhaseKind::AllPairs, .tick_rate_hz = 60}),
            neighbours);
}

}  // namespace
}  // namespace stoss::determinism

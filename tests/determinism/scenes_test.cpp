// SPDX-License-Identifier: Apache-2.0
// Each scene under every circumstance that must not matter, against the pinned table.

#include "determinism/table.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace stoss::determinism {

void PrintTo(const Row& row, std::ostream* out) { *out << row.scene; }

namespace {

class Scene : public testing::TestWithParam<Row> {
 protected:
  Bodies bodies() const {
    return read_scene(std::string(STOSS_SCENE_DIR) + "/" + GetParam().scene + ".json");
  }
  Digests run(const Circumstances& how = {}) const {
    return run_scene(bodies(), GetParam().until, how);
  }
  Digests pinned() const { return GetParam().digests.at("double"); }
};

std::string name_of(const testing::TestParamInfo<Row>& tested) {
  std::string name = tested.param.scene;
  for (char& letter : name) letter = letter == '-' ? '_' : letter;
  return name;
}
INSTANTIATE_TEST_SUITE_P(Pinned, Scene, testing::ValuesIn(read_table(STOSS_HASHES)), name_of);

TEST_P(Scene, IsWhatItWas) {
  EXPECT_EQ(run(), pinned());
  EXPECT_EQ(run({.arithmetic = engine::Arithmetic::Float}), GetParam().digests.at("float"));
}

TEST_P(Scene, DoesNotDependOnTicks) {
  for (const std::uint64_t rate : {1U, 60U, 1000U}) {
    SCOPED_TRACE(rate);
    EXPECT_EQ(run({.tick_rate_hz = rate}), pinned());
  }
}

TEST_P(Scene, DoesNotDependOnItsAge) {
  Digests old = run({.tick_rate_hz = 60, .later_by = std::int64_t{1} << 40});
  old.state = pinned().state;  // knows absolute instants
  EXPECT_EQ(old, pinned());
}

// All pairs of 10,000 bodies take a minute to look at: every so many disks stand for them all.
TEST_P(Scene, DoesNotDependOnTheBroadPhase) {
  constexpr std::size_t kDisksMax = 600;
  Bodies some = bodies();
  const std::size_t stride = 1 + some.disks.size() / kDisksMax;
  std::vector<engine::DiskSpec> kept;
  for (std::size_t i = 0; i < some.disks.size(); i += stride) kept.push_back(some.disks[i]);
  some.disks = kept;
  const Digests neighbours = run_scene(some, GetParam().until);
  EXPECT_EQ(run_scene(some, GetParam().until, {.broad_phase = engine::BroadPhaseKind::AllPairs}),
            neighbours);
  if (stride == 1) {
    EXPECT_EQ(neighbours, pinned());
  }
}

}  // namespace
}  // namespace stoss::determinism

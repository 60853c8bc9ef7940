// SPDX-License-Identifier: Apache-2.0
// A packing made by growth and saved as a scene: nothing in it overlaps, by exact arithmetic, and
// it can be run.

#include "clients/run_program.hpp"
#include "support/oracle.hpp"

#include <stoss/idl/scene_file.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <variant>

namespace stoss::tests {
namespace {

using test::Real;
using test::Real2;

Real2 exact(const Vector2& v) { return {Real(v.x()), Real(v.y())}; }

Real2 from_to(const Real2& a, const Real2& b) { return {b.x - a.x, b.y - a.y}; }

/// The squared distance of a disk's centre from a wall, times the wall's squared length where it is
/// the face that is nearest; 400 bits hold every product of doubles of this size exactly.
bool overlaps(const Disk& disk, const Wall& wall) {
  const Real2 start = exact(wall.start());
  const Real2 edge = from_to(start, exact(wall.end()));
  const Real2 place = from_to(start, exact(disk.position()));
  const Real along = dot(edge, place), length2 = dot(edge, edge);
  const Real radius2 = Real(disk.radius()) * Real(disk.radius());
  if (along > 0 && along < length2) {
    const Real height = cross(edge, place);
    return height * height < radius2 * length2;
  }
  const Real2 from_end = along > 0 ? from_to(edge, place) : place;
  return dot(from_end, from_end) < radius2;
}

/// |p|^2 - d^2 over d^2: exact but for the quotient.
Real gap(const Disk& a, const Disk& b) {
  const Real2 apart = from_to(exact(a.position()), exact(b.position()));
  const Real reach = Real(a.radius()) + Real(b.radius());
  return Real((dot(apart, apart) - reach * reach) / (reach * reach));
}

TEST(Packing, OfAHundredDisksIsSavedWithoutOverlapAndRuns) {
  const std::string path = testing::TempDir() + "packed.binpb";
  const Finished made = stoss({"simulate",
                               std::string(STOSS_SCENE_DIR) + "/packing.json",
                               "--max-collisions",
                               "250000",
                               "--save-scene",
                               path});
  ASSERT_EQ(made.status, 0) << made.error;
  const auto loaded = idl::load_scene(path);
  ASSERT_TRUE(std::holds_alternative<Scene>(loaded));
  const Scene& scene = std::get<Scene>(loaded);
  EXPECT_EQ(scene.disks_size(), 100);
  EXPECT_FALSE(scene.effects().has_growth());
  EXPECT_TRUE(scene.effects().has_restitution());
  int overlapping = 0, touching = 0;
  for (int i = 0; i < scene.disks_size(); ++i) {
    for (int j = 0; j < i; ++j) {
      const Real apart = gap(scene.disks(i), scene.disks(j));
      if (apart < 0) ++overlapping;
      if (apart < Real(1e-5)) ++touching;
    }
    for (const Wall& wall : scene.walls()) overlapping += overlaps(scene.disks(i), wall) ? 1 : 0;
  }
  EXPECT_EQ(overlapping, 0);
  EXPECT_GT(touching, 100) << "it is jammed";
  const Finished run = stoss({"simulate", path, "--max-collisions", "1000", "--verify", "--stats"});
  ASSERT_EQ(run.status, 0) << run.error;
  EXPECT_EQ(nlohmann::json::parse(run.error)["verify_overlaps"], 0);
}

TEST(Packing, ASceneWithoutGrowthIsSavedAsItEnds) {
  const std::string path = testing::TempDir() + "ended.json";
  const std::string tutorial = std::string(STOSS_SCENE_DIR) + "/tutorial.json";
  const Finished ends =
      stoss({"simulate", tutorial, "--until", "2", "--save-scene", path, "--states", "-"});
  ASSERT_EQ(ends.status, 0) << ends.error;
  const Finished begins = stoss({"simulate", path, "--until", "0", "--states", "-"});
  EXPECT_EQ(begins.status, 0) << begins.error;
  EXPECT_EQ(begins.out, ends.out);
  EXPECT_EQ(
      stoss({"simulate", tutorial, "--until", "1", "--save-scene", "/no/such/dir/x.json"}).status,
      1);
}

}  // namespace
}  // namespace stoss::tests

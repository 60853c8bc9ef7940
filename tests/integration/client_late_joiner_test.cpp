// SPDX-License-Identifier: Apache-2.0
// A client that comes late has the whole world, exactly. How long that takes is printed and not
// judged: the machine may be busy.
#include "client_digest.hpp"
#include "live_world.hpp"

#include <stoss/idl/scene_file.hpp>

#include <scene.pb.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>

namespace stoss::tests {
namespace {

constexpr unsigned kDomain = 83;

Effects falling() {
  Effects effects;
  effects.mutable_gravity()->mutable_acceleration()->set_y(-2);
  auto& restitution = *effects.mutable_restitution();
  restitution.set_coefficient(0.9);
  restitution.set_contact_duration(1e-3);
  restitution.set_rest_speed(0.01);
  return effects;
}

Effects falling_through_a_medium() {
  Effects effects = falling();
  effects.mutable_drag()->set_rate(0.3);
  return effects;
}

Effects growing() {
  Effects effects;
  effects.mutable_growth()->set_rate(0.003);
  return effects;
}

/// Disks on a lattice with random velocities, slow enough for a machine that has other things to
/// do.
std::string write_gas(int side, const Effects& effects = {}) {
  Scene gas;
  *gas.mutable_effects() = effects;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> speed(-0.2, 0.2);
  for (int i = 0; i < side * side; ++i) {
    Disk& disk = *gas.add_disks();
    disk.mutable_position()->set_x(2.0 * (i % side));
    disk.mutable_position()->set_y(2.0 * (i / side));
    disk.mutable_velocity()->set_x(speed(random));
    disk.mutable_velocity()->set_y(speed(random));
    disk.set_radius(0.5);
  }
  const double end = 2.0 * side;
  const double corners[5][2] = {{-1, -1}, {end, -1}, {end, end}, {-1, end}, {-1, -1}};
  for (int i = 0; i < 4; ++i) {
    Wall& wall = *gas.add_walls();
    wall.mutable_start()->set_x(corners[i][0]);
    wall.mutable_start()->set_y(corners[i][1]);
    wall.mutable_end()->set_x(corners[i + 1][0]);
    wall.mutable_end()->set_y(corners[i + 1][1]);
  }
  const std::string path = ::testing::TempDir() + "late_joiner_gas.binpb";
  if (const auto error = idl::save_scene(gas, path)) throw std::runtime_error(error->message());
  return path;
}

std::uint64_t digest(const engine::BodyState& state) {
  BitDigest bits;
  bits.add(state.id, state.position, state.velocity);
  bits.add(state.radius);
  return bits.value();
}

/// Against the world itself, which is paused.
void expect_exact(Session& session, const Replica& replica, std::size_t disks) {
  const client::Result<Answer> region =
      session.ask(Query::region({-1e6, -1e6}, {1e6, 1e6}), kPatience);
  ASSERT_TRUE(region.ok()) << region.failure().reject.reason;
  std::map<engine::Id, std::uint64_t> theirs;
  for (const client::FoundBody& body : region.value().bodies) {
    theirs[body.state.id] = digest(body.state);
  }
  EXPECT_EQ(theirs.size(), disks);
  EXPECT_EQ(region.value().walls.size(), 4U);
  const std::vector<engine::BodyState> ours = replica.disks(region.value().at);
  EXPECT_EQ(ours.size(), disks);
  std::size_t different = 0;
  for (const engine::BodyState& state : ours) {
    if (theirs[state.id] != digest(state)) ++different;
  }
  EXPECT_EQ(different, 0U);
}

void join_late(const std::string& scene_path, std::size_t disks) {
  Process daemon(stossd(kDomain, {"--scene", scene_path, "--world", "late"}));
  const client::ConnectOptions options{
      .world = "late", .domain = kDomain, .timeout = kPatience, .network = {}};
  {
    Session first(options);  // the world runs from here on
    ASSERT_TRUE(first.ask(Query::status()).ok()) << daemon.log();
  }
  std::this_thread::sleep_for(milliseconds(500));
  const auto begun = steady_clock::now();
  Session session(options);
  const auto connected = steady_clock::now();
  Replica replica(session);
  ASSERT_TRUE(replica.wait_until_complete(kPatience));
  const auto complete = steady_clock::now();
  const auto in_ms = [](auto duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  };
  std::printf("%zu disks: connected after %.0f ms, the whole world after %.0f ms more\n",
              disks,
              in_ms(connected - begun),
              in_ms(complete - connected));
  ASSERT_TRUE(session.command(Command::pause()).ok());
  const client::Result<Answer> world = session.ask(Query::world(), kPatience);
  ASSERT_TRUE(world.ok());
  ASSERT_TRUE(replica.wait_for_number(world.value().epoch, world.value().motion_number, kPatience));
  expect_exact(session, replica, disks);
  EXPECT_EQ(replica.counters().contradictions, 0U);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

TEST(LateJoiner, HoldsTenThousandBodiesExactly) { join_late(scene("gas-10000"), 10'000); }

TEST(LateJoiner, HoldsAHundredThousandBodiesExactly) {
  constexpr int kSide = 316;
  join_late(write_gas(kSide), kSide * kSide);
}

TEST(LateJoiner, HoldsAWorldWithGravityExactly) { join_late(write_gas(20, falling()), 400); }

TEST(LateJoiner, HoldsAWorldWithDragExactly) {
  join_late(write_gas(20, falling_through_a_medium()), 400);
}

TEST(LateJoiner, HoldsAGrowingWorldExactly) { join_late(write_gas(20, growing()), 400); }

TEST(LateJoiner, AReplicaFindsItsWayThroughAReset) {
  Process daemon(stossd(kDomain, {"--scene", scene("pool-break"), "--world", "late"}));
  Session session({.world = "late", .domain = kDomain, .timeout = kPatience, .network = {}});
  Replica replica(session);
  ASSERT_TRUE(replica.wait_until_complete(kPatience)) << daemon.log();
  std::this_thread::sleep_for(milliseconds(300));
  ASSERT_TRUE(session.command(Command::remove({16})).ok());
  const client::Result<client::Reply> reset = session.command(Command::reset());
  ASSERT_TRUE(reset.ok());
  ASSERT_TRUE(session.command(Command::pause()).ok());
  const client::Result<Answer> world = session.ask(Query::world(), kPatience);
  ASSERT_TRUE(world.ok());
  ASSERT_TRUE(replica.wait_for_number(world.value().epoch, world.value().motion_number, kPatience));
  EXPECT_EQ(replica.stamp().epoch, reset.value().epoch);
  EXPECT_EQ(replica.counters().epochs, 1U);
  expect_exact(session, replica, 16);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

}  // namespace
}  // namespace stoss::tests

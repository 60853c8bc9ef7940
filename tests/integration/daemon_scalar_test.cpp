// SPDX-License-Identifier: Apache-2.0
// A live world in every arithmetic: its status says which, its replicas hold the daemon's own
// picture to the bit, and the world itself is within a rounding of it. Domain 69.
#include "client_digest.hpp"
#include "clients/run_program.hpp"
#include "live_world.hpp"

#include <stoss/translate/scene.hpp>

#include <nlohmann/json.hpp>

#include <bit>
#include <map>
#include <string>

namespace stoss::tests {
namespace {

constexpr unsigned kDomain = 69;

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The replica against LIST, which the daemon answers from its picture, and against REGION, which
/// the world answers itself.
void expect_exact(Session& session, const Replica& replica, bool is_wide) {
  const auto list = session.ask(Query::list(), kPatience);
  const auto region = session.ask(Query::region({-1e6, -1e6}, {1e6, 1e6}), kPatience);
  ASSERT_TRUE(list.ok() && region.ok());
  std::map<engine::Id, engine::BodyState> world;
  for (const client::FoundBody& body : region.value().bodies) world[body.state.id] = body.state;
  const auto& picture = list.value().bodies;
  ASSERT_EQ(picture.size(), 16U);
  for (const client::FoundBody& body : picture) {
    const auto ours = replica.disk(body.state.id, list.value().at);
    ASSERT_TRUE(ours);
    const engine::BodyState& theirs = world[body.state.id];
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_TRUE(same_bits(ours->position[axis], body.state.position[axis])) << body.state.id;
      EXPECT_TRUE(same_bits(ours->velocity[axis], body.state.velocity[axis])) << body.state.id;
      EXPECT_TRUE(same_bits(ours->velocity[axis], theirs.velocity[axis])) << body.state.id;
      const double apart = std::abs(ours->position[axis] - theirs.position[axis]);
      EXPECT_LE(apart, is_wide ? 0x1p-52 * std::abs(theirs.position[axis]) : 0) << body.state.id;
    }
  }
}

void serve_in(engine::Arithmetic arithmetic) {
  const std::string name(translate::name_of(arithmetic));
  SCOPED_TRACE(name);
  Process daemon(stossd(
      kDomain,
      {"--scene", scene("pool-break"), "--world", "wide", "--scalar", name, "--verify", "10"}));
  Session session({.world = "wide", .domain = kDomain, .timeout = kPatience, .network = {}});
  Replica replica(session);
  ASSERT_TRUE(replica.wait_until_complete(kPatience)) << daemon.log();
  ASSERT_TRUE(session.command(Command::run_to({.seconds = 1})).ok());
  const auto deadline = steady_clock::now() + kPatience;
  client::Status status;
  do {
    status = *session.ask(Query::status(), kPatience).value().status;
  } while (status.state != idl::WorldState::kPaused && steady_clock::now() < deadline);
  const auto world = session.ask(Query::world(), kPatience);
  ASSERT_TRUE(world.ok());
  ASSERT_TRUE(replica.wait_for_number(world.value().epoch, world.value().motion_number, kPatience));
  EXPECT_EQ(replica.snapshot().arithmetic, arithmetic);
  expect_exact(session, replica, arithmetic > engine::Arithmetic::Double);

  const Finished told =
      stoss_words("status --json --world wide --domain " + std::to_string(kDomain));
  ASSERT_EQ(told.status, 0) << told.error;
  const auto json = nlohmann::json::parse(told.out);
  EXPECT_EQ(json["arithmetic"], name);
  EXPECT_EQ(json["verify_period"], "10");
  EXPECT_GT(std::stoi(json["verify_checks"].get<std::string>()), 0);
  EXPECT_EQ(json["verify_overlaps"], "0");
  EXPECT_EQ(json["verify_missed"], "0");
  const std::string text =
      stoss_words("status --world wide --domain " + std::to_string(kDomain)).out;
  EXPECT_NE(text.find("0 overlaps, 0 missed"), std::string::npos) << text;

  ASSERT_TRUE(session.command(Command::reset()).ok());
  status = *session.ask(Query::status(), kPatience).value().status;
  EXPECT_EQ(translate::arithmetic_of(status.arithmetic), arithmetic) << "a reset keeps it";
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.log();
}

TEST(DaemonScalar, EveryArithmeticLivesAndSaysWhichItIs) {
  for (const engine::Arithmetic arithmetic : translate::arithmetics()) serve_in(arithmetic);
}

TEST(DaemonScalar, AnUnknownOneIsBadUsage) {
  Process daemon(stossd(kDomain, {"--scene", scene("pool-break"), "--scalar", "half"}));
  EXPECT_EQ(daemon.wait(), 64);
  EXPECT_NE(daemon.log().find("double-double"), std::string::npos) << daemon.log();
  Process zero(stossd(kDomain, {"--scene", scene("pool-break"), "--verify", "0"}));
  EXPECT_EQ(zero.wait(), 64);
}

}  // namespace
}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// Effects in a running world, as clients see them: radii that grow, and a world that repeats
// itself.
#include "client_digest.hpp"
#include "clients/run_program.hpp"
#include "live_world.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/client/feeds.hpp>

#include <fstream>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

constexpr unsigned kDomain = 84;

/// A daemon with a scene of the test's own, and a session with it.
class LiveEffects : public testing::Test {
 protected:
  void start(const std::string& scene_text, const std::vector<std::string>& more = {}) {
    const std::string path = testing::TempDir() + "live_effects.json";
    std::ofstream(path) << scene_text;
    std::vector<std::string> words{"--scene", path, "--world", "live"};
    words.insert(words.end(), more.begin(), more.end());
    daemon_ = std::make_unique<Process>(stossd(kDomain, words));
    session_ = std::make_unique<Session>(client::ConnectOptions{
        .world = "live", .domain = kDomain, .timeout = kPatience, .network = {}});
  }
  void TearDown() override {
    session_.reset();
    if (!daemon_) return;
    daemon_->signal(SIGTERM);
    EXPECT_EQ(daemon_->wait(), 0) << daemon_->log();
  }

  static Finished run(const std::string& command) {
    return stoss_words(command + " --domain " + std::to_string(kDomain) + " --world live");
  }
  static void good(const std::string& command) {
    const Finished finished = run(command);
    EXPECT_EQ(finished.status, 0) << command << ": " << finished.error;
  }
  /// It is refused with exactly these words, and changes nothing.
  void expect_refused(const std::string& command, const std::string& words) {
    const std::uint64_t hash = ask(Query::status()).status->state_hash;
    const Finished finished = run(command);
    EXPECT_EQ(finished.status, 1) << command << ": " << finished.out;
    EXPECT_EQ(finished.error, words + '\n');
    EXPECT_EQ(ask(Query::status()).status->state_hash, hash);
  }
  Answer ask(const Query& query) {
    client::Result<Answer> answer = session_->ask(query);
    if (!answer) throw std::runtime_error(answer.failure().reject.reason);
    return std::move(answer).value();
  }
  /// The replica has all that the (paused) world has published.
  void catch_up(Replica& replica) {
    const Answer world = ask(Query::world());
    ASSERT_TRUE(replica.wait_for_number(world.epoch, world.motion_number, kPatience));
  }
  /// States, radii among them, are those of the world itself to the bit. The world is paused.
  void expect_exact(const Replica& replica) {
    const Answer list = ask(Query::list());
    ASSERT_FALSE(list.bodies.empty());
    for (const client::FoundBody& body : list.bodies) {
      const auto ours = replica.disk(body.state.id, list.at);
      ASSERT_TRUE(ours.has_value());
      EXPECT_EQ(ours->radius, body.state.radius) << body.state.id;
      EXPECT_EQ(ours->position, body.state.position) << body.state.id;
      EXPECT_EQ(ours->velocity, body.state.velocity) << body.state.id;
    }
  }

  std::unique_ptr<Process> daemon_;
  std::unique_ptr<Session> session_;
};

constexpr const char* kGrowing = R"({
  "disks": [{"id": 1, "position": {"x": 0}, "velocity": {"x": 0.1}, "radius": 0.5},
            {"id": 2, "position": {"x": 50}, "radius": 0.3},
            {"id": 3, "position": {"x": 90}, "radius": 0.7, "kind": "STATIC"}],
  "effects": {"growth": {"rate": 0.01}}})";

TEST_F(LiveEffects, FramesTellTheRadiiOfTheirInstant) {
  start(kGrowing, {"--frame-rate", "50"});
  Replica replica(*session_);
  ASSERT_TRUE(replica.wait_until_complete(kPatience)) << daemon_->log();
  client::FrameFeed frames(*session_);
  double last = 0;
  for (int i = 0; i < 20; ++i) {
    const auto frame = frames.next(kPatience);
    ASSERT_TRUE(frame.has_value());
    ASSERT_EQ(frame->bodies.size(), 3U);
    for (const client::FrameBody& body : frame->bodies) {
      // Nothing happens to the disks, so that the replica knows any instant.
      EXPECT_EQ(body.radius, replica.disk(body.id, frame->at)->radius) << body.id;
    }
    EXPECT_GT(frame->bodies[0].radius, last);
    last = frame->bodies[0].radius;
  }
  EXPECT_GT(last, 0.5);
}

TEST_F(LiveEffects, SceneAndStatesTellRadiiAsTheyAre) {
  start(kGrowing, {"--paused"});
  good("speed max");
  good("run-to 10");
  client::SceneFeed scenes(*session_);
  const auto scene = scenes.next(kPatience);
  ASSERT_TRUE(scene.has_value());
  const double seconds = static_cast<double>(scene->at.seconds);  // when the scene was told
  EXPECT_NEAR(scene->disks.at(0).radius, 0.5 + 0.01 * seconds, 1e-15);
  const Finished states = run("states --count 1 --json");
  ASSERT_EQ(states.status, 0) << states.error;
  EXPECT_NE(states.out.find("\"radius\":0.6"), std::string::npos) << states.out;
}

TEST_F(LiveEffects, RadiiStayWhenGrowthIsSwitchedOff) {
  start(kGrowing, {"--paused"});
  Replica replica(*session_);
  ASSERT_TRUE(replica.wait_until_complete(kPatience)) << daemon_->log();
  good("speed max");
  // The second time on and off again between two ticks.
  const Command switches[] = {Command::set_effects({"growth"}, {}),
                              Command::set_effects({}, {{"growth.rate", 0.5}}),
                              Command::set_effects({"growth"}, {})};
  const char* const instants[] = {"3", "4.001", "4.003"};
  std::vector<std::future<client::Result<client::Reply>>> replies;
  for (std::size_t i = 0; i < 3; ++i) {
    Command command = switches[i];
    replies.push_back(session_->submit(command.at(*client::parse_instant(instants[i]))));
  }
  good("run-to 5");
  for (auto& reply : replies) EXPECT_TRUE(reply.get().ok());
  catch_up(replica);
  expect_exact(replica);
  const double expected = 0.5 + 0.01 * 3 + 0.5 * 0.002;
  EXPECT_NEAR(replica.disk(1, replica.stamp().at)->radius, expected, 1e-12);
  client::FrameFeed frames(*session_);
  const auto frame = frames.next(kPatience);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->bodies[0].radius, replica.disk(1, frame->at)->radius);
}

constexpr const char* kPeriodic = R"({
  "disks": [{"id": 1, "position": {"x": 9, "y": 5}, "velocity": {"x": 1.25}, "radius": 0.5},
            {"id": 2, "position": {"x": 3, "y": 5}, "velocity": {"x": -0.25}, "radius": 0.5},
            {"id": 3, "position": {"x": 3, "y": 9}, "velocity": {"y": 0.7}, "radius": 0.5}],
  "period": {"x": 10, "y": 12}})";

TEST_F(LiveEffects, APeriodicWorldIsSearchedAcrossItsEdge) {
  start(kPeriodic, {"--paused"});
  good("spawn disk --position 9.75,1 --radius 0.5 --velocity 0.5,0 --id 4");
  good("speed max");
  good("run-to 1");
  // Disk 4 is at x = 10.25 and is shown at 0.25; it reaches over the edge.
  const Answer state = ask(Query::states({4}));
  EXPECT_EQ(state.bodies.at(0).state.position.x(), 0.25);
  const Answer region = ask(Query::region({9.5, 0.5}, {9.9, 1.5}));
  ASSERT_EQ(region.bodies.size(), 1U);
  EXPECT_EQ(region.bodies[0].state.id, 4U);
  const Answer near = ask(Query::nearest({9.75, 1}, 1));
  ASSERT_EQ(near.bodies.size(), 1U);
  EXPECT_EQ(near.bodies[0].state.id, 4U);
  EXPECT_EQ(near.bodies[0].distance, 0);
  expect_refused("spawn disk --position 9.5,1 --radius 0.5",
                 "OVERLAP: overlaps body 4 (field disks, in the way: 4, clearance -0.25 m)");
}

TEST_F(LiveEffects, AReplicaFollowsAPeriodicWorldOverItsEdge) {
  start(kPeriodic, {"--paused"});
  Replica early(*session_);
  ASSERT_TRUE(early.wait_until_complete(kPatience)) << daemon_->log();
  good("speed max");
  good("run-to 1.5");
  good("spawn disk --position 9.5,1 --radius 0.5 --velocity 0.5,0.1 --id 4");
  good("run-to 40");
  const Answer status = ask(Query::status());
  EXPECT_GT(status.status->collisions, 5U);  // 1 catches up with 2 across the edge, again and again
  Replica late(*session_);
  ASSERT_TRUE(late.wait_until_complete(kPatience));
  for (Replica* replica : {&early, &late}) {
    EXPECT_EQ(replica->snapshot().period, engine::Vector2(10, 12));
    catch_up(*replica);
    expect_exact(*replica);
  }
  for (const engine::BodyState& disk : late.disks()) {
    EXPECT_TRUE(disk.position.x() >= 0 && disk.position.x() < 10) << disk.position.x();
    EXPECT_TRUE(disk.position.y() >= 0 && disk.position.y() < 12) << disk.position.y();
  }
}

TEST_F(LiveEffects, APeriodCannotBeSwitched) {
  start(kPeriodic, {"--paused"});
  const std::string words =
      "UNIMPLEMENTED: is fixed when a world is made and cannot be switched; make one of a scene "
      "with the period that you want (field period)";
  expect_refused("effects set period.x=3", words);
  expect_refused("effects set period=3,4", words);
  expect_refused("effects off period", words);
  const Finished status = run("status");
  EXPECT_NE(status.out.find("x 10 m, y 12 m"), std::string::npos) << status.out;
}

/// Writes a scene of one disk with this period and these effects.
std::string scene_with(const std::string& rest) {
  const std::string path = testing::TempDir() + "live_effects_more.json";
  std::ofstream(path) << R"({"disks": [{"position": {"x": 5, "y": 2}, "radius": 0.1}])"
                      << (rest.empty() ? "" : ", ") << rest << "}";
  return path;
}

TEST_F(LiveEffects, ASceneOfAnotherPeriodOrOtherEffectsIsNotLoadedUnseen) {
  start(kPeriodic, {"--paused"});
  good("effects set restitution.coefficient=0.5 restitution.contact_duration=0.001");
  const std::string load = "load --new-ids ";
  expect_refused(
      load + scene_with(R"("period": {"x": 10, "y": 13})"),
      "FAILED_PRECONDITION: is 13 m in the scene and 12 m in the world, and fixed there; "
      "start stossd with the scene; or load with --bodies-only (field period.y)");
  expect_refused(load + scene_with(R"("effects": {"restitution": {"coefficient": 0.25}})"),
                 "FAILED_PRECONDITION: is 0.25 in the scene and 0.5 in the world; `stoss effects "
                 "set` switches it; or load with --bodies-only (field "
                 "effects.restitution.coefficient)");
  expect_refused(load + scene_with(R"("effects": {"drag": {"rate": 2}})"),
                 "FAILED_PRECONDITION: is 2 in the scene and off in the world; `stoss effects set` "
                 "switches it; or load with --bodies-only (field effects.drag.rate)");
  good(load + scene_with(""));
  good("remove 4");
  good(load + scene_with(R"("period": {"x": 10}, "effects": {"restitution": )"
                         R"({"coefficient": 0.5, "contact_duration": 0.001}})"));
  good("remove 5");
  good(load + scene_with(R"("period": {"x": 11}, "effects": {"drag": {"rate": 2}})") +
       " --bodies-only");
  EXPECT_EQ(ask(Query::list()).bodies.size(), 4U);
}

}  // namespace
}  // namespace stoss::tests

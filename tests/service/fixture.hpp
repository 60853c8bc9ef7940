// SPDX-License-Identifier: Apache-2.0
// A simulation without threads, DDS or real time: its clock stands still until a test moves it.
#pragma once

#include <clock.hpp>
#include <forecaster.hpp>
#include <gtest/gtest.h>
#include <inbox.hpp>
#include <outbox.hpp>
#include <simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stoss::service::testing {

class FakeClock final : public Clock {
 public:
  [[nodiscard]] Nanoseconds now() const override { return now_; }
  void set(Nanoseconds now) { now_ = now; }
  void advance(double seconds) { now_ += Nanoseconds(std::llround(seconds * 1e9)); }

 private:
  Nanoseconds now_{1'000'000'000};
};

inline ClientId client(std::uint8_t name) {
  ClientId id{};
  id.fill(name);
  return id;
}

/// What a simulation handed to the publisher, sorted by kind.
struct Told {
  std::vector<TickRecord> ticks;
  std::vector<EpochRecord> epochs;
  std::vector<ReplyRecord> replies;
  std::vector<AnswerItem> answers;
  std::vector<PictureQuery> picture_queries;
  std::vector<WatchRecord> watches;
  std::vector<WorldStatus> statuses;

  [[nodiscard]] bool has_reply(std::uint8_t name, std::uint64_t number) const {
    return std::any_of(replies.begin(), replies.end(), [&](const ReplyRecord& reply) {
      return reply.request == RequestId{client(name), number};
    });
  }
  /// The first reply of that request; one with code Internal when there is none.
  [[nodiscard]] ReplyRecord reply_to(std::uint8_t name, std::uint64_t number) const {
    for (const ReplyRecord& reply : replies) {
      if (reply.request == RequestId{client(name), number}) return reply;
    }
    ReplyRecord none;
    none.reject = engine::Reject{.code = engine::Code::Internal, .field = "", .reason = "no reply"};
    return none;
  }
  [[nodiscard]] engine::Code code_of(std::uint8_t name, std::uint64_t number) const {
    const ReplyRecord reply = reply_to(name, number);
    return reply.reject ? reply.reject->code : engine::Code::Ok;
  }
  [[nodiscard]] Moment moment_of(std::uint8_t name, std::uint64_t number) const {
    return reply_to(name, number).moment.value_or(Moment{});
  }
};

class SimulationTest : public ::testing::Test {
 protected:
  /// A world of one disk at the origin that flies along x at 1 m/s, unless told otherwise.
  void begin(SimulationOptions options = {}, translate::SceneBodies scene = one_disk()) {
    auto world = translate::make_world(scene, options.choice);
    ASSERT_TRUE(world.ok()) << world.reject().reason;
    simulation = std::make_unique<Simulation>(
        std::move(scene), std::move(world).value(), options, clock, inbox, outbox, forecaster);
  }

  static translate::SceneBodies one_disk() {
    translate::SceneBodies scene;
    scene.disks.push_back({.id = 1, .velocity = {1, 0}, .radius = 0.5});
    scene.disk_names.emplace_back("ball");
    return scene;
  }

  static translate::CommandSpec make(idl::Op op) {
    translate::CommandSpec spec;
    spec.op = idl::wire_value(op);
    return spec;
  }

  static translate::CommandSpec spawn_at(double x, double y, double radius = 0.5) {
    translate::CommandSpec spec = make(idl::Op::kSpawn);
    spec.disks.push_back({.position = {x, y}, .radius = radius});
    return spec;
  }

  static translate::CommandSpec set_velocity(engine::Id id, double vx, double vy) {
    translate::CommandSpec spec = make(idl::Op::kSetVelocity);
    spec.ids = {id};
    spec.vectors = {{id, {vx, vy}}};
    return spec;
  }

  void send(std::uint8_t name, std::uint64_t number, translate::CommandSpec spec) {
    spec.request = {client(name), number};
    inbox.push(CommandItem{std::move(spec), {}});
  }

  void ask(std::uint8_t name, std::uint64_t number, translate::QuerySpec spec) {
    spec.request = {client(name), number};
    inbox.push(QueryItem{std::move(spec), {}});
  }

  /// Turns until nothing is due any more at the clock's present.
  void settle() {
    for (int i = 0; i < 10'000; ++i) {
      if (simulation->turn() > clock.now()) return;
    }
    FAIL() << "the simulation wants a turn again and again";
  }

  /// Lets real time pass in small steps, with turns.
  void run(double seconds, double step = 0.001) {
    const int steps = static_cast<int>(std::lround(seconds / step));
    for (int i = 0; i < steps; ++i) {
      clock.advance(step);
      settle();
    }
  }

  Told told() {
    Told result;
    outbox.wake();
    for (OutboxItem& item : outbox.take(Nanoseconds::zero())) {
      std::visit([&](auto& value) { sort_in(result, value); }, item);
    }
    return result;
  }

  static engine::Instant seconds(double value) { return engine::offset_by({}, value).value(); }

  FakeClock clock;
  Inbox inbox;
  Outbox outbox;
  Forecaster forecaster{outbox};
  std::unique_ptr<Simulation> simulation;

 private:
  static void sort_in(Told& told, TickRecord& v) { told.ticks.push_back(std::move(v)); }
  static void sort_in(Told& told, EpochRecord& v) { told.epochs.push_back(std::move(v)); }
  static void sort_in(Told& told, ReplyItem& v) { told.replies.push_back(std::move(v.reply)); }
  static void sort_in(Told& told, AnswerItem& v) { told.answers.push_back(std::move(v)); }
  static void sort_in(Told& told, PictureQuery& v) { told.picture_queries.push_back(std::move(v)); }
  static void sort_in(Told& told, WatchRecord& v) { told.watches.push_back(v); }
  static void sort_in(Told& told, WorldStatus& v) { told.statuses.push_back(v); }
};

}  // namespace stoss::service::testing

// SPDX-License-Identifier: Apache-2.0
// The world and everything that may change it: ticks, commands in their order, questions. One
// thread owns it; it knows no DDS, and real time only through a Clock, which decides when a tick is
// computed and never what it computes.
//
// Invariants:
//  1. Commands take effect in the order (instant, client, number). One without an instant of its
//  own
//     gets that of the tick that takes it in, or the present when the world is paused.
//  2. Every event up to and at an instant is processed before a command of that instant is applied.
//  3. Every command that was taken in is answered once.
#pragma once

#include "clock.hpp"
#include "forecaster.hpp"
#include "inbox.hpp"
#include "outbox.hpp"
#include "pacer.hpp"
#include "reply_table.hpp"
#include "run_control.hpp"
#include "schedule.hpp"
#include "watch_table.hpp"

#include <stoss/engine/verify.hpp>
#include <stoss/engine/world.hpp>
#include <stoss/translate/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace stoss::service {

/// Events that one turn may process, some 10 ms of work, so that a storm never holds up a question.
inline constexpr std::uint64_t kEventsPerTurn = 8192;
/// Commands taken in at a tick; the rest waits for the next. Keeps a flood from holding up a tick.
inline constexpr std::size_t kCommandsPerTick = 4096;
/// Questions answered in a turn.
inline constexpr std::size_t kQueriesPerTurn = 64;
/// A world as fast as it can lets go of its thread this often.
inline constexpr Nanoseconds kFlatOutSlice{4'000'000};
/// Records that may wait for the publisher. Beyond it changes are kept in the world, where they
/// merge, and go out together later.
inline constexpr std::size_t kTicksWaitingMax = 64;
/// Collisions that may wait with them; beyond it they are dropped, and the gap in their numbers
/// shows.
inline constexpr std::size_t kCollisionsWaitingMax = 65'536;
/// ... and zone events, likewise.
inline constexpr std::size_t kZoneEventsWaitingMax = 65'536;
/// How often the status is told when nothing changes.
inline constexpr Nanoseconds kStatusInterval{1'000'000'000};

struct SimulationOptions {
  double tick_rate = 60;  ///< ticks per simulated second; TickClock::from_rate must take it
  double speed = 1;       ///< simulated seconds per real second, > 0; infinity: flat out
  bool paused = false;
  std::size_t bodies_max = 1'000'000;
  std::uint64_t epoch = 1;   ///< the first one's number
  std::uint64_t verify = 0;  ///< events between two checks of the whole world; 0: none
  translate::WorldChoice choice{};
};

class Simulation final : private engine::CollisionSink {
 public:
  /// REQUIRES: `world` was made of `scene` with options.choice.
  Simulation(translate::SceneBodies scene,
             translate::SceneWorld world,
             const SimulationOptions& options,
             const Clock& clock,
             Inbox& inbox,
             Outbox& outbox,
             Forecaster& forecaster);

  /// Does what is due now, for a bounded time. Returns the clock's time at which it wants to be
  /// called again; earlier does no harm.
  Nanoseconds turn();

  /// Ends it: finishes the tick that was begun, refuses what waits, tells the last status.
  void stop();

  [[nodiscard]] const engine::World& world() const { return world_; }
  [[nodiscard]] bool running() const { return run_.running() && !failed(); }
  [[nodiscard]] bool failed() const { return !failure_.empty(); }
  [[nodiscard]] Moment moment() const { return {epoch_, run_.tick(), world_.now()}; }

 private:
  using Made = engine::Outcome<std::vector<engine::Id>>;

  void on_collision(const engine::Collision& collision) override;
  void on_zone_event(const engine::ZoneEvent& event) override;

  // simulation.cpp: the turns
  Nanoseconds run_turn();
  Nanoseconds idle_turn();
  bool begin_tick();
  bool finish_tick();
  [[nodiscard]] engine::Instant tick_end() const;
  bool advance(const engine::Instant& instant);
  void count_events(std::uint64_t events);
  void take_in_commands();
  void take_in(CommandItem command);
  void schedule_untimed(const engine::Instant& at);
  void settle();
  void fail(std::string reason);
  void refuse(CommandItem command, engine::Code code, const std::string& reason);
  void refuse_scheduled(engine::Code code, const std::string& reason);
  void reply(CommandItem command, Made made);
  void started();

  // simulation_commands.cpp: what each command does
  void apply(CommandItem command);
  Made execute(const translate::CommandSpec& spec);
  Made change_bodies(std::span<const engine::Id> ids, const std::function<Made()>& change);
  Made spawn(const translate::CommandSpec& spec);
  Made remove(const translate::CommandSpec& spec);
  Made step(const translate::CommandSpec& spec);
  Made run_for(const translate::CommandSpec& spec);
  Made run_to(const translate::CommandSpec& spec);
  Made set_speed(const translate::CommandSpec& spec);
  Made reset();
  Made set_effects(const translate::CommandSpec& spec);
  Made watch(const translate::CommandSpec& spec);
  void hand_over(std::vector<WatchRecord> news);

  // simulation_reports.cpp: questions, records, status
  void answer_queries();
  void answer_query(QueryItem query);
  void forecast(QueryItem query, const engine::Instant& at);
  void refuse(QueryItem query, engine::Reject reject);
  void begin_epoch(std::vector<NamedBody> names);
  [[nodiscard]] std::vector<std::string> effects_on() const;
  void publish(bool at_any_rate = false);
  [[nodiscard]] std::vector<engine::ZoneState> zones() const;
  [[nodiscard]] std::vector<NamedBody> scene_names(std::span<const engine::Id> ids) const;
  void send_replies();
  void report_status(idl::WorldState state);
  void report_status_if_due();
  void verify();
  [[nodiscard]] idl::WorldState state() const;

  const translate::SceneBodies scene_;
  const SimulationOptions options_;
  const Clock& clock_;
  Inbox& inbox_;
  Outbox& outbox_;
  Forecaster& forecaster_;

  engine::World world_;
  RunControl run_;
  Pacer pacer_;
  std::uint64_t epoch_;
  std::string failure_;

  std::optional<engine::Instant> tick_;  ///< the end of the tick that was begun and not finished
  std::uint64_t events_left_ = 0;        ///< of this turn
  Schedule schedule_;
  std::vector<CommandItem> untimed_;  ///< of the tick that was begun
  ReplyTable replies_;
  std::vector<ReplyItem> replies_to_send_;
  WatchTable watches_;

  std::optional<Moment> published_;
  bool put_off_ = false;
  std::vector<engine::Collision> collisions_;
  std::vector<engine::ZoneEvent> zone_events_;
  bool zones_changed_ = false;  ///< one came or went since the last record
  std::vector<NamedBody> names_;
  bool effects_changed_ = false;                                  ///< since the last record
  std::unordered_map<engine::Id, engine::MotionRecord> removed_;  ///< where and when they went

  std::optional<engine::Verifier> verifier_;
  std::optional<Nanoseconds> fault_told_at_;

  WorldStatus status_;  ///< its counters are kept here between reports
  bool status_due_ = true;
  Nanoseconds status_at_{0};
  Nanoseconds rate_since_{0};
  engine::Instant rate_instant_;
  std::uint64_t rate_events_ = 0;
  std::uint64_t events_ = 0;  ///< of all epochs
};

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include "simulation.hpp"

#include <stoss/engine/tick_clock.hpp>

#include <algorithm>
#include <utility>

namespace stoss::service {
namespace {

using engine::Code;
using engine::Instant;

engine::TickClock clock_from(const Instant& start, double tick_rate) {
  return engine::TickClock::from_rate(start, tick_rate)
      .value_or(engine::TickClock(start, 60, 1));  // unreachable: options are checked before
}

}  // namespace

Simulation::Simulation(translate::SceneBodies scene,
                       translate::SceneWorld world,
                       const SimulationOptions& options,
                       const Clock& clock,
                       Inbox& inbox,
                       Outbox& outbox,
                       Forecaster& forecaster)
    : scene_(std::move(scene)),
      options_(options),
      clock_(clock),
      inbox_(inbox),
      outbox_(outbox),
      forecaster_(forecaster),
      world_(std::move(world.world)),
      run_(clock_from(world_.now(), options.tick_rate), !options.paused),
      pacer_(options.tick_rate, options.speed),
      epoch_(options.epoch) {
  if (options.verify != 0) verifier_.emplace(options.verify);
  begin_epoch(scene_names(world.ids));
  started();
}

void Simulation::started() {
  pacer_.anchor(clock_.now(), world_.now());
  rate_since_ = clock_.now();
  rate_instant_ = world_.now();
  status_due_ = true;
}

Nanoseconds Simulation::turn() {
  events_left_ = kEventsPerTurn;
  for (const ClientId& client : inbox_.take_gone()) {
    std::vector<WatchRecord> news;
    watches_.drop_client(client, news);
    hand_over(std::move(news));
  }
  answer_queries();
  const Nanoseconds next = running() ? run_turn() : idle_turn();
  report_status_if_due();
  return std::min(next, status_at_ + kStatusInterval);
}

Nanoseconds Simulation::run_turn() {
  const Nanoseconds begun = clock_.now();
  const unsigned most = pacer_.catch_up_ticks();
  unsigned done = 0;
  while (running()) {
    if (!tick_ && !begin_tick()) break;
    if (!finish_tick()) return clock_.now();  // the rest of it in the next turn
    ++done;
    if (pacer_.flat_out() ? clock_.now() - begun >= kFlatOutSlice : done >= most) break;
  }
  if (!running()) return clock_.now();
  if (done >= most) pacer_.slip(clock_.now(), tick_end());
  return pacer_.due(tick_end());
}

Instant Simulation::tick_end() const {
  const Instant next = run_.next_tick();
  return run_.stop_at() ? std::min(next, *run_.stop_at()) : next;
}

bool Simulation::begin_tick() {
  const Nanoseconds now = clock_.now();
  const Instant end = tick_end();
  if (pacer_.due(end) > now) return false;
  pacer_.note_begin(now, end);
  tick_ = run_.next_tick();
  take_in_commands();
  return true;
}

// Runs to the end of the tick, applying commands on the way. False when the turn's budget is used
// up before. A pause or reset on the way ends the tick where it is.
bool Simulation::finish_tick() {
  const std::uint64_t epoch = epoch_;
  while (running() && epoch == epoch_) {
    const Instant end = run_.stop_at() ? std::min(*tick_, *run_.stop_at()) : *tick_;
    const auto next = schedule_.first_at();
    const bool at_end = !next || *next >= end;
    if (at_end && !untimed_.empty()) {
      schedule_untimed(end);
      continue;
    }
    const bool has_command = next && *next <= end;
    if (!advance(has_command ? *next : end)) {
      if (failed()) break;
      return false;
    }
    if (!has_command) break;
    apply(schedule_.take_first());
  }
  tick_.reset();
  if (!failed()) run_.stop_if_due(world_.now());
  if (!running()) settle();
  publish();
  send_replies();
  if (!running()) status_due_ = true;
  return true;
}

// False when the turn's budget is used up before the instant, or the world has failed.
bool Simulation::advance(const Instant& instant) {
  for (;;) {
    const std::uint64_t budget =
        verifier_ ? std::min(events_left_, verifier_->events_left()) : events_left_;
    const auto outcome = world_.advance_to(instant, this, budget);
    if (!outcome) {
      fail(outcome.reject().reason);
      return false;
    }
    const engine::AdvanceReport& report = outcome.value();
    count_events(report.events);
    switch (report.stop) {
      case engine::Stop::Reached:
        run_.reached(world_.now());
        return true;
      case engine::Stop::EventBudget:
        if (events_left_ == 0) return false;
        break;
      case engine::Stop::Stalled:
        fail("events crowd into one instant around body " + std::to_string(report.stalled));
        return false;
    }
  }
}

void Simulation::count_events(std::uint64_t events) {
  events_left_ -= std::min(events_left_, events);
  events_ += events;
  status_.events += events;
  if (!verifier_) return;
  verifier_->count_events(events);
  if (verifier_->events_left() == 0) verify();
}

// A world that stands still: commands take effect at once, at its present.
Nanoseconds Simulation::idle_turn() {
  take_in_commands();
  settle();
  publish();
  send_replies();
  if (running()) return clock_.now();
  constexpr Nanoseconds kRetry{1'000'000};
  if (put_off_) return clock_.now() + kRetry;
  const auto next = schedule_.first_at();
  const bool more = inbox_.has_commands() || (next && *next <= world_.now());
  return more ? clock_.now() : status_at_ + kStatusInterval;
}

// Applies what takes effect at the present of a world that stands still.
void Simulation::settle() {
  schedule_untimed(world_.now());
  for (auto next = schedule_.first_at(); next && *next <= world_.now() && !running();
       next = schedule_.first_at()) {
    // Events that an earlier command at this instant has caused. They may outlast the budget.
    if (!failed() && !advance(world_.now()) && !failed()) return;
    apply(schedule_.take_first());
    schedule_untimed(world_.now());
  }
}

void Simulation::take_in_commands() {
  for (CommandItem& command : inbox_.take_commands(kCommandsPerTick)) take_in(std::move(command));
}

void Simulation::take_in(CommandItem command) {
  auto verdict = replies_.admit(command.spec.request);
  if (auto* const earlier = std::get_if<ReplyRecord>(&verdict)) {
    ++status_.duplicates;
    earlier->duplicate = true;
    replies_to_send_.push_back({std::move(*earlier), std::move(command.ticket)});
    return;
  }
  if (std::holds_alternative<ReplyTable::Waiting>(verdict)) {
    ++status_.duplicates;  // the reply that is to come answers it too
    return;
  }
  if (std::holds_alternative<ReplyTable::Forgotten>(verdict)) {
    ++status_.duplicates;
    engine::Reject reject{.code = Code::FailedPrecondition,
                          .field = "request.number",
                          .reason =
                              "is older than the last replies; its outcome is not known any "
                              "more, and it was not applied now"};
    replies_to_send_.push_back(
        {{command.spec.request, std::move(reject), true, moment(), {}}, std::move(command.ticket)});
    return;
  }
  ++status_.commands;
  if (!command.spec.at) {
    untimed_.push_back(std::move(command));
    return;
  }
  const Instant at = *command.spec.at;
  if (at < world_.now()) {
    refuse(std::move(command), Code::DeadlinePassed, "that instant is in the past");
  } else if (!engine::in_range(at)) {
    refuse(std::move(command), Code::InvalidArgument, "that instant is beyond the end of time");
  } else if (failed()) {
    refuse(std::move(command), Code::FailedPrecondition, "the world has failed: " + failure_);
  } else {
    schedule_.add(at, std::move(command));
  }
}

void Simulation::schedule_untimed(const Instant& at) {
  for (CommandItem& command : std::exchange(untimed_, {})) schedule_.add(at, std::move(command));
}

void Simulation::refuse(CommandItem command, Code code, const std::string& reason) {
  const bool about_instant = code == Code::DeadlinePassed || code == Code::InvalidArgument;
  reply(std::move(command),
        engine::Reject{.code = code, .field = about_instant ? "at" : "", .reason = reason});
}

void Simulation::refuse_scheduled(Code code, const std::string& reason) {
  for (CommandItem& command : schedule_.take_all()) {
    if (command.spec.at) {
      refuse(std::move(command), code, reason);
    } else {
      untimed_.push_back(std::move(command));
    }
  }
}

void Simulation::reply(CommandItem command, Made made) {
  ReplyRecord record;
  record.request = command.spec.request;
  record.moment = moment();
  if (made) {
    record.ids = std::move(made).value();
  } else {
    record.reject = made.reject();
    ++status_.rejected;
  }
  replies_.finish(record);
  replies_to_send_.push_back({std::move(record), std::move(command.ticket)});
}

void Simulation::fail(std::string reason) {
  failure_ = std::move(reason);
  status_due_ = true;
  refuse_scheduled(Code::FailedPrecondition, "the world has failed: " + failure_);
}

void Simulation::stop() {
  // A storm of events may outlast any patience; then the tick stays unfinished.
  constexpr unsigned kTurnsMax = 64;
  for (unsigned turns = 0; tick_ && turns < kTurnsMax; ++turns) {
    events_left_ = kEventsPerTurn;
    finish_tick();
  }
  forecaster_.stop();
  const std::string reason = "the daemon is stopping";
  for (auto commands = inbox_.take_commands(kCommandsPerTick); !commands.empty();
       commands = inbox_.take_commands(kCommandsPerTick)) {
    for (CommandItem& command : commands) take_in(std::move(command));
  }
  schedule_untimed(world_.now());
  for (CommandItem& command : schedule_.take_all()) {
    refuse(std::move(command), Code::Unavailable, reason);
  }
  for (auto queries = inbox_.take_queries(kQueriesPerTurn); !queries.empty();
       queries = inbox_.take_queries(kQueriesPerTurn)) {
    for (QueryItem& query : queries) {
      refuse(std::move(query),
             engine::Reject{.code = Code::Unavailable, .field = "", .reason = reason});
    }
  }
  publish(/*at_any_rate=*/true);
  send_replies();
  report_status(idl::WorldState::kStopped);
}

}  // namespace stoss::service

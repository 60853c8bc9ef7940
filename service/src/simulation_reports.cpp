// SPDX-License-Identifier: Apache-2.0
// What the world tells: answers, the records for the publisher, its status.
#include "questions.hpp"
#include "simulation.hpp"

#include <stoss/engine/features.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace stoss::service {
namespace {

using engine::Code;
using engine::Reject;
using idl::Ask;

// The questions that can be about another instant than the present.
bool can_be_timed(Ask ask) {
  switch (ask) {
    case Ask::kStates:
    case Ask::kList:
    case Ask::kRegion:
    case Ask::kNearest:
    case Ask::kRay:
      return true;
    case Ask::kWorld:
    case Ask::kCollisions:
    case Ask::kZoneEvents:
    case Ask::kFeatures:
    case Ask::kStatus:
    case Ask::kPredict:
    case Ask::kForecast:
      return false;
  }
  return false;
}

// The questions that the publisher answers from its own picture of the world, without holding up a
// tick: those whose answers are large, and those about what it published.
bool answered_by_picture(Ask ask) {
  switch (ask) {
    case Ask::kList:
    case Ask::kWorld:
    case Ask::kCollisions:
    case Ask::kZoneEvents:
    case Ask::kStatus:
      return true;
    case Ask::kStates:
    case Ask::kRegion:
    case Ask::kNearest:
    case Ask::kRay:
    case Ask::kFeatures:
    case Ask::kPredict:
    case Ask::kForecast:
      return false;
  }
  return false;
}

}  // namespace

void Simulation::on_collision(const engine::Collision& collision) {
  if (collisions_.size() >= kCollisionsWaitingMax) {
    status_.collisions_lost += collisions_.size();
    collisions_.clear();
  }
  if (collision.order_dependent) ++status_.order_dependent;
  if (verifier_) verifier_->on_collision(collision);
  collisions_.push_back(collision);
}

void Simulation::on_zone_event(const engine::ZoneEvent& event) {
  if (zone_events_.size() >= kZoneEventsWaitingMax) {
    status_.zone_events_lost += zone_events_.size();
    zone_events_.clear();
  }
  zone_events_.push_back(event);
}

std::vector<engine::ZoneState> Simulation::zones() const {
  std::vector<engine::ZoneState> all;
  world_.for_each_zone([&all](const engine::ZoneState& zone) { all.push_back(zone); });
  return all;
}

/// The names that the scene gives to what its world has given ids to.
std::vector<NamedBody> Simulation::scene_names(std::span<const engine::Id> ids) const {
  std::vector<NamedBody> names;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::string& name = scene_.name_of(i);
    if (!name.empty()) names.emplace_back(ids[i], name);
  }
  return names;
}

void Simulation::answer_queries() {
  bool status_told = false;
  for (QueryItem& query : inbox_.take_queries(kQueriesPerTurn)) {
    ++status_.queries;
    if (static_cast<Ask>(query.spec.op) == Ask::kStatus && !std::exchange(status_told, true)) {
      report_status(state());
    }
    answer_query(std::move(query));
  }
}

void Simulation::answer_query(QueryItem query) {
  const auto ask = static_cast<Ask>(query.spec.op);
  if (ask == Ask::kForecast) {
    const double ahead = query.spec.distance;
    const auto at = engine::offset_by(world_.now(), ahead);
    if (!(ahead >= 0) || !at || query.spec.at) {
      refuse(std::move(query),
             {.code = Code::InvalidArgument,
              .field = "distance",
              .reason = "must be a number of seconds from the present on"});
      return;
    }
    forecast(std::move(query), *at);
    return;
  }
  if (query.spec.at && *query.spec.at != world_.now()) {
    const engine::Instant at = *query.spec.at;
    forecast(std::move(query), at);
    return;
  }
  if (answered_by_picture(ask)) {
    if (put_off_) publish(/*at_any_rate=*/true);
    outbox_.push(PictureQuery{std::move(query.spec), std::move(query.ticket)});
    return;
  }
  AnswerItem item{query.spec.request, moment(), Reject{}, std::move(query.ticket)};
  if (ask == Ask::kFeatures) {
    item.content = features(world_.effects());
  } else if (auto rows = answer(world_, query.spec)) {
    item.content = std::move(rows).value();
  } else {
    item.content = rows.reject();
  }
  outbox_.push(std::move(item));
}

void Simulation::forecast(QueryItem query, const engine::Instant& at) {
  const auto ask = static_cast<Ask>(query.spec.op);
  if (ask != Ask::kForecast && !can_be_timed(ask)) {
    refuse(std::move(query),
           {.code = Code::InvalidArgument,
            .field = "timed",
            .reason = "this question is about the present only"});
  } else if (at < world_.now()) {
    refuse(std::move(query),
           {.code = Code::DeadlinePassed,
            .field = "at",
            .reason = "that instant is in the past; motions are kept from the present on"});
  } else if (!engine::in_range(at)) {
    refuse(std::move(query),
           {.code = Code::InvalidArgument, .field = "at", .reason = "is beyond the end of time"});
  } else if (failed()) {
    refuse(std::move(query),
           {.code = Code::FailedPrecondition,
            .field = "",
            .reason = "the world has failed: " + failure_});
  } else if (!forecaster_.has_room()) {
    refuse(std::move(query),
           {.code = Code::ResourceExhausted,
            .field = "at",
            .reason = "too many questions about the future at once; ask again later"});
  } else {
    forecaster_.submit({world_, std::move(query), {epoch_, run_.tick_at(at), at}});
  }
}

void Simulation::refuse(QueryItem query, Reject reject) {
  outbox_.push(
      AnswerItem{query.spec.request, moment(), std::move(reject), std::move(query.ticket)});
}

void Simulation::begin_epoch(std::vector<NamedBody> names) {
  EpochRecord record;
  record.moment = moment();
  record.names = std::move(names);
  record.effects = effects_on();
  effects_changed_ = false;
  record.bodies.reserve(world_.disk_count() + world_.wall_count());
  for (const engine::Id id : world_.ids()) {
    record.bodies.push_back(
        {engine::ChangeKind::Spawned, world_.motion(id).value(), world_.body(id).value()});
  }
  record.zones = zones();
  record.state_hash = world_.state_hash();
  static_cast<void>(world_.drain_changes());  // from here on changes are kept
  published_ = record.moment;
  put_off_ = false;
  collisions_.clear();
  zone_events_.clear();
  zones_changed_ = false;
  names_.clear();
  removed_.clear();
  status_.events = 0;
  status_.order_dependent = 0;
  if (verifier_) verifier_->begin(world_);
  outbox_.push(std::move(record));
}

std::vector<std::string> Simulation::effects_on() const {
  std::vector<std::string> names;
  const engine::Effects effects = world_.effects();
  for (const engine::EffectInfo& effect : engine::known_effects()) {
    if (effect.is_on(effects)) names.emplace_back(effect.name);
  }
  return names;
}

void Simulation::publish(bool at_any_rate) {
  if (!at_any_rate && outbox_.ticks_waiting() >= kTicksWaitingMax) {
    if (!put_off_) ++status_.records_put_off;
    put_off_ = true;
    return;
  }
  put_off_ = false;
  TickRecord record;
  record.moment = moment();
  const std::vector<engine::Change> changes = world_.drain_changes();
  record.changes.reserve(changes.size());
  for (const engine::Change& change : changes) {
    BodyChange& entry = record.changes.emplace_back();
    entry.kind = change.kind;
    if (change.kind == engine::ChangeKind::Removed) {
      entry.motion = removed_[change.id];
    } else {
      entry.motion = world_.motion(change.id).value();
      entry.body = world_.body(change.id).value();
    }
  }
  removed_.clear();
  if (std::exchange(effects_changed_, false)) record.effects = effects_on();
  if (std::exchange(zones_changed_, false)) record.zones = zones();
  record.zone_events = std::exchange(zone_events_, {});
  const bool is_news = record.changes_the_world();
  if (!is_news && collisions_.empty() && published_ == record.moment) return;
  record.collisions = std::exchange(collisions_, {});
  record.names = std::exchange(names_, {});
  if (is_news && outbox_.hash_wanted.load(std::memory_order_relaxed)) {
    record.state_hash = world_.state_hash();
  }
  published_ = record.moment;
  outbox_.push(std::move(record));
}

void Simulation::send_replies() {
  for (ReplyItem& item : replies_to_send_) outbox_.push(std::move(item));
  replies_to_send_.clear();
}

idl::WorldState Simulation::state() const {
  if (failed()) return idl::WorldState::kFailed;
  return run_.running() ? idl::WorldState::kRunning : idl::WorldState::kPaused;
}

void Simulation::report_status_if_due() {
  if (status_due_ || clock_.now() - status_at_ >= kStatusInterval) report_status(state());
}

void Simulation::report_status(idl::WorldState state) {
  const Nanoseconds now = clock_.now();
  // Rates over a shorter time than this would be noise.
  constexpr Nanoseconds kRateWindow{200'000'000};
  if (now - rate_since_ >= kRateWindow) {
    const double seconds = std::chrono::duration<double>(now - rate_since_).count();
    status_.speed_reached = engine::seconds_between(rate_instant_, world_.now()) / seconds;
    status_.events_per_second = static_cast<double>(events_ - rate_events_) / seconds;
    rate_since_ = now;
    rate_instant_ = world_.now();
    rate_events_ = events_;
  }
  if (state != idl::WorldState::kRunning) {
    status_.speed_reached = 0;
    status_.events_per_second = 0;
  }
  const engine::Counters counters = world_.counters();
  status_.state = state;
  status_.reason = failure_;
  status_.moment = moment();
  status_.tick_rate = options_.tick_rate;
  status_.speed_asked = pacer_.speed();
  status_.bodies = world_.disk_count();
  status_.walls = world_.wall_count();
  status_.zones = world_.zone_count();
  status_.watched = watches_.size();
  status_.collisions = counters.collisions;
  status_.regularised = counters.regularised;
  status_.state_hash = world_.state_hash();
  status_.ticks_late = pacer_.ticks_late();
  status_.ticks_slipped = pacer_.ticks_slipped();
  status_.arithmetic = world_.arithmetic();
  status_.period = world_.period();
  if (verifier_) {
    status_.verify_period = verifier_->period();
    status_.verified = verifier_->found();
  }
  status_.broad_phase = world_.broad_phase();
  status_at_ = now;
  status_due_ = false;
  outbox_.push(status_);
}

void Simulation::verify() {
  const engine::Verification before = verifier_->found();
  const engine::Verification& found = verifier_->check(world_);
  const auto drift = [](const engine::Verification& v) {
    return std::max(v.energy_error, v.momentum_error);
  };
  const bool is_worse = found.overlaps > before.overlaps || found.missed > before.missed ||
                        drift(found) > drift(before);
  // A fault that stays is told once a second, not at every check.
  constexpr Nanoseconds kPatience{1'000'000'000};
  if (!is_worse || engine::is_healthy(found, world_.arithmetic())) return;
  status_due_ = true;
  if (fault_told_at_ && clock_.now() - *fault_told_at_ < kPatience) return;
  fault_told_at_ = clock_.now();
  spdlog::error(
      "verification found a fault at {} s: {} overlaps, {} missed contacts, deepest overlap {:.3g} "
      "of the contact distance, energy off by {:.3g}, momentum by {:.3g}",
      engine::seconds_between({}, world_.now()),
      found.overlaps,
      found.missed,
      found.deepest,
      found.energy_error,
      found.momentum_error);
}

}  // namespace stoss::service

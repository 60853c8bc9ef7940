// SPDX-License-Identifier: Apache-2.0
#include "forecaster.hpp"

#include "questions.hpp"
#include "thread_name.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

namespace stoss::service {
namespace {

using engine::Code;
using engine::Reject;

/// Events between two looks at whether the daemon is stopping: some ten milliseconds.
constexpr std::uint64_t kSlice = 10'000;

}  // namespace

bool Forecaster::has_room() const {
  const std::lock_guard lock(mutex_);
  return !stopping_ && waiting_.size() + (busy_ ? 1 : 0) < kForecastsMax;
}

void Forecaster::submit(Forecast forecast) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(forecast));
  if (!thread_.joinable()) thread_ = std::jthread([this] { run(); });
  changed_.notify_one();
}

void Forecaster::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

bool Forecaster::stopping() const {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

// A fault here costs the forecasts and not the world: no more are taken.
void Forecaster::run() {
  name_thread("forecaster");
  try {
    answer_each();
  } catch (const std::exception& error) {
    spdlog::critical("the forecaster thread cannot go on: {}", error.what());
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
}

void Forecaster::answer_each() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Forecast forecast = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    lock.unlock();
    AnswerItem item{
        forecast.query.spec.request, forecast.moment, Reject{}, std::move(forecast.query.ticket)};
    auto rows = guarded_look_ahead(forecast);
    if (rows) {
      item.content = std::move(rows).value();
    } else {
      item.content = rows.reject();
    }
    outbox_.push(std::move(item));
    lock.lock();
    busy_ = false;
  }
}

// A broken world or a want of memory ends one forecast. If the world is broken, its own thread
// finds the same when it gets there.
engine::Outcome<Rows> Forecaster::guarded_look_ahead(Forecast& forecast) const {
  try {
    return look_ahead(forecast);
  } catch (const std::exception& error) {
    spdlog::error("a forecast failed: {}", error.what());
    return Reject{.code = Code::Internal, .field = "", .reason = error.what()};
  }
}

engine::Outcome<Rows> Forecaster::look_ahead(Forecast& forecast) const {
  std::uint64_t left = kForecastEventsMax;
  for (;;) {
    if (stopping())
      return Reject{.code = Code::Unavailable, .field = "", .reason = "the daemon is stopping"};
    const auto report =
        forecast.world.advance_to(forecast.moment.at, nullptr, std::min(left, kSlice));
    if (!report) return report.reject();
    if (report.value().stop == engine::Stop::Reached) break;
    if (report.value().stop == engine::Stop::Stalled) {
      return Reject{.code = Code::FailedPrecondition,
                    .field = "at",
                    .body = report.value().stalled,
                    .reason = "events crowd into one instant before that"};
    }
    left -= std::min(left, report.value().events);
    if (left == 0) {
      return Reject{.code = Code::ResourceExhausted,
                    .field = "at",
                    .reason = "more than " + std::to_string(kForecastEventsMax) +
                              " events lie before that instant"};
    }
  }
  return answer(forecast.world, forecast.query.spec);
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// Questions about the future, answered from a copy of the world that runs ahead on a thread of its
// own. Commands that are scheduled but have not taken effect yet are no part of the future it
// shows.
//
// Thread safety: one thread submits; the answers go to the outbox from the forecaster's own thread.
#pragma once

#include "outbox.hpp"
#include "records.hpp"

#include <stoss/engine/world.hpp>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>

namespace stoss::service {

/// Copies of the world that may wait or run at once: each holds a world's memory.
inline constexpr std::size_t kForecastsMax = 4;
/// A forecast that needs more events than this is refused: a second or so of computing.
inline constexpr std::uint64_t kForecastEventsMax = 1'000'000;

/// A question, the world to run ahead for it, and the moment that it is about.
struct Forecast {
  engine::World world;
  QueryItem query;
  Moment moment;
};

class Forecaster {
 public:
  explicit Forecaster(Outbox& outbox) : outbox_(outbox) {}
  Forecaster(const Forecaster&) = delete;
  Forecaster& operator=(const Forecaster&) = delete;
  ~Forecaster() { stop(); }

  /// Whether another forecast would be taken. Ask before copying a world.
  [[nodiscard]] bool has_room() const;
  /// REQUIRES: has_room().
  void submit(Forecast forecast);
  /// Ends the thread; what waits is answered Unavailable.
  void stop();

 private:
  void run();
  void answer_each();
  [[nodiscard]] engine::Outcome<Rows> look_ahead(Forecast& forecast) const;
  [[nodiscard]] engine::Outcome<Rows> guarded_look_ahead(Forecast& forecast) const;
  [[nodiscard]] bool stopping() const;

  Outbox& outbox_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Forecast> waiting_;
  bool busy_ = false;
  bool stopping_ = false;
  std::jthread thread_;  // started by the first forecast
};

}  // namespace stoss::service

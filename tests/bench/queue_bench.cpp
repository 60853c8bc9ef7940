// SPDX-License-Identifier: Apache-2.0
// What the queue of events costs by itself: taking the first event, and rescheduling its body and
// another, as a collision does. Waits are exponential, as in a gas.

#include "event_queue.hpp"
#include "support/random.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace stoss::engine;

void BM_Queue(benchmark::State& state) {
  const auto bodies = static_cast<std::uint64_t>(state.range(0));
  stoss::test::Random random(3);
  const auto ids = [](std::int32_t slot, const Event<double>&) {
    const auto id = static_cast<Id>(slot) + 1;
    return IdPair{id, id};
  };
  // Drawn before: a logarithm costs as much as an operation of the queue.
  std::vector<double> waits(std::size_t{1} << 16);
  for (double& wait : waits) wait = -std::log(1 - random.uniform(0, 1));
  std::size_t drawn = 0;
  EventQueue<double> queue;
  Instant now{};
  const auto reschedule = [&](std::int32_t slot) {
    Event<double> event;
    event.at = offset_by(now, waits[drawn++ % waits.size()]).value();
    queue.set(slot, event, ids);
  };
  for (std::uint64_t slot = 0; slot < bodies; ++slot) {
    queue.admit(static_cast<std::int32_t>(slot));
    reschedule(static_cast<std::int32_t>(slot));
  }
  for (auto _ : state) {
    const std::int32_t first = queue.top(ids);
    now = queue.event_of(first).at;
    reschedule(first);
    reschedule(static_cast<std::int32_t>(random.below(bodies)));
  }
}

BENCHMARK(BM_Queue)->Name("queue")->RangeMultiplier(10)->Range(1'000, 1'000'000);

}  // namespace

BENCHMARK_MAIN();

// SPDX-License-Identifier: Apache-2.0
// What a collision costs in the engine alone, and in other engines with the same worlds: processor
// time, beginning after the world has forgotten its lattice. Names are scene/engine/disks/..., a
// benchmark is one run of a fixed number of collisions or steps.
//
//   engine_bench [--quick] [--large] [Google Benchmark's own options]
//
// --quick: a tenth of the work; --large: a million disks, too.
//
// Counters: `ns_per_collision` counts disks with disks; `ns_per_contact` walls, too;
// `ms_per_free_time` is for the mean time between a disk's collisions; `missed` (of the contacts
// that there are), `energy_error` and `overlap` (deepest, of the contact distance) are what an
// engine got wrong; `bytes_per_body` is what it allocated.

#include "bench/commands.hpp"
#include "bench/options.hpp"
#include "bench/peer.hpp"
#include "bench/processor_time.hpp"
#include "bench/scenes.hpp"

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace stoss::bench {
namespace {

constexpr double kStep = 1.0 / 60;  // s
/// Of the worlds that all engines run at every size.
constexpr double kMainFraction = 0.3;
/// Collisions of each disk before the clock starts.
constexpr std::uint64_t kMeltPerDisk = 4;

struct Case {
  std::string name;
  std::function<BenchScene()> make;
  std::uint64_t collisions = 0;  ///< that are timed in the exact engine
  int steps = 0;                 ///< that are timed in the others; 0: they do not run it
};

double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// What happened in the exact run.
struct Exact : engine::CollisionSink {
  double disk_contacts = 0;
  double wall_contacts = 0;
  void on_collision(const engine::Collision& c) override {
    ++(c.kind == engine::ContactKind::DiskDisk ? disk_contacts : wall_contacts);
  }
};

void put(benchmark::State& state, const char* name, double value) {
  if (std::isfinite(value)) state.counters[name] = value;
}

void put_cost(benchmark::State& state, double seconds, const Exact& exact, double disks) {
  put(state, "disks", disks);
  put(state, "disk_contacts", exact.disk_contacts);
  put(state, "wall_contacts", exact.wall_contacts);
  put(state, "ns_per_collision", 1e9 * seconds / exact.disk_contacts);
  put(state, "ns_per_contact", 1e9 * seconds / (exact.disk_contacts + exact.wall_contacts));
  // A disk's mean free time passes when every disk has had one collision: half as many as disks.
  put(state, "ms_per_free_time", 1e3 * seconds * 0.5 * disks / exact.disk_contacts);
}

double energy_of(const BenchScene& start, const engine::World& world) {
  return kinetic_energy(scene_at_present(start, world).disks);
}

// The timed run has no sink; a copy of the world runs again to see what it was made of.
void run_stoss(benchmark::State& state, const Case& run) {
  const BenchScene scene = run.make();
  const auto disks = static_cast<double>(scene.disks.size());
  const double heap_before = heap_bytes();
  engine::World world = make_world(scene);
  melt(world, kMeltPerDisk * scene.disks.size());
  const double bytes = heap_bytes() - heap_before;
  engine::World again = world;
  const double energy = energy_of(scene, world);
  double seconds = 0;
  for (auto _ : state) {
    const double begun = processor_seconds();
    melt(world, run.collisions);
    seconds = processor_seconds() - begun;
    state.SetIterationTime(seconds);
  }
  Exact exact;
  static_cast<void>(again.advance_to(world.now(), &exact));
  put_cost(state, seconds, exact, disks);
  put(state, "bytes_per_body", bytes / (disks + static_cast<double>(scene.walls.size())));
  put(state, "missed", 0);
  put(state, "energy_error", energy_of(scene, world) / energy - 1);
  put(state, "overlap", deepest_overlap(scene_at_present(scene, world).disks));
}

/// Steps the peer and times it; looks at overlaps in between, off the clock.
double timed_steps(Peer& peer, int steps, std::vector<engine::DiskSpec>& disks, double& overlap) {
  constexpr int kLooks = 4;
  double seconds = 0;
  for (int look = 0; look < kLooks; ++look) {
    const int until = steps * (look + 1) / kLooks;
    const double begun = processor_seconds();
    for (int i = steps * look / kLooks; i < until; ++i) peer.step(kStep);
    seconds += processor_seconds() - begun;
    peer.read(disks);
    overlap = std::max(overlap, deepest_overlap(disks));
  }
  return seconds;
}

void run_peer(benchmark::State& state, const Case& run, const PeerKind& kind) {
  const BenchScene start = run.make();
  engine::World world = make_world(start);
  melt(world, kMeltPerDisk * start.disks.size());
  BenchScene scene = scene_at_present(start, world);
  const double heap_before = heap_bytes();
  const auto peer = kind.make(scene);
  const int warm_up = run.steps / 10 + 1;
  for (int i = 0; i < warm_up; ++i) peer->step(kStep);
  const double bytes = heap_bytes() - heap_before;
  const auto contacts = [&] {
    return static_cast<double>(peer->disk_contacts() + peer->wall_contacts());
  };
  const double contacts_before = contacts();
  const double energy = kinetic_energy(scene.disks);
  double overlap = 0;
  double seconds = 0;
  for (auto _ : state) {
    seconds = timed_steps(*peer, run.steps, scene.disks, overlap);
    state.SetIterationTime(seconds);
  }
  Exact exact;
  const auto later = [&world](int steps) {
    return engine::offset_by(world.now(), kStep * steps).value();
  };
  static_cast<void>(world.advance_to(later(warm_up)));
  static_cast<void>(world.advance_to(later(run.steps), &exact));
  put_cost(state, seconds, exact, static_cast<double>(scene.disks.size()));
  put(state,
      "bytes_per_body",
      bytes / static_cast<double>(scene.disks.size() + scene.walls.size()));
  const double counted = contacts() - contacts_before;
  put(state, "missed", 1 - counted / (exact.disk_contacts + exact.wall_contacts));
  put(state, "energy_error", kinetic_energy(scene.disks) / energy - 1);
  put(state, "overlap", overlap);
}

// Ticks of 1/60 s, each timed for itself: most of the world rests.
void put_ticks(benchmark::State& state, double seconds, double ticks, double contacts) {
  put(state, "us_per_tick", 1e6 * seconds / ticks);
  put(state, "share_of_core", seconds / (ticks * kStep));
  put(state, "contacts_per_tick", contacts / ticks);
}

void run_resting_stoss(benchmark::State& state, const Case& run) {
  const BenchScene scene = run.make();
  const double heap_before = heap_bytes();
  engine::World world = make_world(scene);
  const double bytes = heap_bytes() - heap_before;
  static_cast<void>(world.drain_changes());
  double seconds = 0;
  for (auto _ : state) {
    const double begun = processor_seconds();
    for (int i = 1; i <= run.steps; ++i) {
      static_cast<void>(world.advance_to(*engine::offset_by({}, kStep * i)));
      static_cast<void>(world.drain_changes());
    }
    seconds = processor_seconds() - begun;
    state.SetIterationTime(seconds);
  }
  put_ticks(state, seconds, run.steps, static_cast<double>(world.counters().collisions));
  put(state, "bytes_per_body", bytes / static_cast<double>(scene.disks.size()));
}

void run_resting_peer(benchmark::State& state, const Case& run, const PeerKind& kind) {
  const BenchScene scene = run.make();
  const auto peer = kind.make(scene);
  peer->step(kStep);  // the first one sorts everybody in
  double seconds = 0;
  for (auto _ : state) {
    const double begun = processor_seconds();
    for (int i = 0; i < run.steps; ++i) peer->step(kStep);
    seconds = processor_seconds() - begun;
    state.SetIterationTime(seconds);
  }
  put_ticks(state, seconds, run.steps, static_cast<double>(peer->disk_contacts()));
}

/// How much work a run does.
struct Budget {
  bool quick = false;
  bool large = false;
  [[nodiscard]] std::uint64_t collisions(std::size_t disks) const {
    const std::size_t whole = std::max<std::size_t>(200'000, 4 * disks);
    return quick ? whole / 10 : whole;
  }
  /// Of a gas in other engines. A step of the largest would take a minute when it is crowded.
  [[nodiscard]] int steps(std::size_t disks, double fraction) const {
    if (disks > 100'000 || (disks == 100'000 && fraction != kMainFraction)) return 0;
    const int whole = disks <= 1'000 ? 1'000 : disks <= 10'000 ? 60 : 15;
    return quick ? std::max(1, whole / 10) : whole;
  }
};

std::vector<Case> cases_of(const Budget& budget) {
  std::vector<Case> cases;
  std::vector<std::size_t> counts{1'000, 10'000, 100'000};
  if (budget.large) counts.push_back(1'000'000);
  const auto percent = [](double fraction) { return std::to_string(std::lround(100 * fraction)); };
  for (const std::size_t n : counts) {
    for (const double fraction : {0.1, kMainFraction, 0.5, 0.7}) {
      cases.push_back({"gas/@/" + std::to_string(n) + "/" + percent(fraction),
                       [=] { return gas(n, fraction); },
                       budget.collisions(n),
                       budget.steps(n, fraction)});
    }
  }
  const auto add = [&](const std::string& name, std::size_t n, int steps, auto make) {
    cases.push_back(
        {name, make, budget.collisions(n), budget.quick ? std::max(1, steps / 10) : steps});
  };
  for (const int ratio : {10, 100}) {
    add("mixture-" + std::to_string(ratio) + "/@/10000/30", 10'000, 60, [=] {
      return mixture(10'000, 0.3, ratio);
    });
  }
  add("maze/@/100000/30", 100'000, 10, [] { return maze(100'000, 10'000, 0.3); });
  add("burst/@/10000/30", 10'000, 60, [] { return burst(10'000, 0.3); });
  return cases;
}

using Runner = std::function<void(benchmark::State&)>;

void add_run(const Case& run, const std::string& engine, const Runner& runner) {
  std::string name = run.name;
  name.replace(name.find('@'), 1, engine);
  benchmark::RegisterBenchmark(name.c_str(), runner)
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

void register_all(const Budget& budget) {
  std::vector<PeerKind> peers;
#ifdef STOSS_BENCH_PEERS
  for (const auto& kinds : {box2d_kinds(), chipmunk_kinds()}) {
    peers.insert(peers.end(), kinds.begin(), kinds.end());
  }
#endif
  for (const Case& run : cases_of(budget)) {
    add_run(run, "stoss", [run](auto& state) { run_stoss(state, run); });
    if (run.steps == 0) continue;
    for (const PeerKind& kind : peers) {
      add_run(run, kind.name, [run, kind](auto& state) { run_peer(state, run, kind); });
    }
  }
  const std::size_t resting = budget.quick ? 100'000 : 1'000'000;
  const Case bullet_run{"bullet/@/" + std::to_string(resting) + "/30",
                        [=] { return bullet(resting, 0.3); },
                        0,
                        budget.quick ? 60 : 600};
  add_run(bullet_run, "stoss", [=](auto& state) { run_resting_stoss(state, bullet_run); });
  for (const PeerKind& kind : peers) {
    add_run(bullet_run, kind.name, [=](auto& state) { run_resting_peer(state, bullet_run, kind); });
  }
  register_commands(resting);
}

}  // namespace
}  // namespace stoss::bench

int main(int argc, char** argv) {
  stoss::bench::Budget budget;
  budget.quick = stoss::bench::take(argc, argv, "--quick");
  budget.large = stoss::bench::take(argc, argv, "--large");
  stoss::bench::register_all(budget);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random worlds with random commands in flight, and one way to run them under every circumstance
// that must not matter: ticks, broad phase, order of insertion, age, forks, snapshots.

#include "support/random.hpp"
#include "support/worlds.hpp"

#include <stoss/engine/world.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace stoss::test {

/// A command some seconds after the start.
struct Step {
  double after = 0;  ///< s
  std::vector<DiskSpec> disks;
  std::vector<WallSpec> walls;
  std::vector<Id> removed;
  std::vector<engine::VectorFor> velocities;
  std::vector<engine::VectorFor> impulses;
};

struct Story {
  std::string name;
  std::vector<DiskSpec> disks;
  std::vector<WallSpec> walls;
  std::vector<Step> steps;  ///< in the order of time
  double length = 1;        ///< s
  bool conserves_energy = false;
  bool conserves_momentum = false;
  bool is_closed = false;            ///< walls all around: nobody gets out of [low, high]
  Vector2 period = Vector2::Zero();  ///< m; 0: open
  Vector2 low = Vector2::Zero();
  Vector2 high = Vector2::Zero();
};

/// Circumstances.
struct Run {
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::BroadPhaseKind broad_phase = engine::BroadPhaseKind::Neighbours;
  std::int64_t start = 0;       ///< s
  std::vector<double> ticks{};  ///< s after the start, advanced to in between
  bool backwards = false;       ///< the order of insertion
  bool one_by_one = false;      ///< spawn the first bodies in commands of their own
  std::function<void(const World&)> at_each_tick{};
  enum class Break { None, Fork, Snapshot, OtherBroadPhase } at_ticks = Break::None;
};

struct Result {
  std::vector<engine::Collision> collisions;
  std::vector<engine::Code> codes;  ///< of the steps' commands
  World world;
  bool endless = false;  ///< it was given up: events without end, as of a disk being squeezed
};

namespace detail {

inline engine::Code code_of(const auto& outcome) {
  return outcome.ok() ? engine::Code::Ok : outcome.reject().code;
}

inline void apply(World& world, const Step& step, std::vector<engine::Code>& codes) {
  if (!step.disks.empty() || !step.walls.empty()) {
    codes.push_back(code_of(world.spawn({step.disks, step.walls})));
  }
  if (!step.removed.empty()) codes.push_back(code_of(world.remove(step.removed)));
  if (!step.velocities.empty()) codes.push_back(code_of(world.set_velocity(step.velocities)));
  if (!step.impulses.empty()) codes.push_back(code_of(world.apply_impulse(step.impulses)));
}

inline World snapshot_of(const World& world, bool other_broad_phase) {
  auto kind = world.broad_phase();
  if (other_broad_phase) {
    kind = kind == engine::BroadPhaseKind::Neighbours ? engine::BroadPhaseKind::AllPairs
                                                      : engine::BroadPhaseKind::Neighbours;
  }
  return World::deserialise(world.serialise(), kind).value();
}

inline void spawn_first(World& world, const Story& story, const Run& run) {
  std::vector<DiskSpec> disks = story.disks;
  std::vector<WallSpec> walls = story.walls;
  if (run.backwards) {
    std::reverse(disks.begin(), disks.end());
    std::reverse(walls.begin(), walls.end());
  }
  if (!run.one_by_one) {
    must_spawn(world, disks, walls);
    return;
  }
  for (const WallSpec& w : walls) must_spawn(world, {}, std::span(&w, 1));
  for (const DiskSpec& d : disks) must_spawn(world, std::span(&d, 1));
}

}  // namespace detail

/// A story has hundreds of events; one of more than this many is given up.
inline constexpr std::uint64_t kEventsMax = 50'000;

/// Plays a story.
inline Result play(const Story& story, const Run& run = {}) {
  const Instant start{run.start, 0};
  Result result{{},
                {},
                World(engine::WorldOptions{.start = start,
                                           .arithmetic = run.arithmetic,
                                           .broad_phase = run.broad_phase,
                                           .period = story.period})};
  World& world = result.world;
  detail::spawn_first(world, story, run);
  Log log;
  const auto advance = [&](double after) {
    if (result.endless) return;
    const auto report = world.advance_to(*engine::offset_by(start, after), &log, kEventsMax);
    EXPECT_TRUE(report.ok());
    result.endless = !report.ok() || report.value().stop != engine::Stop::Reached;
  };
  auto tick = run.ticks.begin();
  const auto advance_in_ticks = [&](double until) {
    for (; tick != run.ticks.end() && *tick < until; ++tick) {
      advance(*tick);
      if (run.at_each_tick) run.at_each_tick(world);
      if (run.at_ticks == Run::Break::Fork) world = World(world);
      if (run.at_ticks == Run::Break::Snapshot) world = detail::snapshot_of(world, false);
      if (run.at_ticks == Run::Break::OtherBroadPhase) world = detail::snapshot_of(world, true);
    }
    advance(until);
  };
  for (const Step& step : story.steps) {
    advance_in_ticks(step.after);
    detail::apply(world, step, result.codes);
  }
  advance_in_ticks(story.length);
  result.collisions = std::move(log.collisions);
  return result;
}

/// Makes stories: each call is another one. What is random is drawn from `random` alone.
class StoryTeller {
 public:
  static constexpr std::uint64_t kKinds = 7;

  explicit StoryTeller(std::uint64_t seed) : random_(seed) {}

  /// Disks of radii up to 1:1000 in a box, among obstacles; all elastic and at rest around.
  Story gas() {
    Story story = boxed("gas");
    scatter(story, 4 + random_.below(20), /*fixed_one_in=*/8, 0);
    story.conserves_energy = true;
    return story;
  }

  /// Disks alone in open space, falling in on each other.
  Story cluster() {
    Story story;
    story.name = "cluster";
    story.low = {-5, -5};
    story.high = {5, 5};
    story.length = random_.uniform(5, 50);
    scatter(story, 4 + random_.below(12), 0, 0);
    for (DiskSpec& d : story.disks) d.velocity = -0.3 * d.position + 0.1 * d.velocity;
    story.conserves_energy = true;
    story.conserves_momentum = true;
    return story;
  }

  /// A room whose outline is a chain of walls, with bent chains and long walls inside.
  Story chains() {
    Story story;
    story.name = "chains";
    const auto corners = static_cast<int>(3 + random_.below(8));
    std::vector<Vector2> outline;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners;
      const double r = random_.uniform(8, 12);
      outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    outline.push_back(outline.front());
    story.walls = chain(1000, outline);
    std::vector<Vector2> bent = {{random_.uniform(-3, 3), random_.uniform(-3, 3)}};
    for (std::uint64_t i = 0; i < 2 + random_.below(6); ++i) {
      bent.push_back(bent.back() + Vector2(random_.uniform(-2, 2), random_.uniform(-2, 2)));
    }
    for (const WallSpec& w : chain(1100, bent)) story.walls.push_back(w);
    story.low = {-4, -4};
    story.high = {4, 4};
    story.length = random_.uniform(5, 20);
    scatter(story, 3 + random_.below(8), 6, 0);
    story.conserves_energy = true;
    return story;
  }

  /// Pistons, moving obstacles and moving chains.
  Story machines() {
    Story story = boxed("machines");
    scatter(story, 4 + random_.below(8), 6, 4);
    const double s = random_.uniform(0.05, 0.3);
    story.walls.push_back(wall(1200, {-9, -30}, {-9, 30}, {s, 0}));
    story.walls.push_back(wall(1201, {30, -9}, {-30, -9.5}, {s / 3, 0}));
    const Vector2 vertices[] = {{9, -30}, {8.5, 0}, {9, 7}, {9.5, 30}};
    for (WallSpec w : chain(1300, vertices)) {
      w.velocity = {-s, s / 7};
      story.walls.push_back(w);
    }
    story.length = random_.uniform(5, 15);
    remove_overlapping(story);
    return story;
  }

  /// Equal disks on a lattice, with few speeds: simultaneous contacts everywhere.
  Story lattice() {
    Story story;
    story.name = "lattice";
    const double pitch = random_.one_in(2) ? 2 : 1;  // 1: neighbours touch
    const auto n = static_cast<int>(3 + random_.below(4));
    Id id = 1;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const auto step = [&] { return static_cast<double>(random_.below(3)) - 1; };
        story.disks.push_back(
            disk(id++, {pitch * i, pitch * k}, {step(), random_.one_in(2) ? step() : 0.0}, 0.5));
      }
    }
    // Touching disks between touching walls have no room at all: see APackingWithoutRoom.
    const double edge = 0.5 * static_cast<double>((pitch == 1 ? 2 : 1) + random_.below(2));
    const double last = pitch * (n - 1) + edge;
    for (const WallSpec& w : box(1000, {-edge, -edge}, {last, last})) story.walls.push_back(w);
    story.length = random_.uniform(3, 12);
    story.conserves_energy = true;
    shuffle_ids(story);
    return story;
  }

  /// A world that repeats itself along one axis or both: alone, among walls that close around it,
  /// cross its border or sweep through it.
  Story periodic() {
    Story story;
    story.name = "periodic";
    const double height = random_.one_in(2) ? 20 : random_.uniform(8, 30);
    story.period = {20, height};
    story.low = {-10, -8};
    story.high = {10, height - 8};
    const bool is_alone = random_.one_in(3);
    if (!is_alone) {
      if (random_.one_in(2)) {  // a channel, with a step at its border
        story.period.y() = 0;
        const double step = random_.uniform(0, 1);
        story.walls.push_back(wall(1000, {-12, -8}, {8, -8}));
        story.walls.push_back(wall(1001, {10, height - 8}, {-10, height - 8 - step}));
        story.walls.push_back(wall(1002, {10, height - 8}, {10, height - 8 - step}));
      }
      const Vector2 bent[] = {{7, 1}, {10.5, 2}, {13, random_.uniform(-3, 3)}, {14, 1}};
      for (const WallSpec& w : chain(1100, bent)) story.walls.push_back(w);
      story.walls.push_back(wall(1200,
                                 {-3, random_.uniform(0, height)},
                                 {-3.5, random_.uniform(0, height) + 2},
                                 {random_.uniform(-0.4, 0.4), random_.uniform(-0.2, 0.2)}));
    }
    story.length = random_.uniform(3, 15);
    scatter(story, 4 + random_.below(20), is_alone ? 0 : 8, is_alone ? 0 : 8);
    story.conserves_energy = is_alone;
    story.conserves_momentum = is_alone;
    if (random_.one_in(2)) add_commands(story, 3 + random_.below(8));
    return story;
  }

  /// Any of them, with commands in flight.
  Story busy() {
    Story story;
    switch (random_.below(5)) {
      case 0:
        story = gas();
        break;
      case 1:
        story = cluster();
        break;
      case 2:
        story = chains();
        break;
      case 3:
        story = machines();
        break;
      default:
        story = lattice();
        break;
    }
    story.name = "busy " + story.name;
    add_commands(story, 3 + random_.below(12));
    return story;
  }

  /// Dozens of disks of radii up to 1:1000, fixed ones among them, with resting, moving and bent
  /// walls, in a box or in open space; bodies come, go and change their velocities all the time.
  Story crowd() {
    const bool is_open = random_.one_in(3);
    Story story = boxed(is_open ? "open crowd" : "crowd");
    if (is_open) story.walls.clear();
    Vector2 from(random_.uniform(-6, 6), random_.uniform(-6, 6));
    const std::uint64_t bends = random_.below(5);
    for (Id id = 1100; id < 1100 + bends; ++id) {
      const Vector2 to = from + 3 * random_velocity();
      story.walls.push_back(wall(id, from, to));
      from = to;
    }
    const std::uint64_t pistons = random_.below(3);
    for (Id id = 1200; id < 1200 + pistons; ++id) {
      const Vector2 start(random_.uniform(-8, 8), random_.uniform(-8, 8));
      story.walls.push_back(
          wall(id, start, start + Vector2(2, random_.uniform(-2, 2)), 0.3 * random_velocity()));
    }
    scatter(story, 10 + random_.below(random_.one_in(8) ? 150 : 50), 10, 12);
    if (is_open && random_.one_in(2)) {  // they fall in on each other, and fly apart
      for (DiskSpec& d : story.disks) {
        if (d.kind == engine::BodyKind::Dynamic) d.velocity -= 0.3 * d.position;
      }
    }
    story.length = random_.uniform(1, 6);
    add_commands(story, 6 + random_.below(24));
    return story;
  }

  /// Each kind in turn.
  Story any() {
    switch (turn_++ % kKinds) {
      case 0:
        return gas();
      case 1:
        return cluster();
      case 2:
        return chains();
      case 3:
        return machines();
      case 4:
        return lattice();
      case 5:
        return periodic();
      default:
        return busy();
    }
  }

  /// Instants to tick at, at odd distances.
  std::vector<double> odd_ticks(const Story& story) {
    std::vector<double> ticks;
    double t = 0;
    while (t < story.length) {
      t += story.length * random_.decades(-4, -1);
      ticks.push_back(t);
      if (random_.one_in(8)) ticks.push_back(t);  // twice at one instant
    }
    return ticks;
  }

 private:
  Story boxed(const char* name) {
    Story story;
    story.name = name;
    story.low = {-10, -10};
    story.high = {10, 10};
    story.walls = box(1000, story.low, story.high);
    story.is_closed = true;
    story.length = random_.uniform(2, 20);
    return story;
  }

  double random_radius() {
    return random_.one_in(3) ? random_.decades(-3, 0) : random_.uniform(0.3, 1);
  }

  Vector2 random_velocity() {
    const double v = random_.one_in(6) ? random_.decades(-3, 1.5) : 1.0;
    return {random_.uniform(-v, v), random_.uniform(-v, v)};
  }

  DiskSpec random_disk(const Story& story,
                       Id id,
                       std::uint64_t fixed_one_in,
                       std::uint64_t kinematic_one_in) {
    const double r = random_radius();
    DiskSpec d = disk(id,
                      {random_.uniform(story.low.x() + r, story.high.x() - r),
                       random_.uniform(story.low.y() + r, story.high.y() - r)},
                      random_velocity(),
                      r,
                      random_.one_in(2) ? 1 : random_.decades(-4, 4));
    if (fixed_one_in != 0 && random_.one_in(fixed_one_in)) {
      d.kind = engine::BodyKind::Static;
      d.velocity.setZero();
    } else if (kinematic_one_in != 0 && random_.one_in(kinematic_one_in)) {
      d.kind = engine::BodyKind::Kinematic;
    }
    if (random_.one_in(4)) d.spin = random_.uniform(-9, 9);
    return d;
  }

  void scatter(Story& story,
               std::uint64_t count,
               std::uint64_t fixed_one_in,
               std::uint64_t kinematic_one_in) {
    for (Id id = 1; id <= count; ++id) {
      story.disks.push_back(random_disk(story, id, fixed_one_in, kinematic_one_in));
    }
    shuffle_ids(story);
    remove_overlapping(story);
  }

  /// Leaves the disks that fit when all are put in one after the other.
  static void remove_overlapping(Story& story) {
    World world(engine::WorldOptions{.start = {}, .period = story.period});
    must_spawn(world, {}, story.walls);
    std::erase_if(story.disks, [&](const DiskSpec& d) {
      return !world.spawn({std::span(&d, 1), {}}).ok();
    });
  }

  void shuffle_ids(Story& story) {
    for (std::size_t i = story.disks.size(); i > 1; --i) {
      std::swap(story.disks[i - 1].id, story.disks[random_.below(i)].id);
    }
  }

  Id some_id(const Story& story) {
    const std::size_t all = story.disks.size() + story.walls.size();
    const std::size_t i = random_.below(all + 1);
    if (i < story.disks.size()) return story.disks[i].id;
    return i < all ? story.walls[i - story.disks.size()].id : 2000 + random_.below(20);
  }

  void add_commands(Story& story, std::uint64_t count) {
    story.conserves_energy = story.conserves_momentum = story.is_closed = false;
    std::vector<double> instants;
    for (std::uint64_t i = 0; i < count; ++i) {
      const bool again = !instants.empty() && random_.one_in(4);
      const double whole =
          static_cast<double>(random_.below(1 + static_cast<std::uint64_t>(story.length)));
      instants.push_back(again               ? instants.back()
                         : random_.one_in(3) ? whole
                                             : random_.uniform(0, story.length));
    }
    std::sort(instants.begin(), instants.end());
    Id fresh = 2000;
    for (const double after : instants) story.steps.push_back(random_step(story, after, fresh));
  }

  Step random_step(const Story& story, double after, Id& fresh) {
    Step step;
    step.after = after;
    switch (random_.below(6)) {
      case 0:
        step.removed = {some_id(story)};
        break;
      case 1:
        step.impulses = {{some_id(story), random_velocity()}};
        break;
      case 2:
      case 3:
        step.velocities = {{some_id(story), random_velocity()}};
        break;
      case 4: {
        const Vector2 from(random_.uniform(-8, 8), random_.uniform(-8, 8));
        step.walls = {wall(fresh++, from, from + random_velocity() + Vector2(0.1, 0.1))};
        break;
      }
      default:
        step.disks = {random_disk(story, fresh++, 8, 8)};
        break;
    }
    return step;
  }

  Random random_;
  std::uint64_t turn_ = 0;
};

}  // namespace stoss::test

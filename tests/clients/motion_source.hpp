// SPDX-License-Identifier: Apache-2.0
#pragma once

// A world that publishes its motions as the daemon does, without DDS: for tests of replicas.

#include <stoss/client/motion_part.hpp>
#include <stoss/client/query.hpp>
#include <stoss/engine/world.hpp>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace stoss::client {

class MotionSource {
 public:
  explicit MotionSource(std::uint64_t seed,
                        engine::Arithmetic arithmetic = engine::Arithmetic::Double,
                        const engine::Vector2& period = engine::Vector2::Zero())
      : random_(seed), world_({.start = {}, .arithmetic = arithmetic, .period = period}) {
    fill();
    static_cast<void>(world_.drain_changes());
  }

  /// A tick later, after some random commands; its changes in parts of at most `part_size`.
  std::vector<MotionPart> tick(std::size_t part_size = 1000) {
    ++tick_;
    const engine::Instant until = {static_cast<std::int64_t>(tick_ / 10),
                                   (tick_ % 10) * (~std::uint64_t{0} / 10)};
    command();
    static_cast<void>(world_.advance_to(until).ok());
    return parts_of(world_.drain_changes(), part_size);
  }

  /// The answer to Query::world().
  [[nodiscard]] Answer whole() const {
    Answer answer;
    answer.at = world_.now();
    answer.tick = tick_;
    answer.epoch = epoch_;
    answer.motion_number = number_;
    answer.state_hash = world_.state_hash();
    for (const engine::Id id : world_.ids()) {
      answer.motions.push_back(world_.motion(id).value());
      answer.statics.push_back(world_.body(id).value());
    }
    return answer;
  }

  /// Begins a new epoch with the world as it is, as a reset does.
  MotionPart next_epoch() {
    ++epoch_;
    number_ = 1;
    MotionPart part;
    stamp(part, number_);
    return part;
  }

  [[nodiscard]] const engine::World& world() const { return world_; }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void fill() {
    std::vector<engine::DiskSpec> disks;
    for (int i = 0; i < 100; ++i) {
      engine::DiskSpec disk;
      disk.position = {2.0 * (i % 10), 2.0 * (i / 10)};
      disk.velocity = {uniform(-3, 3), uniform(-3, 3)};
      disk.radius = uniform(0.1, 0.9);
      disks.push_back(disk);
    }
    const std::vector<engine::WallSpec> walls = {{.start = {-2, -2}, .end = {20, -2}},
                                                 {.start = {20, -2}, .end = {20, 20}},
                                                 {.start = {20, 20}, .end = {-2, 20}},
                                                 {.start = {-2, 20}, .end = {-2, -2}}};
    static_cast<void>(world_.spawn({disks, walls}).ok());
  }

  /// Refusals are as good as anything: they change nothing.
  void command() {
    const std::vector<engine::Id> ids = world_.ids();
    const engine::Id id = ids[random_() % ids.size()];
    switch (random_() % 4) {
      case 0: {
        const engine::DiskSpec disk{.position = {uniform(0, 18), uniform(0, 18)},
                                    .velocity = {uniform(-3, 3), 0},
                                    .radius = 0.1};
        static_cast<void>(world_.spawn({std::span(&disk, 1), {}}).ok());
        break;
      }
      case 1:
        if (world_.body(id).value().is_wall) break;
        static_cast<void>(world_.remove(std::span(&id, 1)).ok());
        break;
      case 2: {
        const engine::VectorFor velocity{id, {uniform(-3, 3), uniform(-3, 3)}};
        if (world_.body(id).value().is_wall) break;
        static_cast<void>(world_.set_velocity(std::span(&velocity, 1)).ok());
        break;
      }
      default:
        break;
    }
  }

  void stamp(MotionPart& part, std::uint64_t number) const {
    part.epoch = epoch_;
    part.number = number;
    part.tick = tick_;
    part.at = world_.now();
    part.arithmetic = world_.arithmetic();
    part.period = world_.period();
    part.state_hash = world_.state_hash();
  }

  std::vector<MotionPart> parts_of(const std::vector<engine::Change>& changes,
                                   std::size_t part_size) {
    std::vector<MotionPart> parts;
    for (const engine::Change& change : changes) {
      if (parts.empty() || parts.back().changes.size() == part_size) parts.emplace_back();
      MotionChange record{change.kind, {}};
      record.motion.id = change.id;
      if (change.kind != engine::ChangeKind::Removed) {
        record.motion = world_.motion(change.id).value();
      }
      parts.back().changes.push_back(record);
      if (change.kind == engine::ChangeKind::Spawned) {
        parts.back().statics.push_back(world_.body(change.id).value());
      }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      stamp(parts[i], ++number_);
      parts[i].part = static_cast<std::uint32_t>(i);
      parts[i].parts = static_cast<std::uint32_t>(parts.size());
    }
    return parts;
  }

  std::mt19937_64 random_;
  engine::World world_;
  std::uint64_t tick_ = 0;
  std::uint64_t epoch_ = 1;
  std::uint64_t number_ = 0;
};

}  // namespace stoss::client

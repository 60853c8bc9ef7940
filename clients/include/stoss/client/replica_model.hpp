// SPDX-License-Identifier: Apache-2.0
// A copy of a world's stored motions, kept up to date by published changes. No DDS in here.
//
// Thread safety: none; Replica adds it.
//
// Invariants:
//  1. What can be seen is the world after a whole tick, never between two parts of one.
//  2. While complete(), every change up to number() has been applied, each once, in order.
//  3. What waits to be applied is bounded by kPartsWaitingMax parts.
#pragma once

#include <stoss/client/motion_part.hpp>
#include <stoss/client/query.hpp>
#include <stoss/engine/motion.hpp>
#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stoss::client {

/// The parts kept while the whole world is awaited: a minute of a busy world. Beyond them the
/// oldest go, and the world has to be asked for once more.
inline constexpr std::size_t kPartsWaitingMax = 8192;

/// A body of a replica: its stored motion, and what else makes it.
struct ReplicaBody {
  engine::MotionRecord motion;
  engine::BodyRecord body;
};

/// How far a replica is.
struct ReplicaStamp {
  std::uint64_t epoch = 0;
  std::uint64_t number = 0;  ///< the last motion batch applied
  std::uint64_t tick = 0;
  engine::Instant at;            ///< that tick's instant
  std::uint64_t state_hash = 0;  ///< the daemon's, after that tick; 0 when it did not tell
};

struct ReplicaCounters {
  std::uint64_t parts = 0;           ///< applied
  std::uint64_t changes = 0;         ///< applied
  std::uint64_t ignored = 0;         ///< parts that were older than what is held
  std::uint64_t gaps = 0;            ///< numbers found missing
  std::uint64_t epochs = 0;          ///< changes of epoch seen
  std::uint64_t loads = 0;           ///< whole worlds taken in
  std::uint64_t overflows = 0;       ///< waiting parts dropped
  std::uint64_t contradictions = 0;  ///< changes of bodies that are not there, parts out of place
};

class ReplicaModel {
 public:
  /// `arithmetic` and `period` are the daemon's, as its status tells them.
  explicit ReplicaModel(engine::Arithmetic arithmetic = engine::Arithmetic::Double,
                        const engine::Vector2& period = engine::Vector2::Zero())
      : arithmetic_(arithmetic), period_(period) {}

  /// Takes in a part. Called once per received sample, in any order of epochs and numbers.
  void apply(MotionPart part);
  /// Takes in the answer to Query::world(), then whatever waits behind it.
  void load(const Answer& world);
  /// Forgets everything but what waits; a whole world is needed again.
  void invalidate();

  /// Whether the whole world is here. False: ask for it and load() it.
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const ReplicaStamp& stamp() const { return stamp_; }
  [[nodiscard]] const ReplicaCounters& counters() const { return counters_; }
  [[nodiscard]] engine::Arithmetic arithmetic() const { return arithmetic_; }
  /// m; 0: open.
  [[nodiscard]] const engine::Vector2& period() const { return period_; }
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

  /// Called after every tick applied and every world loaded, while complete(). May be empty.
  std::function<void(const ReplicaModel&)> on_tick;

  /// Every body in the order of ids.
  template <class F>
  void for_each(F&& visit) const {
    for (const Place& place : order_) visit(bodies_[place.slot]);
  }
  /// Null when there is none of this id.
  [[nodiscard]] const ReplicaBody* find(engine::Id id) const;

  /// What the daemon's world evaluates a body to at an instant, to the same bits, as long as no
  /// event of the body lies between the stamp's instant and that one.
  [[nodiscard]] engine::BodyState disk_at(const ReplicaBody& body,
                                          const engine::Instant& instant) const;
  [[nodiscard]] engine::WallState wall_at(const ReplicaBody& body,
                                          const engine::Instant& instant) const;

 private:
  struct Place {
    engine::Id id;
    std::uint32_t slot;
  };

  void wait(MotionPart part);
  void apply_waiting();
  void stage(MotionPart part);
  void apply_tick();
  [[nodiscard]] bool apply_part(const MotionPart& part);
  void insert(const engine::MotionRecord& motion, const engine::BodyRecord& body);
  [[nodiscard]] bool remove(engine::Id id);
  void restore_order();
  void clear();
  void tell() const {
    if (on_tick) on_tick(*this);
  }

  std::vector<ReplicaBody> bodies_;  ///< by slot; slots of removed bodies are used again
  std::vector<std::uint32_t> free_;
  std::vector<Place> order_;  ///< sorted by id
  std::unordered_map<engine::Id, std::uint32_t> slot_of_;
  std::vector<Place> inserted_;  ///< by the tick being applied, not yet in order_
  bool removed_ = false;         ///< the tick being applied removes something

  std::vector<MotionPart> staged_;  ///< the parts so far of the tick that is arriving
  std::deque<MotionPart> waiting_;  ///< parts that came before the whole world, by number
  ReplicaStamp stamp_;
  std::uint64_t next_ = 0;  ///< the number of the next part to stage
  engine::Arithmetic arithmetic_;
  engine::Vector2 period_;
  bool complete_ = false;
  ReplicaCounters counters_;
};

}  // namespace stoss::client

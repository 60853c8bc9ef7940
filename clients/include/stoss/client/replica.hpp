// SPDX-License-Identifier: Apache-2.0
// The whole exact world at the client, kept up to date by itself.
#pragma once

#include <stoss/client/replica_model.hpp>
#include <stoss/client/session.hpp>
#include <stoss/engine/types.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace stoss::client {

struct ReplicaOptions {
  /// Called on the replica's thread after every tick applied and every world loaded, with the
  /// replica locked: it sees that tick's world, and must be quick and call nothing of the replica.
  std::function<void(const ReplicaModel&)> on_tick{};
};

/// Subscribes to the motions, asks for the world, and joins the two; does so again by itself when a
/// sample was missed or the world was reset. Thread-safe: any thread may look at it. Must not
/// outlive its session.
///
/// Every evaluation is that of the daemon's engine, to the bit (see engine::evaluate), as long as
/// no later event has changed the body.
class Replica {
 public:
  explicit Replica(Session& session, ReplicaOptions options = {});
  ~Replica();
  Replica(const Replica&) = delete;
  Replica& operator=(const Replica&) = delete;

  /// Waits until the whole world is here; false when that takes longer than `timeout`.
  bool wait_until_complete(Milliseconds timeout);
  /// Waits until a batch of this number or a later one of its epoch, or a later epoch, is applied.
  bool wait_for_number(std::uint64_t epoch, std::uint64_t number, Milliseconds timeout);

  /// Whether the world is whole and, as far as is known, up to date.
  [[nodiscard]] bool complete() const;
  [[nodiscard]] ReplicaStamp stamp() const;
  [[nodiscard]] ReplicaCounters counters() const;
  /// From the replica's making to its first completeness.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> time_to_complete() const;

  /// The present of the last tick applied and everything in it.
  struct Snapshot {
    ReplicaStamp stamp;
    engine::Arithmetic arithmetic = engine::Arithmetic::Double;
    engine::Vector2 period = engine::Vector2::Zero();  ///< m; 0: open
    std::vector<ReplicaBody> bodies;                   ///< in the order of ids
  };
  [[nodiscard]] Snapshot snapshot() const;

  /// Nothing when there is no such disk.
  [[nodiscard]] std::optional<engine::BodyState> disk(engine::Id id,
                                                      const engine::Instant& at) const;
  /// All disks, or all walls, in the order of ids, at an instant; without one at the last tick's.
  [[nodiscard]] std::vector<engine::BodyState> disks(
      std::optional<engine::Instant> at = std::nullopt) const;
  [[nodiscard]] std::vector<engine::WallState> walls(
      std::optional<engine::Instant> at = std::nullopt) const;
  /// The zones as the scene topic tells them: up to a quarter of a second late.
  [[nodiscard]] std::vector<engine::ZoneState> zones() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stoss::client

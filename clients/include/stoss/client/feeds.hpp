// SPDX-License-Identifier: Apache-2.0
// What a world publishes, as streams to read from. Each feed belongs to one thread at a time; a
// thread that reads too slowly loses the oldest samples and nobody else notices. A feed starts with
// what is published after it was made (frames, scene and status: with the latest), and must not
// outlive its session.
#pragma once

#include <stoss/client/motion_part.hpp>
#include <stoss/client/session.hpp>
#include <stoss/client/status.hpp>
#include <stoss/engine/types.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stoss::client {

struct FrameBody {
  engine::Id id = engine::kNoId;
  engine::Vector2 position = engine::Vector2::Zero();
  engine::Vector2 velocity = engine::Vector2::Zero();
  double angle = 0;
  double spin = 0;
  double radius = 0;  ///< m; 0 while none has grown: those of the scene hold
};

/// All disks at one instant.
struct Frame {
  std::uint64_t epoch = 0;
  std::uint64_t tick = 0;
  engine::Instant at{};
  std::vector<FrameBody> bodies{};
};

class FrameFeed {
 public:
  explicit FrameFeed(const Session& session);
  ~FrameFeed();
  FrameFeed(FrameFeed&&) noexcept;
  FrameFeed& operator=(FrameFeed&&) noexcept;
  /// The newest whole frame that was not given out yet, waiting at most `timeout` for it.
  std::optional<Frame> next(Milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Consecutive collisions.
struct CollisionRun {
  std::uint64_t epoch = 0;
  std::uint64_t lost = 0;  ///< collisions right before these that the daemon no longer had
  std::vector<engine::Collision> collisions{};
};

struct CollisionFeedCounters {
  std::uint64_t gaps = 0;     ///< batches found missing
  std::uint64_t refills = 0;  ///< questions that filled one
  std::uint64_t lost = 0;     ///< collisions that could not be had any more
};

/// Collisions in their order. A gap in the numbers is filled by asking the daemon.
class CollisionFeed {
 public:
  /// `since`: the number of the first collision wanted; else starts with the next that happens.
  explicit CollisionFeed(Session& session, std::optional<std::uint64_t> since = std::nullopt);
  ~CollisionFeed();
  CollisionFeed(CollisionFeed&&) noexcept;
  CollisionFeed& operator=(CollisionFeed&&) noexcept;
  /// The next collisions, waiting at most `timeout` (and, in a gap, for the session's).
  std::optional<CollisionRun> next(Milliseconds timeout);
  [[nodiscard]] CollisionFeedCounters counters() const;
  /// Whether the daemon is matched, so that nothing published from now on is missed.
  [[nodiscard]] bool matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Consecutive zone events.
struct ZoneRun {
  std::uint64_t epoch = 0;
  std::uint64_t lost = 0;  ///< events right before these that the daemon no longer had
  std::vector<engine::ZoneEvent> events{};
};

/// Who enters and leaves zones, in order. A gap in the numbers is filled by asking the daemon.
class ZoneFeed {
 public:
  /// `since`: the number of the first event wanted; else starts with the next that happens.
  explicit ZoneFeed(Session& session, std::optional<std::uint64_t> since = std::nullopt);
  ~ZoneFeed();
  ZoneFeed(ZoneFeed&&) noexcept;
  ZoneFeed& operator=(ZoneFeed&&) noexcept;
  /// The next events, waiting at most `timeout` (and, in a gap, for the session's).
  std::optional<ZoneRun> next(Milliseconds timeout);
  /// As of CollisionFeed.
  [[nodiscard]] bool matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The raw changes of motions, in the order of arrival; what a ReplicaModel applies.
class MotionFeed {
 public:
  explicit MotionFeed(const Session& session);
  ~MotionFeed();
  MotionFeed(MotionFeed&&) noexcept;
  MotionFeed& operator=(MotionFeed&&) noexcept;
  std::optional<MotionPart> next(Milliseconds timeout);
  [[nodiscard]] bool matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A watched body, or the news that a slot holds none any more: it was removed, or nobody watches
/// it.
struct BodyUpdate {
  std::uint32_t slot = 0;
  std::uint64_t epoch = 0;
  bool gone = false;
  bool wall = false;
  engine::BodyState state{};  ///< without meaning when gone
};

/// The bodies that somebody watches (Command::watch).
class BodyFeed {
 public:
  explicit BodyFeed(const Session& session);
  ~BodyFeed();
  BodyFeed(BodyFeed&&) noexcept;
  BodyFeed& operator=(BodyFeed&&) noexcept;
  std::optional<BodyUpdate> next(Milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

class StatusFeed {
 public:
  explicit StatusFeed(const Session& session);
  ~StatusFeed();
  StatusFeed(StatusFeed&&) noexcept;
  StatusFeed& operator=(StatusFeed&&) noexcept;
  std::optional<Status> next(Milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What of a world changes rarely.
struct SceneImage {
  struct DiskShape {
    engine::Id id = engine::kNoId;
    engine::BodyKind kind = engine::BodyKind::Dynamic;
    double radius = 0;
    double mass = 0;
  };

  std::uint64_t epoch = 0;
  std::uint64_t version = 0;
  std::string world;
  std::string scene_name;
  engine::Instant at;  ///< what the walls are given for
  engine::Vector2 period = engine::Vector2::Zero();
  std::vector<std::string> effects;
  std::vector<DiskShape> disks;
  std::vector<engine::WallState> walls;
  std::vector<engine::ZoneState> zones;
  std::vector<std::pair<engine::Id, std::string>> names;
};

class SceneFeed {
 public:
  explicit SceneFeed(const Session& session);
  ~SceneFeed();
  SceneFeed(SceneFeed&&) noexcept;
  SceneFeed& operator=(SceneFeed&&) noexcept;
  /// The newest whole scene that was not given out yet.
  std::optional<SceneImage> next(Milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stoss::client

// SPDX-License-Identifier: Apache-2.0
// The engine's records as structures of arrays, and back. A block on the wire is lent a slice of
// these arrays and copies nothing; samples are cut to the bounds of the types by their senders.
#pragma once

#include <stoss/engine/types.hpp>
#include <stoss/translate/basics.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stoss::translate {

/// A column that stays empty as long as every value is zero, as the wire allows.
class SparseColumn {
 public:
  /// Appends the value of row `row`, the number of rows before it.
  void append(std::size_t row, double value) {
    if (value == 0 && values_.empty()) return;
    values_.resize(row, 0.0);
    values_.push_back(value);
  }
  void clear() { values_.clear(); }
  /// The values of `rows` rows, or none when all are zero.
  [[nodiscard]] const std::vector<double>& padded(std::size_t rows) {
    return values_.empty() ? values_ : filled(rows);
  }
  /// The values of `rows` rows, zeros and all.
  [[nodiscard]] const std::vector<double>& filled(std::size_t rows) {
    values_.resize(rows, 0.0);
    return values_;
  }

 private:
  std::vector<double> values_;
};

/// Rows of a StateBlock: disks, and walls by their start points.
class StateColumns {
 public:
  void append(const engine::BodyState& state);
  void append(const engine::WallState& wall);
  /// As above, with the distance that a search by nearness found.
  void append(const engine::BodyState& state, double distance);
  void append(const engine::WallState& wall, double distance);
  void clear();
  void reserve(std::size_t rows);
  [[nodiscard]] std::size_t size() const { return id_.size(); }
  /// Points the block at `count` rows from `first` on; this must outlive the write.
  void lend(wire::StateBlock& block, std::size_t first, std::size_t count);

 private:
  std::vector<std::uint64_t> id_;
  std::vector<std::uint8_t> kind_;
  std::vector<double> x_, y_, vx_, vy_, radius_, distance_;
  SparseColumn angle_, spin_;
};

/// Rows of a WallBlock.
class WallColumns {
 public:
  void append(const engine::WallState& wall);
  void append(const engine::WallSpec& wall);
  void clear();
  [[nodiscard]] std::size_t size() const { return id_.size(); }
  void lend(wire::WallBlock& block, std::size_t first, std::size_t count) const;

 private:
  std::vector<std::uint64_t> id_;
  std::vector<double> start_x_, start_y_, end_x_, end_y_, vx_, vy_;
};

/// Rows of a MotionBlock.
class MotionColumns {
 public:
  /// For ChangeKind::Removed only the id and the instant `since` of the record are read.
  void append(engine::ChangeKind change, const engine::MotionRecord& motion);
  void clear();
  void reserve(std::size_t rows);
  [[nodiscard]] std::size_t size() const { return id_.size(); }
  void lend(wire::MotionBlock& block, std::size_t first, std::size_t count);

 private:
  std::vector<std::uint64_t> id_;
  std::vector<std::uint8_t> change_, law_;
  std::vector<double> x_, y_, x_low_, y_low_, vx_, vy_, vx_low_, vy_low_;
  std::vector<std::int64_t> seconds_;
  std::vector<std::uint64_t> fraction_;
  SparseColumn angle_, spin_, ax_, ay_, ax_low_, ay_low_, rate_;
};

/// Rows of a StaticBlock.
class StaticColumns {
 public:
  void append(const engine::BodyRecord& body);
  void clear();
  void reserve(std::size_t rows);
  [[nodiscard]] std::size_t size() const { return id_.size(); }
  void lend(wire::StaticBlock& block, std::size_t first, std::size_t count);

 private:
  std::vector<std::uint64_t> id_;
  std::vector<std::uint8_t> kind_;
  std::vector<double> radius_, mass_;
  SparseColumn edge_x_, edge_y_, edge_x_low_, edge_y_low_;
  bool has_wall_ = false;
};

/// Rows of a CollisionBlock.
class CollisionColumns {
 public:
  void append(const engine::Collision& collision);
  void clear();
  [[nodiscard]] std::size_t size() const { return a_.size(); }
  void lend(wire::CollisionBlock& block, std::size_t first, std::size_t count);

 private:
  std::vector<std::int64_t> seconds_;
  std::vector<std::uint64_t> fraction_, a_, b_;
  std::vector<std::uint8_t> kind_, flags_;
  std::vector<double> point_x_, point_y_, normal_x_, normal_y_, impulse_, approach_speed_;
  std::vector<double> velocity_a_x_, velocity_a_y_, velocity_b_x_, velocity_b_y_;
  SparseColumn spin_a_, spin_b_;
};

/// Rows of a ZoneEventBlock.
class ZoneEventColumns {
 public:
  void append(const engine::ZoneEvent& event);
  void clear() { *this = ZoneEventColumns(); }
  [[nodiscard]] std::size_t size() const { return zone_.size(); }
  void lend(wire::ZoneEventBlock& block, std::size_t first, std::size_t count) const;

 private:
  std::vector<std::int64_t> seconds_;
  std::vector<std::uint64_t> fraction_, zone_, body_;
  struct Flag {  // for std::vector<bool> has no array to lend
    bool on = false;
  };
  std::vector<Flag> entered_;
  std::vector<double> x_, y_, vx_, vy_;
};

/// Rows of a HitBlock.
class HitColumns {
 public:
  void append(const engine::RayHit& hit);
  [[nodiscard]] std::size_t size() const { return id_.size(); }
  void lend(wire::HitBlock& block, std::size_t first, std::size_t count) const;

 private:
  std::vector<std::uint64_t> id_;
  std::vector<double> distance_, x_, y_, normal_x_, normal_y_;
};

// The way back. A received block is consistent when its arrays have one length, but for those that
// may be empty; only then may its rows be read. A kind or change that is not known here makes a
// block inconsistent too.

[[nodiscard]] bool consistent(const wire::StateBlock& block);
[[nodiscard]] bool consistent(const wire::WallBlock& block);
[[nodiscard]] bool consistent(const wire::MotionBlock& block);
[[nodiscard]] bool consistent(const wire::StaticBlock& block);
[[nodiscard]] bool consistent(const wire::CollisionBlock& block);
[[nodiscard]] bool consistent(const wire::ZoneEventBlock& block);
[[nodiscard]] bool consistent(const wire::HitBlock& block);

[[nodiscard]] engine::MotionRecord motion_at(const wire::MotionBlock& block, std::size_t i);
[[nodiscard]] engine::Change change_at(const wire::MotionBlock& block, std::size_t i);
[[nodiscard]] engine::BodyRecord body_at(const wire::StaticBlock& block, std::size_t i);
/// REQUIRES: the row is not a wall's.
[[nodiscard]] engine::BodyState state_at(const wire::StateBlock& block,
                                         const engine::Instant& at,
                                         std::size_t i);
[[nodiscard]] engine::WallState wall_at(const wire::WallBlock& block,
                                        const engine::Instant& at,
                                        std::size_t i);
/// `first_number` is that of the block's first row.
[[nodiscard]] engine::Collision collision_at(const wire::CollisionBlock& block,
                                             std::uint64_t first_number,
                                             std::size_t i);
[[nodiscard]] engine::ZoneEvent zone_event_at(const wire::ZoneEventBlock& block,
                                              std::uint64_t first_number,
                                              std::size_t i);
[[nodiscard]] engine::RayHit hit_at(const wire::HitBlock& block, std::size_t i);

}  // namespace stoss::translate

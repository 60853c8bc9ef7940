// SPDX-License-Identifier: Apache-2.0
// A received Command in the engine's words, and the way back for clients.
#pragma once

#include <stoss/engine/features.hpp>
#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/translate/basics.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stoss::translate {

/// A name for one of a command's new bodies.
struct NamedPart {
  std::uint64_t of = 0;  ///< position in disks, then walls, then zones
  std::string text;
};

/// A command as plain data; what its operation does not use is empty.
struct CommandSpec {
  RequestId request;
  std::uint16_t op = 0;  ///< idl::Op, or a number that is newer than this program
  std::optional<engine::Instant> at;
  engine::Instant target;
  double value = 0;
  std::uint64_t count = 0;
  std::string label;
  std::vector<engine::Id> ids;
  std::vector<engine::VectorFor> vectors;  ///< ids with x, y; for OP_SET_VELOCITY, OP_APPLY_IMPULSE
  std::vector<engine::DiskSpec> disks;
  std::vector<engine::WallSpec> walls;
  std::vector<engine::ZoneSpec> zones;
  std::vector<NamedPart> names;
  std::vector<std::string> effects_off;         ///< OP_SET_EFFECTS: these first
  std::vector<engine::EffectSetting> settings;  ///< OP_SET_EFFECTS: then these

  /// Roughly the memory that it holds, in bytes; what a queue's bound counts.
  [[nodiscard]] std::size_t footprint() const;
};

/// Errors: Unimplemented for another protocol version; InvalidArgument for arrays of
/// a block whose lengths differ, an unknown kind of body, a name of nothing, more than
/// stoss_v1_MAX_COMMAND_BODIES bodies in all; each names the field. Values are the engine's to
/// judge.
[[nodiscard]] engine::Outcome<CommandSpec> command_of(const wire::Command& command);

/// The arrays of a DiskBlock, filled disk by disk.
class DiskColumns {
 public:
  DiskColumns() = default;
  explicit DiskColumns(const std::vector<engine::DiskSpec>& disks);
  void append(const engine::DiskSpec& disk);
  /// Points the block at these arrays, which must outlive the write.
  void lend(wire::DiskBlock& block) const;
  [[nodiscard]] std::size_t size() const { return id_.size(); }

 private:
  std::vector<std::uint64_t> id_;
  std::vector<std::uint8_t> kind_;
  std::vector<double> x_, y_, vx_, vy_, radius_, mass_, angle_, spin_;
};

/// Likewise of a ZoneBlock.
class ZoneColumns {
 public:
  ZoneColumns() = default;
  explicit ZoneColumns(const std::vector<engine::ZoneSpec>& zones);
  void lend(wire::ZoneBlock& block) const;

 private:
  std::vector<std::uint64_t> id_;
  std::vector<double> x_, y_, radius_;
};

}  // namespace stoss::translate

// SPDX-License-Identifier: Apache-2.0
// Requests to change a world.
#pragma once

#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/translate/command.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stoss::client {

/// The most bodies that one command may name or make; all of them are changed or none.
inline constexpr std::size_t kCommandBodiesMax = 1024;

/// One request. Made by the functions below; applied at the world's next tick (at once, when it is
/// paused), or at the instant given to at().
class Command {
 public:
  /// Brings bodies and zones in; the reply's ids are theirs: disks, walls, zones. Id 0 asks the
  /// world for one.
  static Command spawn(std::vector<engine::DiskSpec> disks,
                       std::vector<engine::WallSpec> walls = {},
                       std::vector<engine::ZoneSpec> zones = {});
  static Command remove(std::vector<engine::Id> ids);
  /// In m/s, for disks and walls.
  static Command set_velocity(std::vector<engine::VectorFor> velocities);
  /// In kg m/s, for dynamic disks.
  static Command apply_impulse(std::vector<engine::VectorFor> impulses);
  /// Switches effects off ("gravity"), then sets numbers ("gravity.acceleration.y"); a number of an
  /// effect that is off switches it on.
  static Command set_effects(std::vector<std::string> off,
                             std::vector<engine::EffectSetting> settings);
  static Command pause();
  static Command resume();
  /// Runs so many ticks, then pauses.
  static Command step(std::uint64_t ticks);
  /// Runs so many simulated seconds, then pauses.
  static Command run_for(double seconds);
  /// Runs to an instant of the world's clock, then pauses.
  static Command run_to(const engine::Instant& target);
  /// In simulated seconds per real second; infinity: as fast as possible.
  static Command set_speed(double speed);
  /// Back to the scene as loaded.
  static Command reset();
  /// Publishes the bodies one by one on the body topic.
  static Command watch(std::vector<engine::Id> ids);
  static Command unwatch(std::vector<engine::Id> ids);

  /// Applies the command at exactly this instant of the world's clock, between ticks if need be.
  Command& at(const engine::Instant& instant);
  /// Names for new bodies, each by its position in disks, then walls, then zones.
  Command& names(std::vector<translate::NamedPart> names);

  [[nodiscard]] const translate::CommandSpec& spec() const { return spec_; }

 private:
  explicit Command(idl::Op op);
  translate::CommandSpec spec_;
};

/// What the world says to a command that it applied.
struct Reply {
  engine::Instant at{};           ///< when the command took effect
  std::uint64_t tick = 0;         ///< the tick that applied it
  std::uint64_t epoch = 0;        ///< raised by every reset
  bool duplicate = false;         ///< this repeats the reply to a command that was sent again
  std::vector<engine::Id> ids{};  ///< of the bodies made, in the order of the request
};

}  // namespace stoss::client

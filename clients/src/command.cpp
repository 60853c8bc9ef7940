// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/command.hpp>

#include <utility>

namespace stoss::client {

static_assert(kCommandBodiesMax == stoss_v1_MAX_COMMAND_BODIES);

Command::Command(idl::Op op) { spec_.op = idl::wire_value(op); }

Command Command::spawn(std::vector<engine::DiskSpec> disks,
                       std::vector<engine::WallSpec> walls,
                       std::vector<engine::ZoneSpec> zones) {
  Command command(idl::Op::kSpawn);
  command.spec_.disks = std::move(disks);
  command.spec_.walls = std::move(walls);
  command.spec_.zones = std::move(zones);
  return command;
}

Command Command::remove(std::vector<engine::Id> ids) {
  Command command(idl::Op::kRemove);
  command.spec_.ids = std::move(ids);
  return command;
}

Command Command::set_velocity(std::vector<engine::VectorFor> velocities) {
  Command command(idl::Op::kSetVelocity);
  command.spec_.vectors = std::move(velocities);
  return command;
}

Command Command::apply_impulse(std::vector<engine::VectorFor> impulses) {
  Command command(idl::Op::kApplyImpulse);
  command.spec_.vectors = std::move(impulses);
  return command;
}

Command Command::set_effects(std::vector<std::string> off,
                             std::vector<engine::EffectSetting> settings) {
  Command command(idl::Op::kSetEffects);
  command.spec_.effects_off = std::move(off);
  command.spec_.settings = std::move(settings);
  return command;
}

Command Command::pause() { return Command(idl::Op::kPause); }
Command Command::resume() { return Command(idl::Op::kResume); }

Command Command::step(std::uint64_t ticks) {
  Command command(idl::Op::kStep);
  command.spec_.count = ticks;
  return command;
}

Command Command::run_for(double seconds) {
  Command command(idl::Op::kRunFor);
  command.spec_.value = seconds;
  return command;
}

Command Command::run_to(const engine::Instant& target) {
  Command command(idl::Op::kRunTo);
  command.spec_.target = target;
  return command;
}

Command Command::set_speed(double speed) {
  Command command(idl::Op::kSetSpeed);
  command.spec_.value = speed;
  return command;
}

Command Command::reset() { return Command(idl::Op::kReset); }

Command Command::watch(std::vector<engine::Id> ids) {
  Command command(idl::Op::kWatch);
  command.spec_.ids = std::move(ids);
  return command;
}

Command Command::unwatch(std::vector<engine::Id> ids) {
  Command command(idl::Op::kUnwatch);
  command.spec_.ids = std::move(ids);
  return command;
}

Command& Command::at(const engine::Instant& instant) {
  spec_.at = instant;
  return *this;
}

Command& Command::names(std::vector<translate::NamedPart> names) {
  spec_.names = std::move(names);
  return *this;
}

}  // namespace stoss::client

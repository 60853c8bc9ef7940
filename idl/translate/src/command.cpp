// SPDX-License-Identifier: Apache-2.0
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/command.hpp>

#include <string>
#include <utility>

namespace stoss::translate {
namespace {

using engine::Code;
using engine::Reject;
using idl::at_or;

Reject invalid(std::string field, std::string reason) {
  return {.code = Code::InvalidArgument, .field = std::move(field), .reason = std::move(reason)};
}

// One array of a block: its name and length, and whether it may be empty.
struct Length {
  const char* name;
  std::size_t length;
  bool may_be_empty;
};

// The array whose length is not the block's, if there is one.
std::optional<Reject> check_lengths(std::initializer_list<Length> arrays, std::size_t rows) {
  for (const Length& array : arrays) {
    if (array.length == rows || (array.may_be_empty && array.length == 0)) continue;
    return invalid(array.name,
                   "has " + std::to_string(array.length) + " elements where " +
                       std::to_string(rows) + " are needed");
  }
  return std::nullopt;
}

std::optional<Reject> check_shape(const wire::DiskBlock& block) {
  return check_lengths({{"disks.y", block.y._length, false},
                        {"disks.radius", block.radius._length, false},
                        {"disks.id", block.id._length, true},
                        {"disks.kind", block.kind._length, true},
                        {"disks.vx", block.vx._length, true},
                        {"disks.vy", block.vy._length, true},
                        {"disks.mass", block.mass._length, true},
                        {"disks.angle", block.angle._length, true},
                        {"disks.spin", block.spin._length, true}},
                       block.x._length);
}

std::optional<Reject> check_shape(const wire::WallBlock& block) {
  return check_lengths({{"walls.start_y", block.start_y._length, false},
                        {"walls.end_x", block.end_x._length, false},
                        {"walls.end_y", block.end_y._length, false},
                        {"walls.id", block.id._length, true},
                        {"walls.vx", block.vx._length, true},
                        {"walls.vy", block.vy._length, true}},
                       block.start_x._length);
}

std::optional<Reject> read_disks(const wire::DiskBlock& block, CommandSpec& spec) {
  if (auto reject = check_shape(block)) return reject;
  spec.disks.reserve(block.x._length);
  for (std::size_t i = 0; i < block.x._length; ++i) {
    const auto kind = body_kind_of(at_or(block.kind, i, stoss_v1_KIND_DYNAMIC));
    if (!kind) {
      Reject reject = invalid("disks.kind", "is not a disk's");
      reject.index = i;
      reject.body = at_or(block.id, i, 0);
      return reject;
    }
    spec.disks.push_back({.id = at_or(block.id, i, 0),
                          .kind = *kind,
                          .position = {block.x._buffer[i], block.y._buffer[i]},
                          .velocity = {at_or(block.vx, i, 0), at_or(block.vy, i, 0)},
                          .radius = block.radius._buffer[i],
                          .mass = at_or(block.mass, i, 1),
                          .angle = at_or(block.angle, i, 0),
                          .spin = at_or(block.spin, i, 0)});
  }
  return std::nullopt;
}

std::optional<Reject> read_walls(const wire::WallBlock& block, CommandSpec& spec) {
  if (auto reject = check_shape(block)) return reject;
  spec.walls.reserve(block.start_x._length);
  for (std::size_t i = 0; i < block.start_x._length; ++i) {
    spec.walls.push_back({.id = at_or(block.id, i, 0),
                          .start = {block.start_x._buffer[i], block.start_y._buffer[i]},
                          .end = {block.end_x._buffer[i], block.end_y._buffer[i]},
                          .velocity = {at_or(block.vx, i, 0), at_or(block.vy, i, 0)}});
  }
  return std::nullopt;
}

std::optional<Reject> read_zones(const wire::ZoneBlock& block, CommandSpec& spec) {
  if (auto reject = check_lengths({{"zones.y", block.y._length, false},
                                   {"zones.radius", block.radius._length, false},
                                   {"zones.id", block.id._length, true}},
                                  block.x._length)) {
    return reject;
  }
  spec.zones.reserve(block.x._length);
  for (std::size_t i = 0; i < block.x._length; ++i) {
    spec.zones.push_back({.id = at_or(block.id, i, 0),
                          .center = {block.x._buffer[i], block.y._buffer[i]},
                          .radius = block.radius._buffer[i]});
  }
  return std::nullopt;
}

std::optional<Reject> read_names(const wire::Command& command, CommandSpec& spec) {
  const std::size_t bodies = spec.disks.size() + spec.walls.size() + spec.zones.size();
  const auto names = idl::view(command.names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].of >= bodies) {
      Reject reject = invalid("names.of", "names the position of no new body");
      reject.index = i;
      return reject;
    }
    spec.names.push_back({names[i].of, std::string(idl::text(names[i].text))});
  }
  return std::nullopt;
}

std::optional<Reject> read_settings(const wire::Command& command, CommandSpec& spec) {
  const auto names = idl::view(command.names);
  if (auto reject = check_lengths({{"x", command.x._length, false}}, names.size())) return reject;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string name(idl::text(names[i].text));
    if (names[i].of > 1) {
      Reject reject = invalid("names.of", "must be 0 (off) or 1 (set)");
      reject.index = i;
      return reject;
    }
    if (names[i].of == 0) {
      spec.effects_off.push_back(std::move(name));
    } else {
      spec.settings.push_back({std::move(name), command.x._buffer[i]});
    }
  }
  return std::nullopt;
}

std::optional<Reject> read_targets(const wire::Command& command, CommandSpec& spec) {
  const auto ids = idl::view(command.ids);
  spec.ids.assign(ids.begin(), ids.end());
  if (spec.op != idl::wire_value(idl::Op::kSetVelocity) &&
      spec.op != idl::wire_value(idl::Op::kApplyImpulse)) {
    return std::nullopt;
  }
  if (auto reject = check_lengths(
          {{"x", command.x._length, false}, {"y", command.y._length, false}}, ids.size())) {
    return reject;
  }
  spec.vectors.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    spec.vectors.push_back({ids[i], {command.x._buffer[i], command.y._buffer[i]}});
  }
  return std::nullopt;
}

}  // namespace

std::size_t CommandSpec::footprint() const {
  std::size_t bytes =
      sizeof(CommandSpec) + label.size() + ids.size() * sizeof(engine::Id) +
      vectors.size() * sizeof(engine::VectorFor) + disks.size() * sizeof(engine::DiskSpec) +
      walls.size() * sizeof(engine::WallSpec) + zones.size() * sizeof(engine::ZoneSpec);
  for (const NamedPart& name : names) bytes += sizeof(NamedPart) + name.text.size();
  for (const std::string& name : effects_off) bytes += sizeof(std::string) + name.size();
  for (const auto& setting : settings) bytes += sizeof(setting) + setting.name.size();
  return bytes;
}

engine::Outcome<CommandSpec> command_of(const wire::Command& command) {
  if (command.protocol != idl::kProtocol) return unknown_protocol(command.protocol);
  CommandSpec spec;
  spec.request = to_engine(command.request);
  spec.op = command.op;
  if (command.timed) spec.at = to_engine(command.at);
  spec.target = to_engine(command.target);
  spec.value = command.value;
  spec.count = command.count;
  spec.label = idl::text(command.label);
  if (spec.op == idl::wire_value(idl::Op::kSetEffects)) {
    if (auto reject = read_settings(command, spec)) return *std::move(reject);
    return spec;
  }
  if (auto reject = read_targets(command, spec)) return *std::move(reject);
  if (auto reject = read_disks(command.disks, spec)) return *std::move(reject);
  if (auto reject = read_walls(command.walls, spec)) return *std::move(reject);
  if (auto reject = read_zones(command.zones, spec)) return *std::move(reject);
  if (spec.disks.size() + spec.walls.size() + spec.zones.size() > stoss_v1_MAX_COMMAND_BODIES) {
    return invalid(
        "walls",
        "one command may make at most " + std::to_string(stoss_v1_MAX_COMMAND_BODIES) + " bodies");
  }
  if (auto reject = read_names(command, spec)) return *std::move(reject);
  return spec;
}

DiskColumns::DiskColumns(const std::vector<engine::DiskSpec>& disks) {
  for (const engine::DiskSpec& disk : disks) append(disk);
}

void DiskColumns::append(const engine::DiskSpec& disk) {
  id_.push_back(disk.id);
  kind_.push_back(idl::wire_value(to_wire(disk.kind)));
  x_.push_back(disk.position.x());
  y_.push_back(disk.position.y());
  vx_.push_back(disk.velocity.x());
  vy_.push_back(disk.velocity.y());
  radius_.push_back(disk.radius);
  mass_.push_back(disk.mass);
  angle_.push_back(disk.angle);
  spin_.push_back(disk.spin);
}

void DiskColumns::lend(wire::DiskBlock& block) const {
  idl::lend(block.id, id_);
  idl::lend(block.kind, kind_);
  idl::lend(block.x, x_);
  idl::lend(block.y, y_);
  idl::lend(block.vx, vx_);
  idl::lend(block.vy, vy_);
  idl::lend(block.radius, radius_);
  idl::lend(block.mass, mass_);
  idl::lend(block.angle, angle_);
  idl::lend(block.spin, spin_);
}

ZoneColumns::ZoneColumns(const std::vector<engine::ZoneSpec>& zones) {
  for (const engine::ZoneSpec& zone : zones) {
    id_.push_back(zone.id);
    x_.push_back(zone.center.x());
    y_.push_back(zone.center.y());
    radius_.push_back(zone.radius);
  }
}

void ZoneColumns::lend(wire::ZoneBlock& block) const {
  idl::lend(block.id, id_);
  idl::lend(block.x, x_);
  idl::lend(block.y, y_);
  idl::lend(block.radius, radius_);
}

}  // namespace stoss::translate

// SPDX-License-Identifier: Apache-2.0
#include "scene_port.hpp"

#include <stoss/idl/sequence.hpp>
#include <stoss/translate/scene.hpp>

#include <algorithm>
#include <map>
#include <span>

namespace stoss::service {
namespace {

std::size_t chunks_for(std::size_t rows, std::size_t per_chunk) {
  return (rows + per_chunk - 1) / per_chunk;
}

// Rows [chunk * most, ...) of a column, at most `most`; none beyond its end.
template <class T>
std::span<const T> slice(const std::vector<T>& column, std::size_t chunk, std::size_t most) {
  const std::size_t first = std::min(chunk * most, column.size());
  return std::span<const T>(column).subspan(first, std::min(most, column.size() - first));
}

}  // namespace

void ScenePort::publish_if_due(const Picture& picture, Nanoseconds now) {
  if (published_ == picture.scene_version() || now < next_) return;
  published_ = picture.scene_version();
  const auto bodies = static_cast<std::int64_t>(picture.size());
  next_ = now + std::max(kSceneInterval, kSceneIntervalPerBody * bodies);
  publish(picture);
}

ScenePort::Columns ScenePort::columns_of(const Picture& picture) {
  Columns columns;
  picture.for_each_in_order([&](const Picture::Body& body) {
    const engine::BodyRecord& record = body.record;
    if (record.is_wall) {
      const engine::WallState wall = picture.wall_of(body);
      columns.wall_id.push_back(wall.id);
      columns.start_x.push_back(wall.start.x());
      columns.start_y.push_back(wall.start.y());
      columns.end_x.push_back(wall.end.x());
      columns.end_y.push_back(wall.end.y());
      columns.vx.push_back(wall.velocity.x());
      columns.vy.push_back(wall.velocity.y());
    } else {
      columns.disk_id.push_back(record.id);
      columns.disk_kind.push_back(idl::wire_value(translate::to_wire(record.kind)));
      columns.disk_radius.push_back(picture.state_of(body).radius);
      columns.disk_mass.push_back(record.mass);
    }
  });
  for (const engine::ZoneState& zone : picture.zones()) {
    columns.zone_id.push_back(zone.id);
    columns.zone_x.push_back(zone.center.x());
    columns.zone_y.push_back(zone.center.y());
    columns.zone_radius.push_back(zone.radius);
  }
  const std::map<engine::Id, std::string> names(picture.names().begin(), picture.names().end());
  for (const auto& [id, text] : names) {
    wire::Name& name = columns.names.emplace_back();
    name.of = id;
    idl::assign(name.text, text);
  }
  for (const std::string& effect : picture.effects()) {
    idl::assign(columns.effects.emplace_back().text, effect);
  }
  return columns;
}

void ScenePort::publish(const Picture& picture) {
  Columns columns = columns_of(picture);
  ++version_;
  const std::size_t needed = std::max({std::size_t{1},
                                       chunks_for(columns.disk_id.size(), stoss_v1_MAX_SCENE_DISKS),
                                       chunks_for(columns.wall_id.size(), stoss_v1_MAX_SCENE_WALLS),
                                       chunks_for(columns.zone_id.size(), stoss_v1_MAX_SCENE_ZONES),
                                       chunks_for(columns.names.size(), stoss_v1_MAX_SCENE_NAMES)});
  const auto chunks = static_cast<std::uint32_t>(needed);
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
    write_chunk(picture, columns, chunk, chunks);
  }
  for (std::uint32_t chunk = chunks; chunk < chunks_; ++chunk) {
    wire::SceneChunk key{};
    key.chunk = chunk;
    static_cast<void>(writer_.dispose(key));
  }
  chunks_ = chunks;
}

void ScenePort::write_chunk(const Picture& picture,
                            Columns& columns,
                            std::uint32_t chunk,
                            std::uint32_t chunks) {
  wire::SceneChunk sample{};
  sample.chunk = chunk;
  sample.chunks = chunks;
  sample.epoch = picture.moment().epoch;
  sample.version = version_;
  idl::assign(sample.world, world_);
  idl::assign(sample.scene_name, scene_name_);
  sample.at = translate::to_wire(picture.moment().at);
  sample.period_x = picture.period().x();
  sample.period_y = picture.period().y();
  static_assert(sizeof(idl::Element<decltype(sample.effects)>) == sizeof(Word));
  sample.effects._buffer = columns.effects.empty() ? nullptr : &columns.effects.front().text;
  sample.effects._length = static_cast<std::uint32_t>(columns.effects.size());
  sample.effects._maximum = sample.effects._length;
  const auto disks = [&](const auto& column) {
    return slice(column, chunk, stoss_v1_MAX_SCENE_DISKS);
  };
  const auto walls = [&](const auto& column) {
    return slice(column, chunk, stoss_v1_MAX_SCENE_WALLS);
  };
  idl::lend(sample.disk_id, disks(columns.disk_id));
  idl::lend(sample.disk_kind, disks(columns.disk_kind));
  idl::lend(sample.disk_radius, disks(columns.disk_radius));
  idl::lend(sample.disk_mass, disks(columns.disk_mass));
  idl::lend(sample.wall_id, walls(columns.wall_id));
  idl::lend(sample.wall_start_x, walls(columns.start_x));
  idl::lend(sample.wall_start_y, walls(columns.start_y));
  idl::lend(sample.wall_end_x, walls(columns.end_x));
  idl::lend(sample.wall_end_y, walls(columns.end_y));
  idl::lend(sample.wall_vx, walls(columns.vx));
  idl::lend(sample.wall_vy, walls(columns.vy));
  const auto zones = [&](const auto& column) {
    return slice(column, chunk, stoss_v1_MAX_SCENE_ZONES);
  };
  idl::lend(sample.zone_id, zones(columns.zone_id));
  idl::lend(sample.zone_x, zones(columns.zone_x));
  idl::lend(sample.zone_y, zones(columns.zone_y));
  idl::lend(sample.zone_radius, zones(columns.zone_radius));
  idl::lend(sample.names, slice(columns.names, chunk, stoss_v1_MAX_SCENE_NAMES));
  static_cast<void>(writer_.write(sample));
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include "cli/table.hpp"

#include "cli/json_object.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/client/json.hpp>
#include <stoss/translate/basics.hpp>

#include <algorithm>
#include <utility>

namespace stoss::client::cli {

Table::Table(std::vector<std::string> heads) { rows_.push_back(std::move(heads)); }

void Table::add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

std::string Table::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      out.append(widths[i] - row[i].size() + (i == 0 ? 0 : 2), ' ');
      out += row[i];
    }
    out += '\n';
  }
  return out;
}

const char* word(engine::BodyKind kind) {
  switch (kind) {
    case engine::BodyKind::Dynamic:
      return "dynamic";
    case engine::BodyKind::Kinematic:
      return "kinematic";
    case engine::BodyKind::Static:
      return "static";
  }
  return "?";
}

const char* word(engine::ContactKind kind) {
  switch (kind) {
    case engine::ContactKind::DiskDisk:
      return "disk-disk";
    case engine::ContactKind::DiskWall:
      return "disk-wall";
    case engine::ContactKind::DiskWallEnd:
      return "disk-wall-end";
  }
  return "?";
}

std::string body_table(const std::vector<FoundBody>& bodies, bool with_distance) {
  const bool turning = std::any_of(bodies.begin(), bodies.end(), [](const FoundBody& body) {
    return body.state.angle != 0 || body.state.spin != 0;
  });
  std::vector<std::string> heads = {"id", "kind", "x", "y", "vx", "vy", "radius"};
  if (turning) heads.insert(heads.end(), {"angle", "spin"});
  if (with_distance) heads.emplace_back("distance");
  Table table(heads);
  for (const FoundBody& body : bodies) {
    const engine::BodyState& state = body.state;
    std::vector<std::string> row = {std::to_string(state.id),
                                    body.wall ? "wall" : word(state.kind),
                                    format_number(state.position.x()),
                                    format_number(state.position.y()),
                                    format_number(state.velocity.x()),
                                    format_number(state.velocity.y()),
                                    body.wall ? "-" : format_number(state.radius)};
    if (turning) {
      row.push_back(format_number(state.angle));
      row.push_back(format_number(state.spin));
    }
    if (with_distance) row.push_back(format_number(body.distance));
    table.add(std::move(row));
  }
  return table.text();
}

std::string wall_table(const std::vector<engine::WallState>& walls) {
  Table table({"wall", "start x", "start y", "end x", "end y", "vx", "vy"});
  for (const engine::WallState& wall : walls) {
    table.add({std::to_string(wall.id),
               format_number(wall.start.x()),
               format_number(wall.start.y()),
               format_number(wall.end.x()),
               format_number(wall.end.y()),
               format_number(wall.velocity.x()),
               format_number(wall.velocity.y())});
  }
  return table.text();
}

std::string reply_text(const Reply& reply, bool json) {
  if (json) {
    std::string ids;
    for (const engine::Id id : reply.ids) {
      ids += (ids.empty() ? "\"" : ",\"") + std::to_string(id) + '"';
    }
    JsonObject object;
    object.string("code", "OK").instant("instant", reply.at);
    object.integer("tick", reply.tick).integer("epoch", reply.epoch);
    if (!reply.ids.empty()) object.object("ids", '[' + ids + ']');
    return object.text() + '\n';
  }
  return "at " + format_instant(reply.at) + " s, tick " + std::to_string(reply.tick) + '\n';
}

}  // namespace stoss::client::cli

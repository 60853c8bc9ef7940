// SPDX-License-Identifier: Apache-2.0
#include "cli/load.hpp"

#include "cli/json_object.hpp"
#include "cli/live_settings.hpp"
#include "cli/scene_bodies.hpp"

#include <stoss/translate/scene.hpp>

#include <algorithm>
#include <future>
#include <iterator>
#include <utility>

namespace stoss::client::cli {
namespace {

/// One command's worth of a scene.
struct Piece {
  std::vector<engine::DiskSpec> disks;
  std::vector<engine::WallSpec> walls;
  std::vector<engine::ZoneSpec> zones;
  std::vector<translate::NamedPart> names;

  [[nodiscard]] std::size_t size() const { return disks.size() + walls.size() + zones.size(); }
};

/// Walls and zones first, so that no disk is on its way before its box is there, or crosses a rim
/// unseen; a piece has one sort.
std::vector<Piece> pieces_of(const translate::SceneBodies& bodies) {
  std::vector<Piece> pieces;
  const auto name = [](Piece& piece, const std::vector<std::string>& names, std::size_t i) {
    if (i < names.size() && !names[i].empty()) piece.names.push_back({piece.size() - 1, names[i]});
  };
  for (std::size_t i = 0; i < bodies.walls.size(); ++i) {
    if (i % kCommandBodiesMax == 0) pieces.emplace_back();
    pieces.back().walls.push_back(bodies.walls[i]);
    name(pieces.back(), bodies.wall_names, i);
  }
  for (std::size_t i = 0; i < bodies.zones.size(); ++i) {
    if (i % kCommandBodiesMax == 0) pieces.emplace_back();
    pieces.back().zones.push_back(bodies.zones[i]);
    name(pieces.back(), bodies.zone_names, i);
  }
  for (std::size_t i = 0; i < bodies.disks.size(); ++i) {
    if (i % kCommandBodiesMax == 0) pieces.emplace_back();
    pieces.back().disks.push_back(bodies.disks[i]);
    name(pieces.back(), bodies.disk_names, i);
  }
  return pieces;
}

Command command_of(const Piece& piece, const std::string& at) {
  Command command = Command::spawn(piece.disks, piece.walls, piece.zones);
  command.names(piece.names);
  if (!at.empty()) command.at(instant_of("--at", at));
  return command;
}

[[noreturn]] void stop(const Failure& failure, std::size_t loaded, std::size_t total) {
  const std::string so_far =
      std::to_string(loaded) + " of " + std::to_string(total) + " bodies are in";
  if (!failure.answered) throw NoAnswerError(failure.reject.reason + "; " + so_far);
  engine::Reject reject = failure.reject;
  reject.reason += "; " + so_far;
  throw RefusedError(std::move(reject));
}

}  // namespace

void load(const GlobalOptions& global, const LoadOptions& options) {
  translate::SceneBodies bodies = scene_bodies(options.scene);
  if (options.new_ids) {
    for (engine::DiskSpec& disk : bodies.disks) disk.id = engine::kNoId;
    for (engine::WallSpec& wall : bodies.walls) wall.id = engine::kNoId;
    for (engine::ZoneSpec& zone : bodies.zones) zone.id = engine::kNoId;
  }
  const std::vector<Piece> pieces = pieces_of(bodies);
  const std::size_t total = bodies.disks.size() + bodies.walls.size() + bodies.zones.size();
  const auto session = connect(global);
  if (!options.bodies_only) refuse_differences(bodies, *session);
  std::size_t loaded = 0;
  if (options.at.empty()) {
    for (const Piece& piece : pieces) {
      const Result<Reply> reply = session->command(command_of(piece, {}));
      if (!reply) stop(reply.failure(), loaded, total);
      loaded += piece.size();
    }
  } else {
    // All are to be there before the instant comes, so all are sent before any reply.
    std::vector<std::future<Result<Reply>>> replies;
    for (const Piece& piece : pieces) {
      replies.push_back(session->submit(command_of(piece, options.at)));
    }
    std::optional<Failure> first;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Result<Reply> reply = replies[i].get();
      if (reply) loaded += pieces[i].size();
      if (!reply && !first) first = reply.failure();
    }
    if (first) stop(*first, loaded, total);
  }
  print(global.json ? JsonObject().string("code", "OK").count("loaded", loaded).text() + '\n'
                    : std::to_string(loaded) + " bodies loaded\n");
}

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
// spawn disk, spawn wall, spawn zone, remove, set-velocity, impulse

#include "cli/common.hpp"
#include "cli/load.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>

#include <algorithm>
#include <cctype>
#include <utility>

namespace stoss::client::cli {
namespace {

/// What every verb that changes bodies takes.
struct CommandOptions {
  std::string at;
};

void add_at(CLI::App* verb, CommandOptions& options) {
  verb->add_option("--at", options.at, "Instant of the world's clock at which to apply it [s]");
}

Reply send(const GlobalOptions& global, Command command, const CommandOptions& options) {
  if (!options.at.empty()) command.at(instant_of("--at", options.at));
  const auto session = connect(global);
  return value_or_throw(session->command(command));
}

/// The ids made are what a script wants to catch; everything else is in the JSON.
void print_ids(const Reply& reply, bool json) {
  if (json) {
    print(reply_text(reply, true));
    return;
  }
  for (const engine::Id id : reply.ids) print(std::to_string(id) + '\n');
}

struct DiskOptions : CommandOptions {
  std::string position;
  std::string velocity = "0,0";
  std::string radius;
  std::string mass = "1";
  std::string kind = "dynamic";
  std::string id = "0";
  std::string angle = "0";
  std::string spin = "0";
  std::string name;
};

engine::BodyKind kind_of(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  for (const auto kind :
       {engine::BodyKind::Dynamic, engine::BodyKind::Kinematic, engine::BodyKind::Static}) {
    if (text == word(kind)) return kind;
  }
  throw UsageError("--kind: must be dynamic, kinematic or static");
}

std::vector<translate::NamedPart> name_of_first(const std::string& name) {
  if (name.empty()) return {};
  return {{0, name}};
}

void spawn_disk(const GlobalOptions& global, const DiskOptions& options) {
  engine::DiskSpec disk;
  disk.id = count_of("--id", options.id);
  disk.kind = kind_of(options.kind);
  disk.position = vector_of("--position", options.position);
  disk.velocity = vector_of("--velocity", options.velocity);
  disk.radius = number_of("--radius", options.radius);
  disk.mass = number_of("--mass", options.mass);
  disk.angle = number_of("--angle", options.angle);
  disk.spin = number_of("--spin", options.spin);
  Command command = Command::spawn({disk});
  command.names(name_of_first(options.name));
  print_ids(send(global, std::move(command), options), global.json);
}

void add_spawn_disk(CLI::App& spawn, Invocation& invocation) {
  auto options = std::make_shared<DiskOptions>();
  CLI::App* verb =
      add_verb(spawn,
               "disk",
               "Bring a disk into the world and print its id",
               "stoss spawn disk --position 1,-2 --radius 0.5 --velocity 3,0 --mass 2");
  verb->add_option("--position", options->position, "X,Y of its centre [m]")->required();
  verb->add_option("--radius", options->radius, "Above 0 [m]")->required();
  verb->add_option("--velocity", options->velocity, "VX,VY [m/s]")->capture_default_str();
  verb->add_option("--mass", options->mass, "Above 0 [kg]")->capture_default_str();
  verb->add_option("--kind", options->kind, "dynamic, kinematic or static")->capture_default_str();
  verb->add_option("--id", options->id, "Its id; 0: the world assigns one")->capture_default_str();
  verb->add_option("--angle", options->angle, "[rad]")->capture_default_str();
  verb->add_option("--spin", options->spin, "Angular velocity [rad/s]")->capture_default_str();
  verb->add_option("--name", options->name, "A name for people");
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { spawn_disk(invocation.global, *options); };
  });
}

struct WallOptions : CommandOptions {
  std::string start;
  std::string end;
  std::string velocity = "0,0";
  std::string id = "0";
  std::string name;
};

void spawn_wall(const GlobalOptions& global, const WallOptions& options) {
  const engine::WallSpec wall{.id = count_of("--id", options.id),
                              .start = vector_of("--start", options.start),
                              .end = vector_of("--end", options.end),
                              .velocity = vector_of("--velocity", options.velocity)};
  Command command = Command::spawn({}, {wall});
  command.names(name_of_first(options.name));
  print_ids(send(global, std::move(command), options), global.json);
}

void add_spawn_wall(CLI::App& spawn, Invocation& invocation) {
  auto options = std::make_shared<WallOptions>();
  CLI::App* verb = add_verb(spawn,
                            "wall",
                            "Bring a wall into the world and print its id",
                            "stoss spawn wall --start 0,-5 --end 0,5");
  verb->add_option("--start", options->start, "X,Y of one end [m]")->required();
  verb->add_option("--end", options->end, "X,Y of the other end [m]")->required();
  verb->add_option("--velocity", options->velocity, "VX,VY [m/s]")->capture_default_str();
  verb->add_option("--id", options->id, "Its id; 0: the world assigns one")->capture_default_str();
  verb->add_option("--name", options->name, "A name for people");
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { spawn_wall(invocation.global, *options); };
  });
}

struct ZoneOptions : CommandOptions {
  std::string center;
  std::string radius;
  std::string id = "0";
  std::string name;
};

void spawn_zone(const GlobalOptions& global, const ZoneOptions& options) {
  const engine::ZoneSpec zone{.id = count_of("--id", options.id),
                              .center = vector_of("--center", options.center),
                              .radius = number_of("--radius", options.radius)};
  Command command = Command::spawn({}, {}, {zone});
  command.names(name_of_first(options.name));
  print_ids(send(global, std::move(command), options), global.json);
}

void add_spawn_zone(CLI::App& spawn, Invocation& invocation) {
  auto options = std::make_shared<ZoneOptions>();
  CLI::App* verb = add_verb(spawn,
                            "zone",
                            "Bring a zone into the world, which reports who enters and leaves, and "
                            "print its id",
                            "stoss spawn zone --center 2,0 --radius 0.5");
  verb->add_option("--center", options->center, "X,Y [m]")->required();
  verb->add_option("--radius", options->radius, "Above 0 [m]")->required();
  verb->add_option("--id", options->id, "Its id; 0: the world assigns one")->capture_default_str();
  verb->add_option("--name", options->name, "A name for people");
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { spawn_zone(invocation.global, *options); };
  });
}

struct IdsOptions : CommandOptions {
  std::vector<std::string> ids;
};

void add_remove(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<IdsOptions>();
  CLI::App* verb = add_verb(
      app, "remove", "Take bodies out of the world, all of them or none", "stoss remove 3 4 5");
  verb->add_option("ID", options->ids, "Disks, walls or zones")->required();
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&global = invocation.global, options] {
      print(reply_text(send(global, Command::remove(ids_of(options->ids)), *options), global.json));
    };
  });
}

struct VectorOptions : CommandOptions {
  std::string id;
  std::string x;
  std::string y;
};

template <class Make>
void add_vector_verb(CLI::App& app,
                     Invocation& invocation,
                     const std::string& name,
                     const std::string& description,
                     const std::string& example,
                     const std::string& symbol,
                     Make make) {
  auto options = std::make_shared<VectorOptions>();
  CLI::App* verb = add_verb(app, name, description, example);
  verb->add_option("ID", options->id, "The body")->required();
  verb->add_option(symbol + "X", options->x, "x component")->required();
  verb->add_option(symbol + "Y", options->y, "y component")->required();
  add_at(verb, *options);
  verb->callback([&invocation, options, make, symbol] {
    invocation.action = [&global = invocation.global, options, make, symbol] {
      const engine::VectorFor vector{
          count_of("ID", options->id),
          {number_of(symbol + "X", options->x), number_of(symbol + "Y", options->y)}};
      print(reply_text(send(global, make({vector}), *options), global.json));
    };
  });
}

void add_load(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<LoadOptions>();
  CLI::App* verb = add_verb(app,
                            "load",
                            "Bring all bodies of a scene file into the world",
                            "stoss load clients/scenes/pool-break.json");
  verb->add_option("SCENE", options->scene, "A .json, .textproto or .binpb file")->required();
  verb->add_flag("--new-ids", options->new_ids, "Let the world assign ids, whatever the file says");
  verb->add_flag("--bodies-only",
                 options->bodies_only,
                 "Load them into a world of another period or other effects, too");
  verb->add_option("--at", options->at, "Instant of the world's clock for all of them [s]");
  verb->callback([&invocation, options] {
    invocation.action = [&global = invocation.global, options] { load(global, *options); };
  });
}

}  // namespace

void add_body_verbs(CLI::App& app, Invocation& invocation) {
  CLI::App* spawn = add_verb(
      app, "spawn", "Bring a body into the world", "stoss spawn disk --position 0,0 --radius 0.5");
  spawn->require_subcommand(1);
  add_spawn_disk(*spawn, invocation);
  add_spawn_wall(*spawn, invocation);
  add_spawn_zone(*spawn, invocation);
  add_load(app, invocation);
  add_remove(app, invocation);
  add_vector_verb(app,
                  invocation,
                  "set-velocity",
                  "Set the velocity of a disk or wall [m/s]",
                  "stoss set-velocity 3 -1.5 0",
                  "V",
                  [](std::vector<engine::VectorFor> vectors) {
                    return Command::set_velocity(std::move(vectors));
                  });
  add_vector_verb(app,
                  invocation,
                  "impulse",
                  "Give a dynamic disk an impulse [kg m/s]",
                  "stoss impulse 3 0 -2.5",
                  "J",
                  [](std::vector<engine::VectorFor> vectors) {
                    return Command::apply_impulse(std::move(vectors));
                  });
}

}  // namespace stoss::client::cli

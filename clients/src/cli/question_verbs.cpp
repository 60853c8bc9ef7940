// SPDX-License-Identifier: Apache-2.0
// get, list, region, nearest, ray

#include "cli/common.hpp"
#include "cli/json_object.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/client/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace stoss::client::cli {
namespace {

struct QuestionOptions {
  std::string at;
};

void add_at(CLI::App* verb, QuestionOptions& options) {
  verb->add_option(
      "--at", options.at, "Ask about this instant of the world's clock instead of the present [s]");
}

Answer ask(const GlobalOptions& global, Query query, const QuestionOptions& options) {
  if (!options.at.empty()) query.at(instant_of("--at", options.at));
  const auto session = connect(global);
  return value_or_throw(session->ask(query));
}

std::string bodies_json(const std::vector<FoundBody>& bodies, bool with_distance) {
  std::string out;
  for (const FoundBody& body : bodies) {
    append_json(out, body.state);
    if (with_distance) {
      out.pop_back();  // the closing brace; an object always has an id before it
      out += ",\"distance\":" + format_number(body.distance) + '}';
    }
    out += '\n';
  }
  return out;
}

std::string walls_json(const std::vector<engine::WallState>& walls) {
  std::string out;
  for (const engine::WallState& wall : walls) {
    append_json(out, wall);
    out += '\n';
  }
  return out;
}

void print_walls(const std::vector<engine::WallState>& walls, bool json) {
  if (walls.empty()) return;
  print(json ? walls_json(walls) : wall_table(walls));
}

struct GetOptions : QuestionOptions {
  std::vector<std::string> ids;
};

void get(const GlobalOptions& global, const GetOptions& options) {
  const Answer answer = ask(global, Query::states(ids_of(options.ids)), options);
  if (global.json) {
    print(bodies_json(answer.bodies, false));
    return;
  }
  print(body_table(answer.bodies, false));
  print_walls(answer.walls, false);
}

void add_get(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<GetOptions>();
  CLI::App* verb = add_verb(app, "get", "Show the states of some bodies", "stoss get 3 4 --json");
  verb->add_option("ID", options->ids, "Disks or walls")->required();
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { get(invocation.global, *options); };
  });
}

struct ListOptions : QuestionOptions {
  bool walls = false;
};

void list(const GlobalOptions& global, const ListOptions& options) {
  const Answer answer = ask(global, Query::list(), options);
  print(global.json ? bodies_json(answer.bodies, false) : body_table(answer.bodies, false));
  if (options.walls) {
    print_walls(answer.walls, global.json);
  } else if (!global.json && !answer.walls.empty()) {
    print("and " + std::to_string(answer.walls.size()) + " walls (--walls shows them)\n");
  }
}

void add_list(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* verb = add_verb(app, "list", "Show the states of all disks", "stoss list --walls");
  verb->add_flag("--walls", options->walls, "Show the walls too, in JSON by their start points");
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { list(invocation.global, *options); };
  });
}

struct RegionOptions : QuestionOptions {
  std::string low;
  std::string high;
};

void region(const GlobalOptions& global, const RegionOptions& options) {
  const Query query =
      Query::region(vector_of("--min", options.low), vector_of("--max", options.high));
  const Answer answer = ask(global, query, options);
  print(global.json ? bodies_json(answer.bodies, false) : body_table(answer.bodies, false));
  print_walls(answer.walls, global.json);
}

void add_region(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<RegionOptions>();
  CLI::App* verb = add_verb(
      app, "region", "Show the bodies that touch a box", "stoss region --min -1,-1 --max 1,1");
  verb->add_option("--min", options->low, "X,Y of its lower left corner [m]")->required();
  verb->add_option("--max", options->high, "X,Y of its upper right corner [m]")->required();
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { region(invocation.global, *options); };
  });
}

struct NearestOptions : QuestionOptions {
  std::string point;
  std::string count = "1";
};

void nearest(const GlobalOptions& global, const NearestOptions& options) {
  const Query query =
      Query::nearest(vector_of("POINT", options.point), count_of("--count", options.count));
  const Answer answer = ask(global, query, options);
  print(global.json ? bodies_json(answer.bodies, true) : body_table(answer.bodies, true));
}

void add_nearest(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<NearestOptions>();
  CLI::App* verb = add_verb(app,
                            "nearest",
                            "Show the bodies nearest to a point, nearest first",
                            "stoss nearest -2,0.5 --count 3");
  verb->add_option("POINT", options->point, "X,Y [m]")->required();
  verb->add_option("--count", options->count, "How many")->capture_default_str();
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { nearest(invocation.global, *options); };
  });
}

struct RayOptions : QuestionOptions {
  std::string from;
  std::string direction;
  std::string length = "inf";
};

std::string vector_json(const engine::Vector2& v) {
  return JsonObject().number("x", v.x()).number("y", v.y()).text();
}

void ray(const GlobalOptions& global, const RayOptions& options) {
  const Query query = Query::ray(vector_of("--from", options.from),
                                 vector_of("--direction", options.direction),
                                 number_of("--length", options.length));
  const Answer answer = ask(global, query, options);
  if (global.json) {
    for (const engine::RayHit& hit : answer.hits) {
      print(JsonObject()
                .integer("id", hit.id)
                .number("distance", hit.distance)
                .object("point", vector_json(hit.point))
                .object("normal", vector_json(hit.normal))
                .text() +
            '\n');
    }
    return;
  }
  if (answer.hits.empty()) {
    print("it meets nothing\n");
    return;
  }
  Table table({"id", "distance", "x", "y", "normal x", "normal y"});
  for (const engine::RayHit& hit : answer.hits) {
    table.add({std::to_string(hit.id),
               format_number(hit.distance),
               format_number(hit.point.x()),
               format_number(hit.point.y()),
               format_number(hit.normal.x()),
               format_number(hit.normal.y())});
  }
  print(table.text());
}

void add_ray(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<RayOptions>();
  CLI::App* verb = add_verb(app,
                            "ray",
                            "Show the first body that a ray meets",
                            "stoss ray --from 0,0 --direction 1,-1 --length 100");
  verb->add_option("--from", options->from, "X,Y of its origin [m]")->required();
  verb->add_option("--direction", options->direction, "X,Y, of any length above 0")->required();
  verb->add_option("--length", options->length, "How far it reaches [m]")->capture_default_str();
  add_at(verb, *options);
  verb->callback([&invocation, options] {
    invocation.action = [&invocation, options] { ray(invocation.global, *options); };
  });
}

}  // namespace

void add_question_verbs(CLI::App& app, Invocation& invocation) {
  add_get(app, invocation);
  add_list(app, invocation);
  add_region(app, invocation);
  add_nearest(app, invocation);
  add_ray(app, invocation);
}

}  // namespace stoss::client::cli

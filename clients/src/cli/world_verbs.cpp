// SPDX-License-Identifier: Apache-2.0
// worlds, status

#include "cli/common.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/client/discovery.hpp>

#include <cmath>

namespace stoss::client::cli {
namespace {

/// A list should be whole, so it waits a little longer than a verb that looks for the only world.
constexpr Milliseconds kListSettle{400};

void list_worlds(const GlobalOptions& global) {
  const std::vector<Status> found = worlds(domain_of(global), {}, timeout_of(global), kListSettle);
  if (found.empty()) throw NoAnswerError("no world in domain " + global.domain);
  if (global.json) {
    for (const Status& status : found) print(status_json(status));
    return;
  }
  Table table({"world", "state", "time [s]", "disks", "walls", "collisions", "speed", "pid"});
  for (const Status& s : found) {
    table.add({s.world,
               std::string(idl::name_of(s.state)),
               format_instant(s.at),
               std::to_string(s.bodies),
               std::to_string(s.walls),
               std::to_string(s.collisions),
               std::isinf(s.speed_asked) ? "max" : format_number(s.speed_asked),
               std::to_string(s.pid)});
  }
  print(table.text());
}

void show_status(const GlobalOptions& global) {
  const auto session = connect(global);
  const Answer answer = value_or_throw(session->ask(Query::status()));
  if (!answer.status) throw NoAnswerError("the answer holds no status");
  print(global.json ? status_json(*answer.status) : status_text(*answer.status));
}

}  // namespace

void add_world_verbs(CLI::App& app, Invocation& invocation) {
  const GlobalOptions& global = invocation.global;
  CLI::App* list = add_verb(app, "worlds", "List the worlds that are running", "stoss worlds");
  list->callback([&] { invocation.action = [&global] { list_worlds(global); }; });
  CLI::App* status =
      add_verb(app, "status", "Show how a world is", "stoss status --world gas --json");
  status->callback([&] { invocation.action = [&global] { show_status(global); }; });
}

}  // namespace stoss::client::cli

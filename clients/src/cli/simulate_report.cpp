// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_report.hpp"

#include "cli/json_object.hpp"

#include <stoss/client/decimal.hpp>

#include <cstdio>
#include <string>

namespace stoss::client::cli {
namespace {

std::string vector_json(const engine::Vector2& v) {
  return JsonObject().number("x", v.x()).number("y", v.y()).text();
}

std::string verification_text(const engine::Verification& found) {
  return "verified: " + std::to_string(found.checks) + " checks, " +
         std::to_string(found.overlaps) + " overlaps, " + std::to_string(found.missed) +
         " missed contacts, deepest overlap " + format_number(found.deepest) +
         " of the contact distance, energy drift " + format_number(found.energy_error) +
         ", momentum drift " + format_number(found.momentum_error);
}

std::string stats_json(const SimulateReport& report, const CollisionLog& log) {
  const double events = static_cast<double>(report.events);
  const engine::Verification found =
      log.verifier() ? log.verifier()->found() : engine::Verification{};
  return JsonObject()
      .count("collisions", log.collisions())
      .count("other_events", report.events - log.collisions())
      .number("wall_seconds", report.wall_seconds)
      .number("events_per_second", report.wall_seconds > 0 ? events / report.wall_seconds : 0)
      .number("kinetic_energy_start", report.at_start.kinetic_energy)
      .number("kinetic_energy_end", report.at_end.kinetic_energy)
      .number("potential_energy_start", report.at_start.potential_energy)
      .number("potential_energy_end", report.at_end.potential_energy)
      .object("momentum_start", vector_json(report.at_start.momentum))
      .object("momentum_end", vector_json(report.at_end.momentum))
      .count("regularised", log.regularised())
      .count("order_dependent", log.order_dependent())
      .count("disks", report.disks)
      .count("walls", report.walls)
      .count("zone_events", report.zone_events)
      .count("verify_checks", found.checks)
      .count("verify_overlaps", found.overlaps)
      .count("verify_missed", found.missed)
      .number("verify_worst_overlap", found.deepest)
      .number("verify_energy_error", found.energy_error)
      .number("verify_momentum_error", found.momentum_error)
      .string("end", format_instant(report.end))
      .text();
}

std::string hash_line(const SimulateOptions& options,
                      const SimulateReport& report,
                      const CollisionLog& log) {
  if (options.json) {
    JsonObject object;
    object.string("collision_log", hexadecimal(log.digest()));
    if (report.state_hash) object.string("state", hexadecimal(*report.state_hash));
    return object.text();
  }
  std::string line = "collision log " + hexadecimal(log.digest());
  if (report.state_hash) line += "  state " + hexadecimal(*report.state_hash);
  return line;
}

}  // namespace

void print_report(const SimulateOptions& options,
                  const SimulateReport& report,
                  const CollisionLog& log) {
  if (options.hash) std::printf("%s\n", hash_line(options, report, log).c_str());
  if (options.stats) {
    std::fprintf(stderr, "%s\n", stats_json(report, log).c_str());
  } else if (log.verifier() && !options.json) {
    std::fprintf(stderr, "%s\n", verification_text(log.verifier()->found()).c_str());
  }
  if (options.hash || options.stats || options.collisions || options.zones || options.states)
    return;
  if (options.json) {
    std::printf("%s\n", stats_json(report, log).c_str());
    return;
  }
  std::printf("%llu collisions until %s s, in %.3f s\n",
              static_cast<unsigned long long>(log.collisions()),
              format_instant(report.end).c_str(),
              report.wall_seconds);
}

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
#include "cli/json_object.hpp"
#include "cli/table.hpp"

#include <stoss/client/decimal.hpp>
#include <stoss/translate/basics.hpp>

#include <cmath>

namespace stoss::client::cli {
namespace {

std::string counters_json(const Status& status) {
  JsonObject object;
  for (const Status::Counter& counter : status.counters) {
    object.integer(counter.name, counter.value);
  }
  return object.text();
}

void add_counts(JsonObject& object, const Status& s) {
  object.integer("bodies", s.bodies)
      .integer("walls", s.walls)
      .integer("zones", s.zones)
      .integer("watched", s.watched)
      .integer("collisions", s.collisions)
      .integer("events", s.events)
      .number("events_per_second", s.events_per_second)
      .integer("commands", s.commands)
      .integer("rejected", s.rejected)
      .integer("duplicates", s.duplicates)
      .integer("queries", s.queries)
      .string("state_hash", hexadecimal(s.state_hash))
      .integer("motion_number", s.motion_number)
      .integer("collision_number", s.collision_number)
      .integer("zone_number", s.zone_number)
      .integer("frame_count", s.frame_count);
}

void add_guards(JsonObject& object, const Status& s) {
  object.integer("dropped", s.dropped)
      .integer("queue_full", s.queue_full)
      .integer("ticks_late", s.ticks_late)
      .integer("ticks_slipped", s.ticks_slipped)
      .integer("regularised", s.regularised)
      .integer("order_dependent", s.order_dependent)
      .integer("verify_period", s.verify_period)
      .integer("verify_checks", s.verify_checks)
      .integer("verify_overlaps", s.verify_overlaps)
      .integer("verify_missed", s.verify_missed)
      .number("verify_worst_overlap", s.verify_worst_overlap)
      .number("verify_energy_error", s.verify_energy_error)
      .number("verify_momentum_error", s.verify_momentum_error);
}

// The figures are always shown: zero overlaps and misses are what a reader looks for.
std::string verified(const Status& s) {
  if (s.verify_period == 0) return "off (stossd --verify)";
  return std::to_string(s.verify_checks) + " checks, one each " + std::to_string(s.verify_period) +
         " events: " + std::to_string(s.verify_overlaps) + " overlaps, " +
         std::to_string(s.verify_missed) + " missed, deepest " +
         format_number(s.verify_worst_overlap) + ", energy " +
         format_number(s.verify_energy_error) + ", momentum " +
         format_number(s.verify_momentum_error);
}

std::string period_word(double period) {
  return period > 0 ? format_number(period) + " m" : "open";
}

std::string speed_word(double speed) { return std::isinf(speed) ? "max" : format_number(speed); }

}  // namespace

std::string arithmetic_name(const Status& status) {
  const auto arithmetic = translate::arithmetic_of(status.arithmetic);
  return arithmetic ? std::string(translate::name_of(*arithmetic)) : "unknown";
}

std::string status_json(const Status& s) {
  JsonObject object;
  object.string("world", s.world).string("state", idl::name_of(s.state));
  if (!s.reason.empty()) object.string("reason", s.reason);
  object.integer("epoch", s.epoch)
      .instant("instant", s.at)
      .string("real_seconds", std::to_string(s.real_seconds))
      .count("real_nanoseconds", s.real_nanoseconds)
      .number("uptime", s.uptime)
      .integer("tick", s.tick)
      .number("tick_rate", s.tick_rate)
      .number("speed_asked", s.speed_asked)
      .number("speed_reached", s.speed_reached);
  add_counts(object, s);
  add_guards(object, s);
  object.string("arithmetic", arithmetic_name(s))
      .string("broad_phase", s.broad_phase)
      .object("period", JsonObject().number("x", s.period.x()).number("y", s.period.y()).text())
      .string("version", s.version)
      .string("build", s.build)
      .count("pid", s.pid)
      .object("counters", counters_json(s));
  return object.text() + '\n';
}

std::string status_text(const Status& s) {
  std::string out;
  const auto line = [&out](std::string name, const std::string& value) {
    name.resize(20, ' ');
    out += name + value + '\n';
  };
  const auto count = [&line](const char* name, std::uint64_t value) {
    line(name, std::to_string(value));
  };
  line("world", s.world);
  line("state", std::string(idl::name_of(s.state)) + (s.reason.empty() ? "" : ": " + s.reason));
  line("simulated time", format_instant(s.at) + " s");
  line("tick", std::to_string(s.tick) + " at " + format_number(s.tick_rate) + " Hz");
  line("speed", speed_word(s.speed_reached) + " of " + speed_word(s.speed_asked));
  line("bodies",
       std::to_string(s.bodies) + " disks, " + std::to_string(s.walls) + " walls" +
           (s.zones > 0 ? ", " + std::to_string(s.zones) + " zones" : ""));
  if (s.period != engine::Vector2::Zero()) {
    line("period", "x " + period_word(s.period.x()) + ", y " + period_word(s.period.y()));
  }
  line("collisions",
       std::to_string(s.collisions) + " (" + std::to_string(s.regularised) + " regularised, " +
           std::to_string(s.order_dependent) + " order-dependent)");
  line("events", std::to_string(s.events) + ", " + format_number(s.events_per_second) + " /s");
  line("commands",
       std::to_string(s.commands) + " (" + std::to_string(s.rejected) + " rejected, " +
           std::to_string(s.duplicates) + " duplicates)");
  count("queries", s.queries);
  count("watched", s.watched);
  line("state hash", hexadecimal(s.state_hash));
  count("epoch", s.epoch);
  line("published",
       "motion " + std::to_string(s.motion_number) + ", collision " +
           std::to_string(s.collision_number) + ", frame " + std::to_string(s.frame_count));
  count("dropped", s.dropped);
  count("queue full", s.queue_full);
  line("ticks late",
       std::to_string(s.ticks_late) + " (" + std::to_string(s.ticks_slipped) + " slipped)");
  line("verified", verified(s));
  line("arithmetic", arithmetic_name(s) + ", " + s.broad_phase);
  line("daemon",
       "stossd " + s.version + ", pid " + std::to_string(s.pid) + ", up " +
           format_number(std::floor(s.uptime)) + " s");
  for (const Status::Counter& counter : s.counters) {
    count(counter.name.c_str(), counter.value);
  }
  return out;
}

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
// The publisher's own copy of every stored motion, kept up by the records of the world's thread.
// Large answers and frames are made from it, so that they cost the world's thread nothing. It
// evaluates motions with the engine's own code, to the same bits.
#pragma once

#include "flights.hpp"
#include "records.hpp"

#include <stoss/engine/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace stoss::service {

class Picture {
 public:
  explicit Picture(engine::Arithmetic arithmetic,
                   const engine::Vector2& period = engine::Vector2::Zero())
      : arithmetic_(arithmetic), period_(period) {}

  void begin(const EpochRecord& record);
  void apply(const TickRecord& record);

  [[nodiscard]] const Moment& moment() const { return moment_; }
  /// 0 when the record of the last change came without.
  [[nodiscard]] std::uint64_t state_hash() const { return state_hash_; }
  [[nodiscard]] engine::Arithmetic arithmetic() const { return arithmetic_; }
  /// m; 0: open.
  [[nodiscard]] const engine::Vector2& period() const { return period_; }
  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  /// The names of those that are on.
  [[nodiscard]] const std::vector<std::string>& effects() const { return effects_; }
  /// Raised by every record; 0 before the first.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Raised whenever a body comes or goes, a wall changes its way, or an effect is switched.
  [[nodiscard]] std::uint64_t scene_version() const { return scene_version_; }

  struct Body {
    engine::MotionRecord motion;
    engine::BodyRecord record;
  };
  /// The i-th of them, which are in no order.
  [[nodiscard]] Body body(std::size_t i) const;
  [[nodiscard]] std::size_t disk_count() const { return bodies_.size() - walls_; }

  /// One a body, in the order of body(), as the flights.
  [[nodiscard]] const std::vector<engine::Id>& ids() const { return ids_; }
  [[nodiscard]] const std::vector<Flight>& flights() const { return flights_; }
  /// Visits every Body, in the order of ids.
  template <class Visit>
  void for_each_in_order(Visit&& visit) const {
    for (const std::size_t i : order()) visit(body(i));
  }
  [[nodiscard]] std::optional<Body> find(engine::Id id) const;
  [[nodiscard]] const std::unordered_map<engine::Id, std::string>& names() const { return names_; }

  /// Has any disk grown since the epoch began? Then radii are what they are at moment().
  [[nodiscard]] bool has_grown() const { return has_grown_; }
  /// In the order of ids.
  [[nodiscard]] const std::vector<engine::ZoneState>& zones() const { return zones_; }

  /// A disk at moment().at. REQUIRES: it is one.
  [[nodiscard]] engine::BodyState state_of(const Body& body) const;
  [[nodiscard]] engine::BodyState state_of(std::size_t i) const {
    return is_flight(flights_[i]) ? state_of(body(i)) : state_of(bodies_[i]);
  }
  [[nodiscard]] bool is_wall(std::size_t i) const { return bodies_[i].record.is_wall; }
  [[nodiscard]] engine::WallState wall_of(const Body& body) const;

 private:
  [[nodiscard]] std::vector<std::size_t> order() const;
  /// Those of the changes, from the first on, that are of the same bodies as before: some of them.
  [[nodiscard]] std::size_t move(std::span<const BodyChange> changes, bool effects_switched);
  void put(const BodyChange& change);
  void set(std::size_t i, const BodyChange& change, bool tells_body);
  void set_zones(const std::vector<engine::ZoneState>& zones);
  [[nodiscard]] bool has_zone(engine::Id id) const;
  void remove(engine::Id id);
  void name(const std::vector<NamedBody>& names);

  engine::Arithmetic arithmetic_;
  engine::Vector2 period_;
  Moment moment_;
  std::uint64_t state_hash_ = 0;
  std::uint64_t version_ = 0;
  std::uint64_t scene_version_ = 0;
  bool has_grown_ = false;
  /// The motions of flights are void: most changes are written to `flights_` alone.
  std::vector<Body> bodies_;
  std::vector<engine::Id> ids_;
  std::vector<Flight> flights_;
  std::size_t walls_ = 0;
  std::unordered_map<engine::Id, std::size_t> index_;
  std::unordered_map<engine::Id, std::string> names_;
  std::vector<engine::ZoneState> zones_;
  std::vector<std::string> effects_;
};

}  // namespace stoss::service

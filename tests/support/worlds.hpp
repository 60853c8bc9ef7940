// SPDX-License-Identifier: Apache-2.0
#pragma once

// Short words for building worlds in tests, and the physicist's checks on them.

#include "support/collision_log.hpp"

#include <stoss/engine/motion.hpp>
#include <stoss/engine/world.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <ostream>
#include <span>
#include <vector>

namespace stoss::test {

using engine::DiskSpec;
using engine::Id;
using engine::Instant;
using engine::Vector2;
using engine::WallSpec;
using engine::World;

inline DiskSpec disk(Id id, Vector2 position, Vector2 velocity, double radius, double mass = 1) {
  DiskSpec spec;
  spec.id = id;
  spec.position = position;
  spec.velocity = velocity;
  spec.radius = radius;
  spec.mass = mass;
  return spec;
}

inline DiskSpec static_disk(Id id, Vector2 position, double radius) {
  DiskSpec spec = disk(id, position, Vector2::Zero(), radius);
  spec.kind = engine::BodyKind::Static;
  return spec;
}

inline DiskSpec kinematic_disk(Id id, Vector2 position, Vector2 velocity, double radius) {
  DiskSpec spec = disk(id, position, velocity, radius);
  spec.kind = engine::BodyKind::Kinematic;
  return spec;
}

inline WallSpec wall(Id id, Vector2 start, Vector2 end, Vector2 velocity = Vector2::Zero()) {
  WallSpec spec;
  spec.id = id;
  spec.start = start;
  spec.end = end;
  spec.velocity = velocity;
  return spec;
}

/// Walls from vertex to vertex, with ids from `first` on.
inline std::vector<WallSpec> chain(Id first, std::span<const Vector2> vertices) {
  std::vector<WallSpec> walls;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    walls.push_back(wall(first + i, vertices[i], vertices[i + 1]));
  }
  return walls;
}

/// The four walls of a box: bottom, right, top, left.
inline std::vector<WallSpec> box(Id first, const Vector2& low, const Vector2& high) {
  const Vector2 corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
  return chain(first, corners);
}

/// Spawns, and fails the test if the world refuses.
inline std::vector<Id> must_spawn(World& world,
                                  std::span<const DiskSpec> disks,
                                  std::span<const WallSpec> walls = {}) {
  auto made = world.spawn({disks, walls});
  if (!made) {
    ADD_FAILURE() << "spawn refused: " << made.reject().field << ' ' << made.reject().reason
                  << ", body " << made.reject().body << ", other " << made.reject().other
                  << ", clearance " << made.reject().clearance;
    return {};
  }
  return std::move(made).value();
}

inline std::vector<Id> must_spawn(World& world,
                                  std::initializer_list<DiskSpec> disks,
                                  std::span<const WallSpec> walls = {}) {
  return must_spawn(world, std::span(disks.begin(), disks.size()), walls);
}

/// An instant so many seconds after 0. REQUIRES: finite and within the range of instants.
inline Instant seconds(double s) { return *engine::offset_by(Instant{}, s); }

/// Advances to `s` seconds and returns the collisions on the way.
inline std::vector<engine::Collision> run_until(World& world, const Instant& until) {
  Log log;
  const auto report = world.advance_to(until, &log);
  EXPECT_TRUE(report.ok() && report.value().stop == engine::Stop::Reached);
  return std::move(log.collisions);
}

inline std::vector<engine::Collision> run_for(World& world, double s) {
  return run_until(world, *engine::offset_by(world.now(), s));
}

/// A disk's state. REQUIRES: it is there.
inline engine::BodyState state(const World& world, Id id) { return world.state(id).value(); }

/// A position in double words, so that no rounding of the question disturbs the answer. For worlds
/// in Float and Double.
inline engine::DoubleWord2<double> exact_position(const World& world, Id id) {
  const auto motion = engine::from_record<double>(world.motion(id).value());
  return engine::position_at(motion, world.now());
}

namespace detail {

inline Vector2 apart(const engine::DoubleWord2<double>& a, const engine::DoubleWord2<double>& b) {
  const auto d = a - b;
  return {engine::to_scalar(d.x), engine::to_scalar(d.y)};
}

/// Calls visit(image) for the images of a place around the origin, for walls of up to a period.
template <class Visit>
void for_each_image(const Vector2& place, const Vector2& period, Visit&& visit) {
  const auto reduced = [](double x, double length) {
    return length > 0 ? std::remainder(x, length) : x;
  };
  const Vector2 near(reduced(place.x(), period.x()), reduced(place.y(), period.y()));
  const int in_x = period.x() > 0 ? 2 : 0;
  const int in_y = period.y() > 0 ? 2 : 0;
  for (int x = -in_x; x <= in_x; ++x) {
    for (int y = -in_y; y <= in_y; ++y) visit(Vector2(near + period.cwiseProduct(Vector2(x, y))));
  }
}

/// Distance from the origin to the segment from `start` along `edge`.
inline double distance_to_segment(const Vector2& start, const Vector2& edge) {
  const double s = std::clamp(-start.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  if (s == 0 || s == 1) return (start + s * edge).norm();
  return std::abs(start.x() * edge.y() - start.y() * edge.x()) / edge.norm();
}

}  // namespace detail

/// The deepest overlap of a dynamic disk with anything, as a part of the distance at which they
/// touch: 0 when nothing overlaps. Over all pairs and their images.
inline double deepest_overlap(const World& world) {
  struct Item {
    engine::BodyRecord body;
    engine::DoubleWord2<double> position;
  };
  std::vector<Item> items;
  for (const Id id : world.ids()) {
    items.push_back({world.body(id).value(), exact_position(world, id)});
  }
  double deepest = 0;
  const auto is_dynamic = [](const Item& i) {
    return !i.body.is_wall && i.body.kind == engine::BodyKind::Dynamic;
  };
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!is_dynamic(items[i])) continue;
    for (std::size_t j = 0; j < items.size(); ++j) {
      if (j == i || (j < i && is_dynamic(items[j]))) continue;
      const double reach = items[i].body.radius + items[j].body.radius;
      const Vector2 d = detail::apart(items[j].position, items[i].position);
      const Vector2 edge(items[j].body.edge_x.high, items[j].body.edge_y.high);
      detail::for_each_image(d, world.period(), [&](const Vector2& image) {
        const double distance =
            items[j].body.is_wall ? detail::distance_to_segment(image, edge) : image.norm();
        deepest = std::max(deepest, 1 - distance / reach);
      });
    }
  }
  return deepest;
}

/// A world's whole identity, for "nothing has changed".
struct Fingerprint {
  std::uint64_t hash;
  std::vector<std::byte> bytes;
  std::vector<Id> ids;
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  friend void PrintTo(const Fingerprint& f, std::ostream* out) {
    WordDigest digest;
    for (const std::byte b : f.bytes) digest.add(static_cast<std::uint64_t>(b));
    *out << "hash " << f.hash << ", " << f.bytes.size() << " bytes of digest " << digest.value()
         << ", " << f.ids.size() << " bodies";
  }
};

inline Fingerprint fingerprint(const World& world) {
  return {world.state_hash(), world.serialise(), world.ids()};
}

/// The world of `make(broad phase)` tells one story: the same bytes at `until` seconds in one leap
/// and in ticks over all pairs, and `further` seconds later after a pause in bytes. Returns it
/// then.
template <class Make>
World expect_one_story(const Make& make, double until, int ticks, double further) {
  World leap = make(engine::BroadPhaseKind::Neighbours);
  World slow = make(engine::BroadPhaseKind::AllPairs);
  EXPECT_TRUE(leap.advance_to(seconds(until)).ok());
  for (int i = 1; i <= ticks; ++i) {
    EXPECT_TRUE(slow.advance_to(seconds(until * i / ticks)).ok());
  }
  EXPECT_EQ(leap.serialise(), slow.serialise());
  EXPECT_EQ(leap.state_hash(), slow.state_hash());
  World again = World::deserialise(leap.serialise()).value();
  EXPECT_EQ(again.effects(), leap.effects());
  run_for(leap, further);
  run_for(again, further);
  EXPECT_EQ(leap.serialise(), again.serialise());
  return leap;
}

}  // namespace stoss::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a world does, as bytes to compare: its collisions, every field by its bit pattern.

#include <stoss/engine/world.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::test {

/// Calls visit(name, 64-bit word) for every field of a collision, in one fixed order.
template <class Visit>
void for_each_word(const engine::Collision& c, Visit&& visit) {
  const auto number = [&](const char* name, double x) {
    visit(name, std::bit_cast<std::uint64_t>(x));
  };
  const auto vector = [&](const char* name, const engine::Vector2& v) {
    number(name, v.x());
    number(name, v.y());
  };
  visit("sequence", c.sequence);
  visit("instant.seconds", static_cast<std::uint64_t>(c.instant.seconds));
  visit("instant.fraction", c.instant.fraction);
  visit("kind", static_cast<std::uint64_t>(c.kind));
  visit("regularised", std::uint64_t{c.regularised});
  visit("order_dependent", std::uint64_t{c.order_dependent});
  visit("a", c.a);
  visit("b", c.b);
  vector("point", c.point);
  vector("normal", c.normal);
  number("impulse", c.impulse);
  number("approach_speed", c.approach_speed);
  vector("velocity_a", c.velocity_a);
  vector("velocity_b", c.velocity_b);
  number("spin_a", c.spin_a);
  number("spin_b", c.spin_b);
}

/// A digest of words; it tells logs apart, it resists no adversary. FNV-1a over bytes, low first.
class WordDigest {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) {
      state_ = (state_ ^ ((word >> (8 * i)) & 0xffU)) * 0x100000001b3U;
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

/// Digests a world's collisions without keeping them. Instants count from `start`.
class DigestLog final : public engine::CollisionSink {
 public:
  explicit DigestLog(const engine::Instant& start = {}) : start_(start) {}

  void on_collision(const engine::Collision& collision) override {
    engine::Collision c = collision;
    c.instant = engine::instant_from_ticks(engine::ticks(c.instant) - engine::ticks(start_));
    for_each_word(c, [this](const char*, std::uint64_t word) { digest_.add(word); });
    ++count_;
  }

  std::uint64_t digest() const { return digest_.value(); }
  std::uint64_t count() const { return count_; }

 private:
  engine::Instant start_;
  WordDigest digest_;
  std::uint64_t count_ = 0;
};

/// Keeps a world's collisions.
class Log final : public engine::CollisionSink {
 public:
  void on_collision(const engine::Collision& collision) override {
    collisions.push_back(collision);
  }

  std::vector<engine::Collision> collisions;
};

inline std::string describe(const engine::Collision& c) {
  std::ostringstream out;
  out.precision(17);
  out << '#' << c.sequence << " at " << c.instant.seconds << " s + " << c.instant.fraction
      << " kind " << static_cast<int>(c.kind) << ", " << c.a << " and " << c.b << ", normal ("
      << c.normal.x() << ", " << c.normal.y() << "), approach " << c.approach_speed;
  return out.str();
}

/// Where two lists of collisions part, for a failing test to print; empty when they are the same to
/// the bit.
inline std::string difference(const std::vector<engine::Collision>& a,
                              const std::vector<engine::Collision>& b) {
  struct Word {
    const char* name;
    std::uint64_t value;
  };
  const auto words = [](const engine::Collision& c) {
    std::vector<Word> result;
    for_each_word(c, [&](const char* name, std::uint64_t w) { result.push_back({name, w}); });
    return result;
  };
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const std::vector<Word> in_a = words(a[i]);
    const std::vector<Word> in_b = words(b[i]);
    for (std::size_t k = 0; k < in_a.size(); ++k) {
      if (in_a[k].value == in_b[k].value) continue;
      return std::string(in_a[k].name) + " differs\n  " + describe(a[i]) + "\n  " + describe(b[i]);
    }
  }
  if (a.size() == b.size()) return {};
  const auto& longer = a.size() > b.size() ? a : b;
  return std::to_string(a.size()) + " and " + std::to_string(b.size()) +
         " collisions, one has\n  " + describe(longer[std::min(a.size(), b.size())]);
}

/// The same collisions of a world that began `shift` whole seconds earlier.
inline std::vector<engine::Collision> earlier_by(std::vector<engine::Collision> collisions,
                                                 std::int64_t shift) {
  for (engine::Collision& c : collisions) c.instant.seconds -= shift;
  return collisions;
}

}  // namespace stoss::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

// A periodic gas in 120 decimal digits, by brute force: every pair, nine images each, every event
// searched for among all of them, and positions taken back into the cell after each. It shares no
// line with the engine.

#include "support/oracle.hpp"
#include "support/worlds.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace stoss::test {

class BruteForceGas {
 public:
  struct Hit {
    Real at;
    Id a = 0;
    Id b = 0;
    Real2 point;
  };

  /// Disks with ids and finite masses in a cell of these sides, m.
  BruteForceGas(std::vector<DiskSpec> disks, const Vector2& period)
      : period_{period.x(), period.y()} {
    for (const DiskSpec& d : disks) {
      bodies_.push_back({d.id,
                         {Real(d.position.x()), Real(d.position.y())},
                         {Real(d.velocity.x()), Real(d.velocity.y())},
                         Real(d.radius),
                         Real(d.mass)});
    }
  }

  /// Flies to the next collision and resolves it.
  Hit next() {
    struct Best {
      Real after;
      std::size_t i = 0;
      std::size_t j = 0;
      Real2 image;
    };
    std::optional<Best> best;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
        for (int kx = -1; kx <= 1; ++kx) {
          for (int ky = -1; ky <= 1; ++ky) {
            const Real2 image{kx * period_.x, ky * period_.y};
            const auto after = meeting(bodies_[i], bodies_[j], image);
            if (after && (!best || *after < best->after)) best = Best{*after, i, j, image};
          }
        }
      }
    }
    // Nobody may fly further than the nine images reach: half a cell at a time.
    const Real step = step_max();
    if (!best || best->after > step) {
      fly(step);
      return next();
    }
    fly_unwrapped(best->after);
    const Hit hit = collide(bodies_[best->i], bodies_[best->j], best->image);
    wrap();
    return hit;
  }

 private:
  struct Body {
    Id id;
    Real2 p;
    Real2 v;
    Real radius;
    Real mass;
  };

  static std::optional<Real> meeting(const Body& a, const Body& b, const Real2& image) {
    const Real2 p{b.p.x + image.x - a.p.x, b.p.y + image.y - a.p.y};
    const Real2 v{b.v.x - a.v.x, b.v.y - a.v.y};
    const Real half = dot(p, v);
    if (half >= 0) return std::nullopt;
    const Real reach = a.radius + b.radius;
    const Real disc = half * half - dot(v, v) * (dot(p, p) - reach * reach);
    if (disc <= 0) return std::nullopt;
    return Real((-half - sqrt(disc)) / dot(v, v));
  }

  Hit collide(Body& a, Body& b, const Real2& image) {
    const Real2 p{b.p.x + image.x - a.p.x, b.p.y + image.y - a.p.y};
    const Real2 v{b.v.x - a.v.x, b.v.y - a.v.y};
    const Real along = 2 * dot(p, v) / (dot(p, p) * (1 / a.mass + 1 / b.mass));
    a.v = {a.v.x + along / a.mass * p.x, a.v.y + along / a.mass * p.y};
    b.v = {b.v.x - along / b.mass * p.x, b.v.y - along / b.mass * p.y};
    const Real part = a.radius / (a.radius + b.radius);
    Hit hit{now_, a.id, b.id, {a.p.x + part * p.x, a.p.y + part * p.y}};
    if (hit.a > hit.b) std::swap(hit.a, hit.b);
    hit.point = in_cell(hit.point);
    return hit;
  }

  Real step_max() const {
    Real fastest = 0;
    for (const Body& b : bodies_) fastest = std::max({fastest, Real(abs(b.v.x)), Real(abs(b.v.y))});
    return std::min(period_.x, period_.y) / (4 * fastest);
  }
  void fly_unwrapped(const Real& t) {
    for (Body& b : bodies_) b.p = {b.p.x + b.v.x * t, b.p.y + b.v.y * t};
    now_ += t;
  }
  void fly(const Real& t) {
    fly_unwrapped(t);
    wrap();
  }
  Real2 in_cell(const Real2& p) const {
    return {p.x - floor(p.x / period_.x) * period_.x, p.y - floor(p.y / period_.y) * period_.y};
  }
  void wrap() {
    for (Body& b : bodies_) b.p = in_cell(b.p);
  }

  std::vector<Body> bodies_;
  Real2 period_;
  Real now_ = 0;
};

}  // namespace stoss::test

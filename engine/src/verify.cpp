// SPDX-License-Identifier: Apache-2.0
#include <stoss/engine/verify.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::engine {

double overlap_tolerance(Arithmetic arithmetic) {
  constexpr double kOfFloat = 1e-3;
  return arithmetic == Arithmetic::Float ? kOfFloat : kOverlapTolerance;
}

double drift_tolerance(Arithmetic arithmetic) {
  // Wide worlds report impulses in double, so their books are no better than those of double.
  return arithmetic == Arithmetic::Float
             ? std::sqrt(static_cast<double>(std::numeric_limits<float>::epsilon()))
             : std::sqrt(std::numeric_limits<double>::epsilon());
}

bool is_healthy(const Verification& found, Arithmetic arithmetic) {
  const double tolerance = drift_tolerance(arithmetic);
  return found.overlaps == 0 && found.missed == 0 && found.energy_error <= tolerance &&
         found.momentum_error <= tolerance;
}

void Verifier::begin(const World& world) {
  const Conserved sums = world.conserved();
  booked_ = {{sums.kinetic_energy, 0}, {{sums.momentum.x(), 0}, {sums.momentum.y(), 0}}};
  energy_max_ = sums.kinetic_energy;
  keeps_books_ = world.effects() == Effects{};
  immovable_.clear();
  world.for_each_disk([this](const BodyState& disk) {
    if (disk.kind != BodyKind::Dynamic) immovable_.insert(disk.id);
  });
  left_ = period_;
}

/// What an immovable body of that velocity gives to the disk that it meets, equation (1).
void Verifier::give(const Vector2& impulse, const Vector2& velocity) {
  booked_.momentum = {booked_.momentum.x + impulse.x(), booked_.momentum.y + impulse.y()};
  if (velocity == Vector2::Zero()) return;
  booked_.energy =
      booked_.energy + two_prod(impulse.x(), velocity.x()) + two_prod(impulse.y(), velocity.y());
}

void Verifier::on_collision(const Collision& collision) {
  const Vector2 on_b = collision.impulse * collision.normal;
  if (collision.kind != ContactKind::DiskDisk) {
    give(-on_b, collision.velocity_b);
  } else if (!immovable_.empty()) {
    if (immovable_.contains(collision.b)) {
      give(-on_b, collision.velocity_b);
    } else if (immovable_.contains(collision.a)) {
      give(on_b, collision.velocity_a);
    }
  }
}

void Verifier::book(const World& world, Id id, double sign) {
  const auto state = world.state(id);
  if (!state) return;  // a wall, or no body
  if (state.value().kind != BodyKind::Dynamic) {
    if (sign > 0) {
      immovable_.insert(id);
    } else {
      immovable_.erase(id);
    }
    return;
  }
  const double mass = sign * world.body(id).value().mass;
  const Vector2& v = state.value().velocity;
  booked_.energy =
      booked_.energy + (two_prod(v.x(), v.x()) + two_prod(v.y(), v.y())) * (0.5 * mass);
  booked_.momentum = {booked_.momentum.x + two_prod(v.x(), mass),
                      booked_.momentum.y + two_prod(v.y(), mass)};
}

void Verifier::take_out(const World& world, std::span<const Id> ids) {
  for (const Id id : ids) book(world, id, -1);
}

void Verifier::put_in(const World& world, std::span<const Id> ids) {
  for (const Id id : ids) book(world, id, 1);
}

void Verifier::audit(const World& world) {
  const Conserved now = world.conserved();
  energy_max_ = std::max(energy_max_, now.kinetic_energy);
  const double energy = std::abs(to_scalar(booked_.energy - now.kinetic_energy));
  const Vector2 momentum{to_scalar(booked_.momentum.x - now.momentum.x()),
                         to_scalar(booked_.momentum.y - now.momentum.y())};
  if (energy > 0) found_.energy_error = std::max(found_.energy_error, energy / energy_max_);
  double mass = 0;
  for (const Id id : world.ids()) {
    const BodyRecord body = world.body(id).value();
    if (!body.is_wall && body.kind == BodyKind::Dynamic) mass += body.mass;
  }
  // By Cauchy and Schwarz no momentum of these masses and that energy is larger.
  const double momentum_max = std::sqrt(2 * energy_max_) * std::sqrt(mass);
  if (const double error = momentum.stableNorm(); error > 0) {
    found_.momentum_error = std::max(found_.momentum_error, error / momentum_max);
  }
}

const Verification& Verifier::check(const World& world) {
  const Census census = world.census();
  ++found_.checks;
  // The census counts from kOverlapTolerance on, which a world in float does not keep.
  if (census.deepest > overlap_tolerance(world.arithmetic())) found_.overlaps += census.overlaps;
  found_.missed += census.missed;
  found_.deepest = std::max(found_.deepest, census.deepest);
  if (keeps_books_) audit(world);
  left_ = period_;
  return found_;
}

}  // namespace stoss::engine

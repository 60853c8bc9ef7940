// SPDX-License-Identifier: Apache-2.0
#pragma once

// A world's identity in canonical bytes: one word with the arithmetic and which effects are on,
// then their numbers, and the periods last. Without any it is the arithmetic alone.

#include "bytes.hpp"

#include <stoss/engine/effects.hpp>
#include <stoss/engine/types.hpp>

#include <array>
#include <bit>

namespace stoss::engine {

struct WorldIdentity {
  Arithmetic arithmetic = Arithmetic::Double;
  Effects effects;
  Vector2 period = Vector2::Zero();
  friend bool operator==(const WorldIdentity&, const WorldIdentity&) = default;
};

namespace detail {

/// Calls `visit(bit, optional, numbers...)` for each effect, in the order of the bytes.
template <class AnyEffects, class Visit>
void for_each_effect(AnyEffects& effects, const Visit& visit) {
  visit(0,
        effects.restitution,
        &Restitution::coefficient,
        &Restitution::wall_coefficient,
        &Restitution::contact_duration,
        &Restitution::rest_speed);
  visit(1, effects.rough, &Rough::tangential_restitution, &Rough::friction);
  visit(2, effects.gravity, &Gravity::acceleration);
  visit(3, effects.floor_friction, &FloorFriction::deceleration);
  visit(4, effects.drag, &Drag::rate);
  visit(5, effects.growth, &Growth::rate);
  visit(6, effects.thermostat, &Thermostat::temperature, &Thermostat::rate, &Thermostat::seed);
}

template <class Sink>
void write_number(Sink& sink, double number) {
  sink.word(std::bit_cast<std::uint64_t>(number));
}
template <class Sink>
void write_number(Sink& sink, std::uint64_t number) {
  sink.word(number);
}
template <class Sink>
void write_number(Sink& sink, const Vector2& v) {
  write_number(sink, v.x());
  write_number(sink, v.y());
}
inline void read_number(ByteSource& source, double& number) {
  number = std::bit_cast<double>(source.word());
}
inline void read_number(ByteSource& source, std::uint64_t& number) { number = source.word(); }
inline void read_number(ByteSource& source, Vector2& v) {
  read_number(source, v.x());
  read_number(source, v.y());
}

inline constexpr int kFirstEffectBit = 8;
inline constexpr std::uint64_t kEffectBits = 0b1111'1111;
/// Of a world that takes zones; the effects keep the bits below.
inline constexpr int kZonesBit = kFirstEffectBit + 16;
inline constexpr std::uint64_t kPeriodBit = 1 << 7;  // like an effect, after them all

}  // namespace detail

template <class Sink>
void write_identity(Sink& sink, const WorldIdentity& identity) {
  auto word = static_cast<std::uint64_t>(identity.arithmetic);
  detail::for_each_effect(identity.effects, [&](int bit, const auto& effect, auto...) {
    if (effect) word |= std::uint64_t{1} << (detail::kFirstEffectBit + bit);
  });
  const bool is_periodic = identity.period != Vector2::Zero();
  if (is_periodic) word |= detail::kPeriodBit << detail::kFirstEffectBit;
  if (identity.effects.zones) word |= std::uint64_t{1} << detail::kZonesBit;
  sink.word(word);
  detail::for_each_effect(identity.effects, [&](int, const auto& effect, auto... number) {
    if (effect) (detail::write_number(sink, (*effect).*number), ...);
  });
  if (is_periodic) detail::write_number(sink, identity.period);
}

/// Nothing if the word is none that write_identity() writes, or the effects are impossible.
inline std::optional<WorldIdentity> read_identity(ByteSource& source) {
  const std::uint64_t whole = source.word();
  const bool zones = ((whole >> detail::kZonesBit) & 1) != 0;
  const std::uint64_t word = whole ^ (std::uint64_t{zones} << detail::kZonesBit);
  const std::uint64_t arithmetic = word & ((std::uint64_t{1} << detail::kFirstEffectBit) - 1);
  const std::uint64_t mask = word >> detail::kFirstEffectBit;
  if (arithmetic > static_cast<std::uint64_t>(Arithmetic::Float128)) return std::nullopt;
  if ((mask & ~detail::kEffectBits) != 0) return std::nullopt;
  WorldIdentity identity{static_cast<Arithmetic>(arithmetic), {}, Vector2::Zero()};
  identity.effects.zones = zones;
  detail::for_each_effect(identity.effects, [&](int bit, auto& effect, auto... number) {
    if (((mask >> bit) & 1) == 0) return;
    effect.emplace();
    (detail::read_number(source, (*effect).*number), ...);
  });
  if ((mask & detail::kPeriodBit) != 0) detail::read_number(source, identity.period);
  if (source.ran_out() || check_effects(identity.effects) || check_period(identity.period)) {
    return std::nullopt;
  }
  return identity;
}

}  // namespace stoss::engine

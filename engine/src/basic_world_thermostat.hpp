// SPDX-License-Identifier: Apache-2.0
#pragma once

// The thermostat: each dynamic disk waits for its next kick. Its instant is drawn at the kick
// before, and is part of the world's state. Worlds without a thermostat keep nothing here.

#include "basic_world.hpp"
#include "motion_law/thermostat.hpp"

namespace stoss::engine {

/// The first kick of a disk that has just come under the thermostat.
template <class S, class Laws>
auto BasicWorld<S, Laws>::first_kick(Slot slot, const Thermostat& thermostat) const -> Kicks {
  return {next_kick(slot, thermostat, 0, now_), 0};
}

/// When the kick of that number comes after `from`.
template <class S, class Laws>
Time<S> BasicWorld<S, Laws>::next_kick(Slot slot,
                                       const Thermostat& thermostat,
                                       std::uint64_t number,
                                       const Time<S>& from) const {
  if (!(thermostat.rate > 0) || !at(slot).is_dynamic()) return Time<S>::never();
  const double wait = wait_before({thermostat.seed, at(slot).id, number}, thermostat.rate);
  const DoubleWord<S> words = detail::stored<S>(wait);
  return later_by(from, words.hi, words.lo).value_or(Time<S>::never());
}

template <class S, class Laws>
void BasicWorld<S, Laws>::start_kicks([[maybe_unused]] Slot slot) {
  if constexpr (!Laws::kPlain) {
    if (!laws_.as_asked.thermostat) return;
    if (index(slot) >= kicks_.size()) kicks_.resize(index(slot) + 1);
    kicks_[index(slot)] = first_kick(slot, *laws_.as_asked.thermostat);
  }
}

template <class S, class Laws>
std::optional<Event<S>> BasicWorld<S, Laws>::kick_event(Slot slot) const {
  if (index(slot) >= kicks_.size()) return std::nullopt;
  Event<S> event;
  event.at = kicks_[index(slot)].next;
  event.kind = EventKind::Kick;
  if (event.at == Time<S>::never() || !at(slot).is_dynamic()) return std::nullopt;
  return event;
}

/// Gives the disk a velocity of the bath, and in a rough world a spin. One at rest is let go.
template <class S, class Laws>
void BasicWorld<S, Laws>::kick(Slot slot, const Time<S>& instant) {
  const Thermostat& thermostat = *laws_.as_asked.thermostat;
  auto&& body = at(slot);
  Kicks& kicks = kicks_[index(slot)];
  const KickKey key{thermostat.seed, body.id, kicks.count};
  const auto mass = static_cast<double>(body.mass());
  rebase(slot, instant);
  let_go(slot);
  body.set_velocity(detail::stored<S>(velocity_after(key, thermostat.temperature, mass)));
  if (laws_.is_rough) {
    const auto radius = static_cast<double>(body.radius());
    body.spin = detail::stored<S>(spin_after(key, thermostat.temperature, mass, radius));
  }
  renew_law(slot);
  ++kicks.count;
  kicks.next = next_kick(slot, thermostat, kicks.count, instant);
  ++counters_.kicks;
  predict(slot, /*changed=*/true);
}

template <class S, class Laws>
template <class Sink>
void BasicWorld<S, Laws>::write_kicks(Sink& sink, Slot slot, const Thermostat& thermostat) const {
  const Kicks kicks = kicks_under(slot, thermostat);
  write_time(sink, kicks.next);
  sink.word(kicks.count);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::read_kicks([[maybe_unused]] ByteSource& source,
                                     [[maybe_unused]] Slot slot) {
  if constexpr (!Laws::kPlain) {
    if (!laws_.as_asked.thermostat) return;
    if (index(slot) >= kicks_.size()) kicks_.resize(index(slot) + 1);
    kicks_[index(slot)].next = read_time<Time<S>>(source);
    kicks_[index(slot)].count = source.word();
  }
}

/// Could a disk wait for this kick?
template <class S, class Laws>
bool BasicWorld<S, Laws>::has_sound_kicks([[maybe_unused]] Slot slot) const {
  if constexpr (!Laws::kPlain) {
    if (!laws_.as_asked.thermostat) return true;
    const Kicks& kicks = kicks_[index(slot)];
    const bool is_kicked = at(slot).is_dynamic() && laws_.as_asked.thermostat->rate > 0;
    if (kicks.next == Time<S>::never()) return true;  // it lies beyond the end of time
    return is_kicked && in_range(to_instant(kicks.next)) && kicks.next >= now_;
  }
  return true;
}

}  // namespace stoss::engine

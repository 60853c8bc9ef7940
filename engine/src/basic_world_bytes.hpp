// SPDX-License-Identifier: Apache-2.0
#pragma once

// The world as canonical bytes and as a digest.
//
// Layout, in 64-bit words: magic, format, arithmetic, effects and periods, now, collisions at now
// that count towards a stall, collisions, regularised, kicks (with a thermostat), next id, retired
// runs (count, then first and last of each), bodies and zones (count, then each in the order of
// ids; the word of a disk's type counts its passages, too), and the number of zone events if there
// have been any. No event, box, list or slot is written: predictions are functions of the motions
// and are made anew.

#include "basic_world.hpp"
#include "bytes.hpp"
#include "effects_bytes.hpp"
#include "limits.hpp"

#include <algorithm>
#include <utility>

namespace stoss::engine {

inline constexpr std::uint64_t kBytesMagic = 0x31444c525753534fU;
/// Raised whenever the layout changes or the engine's results do.
inline constexpr std::uint64_t kBytesFormat = 1;
/// Of a body's word, for its type.
inline constexpr int kTypeBits = 8;

template <class S, class Laws>
template <class Sink>
void BasicWorld<S, Laws>::write_body(Sink& sink, Slot slot, const Effects& kind) const {
  const auto& body = at(slot);
  sink.word(body.id);
  sink.word(static_cast<std::uint64_t>(body.type) | (passage_count(slot) << kTypeBits));
  write_time(sink, body.since());
  write_vector(sink, body.position());
  write_vector(sink, body.velocity());
  if (body.is_wall()) {
    write_vector(sink, shape(slot).edge);
    return;
  }
  if (is_zone(slot)) {
    write_scalar(sink, body.radius());
    return;
  }
  if constexpr (Laws::kGrows) {
    const bool goes_on = laws_for(kind) == LawsKind::Growing;
    write_scalar(sink, goes_on ? body.radius() : to_scalar(body.grown));
  } else {
    write_scalar(sink, body.radius());
  }
  write_scalar(sink, body.mass());
  write_body_part(sink, slot, kind);
  write_passages(sink, slot);
}

template <class S, class Laws>
std::vector<std::byte> BasicWorld<S, Laws>::serialise() const {
  return bytes_for(effects());
}

/// As a world with these effects would write the same state.
template <class S, class Laws>
std::vector<std::byte> BasicWorld<S, Laws>::bytes_for(const Effects& kind) const {
  ByteSink sink;
  sink.word(kBytesMagic);
  sink.word(kBytesFormat);
  write_identity(sink, {arithmetic_, kind, period()});
  write_time(sink, now_);
  sink.word(crowded_instant_ == now_ ? crowd_ : 0);
  sink.word(counters_.collisions);
  sink.word(counters_.regularised);
  if (kind.thermostat) sink.word(counters_.kicks);
  sink.word(next_id_);
  sink.word(ledger_.runs().size());
  for (const auto& [first, last] : ledger_.runs()) {
    sink.word(first);
    sink.word(last);
  }
  sink.word(slots_.size());
  for (const Slot slot : ordered_slots()) write_body(sink, slot, kind);
  if (counters_.zone_events > 0) sink.word(counters_.zone_events);
  return sink.take();
}

template <class S, class Laws>
[[gnu::always_inline]] inline void BasicWorld<S, Laws>::note_digest_stale(Slot slot) {
  if (!digests_.is_kept) return;
  if (index(slot) < digests_.is_stale.size() && digests_.is_stale[index(slot)] != 0) return;
  note_fresh_digest_stale(slot);
}

template <class S, class Laws>
[[gnu::noinline]] void BasicWorld<S, Laws>::note_fresh_digest_stale(Slot slot) {
  if (index(slot) >= digests_.of_slot.size()) {
    digests_.of_slot.resize(index(slot) + 1, 0);
    digests_.is_stale.resize(index(slot) + 1, 0);
  }
  if (std::exchange(digests_.is_stale[index(slot)], std::uint8_t{1}) != 0) return;
  digests_.stale.push_back(slot);
}

template <class S, class Laws>
std::uint64_t BasicWorld<S, Laws>::digest_of(Slot slot, const Effects& kind) const {
  if (at(slot).id == kNoId) return 0;
  DigestSink digest;
  write_body(digest, slot, kind);
  return digest.digest();
}

// A sum over bodies, so that it does not depend on an order and follows changes body by body.
template <class S, class Laws>
std::uint64_t BasicWorld<S, Laws>::state_hash() const {
  const Effects kind = effects();
  DigestSink header;
  write_identity(header, {arithmetic_, kind, period()});
  header.word(counters_.collisions);
  header.word(counters_.regularised);
  if (kind.thermostat) header.word(counters_.kicks);
  header.word(next_id_);
  if (counters_.zone_events > 0) header.word(counters_.zone_events);
  for (const auto& [first, last] : ledger_.runs()) {
    header.word(first);
    header.word(last);
  }
  if (!std::exchange(digests_.is_kept, true)) {
    digests_.of_slot.assign(bodies_.size(), 0);
    digests_.is_stale.assign(bodies_.size(), 0);
    for (Slot slot = 0; index(slot) < bodies_.size(); ++slot) {
      digests_.sum += digests_.of_slot[index(slot)] = digest_of(slot, kind);
    }
  }
  for (const Slot slot : digests_.stale) {
    const std::uint64_t now = digest_of(slot, kind);
    digests_.sum += now - std::exchange(digests_.of_slot[index(slot)], now);
    digests_.is_stale[index(slot)] = 0;
  }
  digests_.stale.clear();
  return header.digest() + digests_.sum;
}

template <class S, class Laws>
Outcome<Done> BasicWorld<S, Laws>::restore(std::span<const std::byte> bytes) {
  const auto damaged = [](const char* why) {
    return Reject{.code = Code::InvalidArgument, .field = "bytes", .reason = why};
  };
  ByteSource source(bytes);
  if (source.word() != kBytesMagic) return damaged("these are not a world's bytes");
  if (source.word() != kBytesFormat) return damaged("written in a format that is not known here");
  const auto identity = read_identity(source);
  if (!identity || *identity != WorldIdentity{arithmetic_, effects(), period()}) {
    return damaged("written in another arithmetic, or with other effects or periods");
  }
  BasicWorld fresh({.start = {},
                    .arithmetic = arithmetic_,
                    .broad_phase = broad_phase_,
                    .effects = effects(),
                    .period = period()});
  fresh.now_ = read_time<Time<S>>(source);
  if (!in_range(to_instant(fresh.now_))) return damaged("the instant is damaged");
  fresh.crowded_instant_ = fresh.now_;
  fresh.crowd_ = source.word();
  fresh.counters_.collisions = source.word();
  fresh.counters_.regularised = source.word();
  if (effects().thermostat) fresh.counters_.kicks = source.word();
  const Id next_id = source.word();
  const std::uint64_t run_count = source.word();
  if (run_count > source.words_left()) return damaged("truncated");
  Id retired = kNoId;
  for (std::uint64_t i = 0; i < run_count; ++i) {
    const Id first = source.word();
    const Id last = source.word();
    // Runs with a gap between them, in order.
    if (first <= retired || (i > 0 && first == retired + 1) || last < first || last >= next_id) {
      return damaged("the retired ids are damaged");
    }
    fresh.ledger_.restore_run(first, last);
    retired = last;
  }
  if (const char* const why = fresh.read_bodies(source)) return damaged(why);
  if (source.words_left() > 0) fresh.counters_.zone_events = source.word();
  if (!source.at_end()) return damaged("truncated, or with bytes left over");
  const Id previous = fresh.slots_.empty() ? kNoId : fresh.at(fresh.ordered_slots().back()).id;
  fresh.next_id_ = next_id;
  const std::vector<std::byte> again = fresh.serialise();
  if (previous >= next_id || !std::equal(bytes.begin(), bytes.end(), again.begin(), again.end())) {
    return damaged("not as any world would write itself");
  }
  for (const Slot slot : fresh.ordered_slots()) {
    if (!fresh.has_sound_supports(slot)) return damaged("what a body rests on is damaged");
    if (!fresh.has_sound_passages(slot)) {
      return damaged("where a disk stands with zones is damaged");
    }
  }
  fresh.settle();
  if (const Slot next = fresh.next_slot();
      next >= 0 && fresh.queue_.event_of(next).at < fresh.now_) {
    return damaged("a contact lies before the present");
  }
  *this = std::move(fresh);
  return Done{};
}

/// Null, or what is wrong with them.
template <class S, class Laws>
const char* BasicWorld<S, Laws>::read_bodies(ByteSource& source) {
  constexpr BodyType kLastType = Laws::kPlain ? BodyType::Wall : BodyType::Zone;
  const std::uint64_t count = source.word();
  constexpr std::uint64_t kWordsMin = 12;  // id, type, instant, position and velocity
  if (count > source.words_left() / kWordsMin) return "truncated";
  make_room(count);
  Id previous = kNoId;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Id id = source.word();
    const std::uint64_t word = source.word();
    const std::uint64_t type = word & ((std::uint64_t{1} << kTypeBits) - 1);
    if (id <= previous || type > static_cast<std::uint64_t>(kLastType) || ledger_.is_retired(id)) {
      return "the bodies are damaged";
    }
    previous = id;
    read_body(source, id, static_cast<BodyType>(type));
    if (!is_sound(slot_of(id))) return "a body is damaged";
    if (!read_passages(source, slot_of(id), word >> kTypeBits)) {
      return "where a disk stands with zones is damaged";
    }
  }
  return nullptr;
}

template <class S, class Laws>
void BasicWorld<S, Laws>::read_body(ByteSource& source, Id id, BodyType type) {
  const Slot slot = take_slot(id, type);
  auto&& body = at(slot);
  body.set_since(read_time<Time<S>>(source));
  body.set_position(read_vector<S>(source));
  body.set_velocity(read_vector<S>(source));
  if (body.is_wall()) {
    body.set_wall(static_cast<std::int32_t>(shapes_.size()));
    shapes_.push_back({read_vector<S>(source), {}});
    ++walls_in_use_;
    return;
  }
  body.set_radius(read_scalar<S>(source));
  if (is_zone(slot)) {
    ++zones_in_use_;
    return;
  }
  body.set_mass(read_scalar<S>(source));
  read_body_part(source, slot);
}

// Could this body have come of commands and collisions?
template <class S, class Laws>
bool BasicWorld<S, Laws>::is_sound(Slot slot) const {
  const auto& body = at(slot);
  const auto is_number = [](const DoubleWord<S>& x) {
    return std::isfinite(static_cast<double>(x.hi)) && S(x.hi + x.lo) == x.hi;
  };
  const auto are_numbers = [&](const DoubleWord2<S>& v) {
    return is_number(v.x) && is_number(v.y);
  };
  const auto& m = body.motion();
  if (!in_range(to_instant(m.since)) || m.since > now_) return false;
  if (!are_numbers(m.position) || !are_numbers(m.velocity) || !is_in_bounds(slot)) return false;
  if (body.is_wall()) {
    const DoubleWord2<S>& edge = shape(slot).edge;
    return are_numbers(edge) && (edge.x.hi != S(0) || edge.y.hi != S(0));
  }
  const bool moves = m.velocity.x.hi != S(0) || m.velocity.y.hi != S(0);
  if (body.type == BodyType::Static && moves) return false;
  if (!(body.radius() > S(0) && static_cast<double>(body.radius()) <= detail::kLengthMax<S>)) {
    return false;
  }
  if (is_zone(slot)) return !moves;
  if constexpr (Laws::kGrows) {
    if (!is_number(body.grown) || !(body.grown.hi > S(0))) return false;
  }
  const Rotation rotation = rotation_of(slot);
  return has_sound_kicks(slot) && detail::is_usable_mass<S>(static_cast<double>(body.mass())) &&
         std::isfinite(rotation.angle) && std::isfinite(rotation.spin);
}

// Boxes, vertices and events for bodies that have just been read.
template <class S, class Laws>
void BasicWorld<S, Laws>::settle() {
  sights_.epoch.start(now_);
  for (const Slot slot : ordered_slots()) renew_law(slot);
  for (const Slot slot : ordered_slots()) renew_box(slot, first_margin(slot));
  for (const Slot slot : ordered_slots()) {
    if (at(slot).is_wall()) link_vertices(slot);
  }
  for (const Slot slot : ordered_slots()) predict(slot, /*changed=*/true);
}

}  // namespace stoss::engine

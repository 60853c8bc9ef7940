// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_log.hpp"

#include <stoss/client/json.hpp>

namespace stoss::client::cli {
namespace {

// Fowler, Noll, Vo: RFC 9923, sections 5 and 6.
constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325U;
constexpr std::uint64_t kFnvPrime = 0x100000001b3U;

}  // namespace

CollisionLog::CollisionLog(const std::optional<std::string>& path,
                           bool digest,
                           std::uint64_t verify)
    : digesting_(digest), digest_(kFnvOffset) {
  if (path) file_.emplace(*path);
  if (verify != 0) verifier_.emplace(verify);
}

void CollisionLog::count_events(const engine::World& world, std::uint64_t events) {
  events_ += events;
  if (!verifier_) return;
  verifier_->count_events(events);
  if (verifier_->events_left() == 0) verifier_->check(world);
}

void CollisionLog::on_collision(const engine::Collision& collision) {
  ++collisions_;
  if (collision.regularised) ++regularised_;
  if (collision.order_dependent) ++order_dependent_;
  if (verifier_) verifier_->on_collision(collision);
  if (!file_ && !digesting_) return;
  std::string& out = file_ ? file_->buffer() : line_;
  if (!file_) out.clear();
  const std::size_t first = out.size();
  append_json(out, collision);
  out += '\n';
  if (digesting_) digest_from(out, first);
  // Inside one advance millions may come; the engine does not mind a sink that takes its time.
  if (file_) file_->flush_if_full();
}

void CollisionLog::on_zone_event(const engine::ZoneEvent& event) {
  if (!zones_) return;
  append_json(zones_->buffer(), event);
  zones_->buffer() += '\n';
  zones_->flush_if_full();
}

void CollisionLog::digest_from(const std::string& text, std::size_t first) {
  for (std::size_t i = first; i < text.size(); ++i) {
    digest_ = (digest_ ^ static_cast<unsigned char>(text[i])) * kFnvPrime;
  }
}

void CollisionLog::flush_if_full() {
  if (file_) file_->flush_if_full();
  if (zones_) zones_->flush_if_full();
}

void CollisionLog::finish() {
  if (file_) file_->flush();
  if (zones_) zones_->flush();
}

}  // namespace stoss::client::cli

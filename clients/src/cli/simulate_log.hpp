// SPDX-License-Identifier: Apache-2.0
#pragma once

// The collision log of an offline run: written, digested, or only counted; and told to the
// verifier.

#include "cli/log_file.hpp"

#include <stoss/engine/types.hpp>
#include <stoss/engine/verify.hpp>
#include <stoss/engine/world.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace stoss::client::cli {

/// Takes collisions from the engine. Writes lines when there is a path, digests the same lines when
/// that is asked for.
class CollisionLog : public engine::CollisionSink {
 public:
  /// `verify`: events between two checks of the world; 0: none.
  CollisionLog(const std::optional<std::string>& path, bool digest, std::uint64_t verify = 0);
  /// Writes zone events, too, to a file of their own.
  void write_zone_events_to(const std::string& path) { zones_.emplace(path); }

  void on_collision(const engine::Collision& collision) override;
  void on_zone_event(const engine::ZoneEvent& event) override;
  /// To be called after every advance of the world, with its events.
  void count_events(const engine::World& world, std::uint64_t events);
  void flush_if_full();
  /// Everything is out. Throws std::system_error.
  void finish();

  [[nodiscard]] std::optional<engine::Verifier>& verifier() { return verifier_; }
  [[nodiscard]] const std::optional<engine::Verifier>& verifier() const { return verifier_; }
  [[nodiscard]] std::uint64_t collisions() const { return collisions_; }
  [[nodiscard]] std::uint64_t regularised() const { return regularised_; }
  [[nodiscard]] std::uint64_t order_dependent() const { return order_dependent_; }
  [[nodiscard]] std::uint64_t events() const { return events_; }
  /// FNV-1a (64 bits) of the log's bytes.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }

 private:
  void digest_from(const std::string& text, std::size_t first);

  std::optional<LogFile> file_;
  std::optional<LogFile> zones_;
  std::optional<engine::Verifier> verifier_;
  bool digesting_;
  std::string line_;
  std::uint64_t digest_;
  std::uint64_t collisions_ = 0;
  std::uint64_t regularised_ = 0;
  std::uint64_t order_dependent_ = 0;
  std::uint64_t events_ = 0;
};

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
// Which bodies are published one by one, in which slot, and for whom. A body is watched until the
// last client that asked for it has let go or is gone, or the body is removed.
#pragma once

#include "records.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

namespace stoss::service {

class WatchTable {
 public:
  static constexpr std::size_t kSlots = stoss_v1_MAX_WATCHED;

  /// Watches all of them for a client, or none: false when there are not slots enough. Appends what
  /// has changed to `news`.
  [[nodiscard]] bool watch(const ClientId& client,
                           std::span<const engine::Id> ids,
                           std::vector<WatchRecord>& news);
  void unwatch(const ClientId& client,
               std::span<const engine::Id> ids,
               std::vector<WatchRecord>& news);
  void drop_client(const ClientId& client, std::vector<WatchRecord>& news);
  void drop_bodies(std::span<const engine::Id> ids, std::vector<WatchRecord>& news);

  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  [[nodiscard]] std::vector<engine::Id> ids() const;

 private:
  struct Watched {
    std::uint32_t slot = 0;
    std::set<ClientId> clients;
  };

  void release(engine::Id id, std::vector<WatchRecord>& news);

  std::unordered_map<engine::Id, Watched> bodies_;
  std::array<bool, kSlots> taken_{};
};

}  // namespace stoss::service

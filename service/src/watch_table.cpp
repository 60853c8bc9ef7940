// SPDX-License-Identifier: Apache-2.0
#include "watch_table.hpp"

#include <algorithm>

namespace stoss::service {

bool WatchTable::watch(const ClientId& client,
                       std::span<const engine::Id> ids,
                       std::vector<WatchRecord>& news) {
  std::set<engine::Id> fresh;
  for (const engine::Id id : ids) {
    if (!bodies_.contains(id)) fresh.insert(id);
  }
  if (bodies_.size() + fresh.size() > kSlots) return false;
  for (const engine::Id id : ids) {
    const auto [entry, is_new] = bodies_.try_emplace(id);
    entry->second.clients.insert(client);
    if (!is_new) continue;
    const auto slot = std::find(taken_.begin(), taken_.end(), false);
    *slot = true;
    entry->second.slot = static_cast<std::uint32_t>(slot - taken_.begin());
    news.push_back({entry->second.slot, id});
  }
  return true;
}

void WatchTable::release(engine::Id id, std::vector<WatchRecord>& news) {
  const auto entry = bodies_.find(id);
  taken_[entry->second.slot] = false;
  news.push_back({entry->second.slot, engine::kNoId});
  bodies_.erase(entry);
}

void WatchTable::unwatch(const ClientId& client,
                         std::span<const engine::Id> ids,
                         std::vector<WatchRecord>& news) {
  for (const engine::Id id : ids) {
    const auto entry = bodies_.find(id);
    if (entry == bodies_.end()) continue;
    entry->second.clients.erase(client);
    if (entry->second.clients.empty()) release(id, news);
  }
}

void WatchTable::drop_client(const ClientId& client, std::vector<WatchRecord>& news) {
  unwatch(client, ids(), news);
}

void WatchTable::drop_bodies(std::span<const engine::Id> ids, std::vector<WatchRecord>& news) {
  for (const engine::Id id : ids) {
    if (bodies_.contains(id)) release(id, news);
  }
}

std::vector<engine::Id> WatchTable::ids() const {
  std::vector<engine::Id> all;
  all.reserve(bodies_.size());
  for (const auto& [id, watched] : bodies_) all.push_back(id);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace stoss::service

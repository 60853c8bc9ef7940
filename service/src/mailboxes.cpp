// SPDX-License-Identifier: Apache-2.0
#include "mailboxes.hpp"

#include <utility>

namespace stoss::service {

Mailbox* Mailboxes::find(const ClientId& client) {
  const auto found = boxes_.find(client);
  return found == boxes_.end() ? nullptr : found->second.get();
}

Mailbox* Mailboxes::of(const ClientId& client, Nanoseconds now) {
  if (Mailbox* const box = find(client)) {
    box->used = now;
    return box;
  }
  if (boxes_.size() >= kMailboxesMax) evict_one();
  try {
    auto box = std::make_unique<Mailbox>(participant_, topics_, idl::mailbox_of(world_, client));
    box->used = now;
    return boxes_.emplace(client, std::move(box)).first->second.get();
  } catch (const dds::Error&) {
    ++failures_;
    return nullptr;
  }
}

// Prefers one that nobody reads; a client that is thrown out gets a new one at its next request.
void Mailboxes::evict_one() {
  auto victim = boxes_.end();
  bool victim_is_read = true;
  for (auto box = boxes_.begin(); box != boxes_.end(); ++box) {
    const bool is_read = box->second->has_reader();
    const bool better = victim == boxes_.end() || (victim_is_read && !is_read) ||
                        (victim_is_read == is_read && box->second->used < victim->second->used);
    if (!better) continue;
    victim = box;
    victim_is_read = is_read;
  }
  if (victim == boxes_.end()) return;
  boxes_.erase(victim);
  ++evicted_;
}

std::vector<ClientId> Mailboxes::sweep(Nanoseconds now) {
  std::vector<ClientId> gone;
  for (auto box = boxes_.begin(); box != boxes_.end();) {
    if (now - box->second->used < kMailboxPatience || box->second->has_reader()) {
      ++box;
      continue;
    }
    gone.push_back(box->first);
    box = boxes_.erase(box);
  }
  return gone;
}

}  // namespace stoss::service

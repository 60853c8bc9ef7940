// SPDX-License-Identifier: Apache-2.0
#include "admission.hpp"

namespace stoss::service {

std::optional<Ticket> Admission::admit(const ClientId& client, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (count_ > 0 && (count_ >= limits_.total || bytes_ + bytes > limits_.bytes)) {
    return std::nullopt;
  }
  std::size_t& mine = per_client_[client];
  if (mine >= limits_.per_client) return std::nullopt;
  ++mine;
  ++count_;
  bytes_ += bytes;
  return Ticket(this, client, bytes);
}

std::size_t Admission::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

void Admission::release(const ClientId& client, std::size_t bytes) noexcept {
  const std::lock_guard lock(mutex_);
  const auto mine = per_client_.find(client);
  if (mine != per_client_.end() && --mine->second == 0) per_client_.erase(mine);
  --count_;
  bytes_ -= bytes;
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// The bounds of the daemon's queues: how many requests, and how much of them, may wait at once.
// Whoever is over a bound is told so at once; nobody is made to wait and nothing is lost in
// silence.
//
// Thread safety: all of it may be called from any thread.
#pragma once

#include <stoss/translate/basics.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>

namespace stoss::service {

using translate::ClientId;
using translate::RequestId;

/// A client's id is random already; its first bytes are a hash.
struct ClientHash {
  std::size_t operator()(const ClientId& client) const noexcept {
    std::size_t hash = 0;
    std::memcpy(&hash, client.data(), sizeof hash);
    return hash;
  }
};

class Admission;

/// The right of one request to be in the daemon; gives its place back when it goes. Move-only.
class Ticket {
 public:
  Ticket() = default;
  Ticket(const Ticket&) = delete;
  Ticket& operator=(const Ticket&) = delete;
  Ticket(Ticket&& other) noexcept
      : admission_(std::exchange(other.admission_, nullptr)),
        client_(other.client_),
        bytes_(other.bytes_) {}
  Ticket& operator=(Ticket&& other) noexcept {
    std::swap(admission_, other.admission_);
    std::swap(client_, other.client_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Ticket();

 private:
  friend class Admission;
  Ticket(Admission* admission, const ClientId& client, std::size_t bytes)
      : admission_(admission), client_(client), bytes_(bytes) {}

  Admission* admission_ = nullptr;
  ClientId client_{};
  std::size_t bytes_ = 0;
};

/// Counts the requests that are in the daemon. Must outlive its tickets.
class Admission {
 public:
  struct Limits {
    std::size_t per_client;
    std::size_t total;
    std::size_t bytes;
  };

  explicit Admission(const Limits& limits) : limits_(limits) {}
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;

  /// A place for a request of `bytes`; nothing when a bound is reached. One request of any size is
  /// let in when no other is there.
  [[nodiscard]] std::optional<Ticket> admit(const ClientId& client, std::size_t bytes);

  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] const Limits& limits() const { return limits_; }

 private:
  friend class Ticket;
  void release(const ClientId& client, std::size_t bytes) noexcept;

  const Limits limits_;
  mutable std::mutex mutex_;
  std::unordered_map<ClientId, std::size_t, ClientHash> per_client_;
  std::size_t count_ = 0;
  std::size_t bytes_ = 0;
};

inline Ticket::~Ticket() {
  if (admission_ != nullptr) admission_->release(client_, bytes_);
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// One daemon a world: a name that the kernel gives to one process of a network namespace at a time
// and takes back when the process ends, however it ends. It is the scope of loopback itself, and
// unlike a look around the DDS domain it cannot be won by two at once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace stoss::service {

class WorldLock {
 public:
  /// Nothing when another process serves this world in this domain. Throws std::system_error when
  /// the system refuses for another reason.
  [[nodiscard]] static std::optional<WorldLock> take(std::uint32_t domain,
                                                     const std::string& world);

  WorldLock(const WorldLock&) = delete;
  WorldLock& operator=(const WorldLock&) = delete;
  WorldLock(WorldLock&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  WorldLock& operator=(WorldLock&& other) noexcept {
    std::swap(socket_, other.socket_);
    return *this;
  }
  ~WorldLock();

 private:
  explicit WorldLock(int socket) : socket_(socket) {}

  int socket_;
};

}  // namespace stoss::service

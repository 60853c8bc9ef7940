// SPDX-License-Identifier: Apache-2.0
#include "world_lock.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace stoss::service {

std::optional<WorldLock> WorldLock::take(std::uint32_t domain, const std::string& world) {
  // A name that begins with a zero byte is in the abstract namespace: no file, nothing to clean up.
  const std::string name = "stoss/" + std::to_string(domain) + "/" + world;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() + 1 > sizeof address.sun_path) throw std::invalid_argument("world name too long");
  std::memcpy(&address.sun_path[1], name.data(), name.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());

  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) throw std::system_error(errno, std::generic_category(), "world lock");
  WorldLock lock(socket);
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&address), length) == 0) return lock;
  if (errno == EADDRINUSE) return std::nullopt;
  throw std::system_error(errno, std::generic_category(), "world lock");
}

WorldLock::~WorldLock() {
  if (socket_ >= 0) ::close(socket_);
}

}  // namespace stoss::service

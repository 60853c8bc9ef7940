// SPDX-License-Identifier: Apache-2.0
#include <stoss/dds/loopback_guard.hpp>

#include <linux/filter.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

namespace stoss::dds {
namespace {

int option(int fd, int name) noexcept {
  int value = 0;
  socklen_t size = sizeof value;
  return getsockopt(fd, SOL_SOCKET, name, &value, &size) == 0 ? value : -1;
}

bool is_udp(int fd) noexcept {
  const int domain = option(fd, SO_DOMAIN);
  return (domain == AF_INET || domain == AF_INET6) && option(fd, SO_TYPE) == SOCK_DGRAM;
}

// Calls each(fd, inode) for every UDP socket of this process.
void for_each_udp_socket(const std::function<void(int, unsigned long)>& each) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string name = entry.path().filename().string();
    int fd = -1;
    std::from_chars(name.data(), name.data() + name.size(), fd);
    struct stat status {};
    if (fd < 0 || fstat(fd, &status) != 0 || !S_ISSOCK(status.st_mode) || !is_udp(fd)) continue;
    each(fd, status.st_ino);
  }
}

// Accepts a packet only when the kernel says that it came in on the interface with this index.
void attach_filter(int fd, unsigned interface_index) {
  constexpr std::uint32_t kWholePacket = 0xFFFFFFFFU;
  constexpr auto kInterfaceIndex = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX);
  std::array<sock_filter, 4> code{{
      {BPF_LD | BPF_W | BPF_ABS, 0, 0, kInterfaceIndex},
      {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, interface_index},
      {BPF_RET | BPF_K, 0, 0, kWholePacket},
      {BPF_RET | BPF_K, 0, 0, 0},
  }};
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  if (setsockopt(fd, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) != 0) {
    throw std::system_error(errno, std::generic_category(), "attach the loopback guard");
  }
}

}  // namespace

std::set<unsigned long> udp_sockets() {
  std::set<unsigned long> inodes;
  for_each_udp_socket([&](int, unsigned long inode) { inodes.insert(inode); });
  return inodes;
}

std::size_t guard_new_sockets(const std::set<unsigned long>& before, const std::string& interface) {
  const unsigned index = if_nametoindex(interface.c_str());
  if (index == 0) {
    throw std::system_error(errno, std::generic_category(), "find interface " + interface);
  }
  std::size_t guarded = 0;
  for_each_udp_socket([&](int fd, unsigned long inode) {
    if (before.count(inode) != 0) return;
    attach_filter(fd, index);
    ++guarded;
  });
  return guarded;
}

}  // namespace stoss::dds

// SPDX-License-Identifier: Apache-2.0
// Cyclone binds its receiving sockets to every address of the machine, whatever interface it is
// configured for, and so would parse packets from anywhere. A socket filter that looks at the
// interface a packet came in on drops the others in the kernel. It needs no privilege.
#pragma once

#include <cstddef>
#include <set>
#include <string>

namespace stoss::dds {

/// The inodes of this process's UDP sockets.
[[nodiscard]] std::set<unsigned long> udp_sockets();

/// Attaches the filter to every UDP socket of this process that is not in `before`: from then on
/// they receive only what arrives on `interface`. Returns how many sockets it guards. Throws
/// std::system_error when one cannot be guarded, since half a guard is none.
std::size_t guard_new_sockets(const std::set<unsigned long>& before, const std::string& interface);

}  // namespace stoss::dds

// SPDX-License-Identifier: Apache-2.0
// How this process takes part in a DDS domain: the network it uses and its place in discovery.
#pragma once

#include <cstdint>
#include <string>

namespace stoss::dds {

/// The two places in the discovery star. Daemons sit on well-known ports; clients ask those ports
/// and do not learn of each other, so that the cost of a client does not grow with their number.
enum class Role { kDaemon, kClient };

/// The network that a domain uses. The default never leaves this machine.
struct Network {
  Role role = Role::kClient;
  /// The interface, as "eth0". Anything but "lo" needs `allow_network`.
  std::string interface = "lo";
  /// Where daemons are looked for: an IPv4 address, or address:port. Only clients use it.
  std::string peer = "127.0.0.1";
  /// Says that traffic beyond this machine is meant. Cyclone 0.10 can be stopped by one forged
  /// packet: only on networks whose every host is trusted, or with DDS Security.
  bool allow_network = false;
  /// More elements for <Domain> (Security, Tracing, Internal/Test), merged by Cyclone; or empty.
  std::string extra_xml;
};

/// The most daemons that one domain of a machine can hold; see ParticipantIndex in the profile.
inline constexpr int kMaxDaemonsPerDomain = 32;

/// Domain ids whose ports lie below the ephemeral range of Linux.
inline constexpr std::uint32_t kMaxDomainId = 101;

/// Cyclone's configuration for `network`, as XML. Throws std::invalid_argument when an interface
/// beyond this machine is named without `allow_network`, or a name would break the XML.
[[nodiscard]] std::string domain_config(const Network& network);

/// The same for the loopback interface.
[[nodiscard]] std::string loopback_config(Role role);

}  // namespace stoss::dds

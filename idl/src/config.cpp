// SPDX-License-Identifier: Apache-2.0
// The Cyclone DDS profiles of daemons and clients. Every element that departs from Cyclone's
// default has its reason here; deploy/cyclonedds-loopback.xml shows the client's for tools that are
// not ours.
#include <stoss/dds/config.hpp>

#include <stdexcept>

namespace stoss::dds {
namespace {

// A name that can stand in an XML attribute without escaping, and is not empty.
void check_plain(const std::string& value, const char* what) {
  constexpr const char* kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._:-";
  if (value.empty() || value.find_first_not_of(kAllowed) != std::string::npos) {
    throw std::invalid_argument(std::string(what) + " \"" + value +
                                "\" must be letters, digits, '.', ':', '_' or '-'");
  }
}

// Cyclone does not find that loopback can do without multicast, and a LAN should not be flooded by
// it.
std::string general(const Network& network) {
  // One sample of up to 60 KiB is one datagram on loopback; on Ethernet a lost frame of a large
  // datagram loses all of it, so there Cyclone's own sizes stay.
  const std::string sizes = network.allow_network ? ""
                                                  : "<MaxMessageSize>65500 B</MaxMessageSize>"
                                                    "<FragmentSize>65000 B</FragmentSize>";
  return "<General><Interfaces><NetworkInterface name=\"" + network.interface +
         "\" multicast=\"false\" presence_required=\"true\"/></Interfaces>"
         "<AllowMulticast>false</AllowMulticast>" +
         sizes + "</General>";
}

// Daemons take the well-known ports of indices 0 to 31. Clients take any ports and greet those 32
// every second, so that whoever comes later is found within that time.
std::string discovery(const Network& network) {
  const std::string last_index = std::to_string(kMaxDaemonsPerDomain - 1);
  std::string xml = "<Discovery>";
  if (network.role == Role::kDaemon) {
    xml += "<ParticipantIndex>auto</ParticipantIndex>";
  } else {
    xml += "<ParticipantIndex>none</ParticipantIndex><Peers><Peer address=\"" + network.peer +
           "\"/></Peers>";
  }
  xml += "<MaxAutoParticipantIndex>" + last_index + "</MaxAutoParticipantIndex>";
  // A process that was killed is noticed after the lease; Cyclone's 10 s is long for a person
  // waiting.
  return xml + "<LeaseDuration>3s</LeaseDuration><SPDPInterval>500ms</SPDPInterval></Discovery>";
}

// With Cyclone's defaults a first sample, or one that was lost, can be 100 ms late twice over.
std::string internal(const Network& network) {
  // A daemon must not wait for a dead client's acknowledgments when it drops that client's mailbox.
  const std::string linger = network.role == Role::kDaemon ? "0s" : "100ms";
  return "<Internal><SocketReceiveBufferSize max=\"4MB\"/>"
         "<NackDelay>1ms</NackDelay><PreEmptiveAckDelay>1ms</PreEmptiveAckDelay>"
         "<HeartbeatInterval min=\"1ms\" minsched=\"5ms\" max=\"1s\">20ms</HeartbeatInterval>"
         "<WriterLingerDuration>" +
         linger +
         "</WriterLingerDuration>"
         // Twice the longest sample that the types allow (a Command at its bounds).
         "<MaxSampleSize>512 kB</MaxSampleSize></Internal>";
}

}  // namespace

std::string domain_config(const Network& network) {
  check_plain(network.interface, "network interface");
  check_plain(network.peer, "discovery peer");
  const bool beyond = network.interface != "lo" || network.peer.rfind("127.", 0) != 0;
  if (beyond && !network.allow_network) {
    throw std::invalid_argument("interface \"" + network.interface + "\" with peer \"" +
                                network.peer +
                                "\" leaves this machine, which must be allowed explicitly");
  }
  return "<CycloneDDS xmlns=\"https://cdds.io/config\"><Domain Id=\"any\">" + general(network) +
         discovery(network) + internal(network) + network.extra_xml + "</Domain></CycloneDDS>";
}

std::string loopback_config(Role role) {
  Network network;
  network.role = role;
  return domain_config(network);
}

}  // namespace stoss::dds

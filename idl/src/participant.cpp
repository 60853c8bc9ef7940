// SPDX-License-Identifier: Apache-2.0
#include <stoss/dds/loopback_guard.hpp>
#include <stoss/dds/participant.hpp>

#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace stoss::dds {
namespace {

// The open domains and their users. Counted by hand and not by a weak pointer, because a domain
// must be gone from Cyclone before it can be opened again: opening and closing share the lock.
struct Registry {
  struct Entry {
    std::unique_ptr<Domain> domain;
    std::size_t users = 0;
  };
  std::mutex mutex;
  std::map<std::uint32_t, Entry> entries;
};

// Never destroyed, so that a domain held by a static object can still be closed at exit.
Registry& registry() {
  static auto* const kRegistry = new Registry;
  return *kRegistry;
}

void close(const Domain* domain) noexcept {
  Registry& open = registry();
  const std::lock_guard lock(open.mutex);
  const auto found = open.entries.find(domain->id());
  if (found != open.entries.end() && --found->second.users == 0) open.entries.erase(found);
}

std::uint32_t checked(std::uint32_t id) {
  if (id > kMaxDomainId) {
    throw std::invalid_argument("domain id " + std::to_string(id) + " must be at most " +
                                std::to_string(kMaxDomainId));
  }
  return id;
}

std::string name_of_domain(std::uint32_t id) { return "DDS domain " + std::to_string(id); }

Entity make_group(dds_entity_t (*create)(dds_entity_t, const dds_qos_t*, const dds_listener_t*),
                  const Participant& participant,
                  const std::string& partition,
                  const char* what) {
  const Qos qos = Qos().partition(partition);
  return Entity(create(participant.handle(), qos.raw(), nullptr), what);
}

}  // namespace

Domain::Domain(std::uint32_t id, const Network& network) : id_(checked(id)), network_(network) {
  const std::string config = domain_config(network);
  const std::set<unsigned long> before = udp_sockets();
  entity_ = Entity(dds_create_domain(id, config.c_str()), "open " + name_of_domain(id));
  if (network.allow_network) return;
  guarded_sockets_ = guard_new_sockets(before, network.interface);
  if (guarded_sockets_ == 0) {
    throw std::runtime_error(name_of_domain(id) + " has no socket that could be guarded");
  }
}

std::shared_ptr<Domain> Domain::open(std::uint32_t id, const Network& network) {
  Registry& open = registry();
  const std::lock_guard lock(open.mutex);
  Registry::Entry& entry = open.entries[id];
  if (!entry.domain) {
    try {
      entry.domain = std::make_unique<Domain>(id, network);
    } catch (...) {
      open.entries.erase(id);
      throw;
    }
  }
  ++entry.users;
  return {entry.domain.get(), &close};
}

Participant::Participant(std::uint32_t domain_id, const Network& network)
    : Participant(Domain::open(domain_id, network)) {}

Participant::Participant(std::shared_ptr<Domain> domain)
    : Entity(dds_create_participant(domain->id(), nullptr, nullptr),
             "take part in " + name_of_domain(domain->id())),
      domain_(std::move(domain)) {}

Participant& Participant::operator=(Participant&& other) noexcept {
  Entity::operator=(std::move(other));
  domain_ = std::move(other.domain_);
  return *this;
}

Publisher::Publisher(const Participant& participant, const std::string& partition)
    : Entity(make_group(
          &dds_create_publisher, participant, partition, "create publisher in partition")) {}

Subscriber::Subscriber(const Participant& participant, const std::string& partition)
    : Entity(make_group(
          &dds_create_subscriber, participant, partition, "create subscriber in partition")) {}

}  // namespace stoss::dds

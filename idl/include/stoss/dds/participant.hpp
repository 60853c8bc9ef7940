// SPDX-License-Identifier: Apache-2.0
// A process's part in a domain, and the publishers and subscribers in it.
#pragma once

#include <stoss/dds/config.hpp>
#include <stoss/dds/entity.hpp>
#include <stoss/dds/qos.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace stoss::dds {

/// A domain with the configuration given in code; the environment (CYCLONEDDS_URI) has no say.
///
/// Cyclone has one instance of a domain per process, so equal ids share one object: the first
/// caller's network holds until the last one lets go. Thread-safe.
class Domain {
 public:
  /// Opens the domain, or returns the one that is open. Throws Error, or std::system_error when the
  /// loopback guard cannot be attached, or std::invalid_argument for a bad id or network.
  [[nodiscard]] static std::shared_ptr<Domain> open(std::uint32_t id, const Network& network);

  Domain(std::uint32_t id, const Network& network);
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;
  ~Domain() = default;

  [[nodiscard]] std::uint32_t id() const noexcept { return id_; }
  [[nodiscard]] const Network& network() const noexcept { return network_; }
  /// How many sockets the loopback guard watches; 0 when `allow_network`.
  [[nodiscard]] std::size_t guarded_sockets() const noexcept { return guarded_sockets_; }

 private:
  std::uint32_t id_;
  Network network_;
  Entity entity_;
  std::size_t guarded_sockets_ = 0;
};

/// One participant. Everything else hangs on it.
class Participant : public Entity {
 public:
  /// Opens the domain (see Domain::open for what it throws) and takes part in it.
  Participant(std::uint32_t domain_id, const Network& network);

  Participant(Participant&&) noexcept = default;
  /// The old participant goes before its domain.
  Participant& operator=(Participant&& other) noexcept;
  ~Participant() { reset(); }

  [[nodiscard]] const Domain& domain() const noexcept { return *domain_; }

 private:
  Participant(std::shared_ptr<Domain> domain);
  std::shared_ptr<Domain> domain_;
};

/// Writers in one partition.
class Publisher : public Entity {
 public:
  Publisher(const Participant& participant, const std::string& partition);
};

/// Readers in one partition; "*" reads all partitions.
class Subscriber : public Entity {
 public:
  Subscriber(const Participant& participant, const std::string& partition);
};

}  // namespace stoss::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Another engine with a scene of the bench in it, stepping, with nothing between it and the clock
// but two counters.

#include "bench/scenes.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stoss::bench {

class Peer {
 public:
  virtual ~Peer() = default;
  virtual void step(double dt) = 0;
  /// Writes where the disks are and how they move, in the order of the scene.
  virtual void read(std::vector<engine::DiskSpec>& disks) const = 0;

  /// Contacts begun so far.
  [[nodiscard]] std::uint64_t disk_contacts() const { return disk_contacts_; }
  [[nodiscard]] std::uint64_t wall_contacts() const { return wall_contacts_; }

 protected:
  void count_contact(bool with_wall) { ++(with_wall ? wall_contacts_ : disk_contacts_); }

 private:
  std::uint64_t disk_contacts_ = 0;
  std::uint64_t wall_contacts_ = 0;
};

/// One way to run an engine, each fair to it.
struct PeerKind {
  std::string name;
  std::function<std::unique_ptr<Peer>(const BenchScene&)> make;
};

/// Those that were found when this was built.
std::vector<PeerKind> box2d_kinds();
std::vector<PeerKind> chipmunk_kinds();

}  // namespace stoss::bench

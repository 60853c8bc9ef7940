// SPDX-License-Identifier: Apache-2.0
// Quality of service as a value that reads like a sentence.
#pragma once

#include <stoss/dds/error.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace stoss::dds {

/// A set of policies; those not named have DDS' defaults. Copyable, comparable.
class Qos {
 public:
  Qos();
  Qos(const Qos& other);
  Qos& operator=(const Qos& other);
  Qos(Qos&&) noexcept = default;
  Qos& operator=(Qos&&) noexcept = default;
  ~Qos() = default;

  /// Lost samples are sent again; a writer that keeps all may block for `max_block`.
  Qos& reliable(std::chrono::nanoseconds max_block = std::chrono::nanoseconds::zero());
  Qos& best_effort();
  /// Keeps the last `depth` samples of each instance. A writer that does so never blocks.
  Qos& keep_last(std::int32_t depth);
  /// Keeps every sample until it is acknowledged (writer) or taken (reader).
  Qos& keep_all();
  Qos& volatile_durability();
  /// Late joiners get the last `depth` samples of each instance.
  Qos& transient_local(std::int32_t depth);
  /// The partition of a publisher or subscriber; "*" and "?" are wildcards.
  Qos& partition(const std::string& name);
  /// Whether unregistering an instance disposes of it too. DDS' default: yes.
  Qos& autodispose(bool on);

  /// For passing to Cyclone.
  [[nodiscard]] const dds_qos_t* raw() const noexcept { return qos_.get(); }

  friend bool operator==(const Qos& a, const Qos& b);

 private:
  struct Deleter {
    void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
  };
  std::unique_ptr<dds_qos_t, Deleter> qos_;
};

}  // namespace stoss::dds

// SPDX-License-Identifier: Apache-2.0
// Writing samples. Not thread-safe per writer by contract: one thread writes.
#pragma once

#include <stoss/dds/topic.hpp>

#include <chrono>
#include <cstdint>

namespace stoss::dds {

/// Writes samples of type T.
template <class T>
class Writer : public Entity {
 public:
  /// Throws Error.
  Writer(const Publisher& publisher, const Topic<T>& topic, const Qos& qos)
      : Entity(dds_create_writer(publisher.handle(), topic.handle(), qos.raw(), nullptr),
               "create writer") {}

  /// Sends a sample; what it points at is copied before the call returns. False when it was not
  /// sent (see last_code()), which is counted in failures().
  [[nodiscard]] bool write(const T& sample) noexcept { return note(dds_write(handle(), &sample)); }

  /// Tells readers that the instance with this key is gone, and forgets it.
  [[nodiscard]] bool dispose(const T& key) noexcept {
    return note(dds_dispose(handle(), &key)) && note(dds_unregister_instance(handle(), &key));
  }

  /// How many readers are matched now.
  [[nodiscard]] int readers() const noexcept {
    const dds_return_t count = dds_get_matched_subscriptions(handle(), nullptr, 0);
    return count > 0 ? count : 0;
  }

  /// Waits until every matched reliable reader has acknowledged everything; false on timeout.
  [[nodiscard]] bool wait_for_acknowledgments(std::chrono::nanoseconds timeout) noexcept {
    return dds_wait_for_acks(handle(), timeout.count()) == DDS_RETCODE_OK;
  }

  /// Writes that did not go out, since creation.
  [[nodiscard]] std::uint64_t failures() const noexcept { return failures_; }
  /// Cyclone's code of the latest failed write.
  [[nodiscard]] dds_return_t last_code() const noexcept { return last_code_; }

 private:
  bool note(dds_return_t code) noexcept {
    if (code >= 0) return true;
    ++failures_;
    last_code_ = code;
    return false;
  }

  std::uint64_t failures_ = 0;
  dds_return_t last_code_ = DDS_RETCODE_OK;
};

}  // namespace stoss::dds

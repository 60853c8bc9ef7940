// SPDX-License-Identifier: Apache-2.0
// The only owner of a raw DDS handle.
#pragma once

#include <stoss/dds/error.hpp>

#include <utility>

namespace stoss::dds {

/// Owns one DDS entity and deletes it. Move-only; a moved-from entity owns nothing.
///
/// Deleting a parent deletes its children in Cyclone; the later deletion of such a child is refused
/// there and is harmless, so members may be declared in any order.
class Entity {
 public:
  Entity() = default;
  /// Takes a fresh handle over; throws Error when it is an error code.
  Entity(dds_entity_t handle, const std::string& what) : handle_(check(handle, what)) {}
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }
  ~Entity() { reset(); }

  /// The raw handle, for use inside stoss::dds; 0 when empty.
  [[nodiscard]] dds_entity_t handle() const noexcept { return handle_; }
  [[nodiscard]] bool valid() const noexcept { return handle_ > 0; }

  /// Deletes the entity now.
  void reset() noexcept {
    if (handle_ > 0) static_cast<void>(dds_delete(handle_));
    handle_ = 0;
  }

 private:
  dds_entity_t handle_ = 0;
};

}  // namespace stoss::dds

// SPDX-License-Identifier: Apache-2.0
// Waiting for samples and for wake-up calls from other threads.
#pragma once

#include <stoss/dds/reader.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stoss::dds {

/// A flag that wakes a WaitSet. set() may be called from any thread.
class Guard : public Entity {
 public:
  explicit Guard(const Participant& participant)
      : Entity(dds_create_guardcondition(participant.handle()), "create guard condition") {}
  void set() noexcept { static_cast<void>(dds_set_guardcondition(handle(), true)); }
  /// Lowers the flag; true if it was up.
  bool clear() noexcept {
    bool was = false;
    static_cast<void>(dds_take_guardcondition(handle(), &was));
    return was;
  }
};

/// Waits for any of several readers and guards. One thread waits.
///
/// Readers are attached by read conditions, which stay triggered as long as a sample is there. The
/// data-available status is edge-triggered and would leave samples lying after a partial take.
class WaitSet : public Entity {
 public:
  /// The most events that one wait reports; the rest follow at the next.
  static constexpr std::size_t kMaxEvents = 16;

  explicit WaitSet(const Participant& participant)
      : Entity(dds_create_waitset(participant.handle()), "create waitset") {}

  /// Reports `tag` whenever the reader has samples. Throws Error. The reader must outlive the
  /// waitset or be detached first.
  template <class T>
  void attach(const Reader<T>& reader, std::intptr_t tag) {
    attach_reader(reader.handle(), tag);
  }
  /// Reports `tag` as long as the guard is set. Throws Error.
  void attach(const Guard& guard, std::intptr_t tag);
  /// No longer reports `tag`.
  void detach(std::intptr_t tag) noexcept;

  /// Waits at most `timeout` and calls `on_tag(tag)` for everything that is triggered. Returns how
  /// many that were: 0 on timeout, negative (a DDS return code) on failure.
  template <class F>
  int wait(std::chrono::nanoseconds timeout, F&& on_tag) {
    std::array<dds_attach_t, kMaxEvents> tags{};
    const dds_return_t count =
        dds_waitset_wait(handle(), tags.data(), tags.size(), timeout.count());
    const auto reported = count < 0 ? 0U : static_cast<unsigned>(count);
    for (std::size_t i = 0; i < reported && i < tags.size(); ++i) on_tag(tags[i]);
    return count;
  }

 private:
  struct Attachment {
    std::intptr_t tag;
    dds_entity_t watched;  // the condition or guard in the waitset
    Entity condition;      // owned read condition, empty for a guard
  };

  void attach_reader(dds_entity_t reader, std::intptr_t tag);

  std::vector<Attachment> attachments_;
};

}  // namespace stoss::dds

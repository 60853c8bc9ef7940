// SPDX-License-Identifier: Apache-2.0
// The zone topic: every entry into a zone and every exit in order, numbered without gaps within an
// epoch, and the last of them for those who missed some.
#pragma once

#include "records.hpp"
#include "topics.hpp"

#include <stoss/translate/columns.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stoss::service {

/// Zone events kept for ASK_ZONE_EVENTS.
inline constexpr std::size_t kZoneEventsKept = 65'536;

class ZonePort {
 public:
  ZonePort(const dds::Publisher& publisher, const Topics& topics)
      : writer_(idl::make_writer(publisher, topics.zone, idl::kZoneTopic)) {}

  void begin_epoch();
  /// Publishes a tick's zone events, if there are any, and keeps them. Without a reader it only
  /// keeps them.
  void publish(const TickRecord& record);

  /// Of the last event.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Of the oldest one that is kept; number() + 1 when there is none.
  [[nodiscard]] std::uint64_t oldest() const { return number_ + 1 - kept_; }
  /// Event `number`. REQUIRES: oldest() <= number <= number()
  [[nodiscard]] const engine::ZoneEvent& at(std::uint64_t number) const {
    return ring_[number % kZoneEventsKept];
  }
  [[nodiscard]] std::uint64_t failures() const { return writer_.failures(); }

 private:
  dds::Writer<wire::ZoneBatch> writer_;
  translate::ZoneEventColumns columns_;
  std::vector<engine::ZoneEvent> ring_;  // an event is at its number modulo the length
  std::uint64_t number_ = 0;
  std::size_t kept_ = 0;
};

}  // namespace stoss::service

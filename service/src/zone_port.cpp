// SPDX-License-Identifier: Apache-2.0
#include "zone_port.hpp"

#include <algorithm>

namespace stoss::service {

void ZonePort::begin_epoch() {
  number_ = 0;
  kept_ = 0;
}

void ZonePort::publish(const TickRecord& record) {
  if (record.zone_events.empty()) return;
  if (ring_.empty()) ring_.resize(kZoneEventsKept);
  for (const engine::ZoneEvent& event : record.zone_events) {
    if (event.sequence != number_ + 1) kept_ = 0;  // some were lost before this one
    number_ = event.sequence;
    ring_[number_ % kZoneEventsKept] = event;
    kept_ = std::min(kept_ + 1, kZoneEventsKept);
  }
  if (writer_.readers() == 0) return;
  const std::size_t count = record.zone_events.size();
  for (std::size_t first = 0; first < count; first += stoss_v1_MAX_ZONE_EVENTS) {
    const std::size_t rows = std::min<std::size_t>(stoss_v1_MAX_ZONE_EVENTS, count - first);
    columns_.clear();
    for (std::size_t i = first; i < first + rows; ++i) columns_.append(record.zone_events[i]);
    wire::ZoneBatch batch{};
    batch.epoch = record.moment.epoch;
    batch.first_number = record.zone_events[first].sequence;
    batch.tick = record.moment.tick;
    batch.at = translate::to_wire(record.moment.at);
    columns_.lend(batch.events, 0, rows);
    static_cast<void>(writer_.write(batch));
  }
}

}  // namespace stoss::service

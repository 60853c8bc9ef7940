// SPDX-License-Identifier: Apache-2.0
#include "frame_port.hpp"

#include <stoss/idl/sequence.hpp>

#include <algorithm>
#include <optional>
#include <span>

namespace stoss::service {

void FramePort::publish(const Picture& picture) {
  const int readers = writer_.readers();
  const bool is_new = is_news(picture) || readers > readers_;
  readers_ = readers;
  if (readers == 0) drop_chunks_from(0);  // or the next reader would first be given an old picture
  if (readers == 0 || !is_new) return;
  published_ = picture.version();
  const std::size_t chunks = std::max<std::size_t>(
      1, (picture.disk_count() + stoss_v1_MAX_FRAME_BODIES - 1) / stoss_v1_MAX_FRAME_BODIES);
  drop_chunks_from(static_cast<std::uint32_t>(chunks));
  std::size_t body = 0;
  for (std::uint32_t chunk = 0; chunk < chunks_; ++chunk) {
    body = fill(picture, body);
    write(picture.moment(), chunk);
  }
  ++count_;
}

void FramePort::write(const Moment& moment, std::uint32_t chunk) {
  wire::FrameChunk sample{};
  sample.chunk = chunk;
  sample.chunks = chunks_;
  sample.epoch = moment.epoch;
  sample.tick = moment.tick;
  sample.at = translate::to_wire(moment.at);
  idl::lend(sample.id, std::span(id_).first(rows_));
  idl::lend(sample.x, std::span(x_).first(rows_));
  idl::lend(sample.y, std::span(y_).first(rows_));
  idl::lend(sample.vx, std::span(vx_).first(rows_));
  idl::lend(sample.vy, std::span(vy_).first(rows_));
  idl::lend(sample.angle, angle_.padded(rows_));
  idl::lend(sample.spin, spin_.padded(rows_));
  idl::lend(sample.radius, radius_);
  static_cast<void>(writer_.write(sample));
}

std::size_t FramePort::fill(const Picture& picture, std::size_t body) {
  rows_ = 0;
  radius_.clear();
  angle_.clear();
  spin_.clear();
  while (body < picture.size() && rows_ < id_.size()) {
    if (append_flights(picture, body)) {
      body += kFlightsAtOnce;
      continue;
    }
    const std::size_t end = std::min(picture.size(), body + kFlightsAtOnce);
    for (; body < end && rows_ < id_.size(); ++body) {
      if (!picture.is_wall(body)) append(picture.state_of(body), picture.has_grown());
    }
  }
  return body;
}

bool FramePort::append_flights(const Picture& picture, std::size_t body) {
  // Far enough ahead for memory to answer in time.
  constexpr std::size_t kAhead = 2 * kFlightsAtOnce;
  const std::span flights(picture.flights());
  const bool is_room =
      body + kFlightsAtOnce <= flights.size() && rows_ + kFlightsAtOnce <= id_.size();
  if (!is_room || picture.has_grown()) return false;
  const auto rows = [this](auto& column) {
    return std::span(column).subspan(rows_).template first<kFlightsAtOnce>();
  };
  if (!states_at(flights.subspan(body).first<kFlightsAtOnce>(),
                 picture.moment().at,
                 {rows(x_), rows(y_), rows(vx_), rows(vy_)},
                 flights.subspan(std::min(body + kAhead, flights.size())))) {
    return false;
  }
  std::ranges::copy(std::span(picture.ids()).subspan(body).first<kFlightsAtOnce>(),
                    rows(id_).begin());
  rows_ += kFlightsAtOnce;
  return true;
}

void FramePort::append(const engine::BodyState& state, bool has_grown) {
  angle_.append(rows_, state.angle);
  spin_.append(rows_, state.spin);
  id_[rows_] = state.id;
  x_[rows_] = state.position.x();
  y_[rows_] = state.position.y();
  vx_[rows_] = state.velocity.x();
  vy_[rows_] = state.velocity.y();
  ++rows_;
  if (has_grown) radius_.push_back(state.radius);
}

void FramePort::drop_chunks_from(std::uint32_t chunks) {
  for (std::uint32_t chunk = chunks; chunk < chunks_; ++chunk) {
    wire::FrameChunk key{};
    key.chunk = chunk;
    static_cast<void>(writer_.dispose(key));
  }
  chunks_ = chunks;
}

void BodyPort::assign(const WatchRecord& record, const Picture& picture) {
  slots_[record.slot] = record.id;
  if (record.id != engine::kNoId) {
    write(record.slot, picture);
    return;
  }
  wire::BodyState key{};
  key.slot = record.slot;
  static_cast<void>(writer_.dispose(key));
}

void BodyPort::publish(const Picture& picture) {
  if (writer_.readers() == 0) return;
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot] != engine::kNoId) write(slot, picture);
  }
}

void BodyPort::write(std::uint32_t slot, const Picture& picture) {
  const std::optional<Picture::Body> body = picture.find(slots_[slot]);
  if (!body) return;
  wire::BodyState sample{};
  sample.slot = slot;
  sample.epoch = picture.moment().epoch;
  sample.id = slots_[slot];
  sample.at = translate::to_wire(picture.moment().at);
  if (body->record.is_wall) {
    const engine::WallState wall = picture.wall_of(*body);
    sample.kind = stoss_v1_KIND_WALL;
    sample.x = wall.start.x();
    sample.y = wall.start.y();
    sample.vx = wall.velocity.x();
    sample.vy = wall.velocity.y();
  } else {
    const engine::BodyState state = picture.state_of(*body);
    sample.kind = idl::wire_value(translate::to_wire(state.kind));
    sample.x = state.position.x();
    sample.y = state.position.y();
    sample.vx = state.velocity.x();
    sample.vy = state.velocity.y();
    sample.angle = state.angle;
    sample.spin = state.spin;
    sample.radius = state.radius;
  }
  static_cast<void>(writer_.write(sample));
}

}  // namespace stoss::service

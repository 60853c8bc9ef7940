// SPDX-License-Identifier: Apache-2.0
#include "frame_order.hpp"

#include <utility>

namespace stoss::client {
namespace {

/// A paused world repeats the frame of a tick at other instants: hence the instant in the key.
bool same(const Frame& a, const Frame& b) {
  return a.epoch == b.epoch && a.tick == b.tick && a.at == b.at;
}

bool older(const Frame& a, const Frame& b) {
  return a.epoch != b.epoch ? a.epoch < b.epoch : a.at < b.at;
}

/// No frame has more bodies than this many chunks hold.
constexpr std::uint32_t kFrameChunksMax = 1U << 20;

}  // namespace

FrameOrder::Partial* FrameOrder::partial_of(const Frame& frame, std::uint32_t count) {
  for (Partial& partial : under_way_) {
    if (same(partial.frame, frame) && partial.chunks.size() == count) return &partial;
  }
  while (under_way_.size() >= kFramesUnderWayMax) under_way_.pop_front();
  Partial& partial = under_way_.emplace_back();
  partial.frame.epoch = frame.epoch;
  partial.frame.tick = frame.tick;
  partial.frame.at = frame.at;
  partial.chunks.resize(count);
  return &partial;
}

std::optional<Frame> FrameOrder::add(Frame chunk, std::uint32_t index, std::uint32_t count) {
  if (index >= count || count > kFrameChunksMax) return std::nullopt;
  if (newest_ && older(chunk, *newest_)) return std::nullopt;
  Partial* partial = partial_of(chunk, count);
  if (partial->chunks[index]) return std::nullopt;
  partial->chunks[index] = std::move(chunk.bodies);
  if (++partial->arrived < count) return std::nullopt;
  Frame whole = std::move(partial->frame);
  for (const auto& bodies : partial->chunks) {
    whole.bodies.insert(whole.bodies.end(), bodies->begin(), bodies->end());
  }
  newest_ = Frame{.epoch = whole.epoch, .tick = whole.tick, .at = whole.at, .bodies = {}};
  std::erase_if(under_way_, [&](const Partial& other) { return !older(*newest_, other.frame); });
  return whole;
}

}  // namespace stoss::client

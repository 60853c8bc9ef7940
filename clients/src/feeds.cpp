// SPDX-License-Identifier: Apache-2.0
#include "frame_order.hpp"
#include "topic_feed.hpp"

#include <stoss/client/feeds.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/basics.hpp>

namespace stoss::client {
namespace {

namespace wire = idl::wire;

/// A chunk's bodies; nothing when its arrays contradict each other.
std::optional<Frame> frame_of(const wire::FrameChunk& chunk) {
  const std::size_t rows = chunk.id._length;
  const auto fits = [rows](std::size_t length, bool may_be_empty) {
    return length == rows || (may_be_empty && length == 0);
  };
  if (!fits(chunk.x._length, false) || !fits(chunk.y._length, false) ||
      !fits(chunk.vx._length, false) || !fits(chunk.vy._length, false) ||
      !fits(chunk.angle._length, true) || !fits(chunk.spin._length, true) ||
      !fits(chunk.radius._length, true)) {
    return std::nullopt;
  }
  Frame frame{.epoch = chunk.epoch, .tick = chunk.tick, .at = translate::to_engine(chunk.at)};
  frame.bodies.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    frame.bodies.push_back({chunk.id._buffer[i],
                            {chunk.x._buffer[i], chunk.y._buffer[i]},
                            {chunk.vx._buffer[i], chunk.vy._buffer[i]},
                            idl::at_or(chunk.angle, i, 0),
                            idl::at_or(chunk.spin, i, 0),
                            idl::at_or(chunk.radius, i, 0)});
  }
  return frame;
}

}  // namespace

class FrameFeed::Impl {
 public:
  explicit Impl(const Session& session) : feed(session, idl::kFrameTopic) {}
  TopicFeed<wire::FrameChunk> feed;
  FrameOrder order;
};

FrameFeed::FrameFeed(const Session& session) : impl_(std::make_unique<Impl>(session)) {}
FrameFeed::~FrameFeed() = default;
FrameFeed::FrameFeed(FrameFeed&&) noexcept = default;
FrameFeed& FrameFeed::operator=(FrameFeed&&) noexcept = default;

std::optional<Frame> FrameFeed::next(Milliseconds timeout) {
  std::optional<Frame> newest;
  return impl_->feed.wait_for(
      timeout,
      [&](const dds::Sample<wire::FrameChunk>& sample) {
        if (!sample.valid()) return;
        std::optional<Frame> chunk = frame_of(sample.data);
        if (!chunk) return;
        if (auto whole =
                impl_->order.add(std::move(*chunk), sample.data.chunk, sample.data.chunks)) {
          newest = std::move(whole);
        }
      },
      [&newest] { return std::move(newest); });
}

class MotionFeed::Impl {
 public:
  explicit Impl(const Session& session) : feed(session, idl::kMotionTopic) {}
  TopicFeed<wire::MotionBatch> feed;
  std::deque<MotionPart> parts;
};

MotionFeed::MotionFeed(const Session& session) : impl_(std::make_unique<Impl>(session)) {}
MotionFeed::~MotionFeed() = default;
MotionFeed::MotionFeed(MotionFeed&&) noexcept = default;
MotionFeed& MotionFeed::operator=(MotionFeed&&) noexcept = default;
bool MotionFeed::matched() const { return impl_->feed.matched(); }

std::optional<MotionPart> MotionFeed::next(Milliseconds timeout) {
  if (auto part = pop(impl_->parts)) return part;
  return impl_->feed.wait_for(
      timeout,
      [this](const dds::Sample<wire::MotionBatch>& sample) {
        if (!sample.valid()) return;
        if (auto part = motion_part_of(sample.data)) impl_->parts.push_back(std::move(*part));
      },
      [this] { return pop(impl_->parts); });
}

class BodyFeed::Impl {
 public:
  explicit Impl(const Session& session) : feed(session, idl::kBodyTopic) {}
  TopicFeed<wire::BodyState> feed;
  std::deque<BodyUpdate> updates;
};

BodyFeed::BodyFeed(const Session& session) : impl_(std::make_unique<Impl>(session)) {}
BodyFeed::~BodyFeed() = default;
BodyFeed::BodyFeed(BodyFeed&&) noexcept = default;
BodyFeed& BodyFeed::operator=(BodyFeed&&) noexcept = default;

namespace {

BodyUpdate body_update_of(const dds::Sample<wire::BodyState>& sample) {
  const wire::BodyState& body = sample.data;
  BodyUpdate update{.slot = body.slot, .epoch = body.epoch, .gone = !sample.valid()};
  if (update.gone) return update;
  update.wall = body.kind == stoss_v1_KIND_WALL;
  update.state = {.id = body.id,
                  .kind = translate::body_kind_of(body.kind).value_or(engine::BodyKind::Static),
                  .instant = translate::to_engine(body.at),
                  .position = {body.x, body.y},
                  .velocity = {body.vx, body.vy},
                  .angle = body.angle,
                  .spin = body.spin,
                  .radius = body.radius};
  return update;
}

}  // namespace

std::optional<BodyUpdate> BodyFeed::next(Milliseconds timeout) {
  if (auto update = pop(impl_->updates)) return update;
  return impl_->feed.wait_for(
      timeout,
      [this](const dds::Sample<wire::BodyState>& sample) {
        impl_->updates.push_back(body_update_of(sample));
        // A state that nobody had looked at when the slot was given up tells of that, too.
        if (sample.valid() && (sample.disposed() || sample.orphaned())) {
          impl_->updates.push_back(
              {.slot = sample.data.slot, .epoch = sample.data.epoch, .gone = true});
        }
      },
      [this] { return pop(impl_->updates); });
}

class StatusFeed::Impl {
 public:
  explicit Impl(const Session& session) : feed(session, idl::kStatusTopic) {}
  TopicFeed<wire::Status> feed;
};

StatusFeed::StatusFeed(const Session& session) : impl_(std::make_unique<Impl>(session)) {}
StatusFeed::~StatusFeed() = default;
StatusFeed::StatusFeed(StatusFeed&&) noexcept = default;
StatusFeed& StatusFeed::operator=(StatusFeed&&) noexcept = default;

std::optional<Status> StatusFeed::next(Milliseconds timeout) {
  std::optional<Status> newest;
  return impl_->feed.wait_for(
      timeout,
      [&newest](const dds::Sample<wire::Status>& sample) {
        if (sample.valid()) newest = status_of(sample.data);
      },
      [&newest] { return std::move(newest); });
}

}  // namespace stoss::client

// SPDX-License-Identifier: Apache-2.0
// The frame topic (all disks at a tick) and the body topic (watched bodies, one by one), both at a
// rate of their own in real time.
#pragma once

#include "clock.hpp"
#include "picture.hpp"
#include "topics.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace stoss::service {

class FramePort {
 public:
  FramePort(const dds::Publisher& publisher, const Topics& topics)
      : writer_(idl::make_writer(publisher, topics.frame, idl::kFrameTopic)) {}

  /// Publishes the picture if somebody reads it, and it is news or there are more readers than the
  /// last time.
  void publish(const Picture& picture);
  /// Is it another picture than the one that was published last?
  [[nodiscard]] bool is_news(const Picture& picture) const {
    return published_ != picture.version();
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t failures() const { return writer_.failures(); }

 private:
  /// The next chunk: as many disks as it holds, from this body on. Returns the first body after.
  std::size_t fill(const Picture& picture, std::size_t body);
  /// The kFlightsAtOnce disks from this one on, into as many rows. False, and nothing done, when
  /// one of them must be evaluated by itself.
  [[nodiscard]] bool append_flights(const Picture& picture, std::size_t body);
  void append(const engine::BodyState& state, bool has_grown);
  void write(const Moment& moment, std::uint32_t chunk);
  void drop_chunks_from(std::uint32_t chunks);

  dds::Writer<wire::FrameChunk> writer_;
  std::uint64_t count_ = 0;
  std::uint32_t chunks_ = 0;
  int readers_ = 0;
  std::uint64_t published_ = 0;  ///< the picture's version
  std::size_t rows_ = 0;         ///< of the chunk at hand, in the columns that follow
  std::array<std::uint64_t, stoss_v1_MAX_FRAME_BODIES> id_;
  std::array<double, stoss_v1_MAX_FRAME_BODIES> x_, y_, vx_, vy_;
  std::vector<double> radius_;  ///< empty while no disk has grown
  translate::SparseColumn angle_, spin_;
};

class BodyPort {
 public:
  BodyPort(const dds::Publisher& publisher, const Topics& topics)
      : writer_(idl::make_writer(publisher, topics.body, idl::kBodyTopic)) {}

  /// A slot was given to a body, or is empty from now on.
  void assign(const WatchRecord& record, const Picture& picture);
  /// Publishes every watched body if there is a reader.
  void publish(const Picture& picture);

  [[nodiscard]] std::uint64_t failures() const { return writer_.failures(); }

 private:
  void write(std::uint32_t slot, const Picture& picture);

  dds::Writer<wire::BodyState> writer_;
  std::array<engine::Id, stoss_v1_MAX_WATCHED> slots_{};
};

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
// The motion topic: what each tick changed, in batches numbered without gaps within an epoch.
#pragma once

#include "records.hpp"
#include "topics.hpp"

#include <stoss/translate/columns.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace stoss::service {

class MotionPort {
 public:
  MotionPort(const dds::Publisher& publisher,
             const Topics& topics,
             engine::Arithmetic arithmetic,
             const engine::Vector2& period);

  /// Starts the numbers anew with an empty batch, number 1, which tells subscribers that the world
  /// that they hold is gone.
  void begin_epoch(const Moment& moment, std::uint64_t state_hash);
  /// Publishes a tick's changes, if there are any. Without a reader only the numbers move on.
  void publish(const TickRecord& record);

  /// Of the last batch.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] bool has_readers() const { return writer_.readers() > 0; }
  [[nodiscard]] std::uint64_t failures() const { return writer_.failures(); }

 private:
  void write_part(wire::MotionBatch& batch,
                  std::span<const BodyChange> changes,
                  bool effects_switched);

  dds::Writer<wire::MotionBatch> writer_;
  engine::Arithmetic arithmetic_;
  engine::Vector2 period_;
  std::uint64_t number_ = 0;
  translate::MotionColumns motions_;
  translate::StaticColumns statics_;
};

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/motion_part.hpp>
#include <stoss/engine/effects.hpp>
#include <stoss/translate/basics.hpp>
#include <stoss/translate/columns.hpp>

namespace stoss::client {

std::optional<MotionPart> motion_part_of(const idl::wire::MotionBatch& batch) {
  const auto arithmetic = translate::arithmetic_of(batch.arithmetic);
  if (!arithmetic || engine::check_period({batch.period_x, batch.period_y}) ||
      !translate::consistent(batch.motions) || !translate::consistent(batch.statics)) {
    return std::nullopt;
  }
  MotionPart part;
  part.epoch = batch.epoch;
  part.number = batch.number;
  part.part = batch.part;
  part.parts = batch.parts;
  part.tick = batch.tick;
  part.at = translate::to_engine(batch.at);
  part.arithmetic = *arithmetic;
  part.period = {batch.period_x, batch.period_y};
  part.state_hash = batch.state_hash;
  part.changes.reserve(batch.motions.id._length);
  for (std::size_t i = 0; i < batch.motions.id._length; ++i) {
    part.changes.push_back(
        {translate::change_at(batch.motions, i).kind, translate::motion_at(batch.motions, i)});
  }
  part.statics.reserve(batch.statics.id._length);
  for (std::size_t i = 0; i < batch.statics.id._length; ++i) {
    part.statics.push_back(translate::body_at(batch.statics, i));
  }
  return part;
}

}  // namespace stoss::client

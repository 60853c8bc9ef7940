// SPDX-License-Identifier: Apache-2.0
#include "motion_port.hpp"

#include <vector>

namespace stoss::service {
namespace {

/// The lengths of the parts that a tick's changes are sent in, within the bounds of the types.
std::vector<std::size_t> parts_of(std::span<const BodyChange> changes, bool effects_switched) {
  std::vector<std::size_t> lengths;
  std::size_t motions = 0;
  std::size_t statics = 0;
  for (const BodyChange& change : changes) {
    const bool is_told = tells_body(change, effects_switched);
    if (motions == stoss_v1_MAX_MOTIONS || (is_told && statics == stoss_v1_MAX_STATICS)) {
      lengths.push_back(motions);
      motions = 0;
      statics = 0;
    }
    ++motions;
    if (is_told) ++statics;
  }
  lengths.push_back(motions);
  return lengths;
}

}  // namespace

MotionPort::MotionPort(const dds::Publisher& publisher,
                       const Topics& topics,
                       engine::Arithmetic arithmetic,
                       const engine::Vector2& period)
    : writer_(idl::make_writer(publisher, topics.motion, idl::kMotionTopic)),
      arithmetic_(arithmetic),
      period_(period) {}

void MotionPort::begin_epoch(const Moment& moment, std::uint64_t state_hash) {
  number_ = 1;
  wire::MotionBatch batch{};
  batch.epoch = moment.epoch;
  batch.number = number_;
  batch.parts = 1;
  batch.tick = moment.tick;
  batch.at = translate::to_wire(moment.at);
  batch.state_hash = state_hash;
  write_part(batch, {}, false);
}

void MotionPort::publish(const TickRecord& record) {
  if (record.changes.empty()) return;
  const std::vector<std::size_t> parts = parts_of(record.changes, record.effects.has_value());
  if (!has_readers()) {
    number_ += parts.size();
    return;
  }
  std::span<const BodyChange> rest(record.changes);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    wire::MotionBatch batch{};
    batch.epoch = record.moment.epoch;
    batch.number = ++number_;
    batch.part = static_cast<std::uint32_t>(part);
    batch.parts = static_cast<std::uint32_t>(parts.size());
    batch.tick = record.moment.tick;
    batch.at = translate::to_wire(record.moment.at);
    batch.state_hash = part + 1 == parts.size() ? record.state_hash : 0;
    write_part(batch, rest.first(parts[part]), record.effects.has_value());
    rest = rest.subspan(parts[part]);
  }
}

void MotionPort::write_part(wire::MotionBatch& batch,
                            std::span<const BodyChange> changes,
                            bool effects_switched) {
  batch.arithmetic = idl::wire_value(translate::to_wire(arithmetic_));
  batch.period_x = period_.x();
  batch.period_y = period_.y();
  motions_.clear();
  statics_.clear();
  for (const BodyChange& change : changes) {
    motions_.append(change.kind, change.motion);
    if (tells_body(change, effects_switched)) statics_.append(change.body);
  }
  motions_.lend(batch.motions, 0, motions_.size());
  statics_.lend(batch.statics, 0, statics_.size());
  static_cast<void>(writer_.write(batch));  // the writer counts its failures
}

}  // namespace stoss::service

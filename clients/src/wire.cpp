// SPDX-License-Identifier: Apache-2.0
#include "wire.hpp"

#include <stoss/idl/sequence.hpp>
#include <stoss/translate/basics.hpp>

#include <cstring>
#include <iterator>
#include <utility>

namespace stoss::client {

using engine::Code;
using engine::Reject;

EncodedCommand::EncodedCommand(const translate::CommandSpec& spec,
                               const translate::RequestId& request)
    : ids_(spec.ids), disks_(spec.disks), zones_(spec.zones) {
  sample_.request = translate::to_wire(request);
  sample_.protocol = idl::kProtocol;
  sample_.op = spec.op;
  sample_.timed = spec.at.has_value();
  if (spec.at) sample_.at = translate::to_wire(*spec.at);
  sample_.target = translate::to_wire(spec.target);
  sample_.value = spec.value;
  sample_.count = spec.count;
  idl::assign(sample_.label, spec.label);
  if (!spec.vectors.empty()) ids_.clear();
  for (const engine::VectorFor& vector : spec.vectors) {
    ids_.push_back(vector.id);
    x_.push_back(vector.value.x());
    y_.push_back(vector.value.y());
  }
  disks_.lend(sample_.disks);
  for (const engine::WallSpec& wall : spec.walls) walls_.append(wall);
  walls_.lend(sample_.walls, 0, walls_.size());
  zones_.lend(sample_.zones);
  const auto name = [this](std::uint64_t of, const std::string& text) {
    idl::wire::Name& to = names_.emplace_back();
    to.of = of;
    idl::assign(to.text, text);
  };
  for (const translate::NamedPart& part : spec.names) name(part.of, part.text);
  for (const std::string& effect : spec.effects_off) {
    name(0, effect);
    x_.push_back(0);
  }
  for (const engine::EffectSetting& setting : spec.settings) {
    name(1, setting.name);
    x_.push_back(setting.value);
  }
  idl::lend(sample_.names, names_);
  idl::lend(sample_.ids, ids_);
  idl::lend(sample_.x, x_);
  idl::lend(sample_.y, y_);
}

std::optional<Reject> too_large(const translate::CommandSpec& spec) {
  const auto refuse = [](const char* field, std::string reason) {
    return Reject{.code = Code::InvalidArgument, .field = field, .reason = std::move(reason)};
  };
  const std::string limit = "at most " + std::to_string(kCommandBodiesMax) + " in one command";
  if (spec.ids.size() > kCommandBodiesMax) return refuse("ids", limit);
  if (spec.vectors.size() > kCommandBodiesMax) return refuse("ids", limit);
  if (spec.disks.size() > kCommandBodiesMax) return refuse("disks", limit);
  if (spec.walls.size() > kCommandBodiesMax) return refuse("walls", limit);
  if (spec.zones.size() > kCommandBodiesMax) return refuse("zones", limit);
  if (spec.disks.size() + spec.walls.size() + spec.zones.size() > kCommandBodiesMax) {
    return refuse("walls", limit);
  }
  if (spec.names.size() > kCommandBodiesMax) return refuse("names", limit);
  if (spec.effects_off.size() + spec.settings.size() > kCommandBodiesMax) {
    return refuse("names", limit);
  }
  const std::string length =
      "is longer than " + std::to_string(stoss_v1_MAX_NAME_LENGTH) + " bytes";
  if (spec.label.size() > stoss_v1_MAX_NAME_LENGTH) return refuse("label", length);
  for (const std::string& name : spec.effects_off) {
    if (name.size() > stoss_v1_MAX_NAME_LENGTH) return refuse("names.text", length);
  }
  for (const engine::EffectSetting& setting : spec.settings) {
    if (setting.name.size() > stoss_v1_MAX_NAME_LENGTH) return refuse("names.text", length);
  }
  for (std::size_t i = 0; i < spec.names.size(); ++i) {
    if (spec.names[i].text.size() <= stoss_v1_MAX_NAME_LENGTH) continue;
    Reject reject = refuse("names.text", length);
    reject.index = i;
    return reject;
  }
  return std::nullopt;
}

std::optional<Reject> too_large(const Query& query) {
  if (query.ids.size() <= kCommandBodiesMax) return std::nullopt;
  return Reject{.code = Code::InvalidArgument,
                .field = "ids",
                .reason = "at most " + std::to_string(kCommandBodiesMax) + " in one query"};
}

idl::wire::Query encode(const Query& query, const translate::RequestId& request) {
  idl::wire::Query sample{};
  sample.request = translate::to_wire(request);
  sample.protocol = idl::kProtocol;
  sample.op = idl::wire_value(query.op);
  sample.timed = query.instant.has_value();
  if (query.instant) sample.at = translate::to_wire(*query.instant);
  idl::lend(sample.ids, query.ids);
  sample.min_x = query.low.x();
  sample.min_y = query.low.y();
  sample.max_x = query.high.x();
  sample.max_y = query.high.y();
  sample.x = query.point.x();
  sample.y = query.point.y();
  sample.direction_x = query.direction.x();
  sample.direction_y = query.direction.y();
  sample.distance = query.distance;
  sample.number = query.number;
  sample.count = query.count;
  return sample;
}

Result<Reply> decode(const idl::wire::Reply& reply) {
  const engine::Instant at = translate::to_engine(reply.at);
  if (reply.code != stoss_v1_CODE_OK) {
    return Failure{.answered = true, .reject = translate::reject_of(reply), .at = at};
  }
  const auto ids = idl::view(reply.ids);
  return Reply{.at = at,
               .tick = reply.tick,
               .epoch = reply.epoch,
               .duplicate = reply.duplicate,
               .ids = {ids.begin(), ids.end()}};
}

namespace {

bool consistent(const idl::wire::Answer& answer) {
  return translate::consistent(answer.states) && translate::consistent(answer.walls) &&
         translate::consistent(answer.hits) && translate::consistent(answer.motions) &&
         translate::consistent(answer.statics) && translate::consistent(answer.collisions) &&
         translate::consistent(answer.zone_events);
}

FoundBody found_body(const idl::wire::StateBlock& block, const engine::Instant& at, std::size_t i) {
  FoundBody body;
  body.wall = block.kind._buffer[i] == stoss_v1_KIND_WALL;
  body.distance = idl::at_or(block.distance, i, 0);
  if (!body.wall) {
    body.state = translate::state_at(block, at, i);
    return body;
  }
  body.state.id = block.id._buffer[i];
  body.state.kind = engine::BodyKind::Static;
  body.state.instant = at;
  body.state.position = {block.x._buffer[i], block.y._buffer[i]};
  body.state.velocity = {block.vx._buffer[i], block.vy._buffer[i]};
  return body;
}

}  // namespace

engine::Outcome<Answer> decode(const idl::wire::Answer& answer) {
  if (!consistent(answer)) {
    return Reject{
        .code = Code::Internal, .field = {}, .reason = "an answer's arrays contradict each other"};
  }
  Answer result;
  result.at = translate::to_engine(answer.at);
  result.tick = answer.tick;
  result.epoch = answer.epoch;
  result.motion_number = answer.motion_number;
  result.collision_number = answer.collision_number;
  result.zone_number = answer.zone_number;
  result.state_hash = answer.state_hash;
  for (std::size_t i = 0; i < answer.states.id._length; ++i) {
    result.bodies.push_back(found_body(answer.states, result.at, i));
  }
  for (std::size_t i = 0; i < answer.walls.start_x._length; ++i) {
    result.walls.push_back(translate::wall_at(answer.walls, result.at, i));
  }
  for (std::size_t i = 0; i < answer.hits.id._length; ++i) {
    result.hits.push_back(translate::hit_at(answer.hits, i));
  }
  result.motions.reserve(answer.motions.id._length);
  for (std::size_t i = 0; i < answer.motions.id._length; ++i) {
    result.motions.push_back(translate::motion_at(answer.motions, i));
  }
  result.statics.reserve(answer.statics.id._length);
  for (std::size_t i = 0; i < answer.statics.id._length; ++i) {
    result.statics.push_back(translate::body_at(answer.statics, i));
  }
  for (std::size_t i = 0; i < answer.collisions.a._length; ++i) {
    result.collisions.push_back(translate::collision_at(answer.collisions, answer.first_number, i));
  }
  for (std::size_t i = 0; i < answer.zone_events.zone._length; ++i) {
    result.zone_events.push_back(
        translate::zone_event_at(answer.zone_events, answer.first_number, i));
  }
  for (const auto& feature : idl::view(answer.features)) {
    result.features.emplace_back(idl::text(feature));
  }
  if (answer.status._length > 0) result.status = status_of(answer.status._buffer[0]);
  return result;
}

namespace {

template <class T>
void move_to_end(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void append(Answer& to, Answer&& chunk) {
  move_to_end(to.bodies, chunk.bodies);
  move_to_end(to.walls, chunk.walls);
  move_to_end(to.hits, chunk.hits);
  move_to_end(to.motions, chunk.motions);
  move_to_end(to.statics, chunk.statics);
  move_to_end(to.collisions, chunk.collisions);
  move_to_end(to.zone_events, chunk.zone_events);
  move_to_end(to.features, chunk.features);
  if (!to.status) to.status = std::move(chunk.status);
}

}  // namespace stoss::client

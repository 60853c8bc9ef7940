// SPDX-License-Identifier: Apache-2.0
// A client made of nothing but the topics, so that tests see what is on the wire.
#pragma once

#include <stoss/dds/dds.hpp>
#include <stoss/engine/outcome.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/idl/topics.hpp>
#include <stoss/translate/columns.hpp>
#include <stoss/translate/command.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace stoss::tests {

namespace wire = idl::wire;

/// A reply, copied.
struct GotReply {
  std::uint64_t number = 0;
  engine::Reject reject;  ///< code Ok when done
  bool duplicate = false;
  std::uint64_t epoch = 0;
  std::uint64_t tick = 0;
  engine::Instant at;
  std::vector<engine::Id> ids;
};

/// All chunks of an answer, copied.
struct GotAnswer {
  engine::Reject reject;
  std::uint32_t chunks = 0;
  std::uint64_t epoch = 0;
  std::uint64_t tick = 0;
  engine::Instant at;
  std::uint64_t motion_number = 0;
  std::uint64_t collision_number = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t first_number = 0;
  std::vector<engine::BodyState> states;
  std::vector<double> distances;
  std::vector<engine::WallState> walls;
  std::vector<engine::RayHit> hits;
  std::vector<engine::MotionRecord> motions;
  std::vector<engine::BodyRecord> statics;
  std::vector<engine::Collision> collisions;
  std::vector<std::string> features;
  std::optional<wire::Status> status;  ///< its sequences are gone
  std::map<std::string, std::uint64_t> counters;
};

class WireClient {
 public:
  using Seconds = std::chrono::duration<double>;

  WireClient(unsigned domain, std::string world, std::uint8_t name)
      : world_(std::move(world)),
        participant_(domain, dds::Network()),
        publisher_(participant_, idl::partition_of(world_)),
        subscriber_(participant_, idl::partition_of(world_)),
        mailbox_(participant_, idl::mailbox_of(world_, id_of(name))),
        command_topic_(idl::make_topic(participant_, idl::kCommandTopic)),
        query_topic_(idl::make_topic(participant_, idl::kQueryTopic)),
        reply_topic_(idl::make_topic(participant_, idl::kReplyTopic)),
        answer_topic_(idl::make_topic(participant_, idl::kAnswerTopic)),
        commands_(idl::make_writer(publisher_, command_topic_, idl::kCommandTopic)),
        queries_(idl::make_writer(publisher_, query_topic_, idl::kQueryTopic)),
        replies_(idl::make_reader(mailbox_, reply_topic_, idl::kReplyTopic)),
        answers_(idl::make_reader(mailbox_, answer_topic_, idl::kAnswerTopic)),
        id_(id_of(name)) {}

  /// Whether a daemon takes this client's requests, after waiting for one.
  bool connect(Seconds timeout = Seconds(10)) {
    return until(timeout, [&] { return commands_.readers() > 0 && queries_.readers() > 0; });
  }

  using Fill = std::function<void(wire::Command&)>;

  /// Sends a command, and returns its number.
  std::uint64_t send(idl::Op op, const Fill& fill = {}) {
    const std::uint64_t number = ++number_;
    send(number, op, fill);
    return number;
  }
  void send(std::uint64_t number, idl::Op op, const Fill& fill) {
    wire::Command command{};
    command.request = translate::to_wire(translate::RequestId{id_, number});
    command.protocol = idl::kProtocol;
    command.op = idl::wire_value(op);
    if (fill) fill(command);
    sent_ = commands_.write(command);
  }
  /// Whether DDS took the last command.
  [[nodiscard]] bool sent() const { return sent_; }

  /// Waits for one reply.
  std::optional<GotReply> reply(std::uint64_t number, Seconds timeout = Seconds(10)) {
    until(timeout, [&] {
      take_replies();
      return got_.contains(number);
    });
    const auto found = got_.find(number);
    if (found == got_.end()) return std::nullopt;
    return found->second.back();
  }
  /// All replies to a request so far.
  std::vector<GotReply> replies(std::uint64_t number) {
    take_replies();
    const auto found = got_.find(number);
    return found == got_.end() ? std::vector<GotReply>{} : found->second;
  }
  [[nodiscard]] std::size_t replied() {
    take_replies();
    return got_.size();
  }

  /// Sends a command and waits for its reply; code Internal when none comes.
  GotReply command(idl::Op op, const Fill& fill = {}) {
    const auto got = reply(send(op, fill));
    if (got) return *got;
    GotReply none;
    none.reject = {.code = engine::Code::Internal, .field = "", .reason = "no reply"};
    return none;
  }

  using FillQuery = std::function<void(wire::Query&)>;

  std::uint64_t send(idl::Ask op, const FillQuery& fill = {}) {
    wire::Query query{};
    query.request = translate::to_wire(translate::RequestId{id_, ++number_});
    query.protocol = idl::kProtocol;
    query.op = idl::wire_value(op);
    if (fill) fill(query);
    sent_ = queries_.write(query);
    return number_;
  }

  GotAnswer ask(idl::Ask op, const FillQuery& fill = {}, Seconds timeout = Seconds(10)) {
    return answer(send(op, fill), timeout);
  }

  /// Waits for all chunks of one answer; code Internal when they do not come.
  GotAnswer answer(std::uint64_t number, Seconds timeout = Seconds(10)) {
    GotAnswer got;
    std::uint32_t chunks = 0;
    const bool whole = until(timeout, [&] {
      answers_.drain([&](const dds::Sample<wire::Answer>& sample) {
        if (!sample.valid() || sample.data.request.number != number) return;
        ++chunks;
        append(got, sample.data);
      });
      return got.chunks != 0 && chunks >= got.chunks;
    });
    if (!whole) got.reject = {.code = engine::Code::Internal, .field = "", .reason = "no answer"};
    return got;
  }

  wire::Status status() {
    const GotAnswer got = ask(idl::Ask::kStatus);
    return got.status.value_or(wire::Status{});
  }

  [[nodiscard]] const dds::Participant& participant() const { return participant_; }
  [[nodiscard]] const dds::Subscriber& subscriber() const { return subscriber_; }
  [[nodiscard]] const translate::ClientId& id() const { return id_; }

  template <class F>
  static bool until(Seconds timeout, F&& done) {
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (!done()) {
      if (std::chrono::steady_clock::now() >= end) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    return true;
  }

 private:
  static translate::ClientId id_of(std::uint8_t name) {
    translate::ClientId id{};
    id.fill(name);
    return id;
  }

  void take_replies() {
    replies_.drain([&](const dds::Sample<wire::Reply>& sample) {
      if (!sample.valid()) return;
      const wire::Reply& reply = sample.data;
      GotReply got;
      got.number = reply.request.number;
      got.reject = translate::reject_of(reply);
      got.duplicate = reply.duplicate;
      got.epoch = reply.epoch;
      got.tick = reply.tick;
      got.at = translate::to_engine(reply.at);
      const auto ids = idl::view(reply.ids);
      got.ids.assign(ids.begin(), ids.end());
      got_[got.number].push_back(std::move(got));
    });
  }

  static void append(GotAnswer& got, const wire::Answer& chunk) {
    got.reject = translate::reject_of(chunk);
    got.chunks = chunk.chunks;
    got.epoch = chunk.epoch;
    got.tick = chunk.tick;
    got.at = translate::to_engine(chunk.at);
    got.motion_number = chunk.motion_number;
    got.collision_number = chunk.collision_number;
    if (chunk.state_hash != 0) got.state_hash = chunk.state_hash;
    if (chunk.chunk == 0) got.first_number = chunk.first_number;
    for (std::size_t i = 0; i < chunk.states.id._length; ++i) {
      got.states.push_back(translate::state_at(chunk.states, got.at, i));
      if (chunk.states.distance._length > 0) {
        got.distances.push_back(chunk.states.distance._buffer[i]);
      }
    }
    for (std::size_t i = 0; i < chunk.walls.id._length; ++i) {
      got.walls.push_back(translate::wall_at(chunk.walls, got.at, i));
    }
    for (std::size_t i = 0; i < chunk.hits.id._length; ++i) {
      got.hits.push_back(translate::hit_at(chunk.hits, i));
    }
    for (std::size_t i = 0; i < chunk.motions.id._length; ++i) {
      got.motions.push_back(translate::motion_at(chunk.motions, i));
    }
    for (std::size_t i = 0; i < chunk.statics.id._length; ++i) {
      got.statics.push_back(translate::body_at(chunk.statics, i));
    }
    for (std::size_t i = 0; i < chunk.collisions.a._length; ++i) {
      got.collisions.push_back(translate::collision_at(chunk.collisions, chunk.first_number, i));
    }
    for (std::size_t i = 0; i < chunk.features._length; ++i) {
      got.features.emplace_back(idl::text(chunk.features._buffer[i]));
    }
    if (chunk.status._length > 0) {
      got.status = chunk.status._buffer[0];
      for (const wire::Counter& counter : idl::view(got.status->counters)) {
        got.counters[std::string(idl::text(counter.name))] = counter.value;
      }
      got.status->counters = {};
    }
  }

  std::string world_;
  dds::Participant participant_;
  dds::Publisher publisher_;
  dds::Subscriber subscriber_;
  dds::Subscriber mailbox_;
  dds::Topic<wire::Command> command_topic_;
  dds::Topic<wire::Query> query_topic_;
  dds::Topic<wire::Reply> reply_topic_;
  dds::Topic<wire::Answer> answer_topic_;
  dds::Writer<wire::Command> commands_;
  dds::Writer<wire::Query> queries_;
  dds::Reader<wire::Reply> replies_;
  dds::Reader<wire::Answer> answers_;
  translate::ClientId id_;
  std::uint64_t number_ = 0;
  bool sent_ = false;
  std::map<std::uint64_t, std::vector<GotReply>> got_;
};

/// Fills in the disks of a spawn. Keeps its arrays until the command is written.
class SpawnDisks {
 public:
  explicit SpawnDisks(const std::vector<engine::DiskSpec>& disks) : columns_(disks) {}
  void operator()(wire::Command& command) const { columns_.lend(command.disks); }

 private:
  translate::DiskColumns columns_;
};

/// Fills in the ids of a command, and a vector for each.
class Targets {
 public:
  Targets(std::vector<engine::Id> ids, std::vector<double> x, std::vector<double> y)
      : ids_(std::move(ids)), x_(std::move(x)), y_(std::move(y)) {}
  explicit Targets(std::vector<engine::Id> ids) : ids_(std::move(ids)) {}
  void operator()(wire::Command& command) const {
    idl::lend(command.ids, ids_);
    idl::lend(command.x, x_);
    idl::lend(command.y, y_);
  }
  void operator()(wire::Query& query) const { idl::lend(query.ids, ids_); }

 private:
  std::vector<engine::Id> ids_;
  std::vector<double> x_, y_;
};

}  // namespace stoss::tests

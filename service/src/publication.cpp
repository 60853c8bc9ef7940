// SPDX-License-Identifier: Apache-2.0
#include "publication.hpp"

#include <stoss/idl/sequence.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace stoss::service {
namespace {

constexpr Nanoseconds kHousekeepingInterval{500'000'000};
/// How soon to look again for acknowledgments when an answer waits for them.
constexpr Nanoseconds kPumpInterval{500'000};
/// How long the last samples may take to reach their readers when the daemon stops.
constexpr Nanoseconds kFarewell{200'000'000};

Nanoseconds interval_of(double rate) {
  return std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(1 / rate));
}

}  // namespace

Publication::Publication(const dds::Participant& participant,
                         const Topics& topics,
                         const PublicationOptions& options,
                         const Clock& clock,
                         Inbox& inbox,
                         Outbox& outbox,
                         const SharedCounters& shared)
    : options_(options),
      clock_(clock),
      inbox_(inbox),
      outbox_(outbox),
      shared_(shared),
      started_(clock.now()),
      picture_(options.arithmetic, options.period),
      publisher_(participant, idl::partition_of(options.world)),
      motions_(publisher_, topics, options.arithmetic, options.period),
      collisions_(publisher_, topics),
      zones_(publisher_, topics),
      frames_(publisher_, topics),
      watched_(publisher_, topics),
      scene_(publisher_, topics, options.world),
      status_writer_(idl::make_writer(publisher_, topics.status, idl::kStatusTopic)),
      mailboxes_(participant, topics, options.world),
      transfers_(mailboxes_),
      frame_times_(interval_of(options.frame_rate), started_),
      next_housekeeping_(started_) {
  scene_.set_scene_name(options.scene_name);
}

void Publication::turn() {
  const Nanoseconds now = clock_.now();
  Nanoseconds next = std::min(frame_times_.next(), next_housekeeping_);
  if (transfers_.underway() > 0) next = std::min(next, now + kPumpInterval);
  handle_all(outbox_.take(std::max(next - now, Nanoseconds::zero())));
  transfers_.pump(clock_.now());
  answer_from_picture();
  publish_frames_if_due();
  keep_house();
}

void Publication::handle_all(std::deque<OutboxItem> items) {
  // One at a time, so that the tickets of what is sent are given back at once.
  for (; !items.empty(); items.pop_front()) {
    std::visit([this](auto& item) { handle(item); }, items.front());
  }
}

void Publication::handle(TickRecord& record) {
  picture_.apply(record);
  motions_.publish(record);
  collisions_.publish(record);
  zones_.publish(record);
}

void Publication::handle(EpochRecord& record) {
  picture_.begin(record);
  motions_.begin_epoch(record.moment, record.state_hash);
  collisions_.begin_epoch();
  zones_.begin_epoch();
}

void Publication::handle(const WatchRecord& record) { watched_.assign(record, picture_); }

void Publication::handle(ReplyItem& item) {
  const ReplyRecord& record = item.reply;
  const Moment moment = record.moment.value_or(picture_.moment());
  wire::Reply reply{};
  reply.request = translate::to_wire(record.request);
  if (record.reject) translate::put_reject(reply, *record.reject);
  reply.duplicate = record.duplicate;
  reply.epoch = moment.epoch;
  reply.at = translate::to_wire(moment.at);
  reply.tick = moment.tick;
  idl::lend(reply.ids, record.ids);
  Mailbox* const mailbox = mailboxes_.of(record.request.client, clock_.now());
  if (mailbox == nullptr || !mailbox->reply.write(reply)) ++replies_failed_;
}

AnswerHead Publication::head() const {
  return {picture_.moment(), motions_.number(), collisions_.number(), zones_.number()};
}

void Publication::handle(AnswerItem& item) {
  if (transfers_.is_underway(item.request)) return;
  AnswerHead answer_head = head();
  if (item.moment) answer_head.moment = *item.moment;
  auto content =
      std::visit([](auto& value) { return make_content(std::move(value)); }, item.content);
  transfers_.start(
      item.request, answer_head, std::move(content), std::move(item.ticket), clock_.now());
}

void Publication::handle(PictureQuery& query) {
  const bool is_small = static_cast<idl::Ask>(query.spec.op) == idl::Ask::kStatus;
  if (is_small) {
    start(query);
  } else {
    picture_queries_.push_back(std::move(query));
    answer_from_picture();
  }
}

void Publication::answer_from_picture() {
  while (!picture_queries_.empty() && transfers_.has_room()) {
    start(picture_queries_.front());
    picture_queries_.pop_front();
  }
}

void Publication::start(PictureQuery& query) {
  if (transfers_.is_underway(query.spec.request)) return;
  transfers_.start(
      query.spec.request, head(), content_for(query.spec), std::move(query.ticket), clock_.now());
}

std::shared_ptr<AnswerContent> Publication::content_for(const translate::QuerySpec& query) {
  switch (static_cast<idl::Ask>(query.op)) {
    case idl::Ask::kList:
      return list_content(picture_);
    case idl::Ask::kWorld:
      return shared_world_content();
    case idl::Ask::kCollisions:
      return collisions_content(collisions_, query.number, query.count);
    case idl::Ask::kZoneEvents:
      return zone_events_content(zones_, query.number, query.count);
    case idl::Ask::kStatus:
      return make_content(status_);
    case idl::Ask::kStates:
    case idl::Ask::kRegion:
    case idl::Ask::kNearest:
    case idl::Ask::kRay:
    case idl::Ask::kFeatures:
    case idl::Ask::kPredict:
    case idl::Ask::kForecast:
      break;
  }
  return make_content(engine::Reject{
      .code = engine::Code::Internal, .field = "op", .reason = "not for the publisher"});
}

std::shared_ptr<AnswerContent> Publication::shared_world_content() {
  auto content = world_content_.lock();
  if (content && world_moment_ == picture_.moment() && world_number_ == motions_.number()) {
    return content;
  }
  content = world_content(picture_);
  world_content_ = content;
  world_moment_ = picture_.moment();
  world_number_ = motions_.number();
  return content;
}

void Publication::publish_frames_if_due() {
  const Nanoseconds now = clock_.now();
  if (!frame_times_.take(now, frames_.is_news(picture_))) return;
  frames_.publish(picture_);
  watched_.publish(picture_);
  scene_.publish_if_due(picture_, now);
}

void Publication::keep_house() {
  const Nanoseconds now = clock_.now();
  outbox_.hash_wanted.store(motions_.has_readers(), std::memory_order_relaxed);
  if (now < next_housekeeping_) return;
  next_housekeeping_ = now + kHousekeepingInterval;
  const std::vector<ClientId> gone = mailboxes_.sweep(now);
  for (const ClientId& client : gone) inbox_.push_gone(client);
  if (!gone.empty()) inbox_.wake();
}

void Publication::handle(const WorldStatus& status) {
  fill_status(status);
  static_cast<void>(status_writer_.write(status_));
}

void Publication::finish() {
  handle_all(outbox_.take(Nanoseconds::zero()));
  const Nanoseconds until = clock_.now() + kFarewell;
  while (transfers_.pump(clock_.now()) && clock_.now() < until) {
    handle_all(outbox_.take(kPumpInterval));
    answer_from_picture();
  }
  static_cast<void>(
      status_writer_.wait_for_acknowledgments(std::max(until - clock_.now(), Nanoseconds::zero())));
}

}  // namespace stoss::service

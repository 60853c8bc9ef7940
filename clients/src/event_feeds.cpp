// SPDX-License-Identifier: Apache-2.0
// Collisions and zone events, each in their order: two streams that differ in what they carry.
#include "event_order.hpp"
#include "topic_feed.hpp"

#include <stoss/client/feeds.hpp>
#include <stoss/translate/columns.hpp>

namespace stoss::client {

namespace wire = idl::wire;

namespace {

struct Collisions {
  using Event = engine::Collision;
  using Batch = wire::CollisionBatch;
  static constexpr const auto& kTopic = idl::kCollisionTopic;
  static const auto& block(const Batch& batch) { return batch.collisions; }
  static std::size_t rows(const Batch& batch) { return batch.collisions.a._length; }
  static Event at(const Batch& batch, std::size_t i) {
    return translate::collision_at(batch.collisions, batch.first_number, i);
  }
  static Query from(std::uint64_t first, std::uint64_t count = 0) {
    return Query::collisions(first, count);
  }
  static std::vector<Event>& in(Answer& answer) { return answer.collisions; }
  static std::vector<Event>& in(CollisionRun& run) { return run.collisions; }
};

struct ZoneEvents {
  using Event = engine::ZoneEvent;
  using Batch = wire::ZoneBatch;
  static constexpr const auto& kTopic = idl::kZoneTopic;
  static const auto& block(const Batch& batch) { return batch.events; }
  static std::size_t rows(const Batch& batch) { return batch.events.zone._length; }
  static Event at(const Batch& batch, std::size_t i) {
    return translate::zone_event_at(batch.events, batch.first_number, i);
  }
  static Query from(std::uint64_t first, std::uint64_t count = 0) {
    return Query::zone_events(first, count);
  }
  static std::vector<Event>& in(Answer& answer) { return answer.zone_events; }
  static std::vector<Event>& in(ZoneRun& run) { return run.events; }
};

template <class Kind, class Run>
class EventFeed {
 public:
  using Event = typename Kind::Event;
  using Batch = typename Kind::Batch;

  EventFeed(Session& session, std::optional<std::uint64_t> since)
      : session_(session), feed_(session, Kind::kTopic), order_(since), since_(since) {}

  std::optional<Run> next(Milliseconds timeout);
  [[nodiscard]] bool matched() const { return feed_.matched(); }
  [[nodiscard]] CollisionFeedCounters counters() const {
    return {order_.gaps(), refills_, order_.lost()};
  }

 private:
  void offer(const Batch& batch);
  bool offer_answer(const Query& query);
  void fill_gap();
  std::optional<Run> take();

  Session& session_;
  TopicFeed<Batch> feed_;
  EventOrder<Event> order_;
  std::optional<std::uint64_t> since_;  ///< those before the subscription are still to be asked for
  std::uint64_t refills_ = 0;
  std::uint64_t lost_told_ = 0;
};

template <class Kind, class Run>
void EventFeed<Kind, Run>::offer(const Batch& batch) {
  if (!translate::consistent(Kind::block(batch))) return;
  std::vector<Event> events;
  events.reserve(Kind::rows(batch));
  for (std::size_t i = 0; i < Kind::rows(batch); ++i) events.push_back(Kind::at(batch, i));
  order_.offer(batch.epoch, std::move(events));
}

template <class Kind, class Run>
bool EventFeed<Kind, Run>::offer_answer(const Query& query) {
  Result<Answer> answer = session_.ask(query);
  if (!answer) return false;
  Answer content = std::move(answer).value();
  order_.offer(content.epoch, std::move(Kind::in(content)));
  return true;
}

// The daemon keeps a bounded number: what it has no longer is lost.
template <class Kind, class Run>
void EventFeed<Kind, Run>::fill_gap() {
  const std::optional<EventRange> gap = order_.missing();
  if (!gap) return;
  if (offer_answer(Kind::from(gap->first, gap->count))) ++refills_;
  const std::optional<EventRange> still = order_.missing();
  if (still && still->first == gap->first) order_.give_up();
}

template <class Kind, class Run>
std::optional<Run> EventFeed<Kind, Run>::take() {
  Run run;
  Kind::in(run) = order_.take();
  while (Kind::in(run).empty() && order_.missing()) {
    fill_gap();
    Kind::in(run) = order_.take();
  }
  run.epoch = order_.epoch();
  if (Kind::in(run).empty()) return std::nullopt;
  run.lost = order_.lost() - lost_told_;
  lost_told_ = order_.lost();
  return run;
}

template <class Kind, class Run>
std::optional<Run> EventFeed<Kind, Run>::next(Milliseconds timeout) {
  if (since_) static_cast<void>(offer_answer(Kind::from(*since_)));
  since_.reset();
  return feed_.wait_for(
      timeout,
      [this](const dds::Sample<Batch>& sample) {
        if (sample.valid()) offer(sample.data);
      },
      [this] { return take(); });
}

}  // namespace

class CollisionFeed::Impl : public EventFeed<Collisions, CollisionRun> {
 public:
  using EventFeed::EventFeed;
};

CollisionFeed::CollisionFeed(Session& session, std::optional<std::uint64_t> since)
    : impl_(std::make_unique<Impl>(session, since)) {}
CollisionFeed::~CollisionFeed() = default;
CollisionFeed::CollisionFeed(CollisionFeed&&) noexcept = default;
CollisionFeed& CollisionFeed::operator=(CollisionFeed&&) noexcept = default;
CollisionFeedCounters CollisionFeed::counters() const { return impl_->counters(); }
bool CollisionFeed::matched() const { return impl_->matched(); }
std::optional<CollisionRun> CollisionFeed::next(Milliseconds timeout) {
  return impl_->next(timeout);
}

class ZoneFeed::Impl : public EventFeed<ZoneEvents, ZoneRun> {
 public:
  using EventFeed::EventFeed;
};

ZoneFeed::ZoneFeed(Session& session, std::optional<std::uint64_t> since)
    : impl_(std::make_unique<Impl>(session, since)) {}
ZoneFeed::~ZoneFeed() = default;
ZoneFeed::ZoneFeed(ZoneFeed&&) noexcept = default;
ZoneFeed& ZoneFeed::operator=(ZoneFeed&&) noexcept = default;
bool ZoneFeed::matched() const { return impl_->matched(); }
std::optional<ZoneRun> ZoneFeed::next(Milliseconds timeout) { return impl_->next(timeout); }

}  // namespace stoss::client

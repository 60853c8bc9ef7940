// SPDX-License-Identifier: Apache-2.0
#include "collision_order.hpp"
#include "topic_feed.hpp"

#include <stoss/client/feeds.hpp>
#include <stoss/translate/columns.hpp>

namespace stoss::client {

namespace wire = idl::wire;

class CollisionFeed::Impl {
 public:
  Impl(Session& session, std::optional<std::uint64_t> since)
      : session_(session), feed_(session, idl::kCollisionTopic), order_(since), since_(since) {}

  std::optional<CollisionRun> next(Milliseconds timeout);
  [[nodiscard]] bool matched() const { return feed_.matched(); }
  [[nodiscard]] CollisionFeedCounters counters() const {
    return {order_.gaps(), refills_, order_.lost()};
  }

 private:
  void offer(const wire::CollisionBatch& batch);
  void fetch_earlier();
  void fill_gap();
  std::optional<CollisionRun> take();

  Session& session_;
  TopicFeed<wire::CollisionBatch> feed_;
  CollisionOrder order_;
  std::optional<std::uint64_t> since_;  ///< those before the subscription are still to be asked for
  std::uint64_t refills_ = 0;
  std::uint64_t lost_told_ = 0;
};

void CollisionFeed::Impl::offer(const wire::CollisionBatch& batch) {
  if (!translate::consistent(batch.collisions)) return;
  std::vector<engine::Collision> collisions;
  collisions.reserve(batch.collisions.a._length);
  for (std::size_t i = 0; i < batch.collisions.a._length; ++i) {
    collisions.push_back(translate::collision_at(batch.collisions, batch.first_number, i));
  }
  order_.offer(batch.epoch, std::move(collisions));
}

// The daemon keeps a bounded number: what it has no longer is lost.
void CollisionFeed::Impl::fill_gap() {
  const std::optional<CollisionRange> gap = order_.missing();
  if (!gap) return;
  Result<Answer> answer = session_.ask(Query::collisions(gap->first, gap->count));
  if (answer) {
    ++refills_;
    Answer content = std::move(answer).value();
    order_.offer(content.epoch, std::move(content.collisions));
  }
  const std::optional<CollisionRange> still = order_.missing();
  if (still && still->first == gap->first) order_.give_up();
}

void CollisionFeed::Impl::fetch_earlier() {
  Result<Answer> answer = session_.ask(Query::collisions(*since_));
  since_.reset();
  if (!answer) return;
  Answer content = std::move(answer).value();
  order_.offer(content.epoch, std::move(content.collisions));
}

std::optional<CollisionRun> CollisionFeed::Impl::take() {
  CollisionRun run;
  run.collisions = order_.take();
  while (run.collisions.empty() && order_.missing()) {
    fill_gap();
    run.collisions = order_.take();
  }
  run.epoch = order_.epoch();
  if (run.collisions.empty()) return std::nullopt;
  run.lost = order_.lost() - lost_told_;
  lost_told_ = order_.lost();
  return run;
}

std::optional<CollisionRun> CollisionFeed::Impl::next(Milliseconds timeout) {
  if (since_) fetch_earlier();
  return feed_.wait_for(
      timeout,
      [this](const dds::Sample<wire::CollisionBatch>& sample) {
        if (sample.valid()) offer(sample.data);
      },
      [this] { return take(); });
}

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

}  // namespace stoss::client

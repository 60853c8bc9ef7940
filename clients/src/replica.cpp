// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/feeds.hpp>
#include <stoss/client/replica.hpp>
#include <stoss/dds/waitset.hpp>
#include <stoss/idl/topics.hpp>
#include <stoss/translate/basics.hpp>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace stoss::client {
namespace {

using std::chrono::steady_clock;
namespace wire = idl::wire;

constexpr std::intptr_t kTagWake = 0;
constexpr std::intptr_t kTagMotion = 1;
constexpr std::intptr_t kTagStatus = 2;

/// How long the daemon may take to be matched before the world is asked for anyhow.
constexpr Milliseconds kMatchGrace{500};
/// Between two questions for the world, when the first was refused or went unanswered.
constexpr Milliseconds kAskAgain{200};
constexpr Milliseconds kWait{20};

/// An answer that is handed from the session's thread to the replica's. It outlives the replica
/// when the answer comes after its end.
struct AnswerBox {
  explicit AnswerBox(const dds::Participant& participant) : arrived(participant) {}
  std::mutex mutex;
  std::optional<Result<Answer>> answer;
  dds::Guard arrived;
};

}  // namespace

class Replica::Impl {
 public:
  Impl(Session& session, ReplicaOptions options);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  template <class Condition>
  bool wait(Milliseconds timeout, Condition condition) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, timeout, condition);
  }

  mutable std::mutex mutex;
  std::condition_variable changed;
  ReplicaModel model;                                  ///< under the mutex
  std::optional<std::chrono::nanoseconds> completed_;  ///< under the mutex

  std::vector<engine::ZoneState> zones();

 private:
  void run();
  void handle(std::intptr_t tag);
  void take_motions();
  void take_status();
  void take_world();
  void ask_if_needed();

  Session& session_;
  dds::Subscriber subscriber_;
  dds::Topic<wire::MotionBatch> motion_topic_;
  dds::Topic<wire::Status> status_topic_;
  dds::Reader<wire::MotionBatch> motions_;
  dds::Reader<wire::Status> status_;
  std::shared_ptr<AnswerBox> box_;
  dds::WaitSet waitset_;
  steady_clock::time_point started_ = steady_clock::now();

  // The replica's thread's own.
  bool asking_ = false;
  steady_clock::time_point ask_at_ = started_;
  std::uint64_t behind_epoch_ = 0;
  std::uint64_t behind_number_ = 0;

  std::mutex scene_mutex_;
  SceneFeed scene_;                       ///< under the scene's mutex, as are
  std::vector<engine::ZoneState> zones_;  ///< the zones that it told last

  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

Replica::Impl::Impl(Session& session, ReplicaOptions options)
    : model(translate::arithmetic_of(session.first_status().arithmetic)
                .value_or(engine::Arithmetic::Double),
            session.first_status().period),
      session_(session),
      subscriber_(session.participant(), idl::partition_of(session.world())),
      motion_topic_(idl::make_topic(session.participant(), idl::kMotionTopic)),
      status_topic_(idl::make_topic(session.participant(), idl::kStatusTopic)),
      motions_(idl::make_reader(subscriber_, motion_topic_, idl::kMotionTopic)),
      status_(idl::make_reader(subscriber_, status_topic_, idl::kStatusTopic)),
      box_(std::make_shared<AnswerBox>(session.participant())),
      waitset_(session.participant()),
      scene_(session) {
  model.on_tick = std::move(options.on_tick);
  waitset_.attach(box_->arrived, kTagWake);
  waitset_.attach(motions_, kTagMotion);
  waitset_.attach(status_, kTagStatus);
  thread_ = std::thread([this] { run(); });
}

Replica::Impl::~Impl() {
  stopping_ = true;
  box_->arrived.set();
  thread_.join();
}

std::vector<engine::ZoneState> Replica::Impl::zones() {
  const std::lock_guard lock(scene_mutex_);
  while (auto scene = scene_.next(Milliseconds{0})) zones_ = std::move(scene->zones);
  return zones_;
}

void Replica::Impl::run() {
  while (!stopping_) {
    waitset_.wait(kWait, [this](std::intptr_t tag) { handle(tag); });
    ask_if_needed();
  }
}

void Replica::Impl::handle(std::intptr_t tag) {
  if (tag == kTagMotion) {
    take_motions();
  } else if (tag == kTagStatus) {
    take_status();
  } else {
    static_cast<void>(box_->arrived.clear());
    take_world();
  }
}

void Replica::Impl::take_motions() {
  motions_.drain([this](const dds::Sample<wire::MotionBatch>& sample) {
    if (!sample.valid()) return;
    std::optional<MotionPart> part = motion_part_of(sample.data);
    if (!part) return;
    const std::lock_guard lock(mutex);
    model.apply(std::move(*part));
  });
  changed.notify_all();
}

// A batch that was lost shows in the number of the next; when none follows, it shows here. The
// status and the batches travel apart, so being behind counts only when it lasts from one status to
// the next.
void Replica::Impl::take_status() {
  status_.drain([this](const dds::Sample<wire::Status>& sample) {
    if (!sample.valid()) return;
    const wire::Status& status = sample.data;
    const std::lock_guard lock(mutex);
    if (!model.complete()) return;
    const ReplicaStamp& stamp = model.stamp();
    const auto behind = [&stamp](std::uint64_t epoch, std::uint64_t number) {
      return stamp.epoch < epoch || (stamp.epoch == epoch && stamp.number < number);
    };
    if (behind(behind_epoch_, behind_number_)) model.invalidate();
    behind_epoch_ = status.epoch;
    behind_number_ = status.motion_number;
  });
}

void Replica::Impl::ask_if_needed() {
  const auto now = steady_clock::now();
  if (asking_ || now < ask_at_) return;
  {
    const std::lock_guard lock(mutex);
    if (model.complete()) return;
  }
  // Subscribed first, asked second: then nothing falls between the answer and the batches.
  if (motions_.writers() == 0 && now < started_ + kMatchGrace) {
    ask_at_ = now + Milliseconds{1};
    return;
  }
  asking_ = true;
  session_.submit(Query::world(), session_.timeout(), [box = box_](Result<Answer> answer) {
    const std::lock_guard lock(box->mutex);
    box->answer = std::move(answer);
    box->arrived.set();
  });
}

void Replica::Impl::take_world() {
  std::optional<Result<Answer>> answer;
  {
    const std::lock_guard lock(box_->mutex);
    answer = std::exchange(box_->answer, std::nullopt);
  }
  if (!answer) return;
  asking_ = false;
  ask_at_ = steady_clock::now() + (answer->ok() ? Milliseconds::zero() : kAskAgain);
  if (!answer->ok()) return;
  take_motions();  // so that a world is joined with all that is there
  {
    const std::lock_guard lock(mutex);
    model.load(answer->value());
    if (model.complete() && !completed_) completed_ = steady_clock::now() - started_;
  }
  changed.notify_all();
}

Replica::Replica(Session& session, ReplicaOptions options)
    : impl_(std::make_unique<Impl>(session, std::move(options))) {}
Replica::~Replica() = default;

bool Replica::wait_until_complete(Milliseconds timeout) {
  return impl_->wait(timeout, [this] { return impl_->model.complete(); });
}

bool Replica::wait_for_number(std::uint64_t epoch, std::uint64_t number, Milliseconds timeout) {
  return impl_->wait(timeout, [&] {
    const ReplicaStamp& stamp = impl_->model.stamp();
    return impl_->model.complete() &&
           (stamp.epoch > epoch || (stamp.epoch == epoch && stamp.number >= number));
  });
}

bool Replica::complete() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->model.complete();
}

ReplicaStamp Replica::stamp() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->model.stamp();
}

ReplicaCounters Replica::counters() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->model.counters();
}

std::optional<std::chrono::nanoseconds> Replica::time_to_complete() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->completed_;
}

Replica::Snapshot Replica::snapshot() const {
  const std::lock_guard lock(impl_->mutex);
  Snapshot result{impl_->model.stamp(), impl_->model.arithmetic(), impl_->model.period(), {}};
  result.bodies.reserve(impl_->model.size());
  impl_->model.for_each([&result](const ReplicaBody& body) { result.bodies.push_back(body); });
  return result;
}

std::optional<engine::BodyState> Replica::disk(engine::Id id, const engine::Instant& at) const {
  const std::lock_guard lock(impl_->mutex);
  const ReplicaBody* body = impl_->model.find(id);
  if (body == nullptr || body->body.is_wall) return std::nullopt;
  return impl_->model.disk_at(*body, at);
}

std::vector<engine::BodyState> Replica::disks(std::optional<engine::Instant> at) const {
  const std::lock_guard lock(impl_->mutex);
  const engine::Instant when = at.value_or(impl_->model.stamp().at);
  std::vector<engine::BodyState> result;
  result.reserve(impl_->model.size());
  impl_->model.for_each([&](const ReplicaBody& body) {
    if (!body.body.is_wall) result.push_back(impl_->model.disk_at(body, when));
  });
  return result;
}

std::vector<engine::WallState> Replica::walls(std::optional<engine::Instant> at) const {
  const std::lock_guard lock(impl_->mutex);
  const engine::Instant when = at.value_or(impl_->model.stamp().at);
  std::vector<engine::WallState> result;
  impl_->model.for_each([&](const ReplicaBody& body) {
    if (body.body.is_wall) result.push_back(impl_->model.wall_at(body, when));
  });
  return result;
}

std::vector<engine::ZoneState> Replica::zones() const { return impl_->zones(); }

}  // namespace stoss::client

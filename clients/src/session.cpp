// SPDX-License-Identifier: Apache-2.0
#include "pending.hpp"

#include <stoss/client/session.hpp>
#include <stoss/dds/waitset.hpp>
#include <stoss/idl/topics.hpp>
#include <stoss/translate/basics.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

namespace stoss::client {
namespace {

using std::chrono::steady_clock;
namespace wire = idl::wire;

constexpr Milliseconds kPollMatched{1};
constexpr Milliseconds kFirstAnswer{150};
constexpr Milliseconds kMailboxGrace{300};
constexpr Milliseconds kWaitBusy{20};
constexpr Milliseconds kWaitIdle{1000};

constexpr std::intptr_t kTagWake = 0;
constexpr std::intptr_t kTagReply = 1;
constexpr std::intptr_t kTagAnswer = 2;

ClientId random_id() {
  std::random_device device;
  ClientId id{};
  for (std::uint8_t& byte : id) byte = static_cast<std::uint8_t>(device());
  return id;
}

dds::Network as_client(dds::Network network) {
  network.role = dds::Role::kClient;
  return network;
}

Failure silence(const char* why) {
  return {.answered = false,
          .reject = {.code = engine::Code::Unavailable, .field = {}, .reason = why}};
}

}  // namespace

class Session::Impl {
 public:
  explicit Impl(const ConnectOptions& options);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void connect();
  void submit(const Command& command, Milliseconds timeout, ReplyHandler handler);
  void submit(const Query& query, Milliseconds timeout, AnswerHandler handler);
  Result<Answer> ask(const Query& query, Milliseconds timeout);
  SessionCounters counters() const;

  const ConnectOptions options;
  const ClientId id = random_id();
  Status first_status;

 private:
  template <class Request, class Handler, class Waiting>
  void start(const Request& request, Milliseconds timeout, Handler handler, Waiting waiting);
  void send(std::uint64_t number, const Command& command);
  void send(std::uint64_t number, const Query& query);
  void run();
  void receive();
  void on_reply(const wire::Reply& reply);
  void on_answer(const wire::Answer& answer);
  void tend();
  void resend(const Due& due);
  void wait_until_heard(steady_clock::time_point deadline);
  void wait_for_mailbox(steady_clock::time_point deadline);
  void wake_if_idle(bool was_empty);
  static void fail(const Due& due, const char* why);

 public:
  dds::Participant participant;

 private:
  dds::Publisher publisher_;
  dds::Subscriber mailbox_;
  dds::Topic<wire::Command> command_topic_;
  dds::Topic<wire::Query> query_topic_;
  dds::Topic<wire::Reply> reply_topic_;
  dds::Topic<wire::Answer> answer_topic_;
  dds::Writer<wire::Command> command_writer_;
  dds::Writer<wire::Query> query_writer_;
  dds::Reader<wire::Reply> reply_reader_;
  dds::Reader<wire::Answer> answer_reader_;
  dds::Guard wake_;
  dds::WaitSet waitset_;

  mutable std::mutex mutex_;  ///< guards the three below; never held while DDS is called
  PendingRequests pending_;
  std::uint64_t last_number_ = 0;
  SessionCounters counters_;

  /// One thread writes at a time, and in the order of numbers: the daemon refuses a number that
  /// comes long after those that follow it. Taken before mutex_, never after.
  std::mutex send_mutex_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

Session::Impl::Impl(const ConnectOptions& given)
    : options(given),
      participant(given.domain, as_client(given.network)),
      publisher_(participant, idl::partition_of(given.world)),
      mailbox_(participant, idl::mailbox_of(given.world, id)),
      command_topic_(idl::make_topic(participant, idl::kCommandTopic)),
      query_topic_(idl::make_topic(participant, idl::kQueryTopic)),
      reply_topic_(idl::make_topic(participant, idl::kReplyTopic)),
      answer_topic_(idl::make_topic(participant, idl::kAnswerTopic)),
      command_writer_(idl::make_writer(publisher_, command_topic_, idl::kCommandTopic)),
      query_writer_(idl::make_writer(publisher_, query_topic_, idl::kQueryTopic)),
      reply_reader_(idl::make_reader(mailbox_, reply_topic_, idl::kReplyTopic)),
      answer_reader_(idl::make_reader(mailbox_, answer_topic_, idl::kAnswerTopic)),
      wake_(participant),
      waitset_(participant) {
  waitset_.attach(wake_, kTagWake);
  waitset_.attach(reply_reader_, kTagReply);
  waitset_.attach(answer_reader_, kTagAnswer);
  thread_ = std::thread([this] { run(); });
}

Session::Impl::~Impl() {
  stopping_ = true;
  wake_.set();
  thread_.join();
  Due rest;
  {
    const std::lock_guard lock(mutex_);
    rest = pending_.drop_all();
  }
  fail(rest, "the session has ended");
}

// The first answer proves all of the way there and back but for the replies' writer, which the
// daemon makes together with the answers'.
void Session::Impl::connect() {
  const auto deadline = steady_clock::now() + options.timeout;
  wait_until_heard(deadline);
  for (;;) {
    const auto left = std::chrono::duration_cast<Milliseconds>(deadline - steady_clock::now());
    if (left <= Milliseconds::zero()) {
      throw NoWorldError("world \"" + options.world + "\" did not answer in time");
    }
    Result<Answer> answer = ask(Query::status(), std::min(left, kFirstAnswer));
    if (answer.ok() && answer.value().status) {
      first_status = *answer.value().status;
      break;
    }
    if (!answer.ok() && answer.failure().answered) {
      throw NoWorldError("world \"" + options.world +
                         "\" does not tell its status: " + answer.failure().reject.reason);
    }
  }
  wait_for_mailbox(std::min(deadline, steady_clock::now() + kMailboxGrace));
}

void Session::Impl::wait_until_heard(steady_clock::time_point deadline) {
  while (command_writer_.readers() == 0 || query_writer_.readers() == 0) {
    if (steady_clock::now() >= deadline) {
      throw NoWorldError("no world \"" + options.world + "\" in domain " +
                         std::to_string(options.domain));
    }
    std::this_thread::sleep_for(kPollMatched);
  }
}

void Session::Impl::wait_for_mailbox(steady_clock::time_point deadline) {
  while ((reply_reader_.writers() == 0 || answer_reader_.writers() == 0) &&
         steady_clock::now() < deadline) {
    std::this_thread::sleep_for(kPollMatched);
  }
}

void Session::Impl::wake_if_idle(bool was_empty) {
  if (was_empty) wake_.set();
}

template <class Request, class Handler, class Waiting>
void Session::Impl::start(const Request& request,
                          Milliseconds timeout,
                          Handler handler,
                          Waiting waiting) {
  waiting.handler = std::move(handler);
  waiting.deadline = steady_clock::now() + timeout;
  std::uint64_t number = 0;
  bool was_empty = false;
  {
    const std::lock_guard in_order(send_mutex_);
    {
      const std::lock_guard lock(mutex_);
      number = ++last_number_;
      was_empty = pending_.empty();
      pending_.add(number, std::move(waiting));
    }
    send(number, request);
  }
  wake_if_idle(was_empty);
}

void Session::Impl::submit(const Command& command, Milliseconds timeout, ReplyHandler handler) {
  if (auto reject = too_large(command.spec())) {
    handler(Failure{.answered = true, .reject = std::move(*reject)});
    return;
  }
  PendingCommand waiting{.spec = command.spec()};
  waiting.resend = steady_clock::now() + kCommandRetry;
  start(command, timeout, std::move(handler), std::move(waiting));
}

void Session::Impl::submit(const Query& query, Milliseconds timeout, AnswerHandler handler) {
  if (auto reject = too_large(query)) {
    handler(Failure{.answered = true, .reject = std::move(*reject)});
    return;
  }
  PendingQuery waiting{.query = query};
  waiting.resend = steady_clock::now() + kQueryRetry;
  start(query, timeout, std::move(handler), std::move(waiting));
}

Result<Answer> Session::Impl::ask(const Query& query, Milliseconds timeout) {
  std::promise<Result<Answer>> promise;
  auto future = promise.get_future();
  submit(
      query, timeout, [&promise](Result<Answer> answer) { promise.set_value(std::move(answer)); });
  return future.get();
}

// A write that fails because the daemon takes nothing in is made good by the next retry. REQUIRES:
// send_mutex_ is held.
void Session::Impl::send(std::uint64_t number, const Command& command) {
  const EncodedCommand encoded(command.spec(), {id, number});
  static_cast<void>(command_writer_.write(encoded.sample()));
}

void Session::Impl::send(std::uint64_t number, const Query& query) {
  const wire::Query sample = encode(query, {id, number});
  static_cast<void>(query_writer_.write(sample));
}

void Session::Impl::run() {
  auto next_tending = steady_clock::now();
  while (!stopping_) {
    receive();
    if (steady_clock::now() < next_tending) continue;
    tend();
    next_tending = steady_clock::now() + kWaitBusy;
  }
}

void Session::Impl::receive() {
  bool busy = false;
  {
    const std::lock_guard lock(mutex_);
    busy = !pending_.empty();
  }
  waitset_.wait(busy ? kWaitBusy : kWaitIdle, [this](std::intptr_t tag) {
    if (tag == kTagWake) {
      static_cast<void>(wake_.clear());
    } else if (tag == kTagReply) {
      reply_reader_.drain([this](const dds::Sample<wire::Reply>& sample) {
        if (sample.valid()) on_reply(sample.data);
      });
    } else {
      answer_reader_.drain([this](const dds::Sample<wire::Answer>& sample) {
        if (sample.valid()) on_answer(sample.data);
      });
    }
  });
}

void Session::Impl::on_reply(const wire::Reply& reply) {
  std::optional<ReplyHandler> handler;
  {
    const std::lock_guard lock(mutex_);
    handler = pending_.take_command(reply.request.number);
    if (!handler) ++counters_.stray_replies;
  }
  if (handler) (*handler)(decode(reply));
}

void Session::Impl::on_answer(const wire::Answer& answer) {
  const std::uint64_t number = answer.request.number;
  std::optional<AnswerHandler> handler;
  std::optional<Result<Answer>> result;
  if (answer.code != stoss_v1_CODE_OK) {
    result = Failure{.answered = true,
                     .reject = translate::reject_of(answer),
                     .at = translate::to_engine(answer.at)};
  } else if (engine::Outcome<Answer> chunk = decode(answer); !chunk) {
    const std::lock_guard lock(mutex_);
    ++counters_.malformed;
    result = Failure{.answered = true, .reject = chunk.reject()};
  } else {
    const std::lock_guard lock(mutex_);
    if (auto whole = pending_.add_chunk(
            number, answer.chunk, answer.chunks, std::move(chunk).value(), steady_clock::now())) {
      result = std::move(*whole);
    }
  }
  if (!result) return;
  {
    const std::lock_guard lock(mutex_);
    handler = pending_.take_query(number);
  }
  if (handler) (*handler)(std::move(*result));
}

void Session::Impl::tend() {
  Due due;
  {
    const std::lock_guard lock(mutex_);
    due = pending_.due(steady_clock::now());
    counters_.retries += due.commands_to_send.size() + due.queries_to_send.size();
  }
  resend(due);
  fail(due, "no answer in time");
}

void Session::Impl::resend(const Due& due) {
  for (const std::uint64_t number : due.commands_to_send) {
    std::unique_ptr<EncodedCommand> encoded;
    {
      const std::lock_guard lock(mutex_);
      if (const PendingCommand* waiting = pending_.command(number)) {
        encoded = std::make_unique<EncodedCommand>(waiting->spec, translate::RequestId{id, number});
      }
    }
    if (!encoded) continue;
    const std::lock_guard lock(send_mutex_);
    static_cast<void>(command_writer_.write(encoded->sample()));
  }
  for (const std::uint64_t number : due.queries_to_send) {
    std::optional<Query> query;
    {
      const std::lock_guard lock(mutex_);
      if (const PendingQuery* waiting = pending_.query(number)) query = waiting->query;
    }
    if (!query) continue;
    const std::lock_guard lock(send_mutex_);
    send(number, *query);
  }
}

void Session::Impl::fail(const Due& due, const char* why) {
  for (const ReplyHandler& handler : due.silent_commands) handler(silence(why));
  for (const AnswerHandler& handler : due.silent_queries) handler(silence(why));
}

SessionCounters Session::Impl::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

Session::Session(const ConnectOptions& options) : impl_(std::make_unique<Impl>(options)) {
  impl_->connect();
}

Session::~Session() = default;

Result<Reply> Session::command(const Command& command) {
  return this->command(command, impl_->options.timeout);
}

Result<Reply> Session::command(const Command& command, Milliseconds timeout) {
  std::promise<Result<Reply>> promise;
  auto future = promise.get_future();
  impl_->submit(
      command, timeout, [&promise](Result<Reply> reply) { promise.set_value(std::move(reply)); });
  return future.get();
}

std::future<Result<Reply>> Session::submit(const Command& command) {
  auto promise = std::make_shared<std::promise<Result<Reply>>>();
  auto future = promise->get_future();
  impl_->submit(command, impl_->options.timeout, [promise](Result<Reply> reply) {
    promise->set_value(std::move(reply));
  });
  return future;
}

void Session::submit(const Command& command, Milliseconds timeout, ReplyHandler handler) {
  impl_->submit(command, timeout, std::move(handler));
}

Result<Answer> Session::ask(const Query& query) { return ask(query, impl_->options.timeout); }

Result<Answer> Session::ask(const Query& query, Milliseconds timeout) {
  return impl_->ask(query, timeout);
}

void Session::submit(const Query& query, Milliseconds timeout, AnswerHandler handler) {
  impl_->submit(query, timeout, std::move(handler));
}

const std::string& Session::world() const { return impl_->options.world; }
const ClientId& Session::id() const { return impl_->id; }
const Status& Session::first_status() const { return impl_->first_status; }
Milliseconds Session::timeout() const { return impl_->options.timeout; }
SessionCounters Session::counters() const { return impl_->counters(); }
const dds::Participant& Session::participant() const { return impl_->participant; }

}  // namespace stoss::client

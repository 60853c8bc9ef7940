// SPDX-License-Identifier: Apache-2.0
#include "intake.hpp"

#include "guarded_thread.hpp"

#include <stoss/translate/command.hpp>
#include <stoss/translate/query.hpp>

#include <spdlog/spdlog.h>

#include <optional>
#include <utility>

namespace stoss::service {
namespace {

using engine::Code;
using engine::Reject;

constexpr std::intptr_t kCommandTag = 1;
constexpr std::intptr_t kQueryTag = 2;
constexpr std::intptr_t kStopTag = 3;
constexpr std::chrono::seconds kWait{1};

// What a request of any kind must have.
std::optional<Reject> check(const RequestId& request) {
  if (request.number != 0) return std::nullopt;
  return Reject{.code = Code::InvalidArgument,
                .field = "request.number",
                .reason = "requests are numbered from 1"};
}

Reject queue_full() {
  return {.code = Code::ResourceExhausted,
          .field = "",
          .reason = "the daemon's queue is full; try again later"};
}

}  // namespace

void RefusalLog::add(const RequestId& request) {
  if (!refused_.emplace(request, true).second) return;
  order_.push_back(request);
  if (order_.size() <= kRefusalsKept) return;
  refused_.erase(order_.front());
  order_.pop_front();
}

bool RefusalLog::contains(const RequestId& request) const { return refused_.contains(request); }

Intake::Intake(const dds::Participant& participant,
               const Topics& topics,
               const std::string& world,
               Gates& gates,
               Inbox& inbox,
               Outbox& outbox,
               SharedCounters& shared)
    : gates_(gates),
      inbox_(inbox),
      outbox_(outbox),
      shared_(shared),
      subscriber_(participant, idl::partition_of(world)),
      command_reader_(idl::make_reader(subscriber_, topics.command, idl::kCommandTopic)),
      query_reader_(idl::make_reader(subscriber_, topics.query, idl::kQueryTopic)),
      stop_(participant),
      waitset_(participant) {
  waitset_.attach(command_reader_, kCommandTag);
  waitset_.attach(query_reader_, kQueryTag);
  waitset_.attach(stop_, kStopTag);
}

void Intake::start(std::atomic<int>& failure) {
  thread_ = std::jthread([this, &failure] { run_guarded("intake", failure, [this] { run(); }); });
}

void Intake::stop() noexcept {
  stopping_ = true;
  stop_.set();
  if (thread_.joinable()) thread_.join();
}

void Intake::run() {
  for (bool is_last = false; !is_last;) {
    const int triggered = waitset_.wait(kWait, [](std::intptr_t) {});
    is_last = stopping_;  // what came before the stop is still taken in
    if (triggered < 0) {
      spdlog::error("waiting for commands failed with code {}", triggered);
      if (!is_last) std::this_thread::sleep_for(kWait);
    }
    // A batch of each in turn; whatever is left triggers the waitset again.
    for (const auto sample : command_reader_.take()) {
      if (sample.valid()) take(sample.data);
    }
    for (const auto sample : query_reader_.take()) {
      if (sample.valid()) take(sample.data);
    }
  }
}

void Intake::refuse(const RequestId& request, Reject reject, bool duplicate) {
  outbox_.push_refusal(ReplyRecord{request, std::move(reject), duplicate, std::nullopt, {}});
}

void Intake::take(const wire::Command& command) {
  const RequestId request = translate::to_engine(command.request);
  auto spec = translate::command_of(command);
  auto wrong = spec ? check(request) : std::optional(spec.reject());
  if (wrong) {
    shared_.malformed.fetch_add(1, std::memory_order_relaxed);
    refuse(request, *std::move(wrong), false);
    return;
  }
  if (refusals_.contains(request)) {
    refuse(request, queue_full(), true);
    return;
  }
  auto ticket = gates_.commands.admit(request.client, spec.value().footprint());
  if (!ticket) {
    shared_.queue_full.fetch_add(1, std::memory_order_relaxed);
    refusals_.add(request);
    refuse(request, queue_full(), false);
    return;
  }
  inbox_.push(CommandItem{std::move(spec).value(), *std::move(ticket)});
}

void Intake::take(const wire::Query& query) {
  const RequestId request = translate::to_engine(query.request);
  auto spec = translate::query_of(query);
  auto wrong = spec ? check(request) : std::optional(spec.reject());
  std::optional<Ticket> ticket;
  if (wrong) {
    shared_.malformed.fetch_add(1, std::memory_order_relaxed);
  } else if (ticket = gates_.queries.admit(request.client, sizeof(QueryItem)); !ticket) {
    shared_.queue_full.fetch_add(1, std::memory_order_relaxed);
    wrong = queue_full();
  }
  if (wrong) {
    outbox_.push_refusal(AnswerItem{request, std::nullopt, *std::move(wrong), {}});
    return;
  }
  inbox_.push(QueryItem{std::move(spec).value(), *std::move(ticket)});
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include "pending.hpp"

#include <utility>

namespace stoss::client {
namespace {

bool same_stamp(const Answer& a, const Answer& b) {
  return a.epoch == b.epoch && a.at == b.at && a.tick == b.tick &&
         a.motion_number == b.motion_number && a.collision_number == b.collision_number;
}

Answer stamp_of(const Answer& answer) {
  Answer stamp;
  stamp.epoch = answer.epoch;
  stamp.at = answer.at;
  stamp.tick = answer.tick;
  stamp.motion_number = answer.motion_number;
  stamp.collision_number = answer.collision_number;
  return stamp;
}

template <class Map>
auto* find_in(Map& map, std::uint64_t number) {
  const auto found = map.find(number);
  return found == map.end() ? nullptr : &found->second;
}

template <class Map>
auto take_handler(Map& map, std::uint64_t number)
    -> std::optional<decltype(map.begin()->second.handler)> {
  const auto found = map.find(number);
  if (found == map.end()) return std::nullopt;
  auto handler = std::move(found->second.handler);
  map.erase(found);
  return handler;
}

template <class Map, class Handlers>
void sort_due(Map& map,
              SteadyTime now,
              Milliseconds retry,
              std::vector<std::uint64_t>& to_send,
              Handlers& silent) {
  for (auto it = map.begin(); it != map.end();) {
    auto& [number, request] = *it;
    if (now >= request.deadline) {
      silent.push_back(std::move(request.handler));
      it = map.erase(it);
      continue;
    }
    if (now >= request.resend) {
      request.resend = now + retry;
      to_send.push_back(number);
    }
    ++it;
  }
}

}  // namespace

void PendingRequests::add(std::uint64_t number, PendingCommand command) {
  commands_.emplace(number, std::move(command));
}

void PendingRequests::add(std::uint64_t number, PendingQuery query) {
  queries_.emplace(number, std::move(query));
}

const PendingCommand* PendingRequests::command(std::uint64_t number) const {
  return find_in(commands_, number);
}

const PendingQuery* PendingRequests::query(std::uint64_t number) const {
  return find_in(queries_, number);
}

std::optional<Session::ReplyHandler> PendingRequests::take_command(std::uint64_t number) {
  return take_handler(commands_, number);
}

std::optional<Session::AnswerHandler> PendingRequests::take_query(std::uint64_t number) {
  return take_handler(queries_, number);
}

std::optional<Answer> PendingRequests::add_chunk(std::uint64_t number,
                                                 std::uint32_t chunk,
                                                 std::uint32_t chunks,
                                                 Answer content,
                                                 SteadyTime now) {
  PendingQuery* query = find_in(queries_, number);
  if (query == nullptr || chunk >= chunks || chunks > kChunksMax) return std::nullopt;
  query->resend = now + kQueryRetry;
  if (query->chunks.size() != chunks || !same_stamp(query->stamp, content)) {
    query->chunks.assign(chunks, std::nullopt);
    query->arrived = 0;
    query->stamp = stamp_of(content);
  }
  std::optional<Answer>& place = query->chunks[chunk];
  if (place) return std::nullopt;
  place = std::move(content);
  if (++query->arrived < chunks) return std::nullopt;
  Answer whole = std::move(*query->chunks.front());
  for (std::size_t i = 1; i < query->chunks.size(); ++i) {
    append(whole, std::move(*query->chunks[i]));
  }
  return whole;
}

Due PendingRequests::due(SteadyTime now) {
  Due due;
  sort_due(commands_, now, kCommandRetry, due.commands_to_send, due.silent_commands);
  sort_due(queries_, now, kQueryRetry, due.queries_to_send, due.silent_queries);
  return due;
}

Due PendingRequests::drop_all() {
  Due due;
  for (auto& [number, request] : commands_) {
    due.silent_commands.push_back(std::move(request.handler));
  }
  for (auto& [number, request] : queries_) {
    due.silent_queries.push_back(std::move(request.handler));
  }
  commands_.clear();
  queries_.clear();
  return due;
}

}  // namespace stoss::client

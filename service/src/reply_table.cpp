// SPDX-License-Identifier: Apache-2.0
#include "reply_table.hpp"

#include <algorithm>
#include <iterator>

namespace stoss::service {
namespace {

std::size_t size_of(const ReplyRecord& reply) {
  std::size_t bytes = sizeof(ReplyRecord) + reply.ids.size() * sizeof(engine::Id);
  if (reply.reject) bytes += reply.reject->field.size() + reply.reject->reason.size();
  return bytes;
}

}  // namespace

ReplyTable::Client& ReplyTable::client_of(const ClientId& id) {
  const auto [entry, is_new] = clients_.try_emplace(id);
  Client& client = entry->second;
  if (is_new) {
    recent_.push_front(id);
    client.recent = recent_.begin();
    forget_old_clients();
  } else {
    recent_.splice(recent_.begin(), recent_, client.recent);
  }
  return client;
}

// A client with waiting commands is kept, since their replies are to come.
void ReplyTable::forget_old_clients() {
  auto oldest = recent_.end();
  while (clients_.size() > kClientsMax && oldest != std::next(recent_.begin())) {
    --oldest;
    if (!clients_.at(*oldest).waiting.empty()) continue;
    clients_.erase(*oldest);
    oldest = recent_.erase(oldest);
  }
}

ReplyTable::Verdict ReplyTable::admit(const RequestId& request) {
  Client& client = client_of(request.client);
  if (client.waiting.contains(request.number)) return Waiting{};
  const auto reply = client.replies.find(request.number);
  if (reply != client.replies.end()) return reply->second;
  if (request.number <= client.forgotten) return Forgotten{};
  client.waiting.insert(request.number);
  return New{};
}

void ReplyTable::finish(const ReplyRecord& reply) {
  Client& client = client_of(reply.request.client);
  client.waiting.erase(reply.request.number);
  const auto [entry, is_new] = client.replies.insert_or_assign(reply.request.number, reply);
  if (!is_new) return;
  client.order.push_back(reply.request.number);
  client.bytes += size_of(entry->second);
  forget_old_replies(client);
}

void ReplyTable::forget_old_replies(Client& client) {
  while (client.order.size() > kRepliesKept ||
         (client.bytes > kReplyBytesKept && client.order.size() > 1)) {
    const auto oldest = client.replies.find(client.order.front());
    client.forgotten = std::max(client.forgotten, oldest->first);
    client.bytes -= size_of(oldest->second);
    client.replies.erase(oldest);
    client.order.pop_front();
  }
}

}  // namespace stoss::service

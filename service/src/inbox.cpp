// SPDX-License-Identifier: Apache-2.0
#include "inbox.hpp"

#include <iterator>
#include <utility>

namespace stoss::service {

void Inbox::push(CommandItem command) {
  const std::lock_guard lock(mutex_);
  commands_[command.spec.request.client].push_back(std::move(command));
  news_ = true;
  arrived_.notify_one();
}

void Inbox::push(QueryItem query) {
  const std::lock_guard lock(mutex_);
  queries_.push_back(std::move(query));
  news_ = true;
  arrived_.notify_one();
}

void Inbox::push_gone(const ClientId& client) {
  const std::lock_guard lock(mutex_);
  gone_.push_back(client);
}

void Inbox::wake() {
  const std::lock_guard lock(mutex_);
  news_ = true;
  arrived_.notify_one();
}

std::vector<CommandItem> Inbox::take_commands(std::size_t most) {
  const std::lock_guard lock(mutex_);
  std::vector<CommandItem> taken;
  auto client = commands_.lower_bound(next_client_);
  while (taken.size() < most && !commands_.empty()) {
    if (client == commands_.end()) client = commands_.begin();
    taken.push_back(std::move(client->second.front()));
    client->second.pop_front();
    client = client->second.empty() ? commands_.erase(client) : std::next(client);
  }
  next_client_ = client == commands_.end() ? ClientId{} : client->first;
  return taken;
}

std::vector<QueryItem> Inbox::take_queries(std::size_t most) {
  const std::lock_guard lock(mutex_);
  std::vector<QueryItem> taken;
  while (taken.size() < most && !queries_.empty()) {
    taken.push_back(std::move(queries_.front()));
    queries_.pop_front();
  }
  return taken;
}

std::vector<ClientId> Inbox::take_gone() {
  const std::lock_guard lock(mutex_);
  return std::exchange(gone_, {});
}

bool Inbox::has_commands() const {
  const std::lock_guard lock(mutex_);
  return !commands_.empty();
}

void Inbox::wait(Nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, timeout, [this] { return news_; });
  news_ = false;
}

}  // namespace stoss::service

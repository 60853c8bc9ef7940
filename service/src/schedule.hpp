// SPDX-License-Identifier: Apache-2.0
// Commands whose instant is known, in the order in which they take effect: (instant, client,
// number). Neither arrival nor ticks enter into it.
#pragma once

#include "records.hpp"

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace stoss::service {

class Schedule {
 public:
  /// REQUIRES: no command of the same request is here.
  void add(const engine::Instant& at, CommandItem command) {
    const Key key{at, command.spec.request};
    commands_.emplace(key, std::move(command));
  }

  [[nodiscard]] bool empty() const { return commands_.empty(); }
  [[nodiscard]] std::size_t size() const { return commands_.size(); }
  /// The instant of the first.
  [[nodiscard]] std::optional<engine::Instant> first_at() const {
    if (commands_.empty()) return std::nullopt;
    return commands_.begin()->first.at;
  }
  /// REQUIRES: !empty()
  [[nodiscard]] CommandItem take_first() {
    const auto first = commands_.begin();
    CommandItem command = std::move(first->second);
    commands_.erase(first);
    return command;
  }
  /// All of them, in their order.
  [[nodiscard]] std::vector<CommandItem> take_all() {
    std::vector<CommandItem> all;
    all.reserve(commands_.size());
    for (auto& [key, command] : commands_) all.push_back(std::move(command));
    commands_.clear();
    return all;
  }

 private:
  struct Key {
    engine::Instant at;
    RequestId request;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  std::map<Key, CommandItem> commands_;
};

}  // namespace stoss::service

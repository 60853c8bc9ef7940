// SPDX-License-Identifier: Apache-2.0
#pragma once

// A reader of one of a world's topics, with a thread of its user waiting on it.

#include <stoss/client/session.hpp>
#include <stoss/dds/waitset.hpp>
#include <stoss/idl/topics.hpp>

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <utility>

namespace stoss::client {

template <class T>
class TopicFeed {
 public:
  TopicFeed(const Session& session, const idl::TopicSpec<T>& spec)
      : subscriber_(session.participant(), idl::partition_of(session.world())),
        topic_(idl::make_topic(session.participant(), spec)),
        reader_(idl::make_reader(subscriber_, topic_, spec)),
        waitset_(session.participant()) {
    waitset_.attach(reader_, 0);
  }

  /// Calls `each(Sample<T>)` for whatever has arrived.
  template <class F>
  void drain(F&& each) {
    reader_.drain(std::forward<F>(each));
  }

  [[nodiscard]] bool matched() const { return reader_.writers() > 0; }
  [[nodiscard]] const dds::Reader<T>& reader() const { return reader_; }

  /// Drains until `ready()` yields something or the time is up.
  template <class F, class Ready>
  auto wait_for(Milliseconds timeout, F&& each, Ready&& ready) -> decltype(ready()) {
    using std::chrono::steady_clock;
    const auto end = steady_clock::now() + timeout;
    for (;;) {
      reader_.drain(each);
      if (auto result = ready()) return result;
      const auto left = end - steady_clock::now();
      if (left <= left.zero()) return std::nullopt;
      waitset_.wait(left, [](std::intptr_t) {});
    }
  }

 private:
  dds::Subscriber subscriber_;
  dds::Topic<T> topic_;
  dds::Reader<T> reader_;
  dds::WaitSet waitset_;
};

/// The front of a queue, if there is one.
template <class T>
std::optional<T> pop(std::deque<T>& queue) {
  if (queue.empty()) return std::nullopt;
  std::optional<T> front = std::move(queue.front());
  queue.pop_front();
  return front;
}

}  // namespace stoss::client

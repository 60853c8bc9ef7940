// SPDX-License-Identifier: Apache-2.0
#include "broad_phase/list_pool.hpp"

#include "grow.hpp"

#include <algorithm>

namespace stoss::engine {

ListPool::Word ListPool::grow(PooledList& list, std::size_t wanted) {
  const std::uint32_t held = size(list);
  std::uint32_t room_class = Word(memory_[list.head]).room_class();
  while (Word::of_class(room_class).room() < wanted) ++room_class;
  const Word word = Word::of_class(room_class);
  PooledList larger{free_[room_class]};
  if (larger.head != 0) {
    free_[room_class] = static_cast<std::uint32_t>(memory_[larger.head + 1]);
    free_words_ -= word.room() + 1;
  } else {
    larger.head = static_cast<std::uint32_t>(memory_.size());
    make_line_of(memory_.size() + word.room(), memory_);
  }
  std::copy_n(memory_.data() + list.head + 1, held, memory_.data() + larger.head + 1);
  memory_[larger.head] = word.with_size(held);
  release(list);
  list = larger;
  return Word(memory_[list.head]);
}

void ListPool::move_in(PooledList& list, const ListPool& from) {
  if (list.head == 0) return;
  const auto first = from.memory_.begin() + list.head;
  list.head = static_cast<std::uint32_t>(memory_.size());
  memory_.insert(memory_.end(), first, first + 1 + Word(*first).room());
}

}  // namespace stoss::engine

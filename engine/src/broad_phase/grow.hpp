// SPDX-License-Identifier: Apache-2.0
#pragma once

// Growth of what holds a line for each of many bodies: by a quarter at a time, so that no more than
// a fifth lies idle. What that copies is still a constant number of lines for each that comes.

#include <cstddef>
#include <vector>

namespace stoss::engine {

template <class T>
void make_room_for_more(std::vector<T>& lines, std::size_t more = 1) {
  constexpr std::size_t kLeast = 8;
  const std::size_t wanted = lines.size() + more;
  if (wanted <= lines.capacity()) return;
  const std::size_t larger = lines.capacity() + lines.capacity() / 4 + kLeast;
  lines.reserve(wanted < larger ? larger : wanted);
}

/// Makes the line of a number, and all before it.
template <class T>
void make_line_of(std::size_t number, std::vector<T>& lines, const T& empty = T{}) {
  if (number < lines.size()) return;
  make_room_for_more(lines, number + 1 - lines.size());
  lines.resize(number + 1, empty);
}

}  // namespace stoss::engine

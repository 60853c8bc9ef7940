// SPDX-License-Identifier: Apache-2.0
#pragma once

// Growth of what holds a line for each of many bodies: by a quarter at a time, so that no more than
// a fifth lies idle; by doubling where that is little. What is copied stays within a constant
// number of lines for each that comes.

#include <cstddef>
#include <vector>

namespace stoss::engine {

/// REQUIRES: there is no room for so many more.
template <class T>
void grow_for(std::vector<T>& lines, std::size_t more) {
  constexpr std::size_t kLittle = (std::size_t{1} << 16) / sizeof(T);
  const std::size_t now = lines.capacity();
  const std::size_t larger = now + (now < kLittle ? now : now / 4) + 1;
  lines.reserve(lines.size() + more < larger ? larger : lines.size() + more);
}

template <class T>
void make_room_for(std::size_t more, std::vector<T>& lines) {
  if (lines.capacity() - lines.size() < more) grow_for(lines, more);
}

/// Makes the line of a number, and those before it.
template <class T>
void make_line_of(std::size_t number, std::vector<T>& lines) {
  if (number < lines.size()) return;
  make_room_for(number + 1 - lines.size(), lines);
  lines.resize(number + 1);
}

}  // namespace stoss::engine

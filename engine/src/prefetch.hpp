// SPDX-License-Identifier: Apache-2.0
#pragma once

// A hint that memory is about to be read. Never changes a result; nothing where the compiler has no
// word for it.

#include <cstddef>

namespace stoss::engine {

inline void prefetch([[maybe_unused]] const void* where) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(where);
  // To GCC 12 a function that does nothing else has no effect, and calls of it are dropped.
  asm volatile("" : : "r"(where));
#endif
}

/// The same for all lines of an object.
template <class T>
inline void prefetch_all(const T& object) {
  const char* const first = reinterpret_cast<const char*>(&object);
  for (std::size_t at = 0; at < sizeof(T); at += 64) prefetch(first + at);
}

}  // namespace stoss::engine

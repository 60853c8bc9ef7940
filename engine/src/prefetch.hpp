// SPDX-License-Identifier: Apache-2.0
#pragma once

// A hint that memory is about to be read. Never changes a result; nothing where the compiler has no
// word for it.

namespace stoss::engine {

inline void prefetch([[maybe_unused]] const void* where) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(where);
#endif
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace stoss::engine {

/// Thrown when the engine finds one of its own invariants broken. The world must not be used again.
class InvariantBroken : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Cheap checks stay on in every build.
inline void check(bool holds, const char* what) {
  if (!holds) [[unlikely]] {
    throw InvariantBroken(what);
  }
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
// The event loops of a plain world and of one with effects, compiled so that every function keeps
// its name: what check_plain_loop.py reads.
#include "basic_world.hpp"

namespace stoss::engine {

template <>
std::unique_ptr<WorldCore> make_plain_core<double>(const WorldOptions& options) {
  return std::make_unique<BasicWorld<double, PlainLaws>>(options);
}

template <>
std::unique_ptr<WorldCore> make_effects_core<double>(const WorldOptions& options) {
  return std::make_unique<BasicWorld<double, AcceleratedLaws>>(options);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What world_core.hpp promises of one arithmetic; the translation units that include this
// instantiate one function each.

#include "basic_world.hpp"

namespace stoss::engine {

template <class S>
std::unique_ptr<WorldCore> make_plain_core(const WorldOptions& options) {
  return std::make_unique<BasicWorld<S, PlainLaws>>(options);
}

template <class S>
std::unique_ptr<WorldCore> make_effects_core(const WorldOptions& options) {
  switch (laws_for(options.effects)) {
    case LawsKind::Growing:
      return std::make_unique<BasicWorld<S, GrowingLaws>>(options);
    case LawsKind::Dragged:
      return std::make_unique<BasicWorld<S, DragLaws>>(options);
    case LawsKind::Accelerated:
      return std::make_unique<BasicWorld<S, AcceleratedLaws>>(options);
    case LawsKind::Plain:
    case LawsKind::Contact:
      break;
  }
  return std::make_unique<BasicWorld<S, ContactLaws>>(options);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#include "basic_world.hpp"
#include "cores.hpp"
#include "double_double.hpp"

namespace stoss::wide {

std::unique_ptr<engine::WorldCore> make_double_double_core(const engine::WorldOptions& options) {
  return std::make_unique<engine::BasicWorld<DoubleDouble>>(options);
}

}  // namespace stoss::wide

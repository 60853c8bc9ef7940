// SPDX-License-Identifier: Apache-2.0
#include "basic_world.hpp"

namespace stoss::engine {

template class BasicWorld<float>;

std::unique_ptr<WorldCore> make_float_core(const WorldOptions& options);
std::unique_ptr<WorldCore> make_float_core(const WorldOptions& options) {
  return std::make_unique<BasicWorld<float>>(options);
}

}  // namespace stoss::engine

// SPDX-License-Identifier: Apache-2.0
#include "basic_world.hpp"

namespace stoss::engine {

template class BasicWorld<long double>;

std::unique_ptr<WorldCore> make_long_double_core(const WorldOptions& options);
std::unique_ptr<WorldCore> make_long_double_core(const WorldOptions& options) {
  return std::make_unique<BasicWorld<long double>>(options);
}

}  // namespace stoss::engine

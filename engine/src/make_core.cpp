// SPDX-License-Identifier: Apache-2.0
#include "world_core.hpp"

namespace stoss::engine {

std::unique_ptr<WorldCore> make_core(const WorldOptions& options) {
  switch (options.arithmetic) {
    case Arithmetic::Float:
      return make_core_in<float>(options);
    case Arithmetic::Double:
      return make_core_in<double>(options);
    case Arithmetic::LongDouble:
      return make_core_in<long double>(options);
    case Arithmetic::DoubleDouble:
    case Arithmetic::Float128:
      break;
  }
  return nullptr;
}

}  // namespace stoss::engine

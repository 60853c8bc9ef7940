// SPDX-License-Identifier: Apache-2.0
#include "world_core.hpp"

namespace stoss::engine {

// Each arithmetic is one translation unit (world_<name>.cpp).
std::unique_ptr<WorldCore> make_float_core(const WorldOptions& options);
std::unique_ptr<WorldCore> make_double_core(const WorldOptions& options);
std::unique_ptr<WorldCore> make_long_double_core(const WorldOptions& options);

std::unique_ptr<WorldCore> make_core(const WorldOptions& options) {
  switch (options.arithmetic) {
    case Arithmetic::Float:
      return make_float_core(options);
    case Arithmetic::Double:
      return make_double_core(options);
    case Arithmetic::LongDouble:
      return make_long_double_core(options);
    case Arithmetic::DoubleDouble:
    case Arithmetic::Float128:
      break;
  }
  return nullptr;
}

}  // namespace stoss::engine

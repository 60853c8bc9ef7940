// SPDX-License-Identifier: Apache-2.0
#include "basic_world.hpp"
#include "cores.hpp"

#include <boost/multiprecision/float128.hpp>

namespace stoss::wide {

/// IEEE binary128: 113 bits, 34 digits, in software.
using Float128 = boost::multiprecision::number<boost::multiprecision::float128_backend,
                                               boost::multiprecision::et_off>;

std::unique_ptr<engine::WorldCore> make_float128_core(const engine::WorldOptions& options) {
  return std::make_unique<engine::BasicWorld<Float128>>(options);
}

}  // namespace stoss::wide

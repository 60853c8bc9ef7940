// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/multiprecision/float128.hpp>

namespace stoss::wide {

/// IEEE binary128: 113 bits, 34 digits, in software.
using Float128 = boost::multiprecision::number<boost::multiprecision::float128_backend,
                                               boost::multiprecision::et_off>;

}  // namespace stoss::wide

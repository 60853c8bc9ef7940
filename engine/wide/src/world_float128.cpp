// SPDX-License-Identifier: Apache-2.0
#include "core_of.hpp"
#include "float128.hpp"

template std::unique_ptr<stoss::engine::WorldCore>
stoss::engine::make_plain_core<stoss::wide::Float128>(const WorldOptions& options);

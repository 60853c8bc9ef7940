// SPDX-License-Identifier: Apache-2.0
#include "core_of.hpp"
#include "double_double.hpp"

template std::unique_ptr<stoss::engine::WorldCore>
stoss::engine::make_plain_core<stoss::wide::DoubleDouble>(const WorldOptions& options);

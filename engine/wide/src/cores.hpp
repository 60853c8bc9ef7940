// SPDX-License-Identifier: Apache-2.0
#pragma once

// Each wide arithmetic is one translation unit; these are their doors.

#include "world_core.hpp"

#include <memory>

namespace stoss::wide {

std::unique_ptr<engine::WorldCore> make_double_double_core(const engine::WorldOptions& options);
std::unique_ptr<engine::WorldCore> make_float128_core(const engine::WorldOptions& options);

}  // namespace stoss::wide

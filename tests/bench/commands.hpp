// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace stoss::bench {

/// What a command to one body costs in a world of so many.
void register_commands(std::size_t disks);

}  // namespace stoss::bench

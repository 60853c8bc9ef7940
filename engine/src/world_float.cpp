// SPDX-License-Identifier: Apache-2.0
#include "core_of.hpp"

template std::unique_ptr<stoss::engine::WorldCore> stoss::engine::make_plain_core<float>(
    const WorldOptions& options);

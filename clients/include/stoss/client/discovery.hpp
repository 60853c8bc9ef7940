// SPDX-License-Identifier: Apache-2.0
// Which worlds are there.
#pragma once

#include <stoss/client/session.hpp>
#include <stoss/client/status.hpp>

#include <cstdint>
#include <vector>

namespace stoss::client {

/// The latest status of every world that is running in a domain, in the order of their names. Waits
/// at most `timeout` for the first; once one has answered, `settle` more for others. A world whose
/// daemon has gone is not listed. Throws dds::Error when there is no network to use.
[[nodiscard]] std::vector<Status> worlds(std::uint32_t domain,
                                         const dds::Network& network,
                                         Milliseconds timeout,
                                         Milliseconds settle);

}  // namespace stoss::client

// SPDX-License-Identifier: Apache-2.0
// What tests that hold a session with a running daemon have in common.
#pragma once

#include "daemon_process.hpp"

#include <stoss/client/replica.hpp>
#include <stoss/client/session.hpp>

namespace stoss::tests {

using client::Answer;
using client::Command;
using client::Milliseconds;
using client::Query;
using client::Replica;
using client::Session;

/// How long anything may take before the test gives up: the machine may be busy.
inline constexpr Milliseconds kPatience{30'000};

}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// Where Cyclone's own messages go.
#pragma once

#include <functional>
#include <string_view>

namespace stoss::dds {

enum class LogLevel { kInfo, kWarning, kError, kTrace };

/// Receives one line without its line end. Called from Cyclone's threads, one call at a time; must
/// not call DDS and must not throw.
using LogSink = std::function<void(LogLevel, std::string_view)>;

/// Sends the messages of every domain of this process to `sink`; an empty function drops them.
/// Before the first call Cyclone writes to standard error.
void set_log_sink(LogSink sink);

/// Back to standard error.
void reset_log_sink();

}  // namespace stoss::dds

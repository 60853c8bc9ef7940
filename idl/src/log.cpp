// SPDX-License-Identifier: Apache-2.0
#include <stoss/dds/log.hpp>

#include <dds/ddsrt/log.h>

#include <mutex>
#include <utility>

namespace stoss::dds {
namespace {

struct Destination {
  std::mutex mutex;
  LogSink sink;
};

// Never destroyed: Cyclone's threads may still log while the process exits.
Destination& destination() {
  static auto* const kDestination = new Destination;
  return *kDestination;
}

LogLevel level_of(std::uint32_t priority) {
  if ((priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0) return LogLevel::kError;
  if ((priority & DDS_LC_WARNING) != 0) return LogLevel::kWarning;
  if ((priority & DDS_LC_INFO) != 0) return LogLevel::kInfo;
  return LogLevel::kTrace;
}

// Called by Cyclone, through C: no exception may leave it.
void forward(void*, const dds_log_data_t* data) noexcept {
  std::string_view line(data->message, data->size);
  while (!line.empty() && (line.back() == '\n' || line.back() == '\0')) line.remove_suffix(1);
  Destination& to = destination();
  const std::lock_guard lock(to.mutex);
  if (!to.sink) return;
  try {
    to.sink(level_of(data->priority), line);
  } catch (...) {
    // Losing a line is better than ending the process inside the library.
    return;
  }
}

}  // namespace

void set_log_sink(LogSink sink) {
  Destination& to = destination();
  {
    const std::lock_guard lock(to.mutex);
    to.sink = std::move(sink);
  }
  // The same pair for both, so that Cyclone hands over each message once.
  dds_set_log_sink(&forward, &to);
  dds_set_trace_sink(&forward, &to);
}

void reset_log_sink() {
  dds_set_log_sink(nullptr, nullptr);
  dds_set_trace_sink(nullptr, nullptr);
  Destination& to = destination();
  const std::lock_guard lock(to.mutex);
  to.sink = nullptr;
}

}  // namespace stoss::dds

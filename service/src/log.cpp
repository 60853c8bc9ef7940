// SPDX-License-Identifier: Apache-2.0
#include "log.hpp"

#include <stoss/dds/log.hpp>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

namespace stoss::service {
namespace {

constexpr double kBurst = 20;
constexpr double kPerSecond = 2;

spdlog::level::level_enum level_of(dds::LogLevel level) {
  switch (level) {
    case dds::LogLevel::kError:
      return spdlog::level::err;
    case dds::LogLevel::kWarning:
      return spdlog::level::warn;
    case dds::LogLevel::kInfo:
      return spdlog::level::info;
    case dds::LogLevel::kTrace:
      return spdlog::level::trace;
  }
  return spdlog::level::warn;
}

}  // namespace

bool LineBudget::take(Nanoseconds now) {
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  left_ = std::min(burst_, left_ + seconds * per_second_);
  if (left_ < 1) {
    ++suppressed_;
    return false;
  }
  left_ -= 1;
  return true;
}

std::uint64_t LineBudget::take_suppressed() { return std::exchange(suppressed_, 0); }

void start_log(const std::string& level) {
  auto logger =
      std::make_shared<spdlog::logger>("stossd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  logger->set_level(spdlog::level::from_str(level == "warning" ? "warn" : level));
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(std::move(logger));
  // Cyclone calls one line at a time, so the budget needs no lock of its own.
  auto budget = std::make_shared<LineBudget>(kBurst, kPerSecond);
  dds::set_log_sink([budget](dds::LogLevel dds_level, std::string_view line) {
    const auto spd_level = level_of(dds_level);
    if (!spdlog::should_log(spd_level)) return;
    if (!budget->take(SteadyClock().now())) return;
    if (const std::uint64_t held_back = budget->take_suppressed(); held_back > 0) {
      spdlog::warn("dds: {} lines were held back", held_back);
    }
    spdlog::log(spd_level, "dds: {}", line);
  });
}

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#include "cli/exit_code.hpp"

#include <stoss/client/decimal.hpp>

namespace stoss::client::cli {

std::string describe(const engine::Reject& reject) {
  std::string details;
  const auto add = [&details](const std::string& detail) {
    details += (details.empty() ? " (" : ", ") + detail;
  };
  if (!reject.field.empty()) add("field " + reject.field);
  if (reject.body != engine::kNoId) add("body " + std::to_string(reject.body));
  if (reject.other != engine::kNoId) {
    add("in the way: " + std::to_string(reject.other));
    add("clearance " + format_number(reject.clearance) + " m");
  }
  if (!details.empty()) details += ')';
  const std::string reason = reject.reason.empty() ? "refused" : reject.reason;
  return std::string(engine::to_string(reject.code)) + ": " + reason + details;
}

RefusedError::RefusedError(engine::Reject reject)
    : std::runtime_error(describe(reject)), reject_(std::move(reject)) {}

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
// The error of a DDS call that failed while something was being set up.
#pragma once

#include <dds/dds.h>

#include <stdexcept>
#include <string>

namespace stoss::dds {

/// Thrown by constructors and set-up calls. Writing and taking do not throw.
class Error : public std::runtime_error {
 public:
  /// `what` says what was attempted, `code` is Cyclone's (negative) return code.
  Error(const std::string& what, dds_return_t code)
      : std::runtime_error(what + ": " + dds_strretcode(-code)), code_(code) {}

  /// Cyclone's return code: DDS_RETCODE_..., negative.
  [[nodiscard]] dds_return_t code() const noexcept { return code_; }

 private:
  dds_return_t code_;
};

/// Passes a good return code (>= 0) on; throws Error for any other.
inline dds_return_t check(dds_return_t code, const std::string& what) {
  if (code < 0) throw Error(what, code);
  return code;
}

}  // namespace stoss::dds

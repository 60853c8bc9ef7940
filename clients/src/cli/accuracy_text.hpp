// SPDX-License-Identifier: Apache-2.0
#pragma once

// A report of accuracy for people.

#include "accuracy/measure.hpp"

#include <string>

namespace stoss::client::cli {

/// What was compared, the table of methods, the table of horizons and the notes.
[[nodiscard]] std::string accuracy_text(const accuracy::Report& report);

}  // namespace stoss::client::cli

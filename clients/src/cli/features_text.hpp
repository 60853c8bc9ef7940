// SPDX-License-Identifier: Apache-2.0
#pragma once

// What this program's engine can do, from the engine's own tables.

#include <string>

namespace stoss::client::cli {

/// Effects with their numbers and ranges, combinations, limits; for people.
[[nodiscard]] std::string features_text();
/// The same as one JSON object on one line.
[[nodiscard]] std::string features_json();

}  // namespace stoss::client::cli

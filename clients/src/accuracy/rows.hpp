// SPDX-License-Identifier: Apache-2.0
#pragma once

// A report as rows of named values, one for each method and instant: what the CSV file and --json
// hold. What is not known is left out.

#include "accuracy/measure.hpp"

#include <string>
#include <vector>

namespace stoss::client::accuracy {

/// The columns, in order. Units are the last part of a name: _s, _m; none: a plain number.
[[nodiscard]] const std::vector<std::string>& column_names();

/// A header line and a line for each row, as RFC 4180 with bare line feeds.
[[nodiscard]] std::string csv_text(const Report& report);

/// The same rows as JSON objects, one a line; numbers that are not finite are strings.
[[nodiscard]] std::string json_lines(const Report& report);

}  // namespace stoss::client::accuracy

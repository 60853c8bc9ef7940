// SPDX-License-Identifier: Apache-2.0
// Numbers and instants as people write them. Instants are converted exactly: never through a
// double.
#pragma once

#include <stoss/engine/instant.hpp>
#include <stoss/engine/types.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stoss::client {

/// Reads an instant or a duration in seconds: a decimal number ("1.5", "-0.25", "3e-9"), rounded
/// once to the nearest 2^-64 s (halves away from zero), or "SECONDS:FRACTION" with the fraction in
/// units of 2^-64 s. Nothing when it is neither, or beyond the end of time.
[[nodiscard]] std::optional<engine::Instant> parse_instant(std::string_view text);

/// The shortest decimal number of seconds that parse_instant() reads back to the same instant.
[[nodiscard]] std::string format_instant(const engine::Instant& instant);

/// Reads a whole text as a double ("inf" and "nan" included), ignoring blanks around it.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Reads a whole text as a number without sign.
[[nodiscard]] std::optional<std::uint64_t> parse_count(std::string_view text);

/// Reads "X,Y".
[[nodiscard]] std::optional<engine::Vector2> parse_vector(std::string_view text);

/// The shortest text that reads back to the same double.
[[nodiscard]] std::string format_number(double value);

}  // namespace stoss::client

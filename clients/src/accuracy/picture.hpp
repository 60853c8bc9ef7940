// SPDX-License-Identifier: Apache-2.0
#pragma once

// A report as a picture of four panels, drawn by gnuplot: work and precision, growth of the error,
// horizon against digits, energy error against collisions. Colours are those of Okabe and Ito, and
// every method has a marker and a line of its own, so that no colour need be seen.

#include "accuracy/measure.hpp"

#include <string>

namespace stoss::client::accuracy {

/// Whether `path` ends in .svg or .png.
[[nodiscard]] bool is_picture_path(const std::string& path);

/// Whether gnuplot can be run.
[[nodiscard]] bool has_gnuplot();

/// What gnuplot is told. REQUIRES: is_picture_path(path)
[[nodiscard]] std::string picture_script(const Report& report, const std::string& path);

/// Writes the picture. Throws std::runtime_error when gnuplot or the file cannot be had.
void draw(const Report& report, const std::string& path);

}  // namespace stoss::client::accuracy

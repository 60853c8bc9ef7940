// SPDX-License-Identifier: Apache-2.0
#pragma once

// The equation of state of hard disks by its virial series.
// Source: Clisby, McCoy, J. Stat. Phys. 122 (2006) 15.

#include <array>

namespace stoss::test {

/// Z = p / (n k T) and what of it depends on the area fraction y.
struct EquationOfState {
  double excess = 0;     ///< Z - 1
  double stiffness = 0;  ///< d(y Z)/dy, one over the structure factor at zero
  double bending = 0;    ///< y^2 h'' / h for h = y (Z - 1): 2 in a dilute gas
};

/// To the tenth coefficient; Z is good to 1e-5 up to area fraction 0.2 and 3e-4 at 0.3.
inline EquationOfState virial_series(double area_fraction) {
  constexpr std::array<double, 9> kReduced{1,
                                           0.7820044379,
                                           0.5322318071,
                                           0.33355604,
                                           0.1988425,
                                           0.1148728,
                                           0.0649930,
                                           0.0362193,
                                           0.0199537};
  EquationOfState state{.excess = 0, .stiffness = 1, .bending = 0};
  double power = 1;
  double bending = 0;
  for (std::size_t i = 0; i < kReduced.size(); ++i) {
    power *= 2 * area_fraction;
    const double term = kReduced[i] * power;
    const auto order = static_cast<double>(i + 1);
    state.excess += term;
    state.stiffness += (order + 1) * term;
    bending += order * (order + 1) * term;
  }
  state.bending = bending / state.excess;
  return state;
}

}  // namespace stoss::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Box2D and Chipmunk, set up to be as exact as they can be: no friction, full restitution at every
// speed, nothing sleeps, every disk is looked after as a bullet where there is such a thing.

#include "accuracy/method.hpp"

#include <vector>

namespace stoss::tests {

/// One method for each step (s). `bodies` must outlive the methods.
[[nodiscard]] std::vector<client::accuracy::Method> box2d_methods(
    const translate::SceneBodies& bodies, const std::vector<double>& steps);
[[nodiscard]] std::vector<client::accuracy::Method> chipmunk_methods(
    const translate::SceneBodies& bodies, const std::vector<double>& steps);

}  // namespace stoss::tests

// SPDX-License-Identifier: Apache-2.0
// Helpers that reading and checking scenes share.
#pragma once

#include <stoss/idl/scene_file.hpp>

#include <scene.pb.h>

#include <string>

namespace stoss::idl {

/// Fills in the id and the name of the body that error.field lies in, if it lies in one.
void name_body(const Scene& scene, SceneError& error);

}  // namespace stoss::idl

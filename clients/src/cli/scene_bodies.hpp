// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stoss/translate/scene.hpp>

#include <string>

namespace stoss::client::cli {

/// A scene file as it is. Throws RefusedError, which names the file, the field and the body.
[[nodiscard]] Scene scene_in(const std::string& path);

/// Reads a scene file. Throws RefusedError, which names the file, the field and the body.
[[nodiscard]] translate::SceneBodies scene_bodies(const std::string& path);

/// Throws RefusedError (UNIMPLEMENTED) for a scene with effects; `who`: what does not know them.
void refuse_effects(const translate::SceneBodies& bodies, const std::string& who);

}  // namespace stoss::client::cli

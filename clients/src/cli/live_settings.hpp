// SPDX-License-Identifier: Apache-2.0
#pragma once

// The effects of a running world, and whether a scene's are the same.

#include <stoss/client/session.hpp>
#include <stoss/engine/features.hpp>
#include <stoss/translate/scene.hpp>

#include <vector>

namespace stoss::client::cli {

/// The numbers of the effects that are on in the world. Throws RefusedError or NoAnswerError.
[[nodiscard]] std::vector<engine::EffectSetting> live_settings(Session& session);

/// Throws RefusedError (FAILED_PRECONDITION), which names the first field of the scene's period and
/// effects that is another in the world. What the scene leaves out is as the world has it, and so
/// are the seeds of random effects.
void refuse_differences(const translate::SceneBodies& scene, Session& session);

}  // namespace stoss::client::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

// `stoss load`: a scene's bodies brought into a running world.

#include "cli/common.hpp"

#include <string>

namespace stoss::client::cli {

struct LoadOptions {
  std::string scene;
  std::string at;
  bool new_ids = false;      ///< the world assigns ids, whatever the file says
  bool bodies_only = false;  ///< whatever period and effects the file asks for
};

/// Refuses a scene whose period or effects are not the world's, see refuse_differences(). Sends the
/// bodies in commands of at most kCommandBodiesMax; each is taken in whole or not at all. Stops at
/// the first refusal. Throws RefusedError, which says how many bodies are in.
void load(const GlobalOptions& global, const LoadOptions& options);

}  // namespace stoss::client::cli

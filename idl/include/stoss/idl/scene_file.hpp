// SPDX-License-Identifier: Apache-2.0
// Scenes in files: reading, checking, writing.
#pragma once

#include <stoss/idl/types.hpp>

#include <scene.pb.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stoss::idl {

/// How a scene is written, told by the file's extension: .json, .textproto, .binpb.
enum class SceneFormat { kJson, kText, kBinary };

/// Why a scene was not read or not written. Enough to find the place and mend it.
struct SceneError {
  Code code = Code::kInvalidArgument;
  std::string file;
  std::size_t line = 0;    // from 1; 0 when not known
  std::size_t column = 0;  // from 1; 0 when not known
  std::string field;       // as "disks[3].radius"; empty when the file as a whole is at fault
  std::uint64_t id = 0;    // of the body that holds the field, 0 if none is given
  std::string body;        // its name, or empty
  std::string reason;      // what is wrong and what would be right

  /// All of it in one line, as "box.json:12:5: disks[3].radius (id 7, \"red\"): must be ...".
  [[nodiscard]] std::string message() const;
};

/// The format that a path's extension names, if it names one.
[[nodiscard]] std::optional<SceneFormat> scene_format(const std::filesystem::path& path);

/// Reads a scene and checks all that can be checked without a world: unknown and missing fields,
/// numbers that are not finite or out of range, ids given twice. Overlaps and effects are the
/// engine's to judge.
[[nodiscard]] std::variant<Scene, SceneError> load_scene(const std::filesystem::path& path);

/// The same, from text in memory; `file` is only for messages.
[[nodiscard]] std::variant<Scene, SceneError> parse_scene(std::string_view content,
                                                          SceneFormat format,
                                                          const std::string& file);

/// The checks alone, for a scene that did not come from a file.
[[nodiscard]] std::optional<SceneError> check_scene(const Scene& scene);

/// Writes a scene in the format that the extension names, to a new file that then takes the old
/// one's place. Nothing on success.
[[nodiscard]] std::optional<SceneError> save_scene(const Scene& scene,
                                                   const std::filesystem::path& path);

/// The names of the effects that are on, as "restitution", in the order of the Effects message.
[[nodiscard]] std::vector<std::string> effect_names(const Scene& scene);

}  // namespace stoss::idl

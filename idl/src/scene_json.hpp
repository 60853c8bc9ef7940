// SPDX-License-Identifier: Apache-2.0
// The canonical Protobuf JSON mapping, read strictly and with places in the text.
//
// The library's own reader takes a second for 100,000 disks, tells no lines, and lets pass what is
// no JSON (keys without quotes, commas before a closing bracket, an object for a list). This one
// takes the same well-formed input to the same message, which its test checks against the library.
#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stoss::idl {

/// Where in a JSON text, and in which field, something is.
struct JsonPlace {
  std::size_t offset = 0;
  std::string field;  // as "disks[3].radius"
};

/// Why a text could not be read.
struct JsonError {
  JsonPlace place;
  std::string reason;
};

/// Reads `text` into `message`, which is empty. Nothing on success; on an error `message` holds
/// what came before it. Lists, messages, enumerations, strings, booleans, numbers; no maps, bytes
/// or any-types.
[[nodiscard]] std::optional<JsonError> read_json(std::string_view text,
                                                 google::protobuf::Message& message);

/// The offset of the value of `field` in a text that read_json reads; the innermost enclosing
/// value's where the field itself is absent.
[[nodiscard]] std::size_t locate_json(std::string_view text,
                                      const google::protobuf::Message& prototype,
                                      const std::string& field);

}  // namespace stoss::idl

// SPDX-License-Identifier: Apache-2.0
// Answers cut into chunks that travel as one datagram each.
#pragma once

#include "collision_port.hpp"
#include "picture.hpp"
#include "records.hpp"
#include "zone_port.hpp"

#include <stoss/translate/columns.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stoss::service {

/// The content of an answer. Its arrays are lent to the samples, so it must outlive their writing.
class AnswerContent {
 public:
  AnswerContent() = default;
  AnswerContent(const AnswerContent&) = delete;
  AnswerContent& operator=(const AnswerContent&) = delete;
  virtual ~AnswerContent() = default;
  /// At least 1.
  [[nodiscard]] virtual std::uint32_t chunks() const = 0;
  /// Points the blocks of a zeroed sample at the rows of a chunk.
  virtual void fill(std::uint32_t chunk, wire::Answer& answer) = 0;
};

[[nodiscard]] std::shared_ptr<AnswerContent> make_content(engine::Reject reject);
[[nodiscard]] std::shared_ptr<AnswerContent> make_content(Rows rows);
[[nodiscard]] std::shared_ptr<AnswerContent> make_content(std::vector<std::string> features);
[[nodiscard]] std::shared_ptr<AnswerContent> make_content(const wire::Status& status);

/// Every state, from the picture.
[[nodiscard]] std::shared_ptr<AnswerContent> list_content(const Picture& picture);
/// The whole exact world: every stored motion, and what does not change of every body.
[[nodiscard]] std::shared_ptr<AnswerContent> world_content(const Picture& picture);
/// Collisions from `first` on, at most `count` (0: all there are). Errors: those that are no longer
/// kept are NotFound.
[[nodiscard]] std::shared_ptr<AnswerContent> collisions_content(const CollisionPort& port,
                                                                std::uint64_t first,
                                                                std::uint64_t count);

/// Zone events, likewise.
[[nodiscard]] std::shared_ptr<AnswerContent> zone_events_content(const ZonePort& port,
                                                                 std::uint64_t first,
                                                                 std::uint64_t count);

}  // namespace stoss::service

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Requests as samples, and samples as answers.

#include <stoss/client/command.hpp>
#include <stoss/client/query.hpp>
#include <stoss/client/result.hpp>
#include <stoss/idl/types.hpp>
#include <stoss/translate/columns.hpp>
#include <stoss/translate/command.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace stoss::client {

/// A command as a sample, with the arrays that the sample points at. Neither copied nor moved.
class EncodedCommand {
 public:
  EncodedCommand(const translate::CommandSpec& spec, const translate::RequestId& request);
  EncodedCommand(const EncodedCommand&) = delete;
  EncodedCommand& operator=(const EncodedCommand&) = delete;
  [[nodiscard]] const idl::wire::Command& sample() const { return sample_; }

 private:
  idl::wire::Command sample_{};
  std::vector<std::uint64_t> ids_;
  std::vector<double> x_;
  std::vector<double> y_;
  translate::DiskColumns disks_;
  translate::WallColumns walls_;
  translate::ZoneColumns zones_;
  std::vector<idl::wire::Name> names_;
};

/// Why a command cannot even be sent: more bodies or longer names than the type has room for.
[[nodiscard]] std::optional<engine::Reject> too_large(const translate::CommandSpec& spec);
[[nodiscard]] std::optional<engine::Reject> too_large(const Query& query);

/// A query as a sample; its ids are those of `query`, which must outlive the write.
[[nodiscard]] idl::wire::Query encode(const Query& query, const translate::RequestId& request);

/// A reply in this library's words: its value, or the refusal in it.
[[nodiscard]] Result<Reply> decode(const idl::wire::Reply& reply);

/// One chunk of an answer. Errors: Internal when its arrays contradict each other.
[[nodiscard]] engine::Outcome<Answer> decode(const idl::wire::Answer& answer);

/// Appends a later chunk's content to that of earlier ones.
void append(Answer& to, Answer&& chunk);

}  // namespace stoss::client
